//! Colours, dashes and markers that are told apart by colour-blind eyes and in grey.
//!
//! Colours: M. Okabe, K. Ito, "Color Universal Design", 2008, without the yellow, which fades on white. Scale of
//! continuous values: viridis (S. van der Walt, N. Smith, matplotlib 1.5, 2015), perceptually even and monotone in lightness.

use plotters::style::RGBColor;

/// Colours of series.
pub(super) const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// Lengths of strokes and gaps \[px\], in turn; solid without any.
pub(super) const DASHES: [&[f64]; 7] = [
    &[],
    &[9.0, 5.0],
    &[2.5, 4.0],
    &[10.0, 4.0, 2.5, 4.0],
    &[18.0, 5.0],
    &[5.0, 3.0],
    &[10.0, 3.0, 2.5, 3.0, 2.5, 3.0],
];

/// Fill colours of a map's classes, each of another lightness.
pub(super) const CLASSES: [RGBColor; 6] = [
    RGBColor(86, 180, 233),
    RGBColor(213, 94, 0),
    RGBColor(240, 228, 66),
    RGBColor(40, 40, 40),
    RGBColor(204, 121, 167),
    RGBColor(0, 158, 115),
];

pub(super) const WHITE: RGBColor = RGBColor(255, 255, 255);
/// Axes and their labels.
pub(super) const INK: RGBColor = RGBColor(38, 38, 38);
/// References without a colour of their own.
pub(super) const GREY: RGBColor = RGBColor(100, 100, 100);
pub(super) const GRID: RGBColor = RGBColor(217, 217, 217);
pub(super) const FINE_GRID: RGBColor = RGBColor(238, 238, 238);

/// Viridis at every eighth of its length.
const VIRIDIS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 45.0, 123.0],
    [59.0, 82.0, 139.0],
    [44.0, 114.0, 142.0],
    [33.0, 145.0, 140.0],
    [40.0, 174.0, 128.0],
    [94.0, 201.0, 98.0],
    [173.0, 220.0, 48.0],
    [253.0, 231.0, 37.0],
];

/// Colour of a share in \[0, 1\].
pub(super) fn continuous(share: f64) -> RGBColor {
    let place = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let below = (place.floor() as usize).min(VIRIDIS.len() - 2);
    let part = place - below as f64;
    let mixed = |k: usize| ((1.0 - part) * VIRIDIS[below][k] + part * VIRIDIS[below + 1][k]).round() as u8;
    RGBColor(mixed(0), mixed(1), mixed(2))
}
