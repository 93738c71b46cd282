//! A drawing in px: lines, areas and texts, in the colours of the charts, as elements of an SVG.

use crate::error::FigureError;
use crate::palette::{Colour, GREY, INK, PALETTE, WHITE};

/// Size of letters, and of those of titles \[px\].
pub(crate) const TEXT: f64 = 14.0;
pub(crate) const TITLE: f64 = 16.0;
/// Width of a letter as a share of the font's size, rather too much.
const LETTER: f64 = 0.6;

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

/// A point \[px\], y downward.
pub(crate) type Point = (f64, f64);

/// A rectangle \[px\], y downward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rect {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Rect {
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub fn centre(&self) -> Point {
        (0.5 * (self.left + self.right), 0.5 * (self.top + self.bottom))
    }

    pub fn corners(&self) -> [Point; 4] {
        let [low, high] = [self.top, self.bottom].map(|y| [(self.left, y), (self.right, y)]);
        [low[0], low[1], high[1], high[0]]
    }

    pub fn between((left, top): Point, (right, bottom): Point) -> Self {
        Self {
            left,
            top,
            right,
            bottom,
        }
    }

    /// Of so much width and height to either side of a point.
    pub fn around((x, y): Point, half_width: f64, half_height: f64) -> Self {
        Self::between(
            (x - half_width, y - half_height),
            (x + half_width, y + half_height),
        )
    }

    /// Whether a point lies inside or on the border, up to the last digits.
    pub fn holds(&self, (x, y): Point) -> bool {
        let within = |low: f64, value, high: f64| (low - 1e-6..=high + 1e-6).contains(&value);
        within(self.left, x, self.right) && within(self.top, y, self.bottom)
    }
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Stroke {
    pub colour: Colour,
    pub width: f64,
    /// Lengths of strokes and gaps \[px\], in turn; solid without any.
    pub dash: &'static str,
}

impl Stroke {
    pub const fn solid(colour: Colour, width: f64) -> Self {
        let dash = "";
        Self { colour, width, dash }
    }

    fn attributes(&self) -> String {
        let Self { colour, width, dash } = self;
        let stroke = format!("stroke=\"#{colour:06X}\" stroke-width=\"{width}\"");
        if dash.is_empty() {
            return stroke;
        }
        format!("{stroke} stroke-dasharray=\"{dash}\"")
    }
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
pub struct Drawing {
    name: String,
    pub(crate) size: Point,
    elements: String,
}

impl Drawing {
    /// Height of a line of text \[px\].
    pub const LINE: f64 = 1.3 * TEXT;

    /// An empty drawing of this width and height \[px\] on white; readers who cannot see it get its `name`.
    pub fn new(name: &str, size: (f64, f64)) -> Self {
        let (name, elements) = (escaped(name), String::new());
        Self { name, size, elements }
    }

    /// A line through the points, `width` px wide.
    pub fn line(&mut self, points: &[(f64, f64)], ink: Ink, width: f64) {
        self.stroke(points, Stroke::solid(ink.colour(), width));
    }

    /// A filled polygon; `opacity` in \[0, 1\].
    pub fn area(&mut self, points: &[(f64, f64)], ink: Ink, opacity: f64) {
        self.fill(points, ink.colour(), opacity);
    }

    /// A text, its middle height at `at`.
    pub fn text(&mut self, text: &str, at: (f64, f64), anchor: Anchor) {
        self.write(text, at, anchor, INK, TEXT, "");
    }

    /// A bold text centred at `at`.
    pub fn title(&mut self, text: &str, at: (f64, f64)) {
        self.write(text, at, Anchor::Middle, INK, TITLE, " font-weight=\"bold\"");
    }

    /// About the width of a text \[px\], rather too much: the program that shows an SVG chooses the font.
    pub fn text_width(text: &str) -> f64 {
        // CJK and full-width forms are as wide as high.
        let letter = |letter| match letter {
            '\u{2e80}'..='\u{9fff}'
            | '\u{ac00}'..='\u{d7a3}'
            | '\u{f900}'..='\u{faff}'
            | '\u{ff00}'..='\u{ff60}' => 1.0,
            _ => LETTER,
        };
        TEXT * text.chars().map(letter).sum::<f64>()
    }

    /// The drawing as an SVG.
    pub fn to_svg(self) -> String {
        let Self { name, size, elements } = self;
        let (width, height) = (tenths(size.0), tenths(size.1));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\">\n<title>{name}</title>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#{WHITE:06X}\"/>\n{elements}</svg>\n"
        )
    }

    pub(crate) fn stroke(&mut self, points: &[Point], stroke: Stroke) {
        let style = format!("fill=\"none\" {}", stroke.attributes());
        self.shape("polyline", points, &style);
    }

    pub(crate) fn fill(&mut self, points: &[Point], colour: Colour, opacity: f64) {
        let style = format!("fill=\"#{colour:06X}\" opacity=\"{opacity}\"");
        self.shape("polygon", points, &style);
    }

    pub(crate) fn outlined(&mut self, points: &[Point], colour: Colour, stroke: Stroke) {
        let style = format!("fill=\"#{colour:06X}\" {}", stroke.attributes());
        self.shape("polygon", points, &style);
    }

    pub(crate) fn circle(&mut self, (x, y): Point, radius: f64, colour: Colour, stroke: Stroke) {
        let (x, y, stroke) = (tenths(x), tenths(y), stroke.attributes());
        let fill = format!("fill=\"#{colour:06X}\" {stroke}");
        self.element(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius:.1}\" {fill}/>"
        ));
    }

    pub(crate) fn rectangle(&mut self, rect: Rect, colour: Colour, opacity: f64) {
        self.fill(&rect.corners(), colour, opacity);
    }

    /// What is drawn by `draw` is cut off at the border of `rect`.
    pub(crate) fn clipped(&mut self, rect: Rect, draw: impl FnOnce(&mut Self)) {
        let [x, y, width, height] = [rect.left, rect.top, rect.width(), rect.height()].map(tenths);
        let size = format!("width=\"{width}\" height=\"{height}\"");
        self.element(&format!(
            "<svg x=\"{x}\" y=\"{y}\" {size} viewBox=\"{x} {y} {width} {height}\">"
        ));
        draw(self);
        self.element("</svg>");
    }

    /// A text that runs upward, centred at `at`.
    pub(crate) fn upward(&mut self, text: &str, at: Point) {
        let turned = format!(" transform=\"rotate(270 {} {})\"", tenths(at.0), tenths(at.1));
        self.write(text, at, Anchor::Middle, INK, TEXT, &turned);
    }

    /// A text centred at `at` on a white ground that lets what it covers shine through.
    pub(crate) fn text_on_white(&mut self, text: &str, at: Point, colour: Colour) {
        let ground = Rect::around(at, 0.5 * Self::text_width(text) + 2.0, 0.62 * TEXT);
        self.rectangle(ground, WHITE, 0.75);
        self.write(text, at, Anchor::Middle, colour, TEXT, "");
    }

    fn write(&mut self, text: &str, (x, y): Point, anchor: Anchor, colour: Colour, size: f64, more: &str) {
        let (x, y, text) = (tenths(x), tenths(y), escaped(text));
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.element(&format!(
            "<text x=\"{x}\" y=\"{y}\" dy=\"0.35em\" text-anchor=\"{anchor}\" font-size=\"{size}\" \
             fill=\"#{colour:06X}\"{more}>{text}</text>"
        ));
    }

    fn element(&mut self, element: &str) {
        self.elements += element;
        self.elements += "\n";
    }

    fn shape(&mut self, tag: &str, points: &[Point], style: &str) {
        let point = |(x, y): &Point| format!("{},{}", tenths(*x), tenths(*y));
        let points: Vec<String> = points.iter().map(point).collect();
        self.element(&format!("<{tag} points=\"{}\" {style}/>", points.join(" ")));
    }
}

/// Rounded to a tenth of a px, which no eye sees; without the sign of zero.
fn tenths(length: f64) -> f64 {
    (10.0 * length).round() / 10.0 + 0.0
}

/// Text for SVG and HTML, in elements and in attributes; characters that have no place in a text become a replacement mark.
pub fn escaped(text: &str) -> String {
    let unknown = |letter: char| letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}');
    text.replace(['\n', '\t'], " ")
        .replace(unknown, "\u{fffd}")
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&apos;")
}

/// An error where `text` needs more than its room \[px\].
pub(crate) fn check_room(text: &str, needed: f64, room: f64) -> Result<(), FigureError> {
    if needed <= room {
        return Ok(());
    }
    let text = text.to_owned();
    Err(FigureError::NoRoom { text, needed, room })
}
