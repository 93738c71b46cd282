//! A drawing in px: lines, areas and texts, in the colours of the charts.

use crate::draw::canvas::{Canvas, Stroke, TEXT, text_width};
use crate::palette::{Colour, DASHES, GREY, INK, PALETTE};

/// What a line or an area is drawn with; each has its colour in the [dark style](crate::dark_style).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// That of axes and texts.
    Dark,
    /// That of references.
    Grey,
    /// That of the `index`-th series, from 0.
    Series(usize),
}

impl Ink {
    fn colour(self) -> Colour {
        match self {
            Self::Dark => INK,
            Self::Grey => GREY,
            Self::Series(index) => PALETTE[index % PALETTE.len()],
        }
    }
}

/// What of a text lies at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// A drawing of something that is no chart: a plan, a section. Places are px from the upper left corner, y downward.
///
/// ```
/// use plain_figure::{Anchor, Drawing, Ink};
///
/// let mut drawing = Drawing::new("A duct", (200.0, 80.0));
/// drawing.line(&[(20.0, 40.0), (180.0, 40.0)], Ink::Series(0), 4.0);
/// drawing.text("250 m", (100.0, 60.0), Anchor::Middle);
/// assert!(drawing.to_svg().contains("<title>A duct</title>"));
/// ```
#[derive(Debug)]
#[must_use]
pub struct Drawing(Canvas);

/// Size of a title \[px\], that of charts.
const TITLE: f64 = 16.0;

impl Drawing {
    /// Height of a line of text \[px\].
    pub const LINE: f64 = 1.3 * TEXT;

    /// An empty drawing of this width and height \[px\]; readers who cannot see it get its `name`.
    pub fn new(name: &str, size: (f64, f64)) -> Self {
        Self(Canvas::new(name, size))
    }

    /// A line through the points, `width` px wide.
    pub fn line(&mut self, points: &[(f64, f64)], ink: Ink, width: f64) {
        self.0.line(points, Stroke::solid(ink.colour(), width));
    }

    /// A thin dashed line through the points.
    pub fn dashed(&mut self, points: &[(f64, f64)], ink: Ink) {
        let dash = DASHES[2];
        let stroke = Stroke {
            dash,
            ..Stroke::solid(ink.colour(), 1.0)
        };
        self.0.line(points, stroke);
    }

    /// A filled polygon; `opacity` in \[0, 1\].
    pub fn area(&mut self, points: &[(f64, f64)], ink: Ink, opacity: f64) {
        self.0.area(points, ink.colour(), opacity);
    }

    /// A text, its middle height at `at`.
    pub fn text(&mut self, text: &str, at: (f64, f64), anchor: Anchor) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.0.text(text, at, anchor);
    }

    /// A bold text centred at `at`.
    pub fn title(&mut self, text: &str, at: (f64, f64)) {
        self.0.bold(text, at, TITLE);
    }

    /// About the width of a text \[px\], rather too much.
    pub fn text_width(text: &str) -> f64 {
        text_width(text, TEXT)
    }

    /// The drawing as an SVG.
    pub fn to_svg(self) -> String {
        self.0.finish()
    }
}
