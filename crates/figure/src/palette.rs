//! Colours and dashes that are told apart by colour-blind eyes and in grey, and their dark theme.
//!
//! Colours: M. Okabe, K. Ito, "Color Universal Design", 2008, without the yellow, which fades on white. Scale of
//! continuous values: viridis (S. van der Walt, N. Smith, matplotlib 1.5, 2015), perceptually even and monotone in lightness.

/// Red, green and blue, a byte each.
pub(crate) type Colour = u32;

pub(crate) const PALETTE: [Colour; 7] = [0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, BLACK];

/// Lengths of strokes and gaps \[px\], in turn; solid without any.
pub(crate) const DASHES: [&str; 7] = [
    "",
    "9 5",
    "2.5 4",
    "10 4 2.5 4",
    "18 5",
    "5 3",
    "10 3 2.5 3 2.5 3",
];

/// Fill colours of classes, each of another lightness.
const CLASSES: [Colour; 6] = [0x56B4E9, 0xD55E00, 0xF0E442, 0x282828, 0xCC79A7, 0x009E73];

pub(crate) const WHITE: Colour = 0xFFFFFF;
const BLACK: Colour = 0x000000;
/// Axes and their labels.
pub(crate) const INK: Colour = 0x262626;
/// References without a colour of their own.
pub(crate) const GREY: Colour = 0x646464;
pub(crate) const GRID: Colour = 0xD9D9D9;

/// On a dark page: the same hues, light enough to stand out from the ground and from each other.
const DARK_PALETTE: [Colour; 7] = [
    0x4DABE6, 0xFF9141, 0x3CC8A0, 0xE6A0C8, 0xF0BE50, 0x96D2F5, 0xEBEBEB,
];
const OTHERS: [Colour; 4] = [WHITE, INK, GREY, GRID];
const DARK_OTHERS: [Colour; 4] = [0x16191D, 0xE1E4E8, 0xA5AAB0, 0x3E434A];

/// Viridis at every eighth of its length.
const VIRIDIS: [Colour; 9] = [
    0x440154, 0x472D7B, 0x3B528B, 0x2C728E, 0x21918C, 0x28AE80, 0x5EC962, 0xADDC30, 0xFDE725,
];

/// Rules of CSS that give charts inside an HTML page the colours of a dark theme, for a block such as
/// `@media screen and (prefers-color-scheme: dark) { … }`. Cells coloured by value keep their colours.
///
/// A figure states its colours in attributes, which any rule of a style sheet overrides, so that the SVG itself stays the same.
///
/// ```
/// let style = plain_figure::dark_style();
/// assert!(style.contains("svg [fill=\"#FFFFFF\"]{fill:#16191D}"));
/// ```
pub fn dark_style() -> String {
    let rule = |(light, dark): (Colour, Colour)| {
        ["fill", "stroke"]
            .map(|property| format!("svg [{property}=\"#{light:06X}\"]{{{property}:#{dark:06X}}}\n"))
    };
    let palette = PALETTE.into_iter().zip(DARK_PALETTE);
    let others = OTHERS.into_iter().zip(DARK_OTHERS);
    palette.chain(others).flat_map(rule).collect()
}

/// Fill colour of the `index`-th class.
pub(crate) fn class_colour(index: usize) -> Colour {
    CLASSES[index % CLASSES.len()]
}

/// Colour of a share in \[0, 1\].
pub(crate) fn continuous(share: f64) -> Colour {
    let place = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let below = (place.floor() as usize).min(VIRIDIS.len() - 2);
    let part = place - below as f64;
    let mixed = |shift: u32| {
        let channel = |k: usize| f64::from(VIRIDIS[k] >> shift & 0xFF);
        (((1.0 - part) * channel(below) + part * channel(below + 1)).round() as u32) << shift
    };
    mixed(16) | mixed(8) | mixed(0)
}
