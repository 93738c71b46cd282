//! Lines, areas and texts as elements of an SVG, in px.

use std::fmt::Write;

use crate::error::FigureError;
use crate::palette::{Colour, INK, WHITE};

/// Size of letters \[px\].
pub const TEXT: f64 = 14.0;
/// Width of a letter as a share of the font's size, rather too much.
const LETTER: f64 = 0.6;

/// A point \[px\], y downward.
pub type Point = (f64, f64);

/// A rectangle \[px\], y downward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
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

    /// Of so much width and height to either side of a point.
    pub fn around(centre: Point, half_width: f64, half_height: f64) -> Self {
        Self {
            left: centre.0 - half_width,
            top: centre.1 - half_height,
            right: centre.0 + half_width,
            bottom: centre.1 + half_height,
        }
    }

    /// Whether a point lies inside or on the border, up to the last digits.
    pub fn holds(&self, (x, y): Point) -> bool {
        let within = |low: f64, value, high: f64| (low - 1e-6..=high + 1e-6).contains(&value);
        within(self.left, x, self.right) && within(self.top, y, self.bottom)
    }
}

#[derive(Debug, Clone, Copy)]
pub struct Stroke {
    pub colour: Colour,
    pub width: f64,
    /// Lengths of strokes and gaps \[px\], in turn; solid without any.
    pub dash: &'static [f64],
}

impl Stroke {
    pub const fn solid(colour: Colour, width: f64) -> Self {
        let dash = &[];
        Self { colour, width, dash }
    }

    fn attributes(&self) -> String {
        let Self { colour, width, dash } = self;
        let stroke = format!("stroke=\"#{colour:06X}\" stroke-width=\"{width}\"");
        if dash.is_empty() {
            return stroke;
        }
        let lengths: Vec<String> = dash.iter().map(f64::to_string).collect();
        format!("{stroke} stroke-dasharray=\"{}\"", lengths.join(" "))
    }
}

#[derive(Debug)]
pub struct Canvas(String);

impl Canvas {
    /// A white ground of `size` \[px\]; readers who cannot see it get its `name`.
    pub fn new(name: &str, size: Point) -> Self {
        let (width, height) = (tenths(size.0), tenths(size.1));
        Self(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\">\n<title>{}</title>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#{WHITE:06X}\"/>\n",
            escaped(name)
        ))
    }

    pub fn finish(self) -> String {
        self.0 + "</svg>\n"
    }

    pub fn line(&mut self, points: &[Point], stroke: Stroke) {
        let style = format!("fill=\"none\" {}", stroke.attributes());
        self.shape("polyline", points, &style);
    }

    /// A filled polygon; `opacity` in \[0, 1\].
    pub fn area(&mut self, points: &[Point], colour: Colour, opacity: f64) {
        let style = format!("fill=\"#{colour:06X}\" opacity=\"{opacity}\"");
        self.shape("polygon", points, &style);
    }

    pub fn outlined(&mut self, points: &[Point], colour: Colour, stroke: Stroke) {
        let style = format!("fill=\"#{colour:06X}\" {}", stroke.attributes());
        self.shape("polygon", points, &style);
    }

    pub fn circle(&mut self, (x, y): Point, radius: f64, colour: Colour, stroke: Stroke) {
        let (x, y, stroke) = (tenths(x), tenths(y), stroke.attributes());
        let fill = format!("fill=\"#{colour:06X}\" {stroke}");
        let _ = writeln!(self.0, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius:.1}\" {fill}/>");
    }

    /// What is drawn by `draw` is cut off at the border of `rect`.
    pub fn clipped(&mut self, rect: Rect, draw: impl FnOnce(&mut Self)) {
        let (left, top) = (tenths(rect.left), tenths(rect.top));
        let (width, height) = (tenths(rect.width()), tenths(rect.height()));
        let _ = writeln!(
            self.0,
            "<svg x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" viewBox=\"{left} {top} {width} {height}\">"
        );
        draw(self);
        self.0.push_str("</svg>\n");
    }

    pub fn rectangle(&mut self, rect: Rect, colour: Colour, opacity: f64) {
        self.area(&rect.corners(), colour, opacity);
    }

    /// A text whose middle height is at `at`; `anchor`, in SVG's words, is what lies there: its "start", "middle" or "end".
    pub fn text(&mut self, text: &str, at: Point, anchor: &str) {
        self.write(text, at, anchor, INK, TEXT, "");
    }

    /// A bold text of `size`, centred at `at`.
    pub fn bold(&mut self, text: &str, at: Point, size: f64) {
        self.write(text, at, "middle", INK, size, " font-weight=\"bold\"");
    }

    /// A text that runs upward, centred at `at`.
    pub fn upward(&mut self, text: &str, at: Point) {
        let turned = format!(" transform=\"rotate(270 {} {})\"", tenths(at.0), tenths(at.1));
        self.write(text, at, "middle", INK, TEXT, &turned);
    }

    /// A text centred at `at` on a white ground that lets what it covers shine through.
    pub fn text_on_white(&mut self, text: &str, at: Point, colour: Colour) {
        let ground = Rect::around(at, 0.5 * text_width(text, TEXT) + 2.0, 0.62 * TEXT);
        self.rectangle(ground, WHITE, 0.75);
        self.write(text, at, "middle", colour, TEXT, "");
    }

    fn shape(&mut self, tag: &str, points: &[Point], style: &str) {
        let point = |(x, y): &Point| format!("{},{}", tenths(*x), tenths(*y));
        let points: Vec<String> = points.iter().map(point).collect();
        // Writing to a String does not fail.
        let _ = writeln!(self.0, "<{tag} points=\"{}\" {style}/>", points.join(" "));
    }

    fn write(&mut self, text: &str, (x, y): Point, anchor: &str, colour: Colour, size: f64, more: &str) {
        let (x, y, text) = (tenths(x), tenths(y), escaped(text));
        let _ = writeln!(
            self.0,
            "<text x=\"{x}\" y=\"{y}\" dy=\"0.35em\" text-anchor=\"{anchor}\" font-size=\"{size}\" \
             fill=\"#{colour:06X}\"{more}>{text}</text>"
        );
    }
}

/// Rounded to a tenth of a px, which no eye sees; without the sign of zero.
fn tenths(length: f64) -> f64 {
    (10.0 * length).round() / 10.0 + 0.0
}

/// Text for XML; characters that XML 1.0 does not know become a replacement mark.
fn escaped(text: &str) -> String {
    let unknown = |letter: char| letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}');
    text.replace(unknown, "\u{fffd}")
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Width of a text \[px\], an estimate on the safe side: an SVG is laid out by the program that shows it.
pub fn text_width(text: &str, size: f64) -> f64 {
    let letter = |letter| if is_wide(letter) { 1.0 } else { LETTER };
    size * text.chars().map(letter).sum::<f64>()
}

/// Letters as wide as high: CJK and full-width forms.
fn is_wide(letter: char) -> bool {
    matches!(letter, '\u{2e80}'..='\u{9fff}' | '\u{ac00}'..='\u{d7a3}' | '\u{f900}'..='\u{faff}' | '\u{ff00}'..='\u{ff60}')
}

/// An error where `text` needs more than its room \[px\].
pub fn check_room(text: &str, needed: f64, room: f64) -> Result<(), FigureError> {
    if needed <= room {
        return Ok(());
    }
    Err(FigureError::NoRoom {
        text: text.to_owned(),
        needed,
        room,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_escaped() {
        assert_eq!(escaped("a < b & \u{1}"), "a &lt; b &amp; \u{fffd}");
    }
}
