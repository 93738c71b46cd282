//! Figures on a dark page.
//!
//! A figure says its colours in attributes of its elements, which any rule of a style sheet overrules. So the page that holds the
//! figure needs rules only, and the SVG stays what it is. Dark colours are the light ones of the same hue, light enough to be
//! told from the ground and from each other.

use std::fmt::Write;

use plotters::style::RGBColor;

use super::palette::{FINE_GRID, GREY, GRID, INK, PALETTE, WHITE};

/// The ground of a dark page.
const GROUND: RGBColor = RGBColor(22, 25, 29);
/// Colours of series, in the order of the palette.
const SERIES: [RGBColor; 7] = [
    RGBColor(77, 171, 230),
    RGBColor(255, 145, 65),
    RGBColor(60, 200, 160),
    RGBColor(230, 160, 200),
    RGBColor(240, 190, 80),
    RGBColor(150, 210, 245),
    RGBColor(235, 235, 235),
];
/// The rest.
const OTHERS: [(RGBColor, RGBColor); 5] = [
    (WHITE, GROUND),
    (INK, RGBColor(225, 228, 232)),
    (GREY, RGBColor(165, 170, 176)),
    (GRID, RGBColor(62, 67, 74)),
    (FINE_GRID, RGBColor(40, 44, 50)),
];

/// Rules of CSS that give charts in a page, as SVG elements, the colours of a dark theme; for a block such as
/// `@media screen and (prefers-color-scheme: dark) { … }`. Cells of maps keep their colours.
///
/// ```
/// let style = creepage::figure::dark_style();
/// assert!(style.contains("svg [fill=\"#FFFFFF\"]{fill:#16191D}"));
/// ```
pub fn dark_style() -> String {
    let mut style = String::new();
    for (light, dark) in PALETTE.into_iter().zip(SERIES).chain(OTHERS) {
        for property in ["fill", "stroke"] {
            let (light, dark) = (hex(light), hex(dark));
            // Writing to a String does not fail.
            let _ = writeln!(style, "svg [{property}=\"{light}\"]{{{property}:{dark}}}");
        }
    }
    style
}

fn hex(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}
