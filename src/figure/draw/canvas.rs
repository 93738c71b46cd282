//! Lines, areas and texts in px on plotters' SVG.
//!
//! plotters knows whole pixels only. It draws ten times too large here, and the SVG's view box scales it back, so that
//! curves are smooth to a tenth of a pixel.

use plotters::coord::Shift;
use plotters::element::{PathElement, Polygon, Text};
use plotters::prelude::{Color, DrawingArea, IntoDrawingArea, RGBColor, SVGBackend, ShapeStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontTransform, IntoTextStyle, TextStyle};

use crate::figure::FigureError;
use crate::figure::palette::{INK, WHITE};

/// Units of plotters a px.
pub const UNITS: f64 = 10.0;
/// plotters divides the sizes of fonts by this on their way to SVG.
const FONT: f64 = 1.24;
/// Width of a letter as a share of the font's size: wide, so that estimates err on the safe side.
const LETTER: f64 = 0.6;
/// Text \[px\].
pub const TEXT: f64 = 14.0;

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
}

/// Which part of a text lies at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
}

/// Where to draw.
pub struct Canvas<'a> {
    pub root: DrawingArea<SVGBackend<'a>, Shift>,
}

/// An SVG of `size` \[px\] that tells its `name`.
pub fn svg(
    name: &str,
    size: (f64, f64),
    draw: impl FnOnce(&Canvas<'_>) -> Result<(), FigureError>,
) -> Result<String, FigureError> {
    let mut drawn = String::new();
    let units = |length: f64| (length * UNITS).round() as u32;
    {
        let root = SVGBackend::with_string(&mut drawn, (units(size.0), units(size.1))).into_drawing_area();
        root.fill(&WHITE).map_err(|error| drawing(&error))?;
        let canvas = Canvas { root };
        draw(&canvas)?;
        canvas.root.present().map_err(|error| drawing(&error))?;
    }
    let body = drawn.find('>').map_or("", |end| &drawn[end + 1..]);
    let (width, height) = (size.0.round(), size.1.round());
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {} {}\">\n<title>{}</title>{body}",
        units(size.0),
        units(size.1),
        escape(name)
    ))
}

pub fn drawing(error: &impl std::fmt::Display) -> FigureError {
    FigureError::Drawing(error.to_string())
}

/// Text for XML; characters that XML 1.0 does not know at all become a replacement mark.
fn escape(text: &str) -> String {
    let escaped = text
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;");
    legal(&escaped)
}

fn legal(text: &str) -> String {
    let known = |letter: char| !letter.is_control() && !matches!(letter, '\u{fffe}' | '\u{ffff}');
    text.chars()
        .map(|letter| if known(letter) { letter } else { '\u{fffd}' })
        .collect()
}

/// Estimated width of a text \[px\].
pub fn text_width(text: &str, size: f64) -> f64 {
    let letters: f64 = text
        .chars()
        .map(|letter| if is_wide(letter) { 1.0 } else { LETTER })
        .sum();
    letters * size
}

/// Letters as wide as high: CJK and full-width forms.
fn is_wide(letter: char) -> bool {
    ('\u{2e80}'..='\u{9fff}').contains(&letter)
        || ('\u{ac00}'..='\u{d7a3}').contains(&letter)
        || ('\u{f900}'..='\u{faff}').contains(&letter)
        || ('\u{ff00}'..='\u{ff60}').contains(&letter)
}

/// A text style in units of plotters.
pub fn text_style(size: f64, bold: bool) -> TextStyle<'static> {
    // In whole units: plotters rounds down.
    let size = (size * FONT * UNITS).ceil();
    let style = if bold {
        ("sans-serif", size, plotters::style::FontStyle::Bold).into_text_style(&(0, 0))
    } else {
        ("sans-serif", size).into_text_style(&(0, 0))
    };
    style.color(&INK)
}

pub fn stroke(colour: RGBColor, width: f64) -> ShapeStyle {
    colour.stroke_width((width * UNITS).round() as u32)
}

impl Canvas<'_> {
    /// A line through points.
    pub fn line(&self, points: &[(f64, f64)], style: ShapeStyle) -> Result<(), FigureError> {
        let path: Vec<_> = points.iter().map(|point| units(*point)).collect();
        self.root
            .draw(&PathElement::new(path, style))
            .map_err(|error| drawing(&error))
    }

    /// A line with strokes and gaps of the given lengths in turn; solid without any.
    pub fn dashed(
        &self,
        points: &[(f64, f64)],
        style: ShapeStyle,
        lengths: &[f64],
    ) -> Result<(), FigureError> {
        if lengths.is_empty() {
            return self.line(points, style);
        }
        dashes(points, lengths)
            .iter()
            .try_for_each(|dash| self.line(dash, style))
    }

    /// A filled polygon; `opacity` in \[0, 1\].
    pub fn area(&self, points: &[(f64, f64)], colour: RGBColor, opacity: f64) -> Result<(), FigureError> {
        let path: Vec<_> = points.iter().map(|point| units(*point)).collect();
        let style = colour.mix(opacity).filled();
        self.root
            .draw(&Polygon::new(path, style))
            .map_err(|error| drawing(&error))
    }

    /// A filled rectangle.
    pub fn rectangle(&self, rect: Rect, colour: RGBColor, opacity: f64) -> Result<(), FigureError> {
        let corners = [
            (rect.left, rect.top),
            (rect.right, rect.top),
            (rect.right, rect.bottom),
            (rect.left, rect.bottom),
        ];
        self.area(&corners, colour, opacity)
    }

    /// A text that runs upward, centred at `at`.
    pub fn upward_text(&self, text: &str, at: (f64, f64), style: &TextStyle<'_>) -> Result<(), FigureError> {
        let style = style.transform(FontTransform::Rotate270);
        self.text(text, at, Anchor::Middle, &style)
    }

    /// A text on a white ground that lets what it covers shine through.
    pub fn text_on_white(
        &self,
        text: &str,
        at: (f64, f64),
        anchor: Anchor,
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let width = text_width(text, TEXT);
        let left = match anchor {
            Anchor::Start => at.0,
            Anchor::Middle => at.0 - 0.5 * width,
        };
        let ground = Rect {
            left: left - 2.0,
            right: left + width + 2.0,
            top: at.1 - 0.62 * TEXT,
            bottom: at.1 + 0.62 * TEXT,
        };
        self.rectangle(ground, WHITE, 0.75)?;
        self.text(text, at, anchor, &text_style(TEXT, false).color(&colour))
    }

    /// A text whose middle height is at `at`.
    pub fn text(
        &self,
        text: &str,
        at: (f64, f64),
        anchor: Anchor,
        style: &TextStyle<'_>,
    ) -> Result<(), FigureError> {
        let horizontal = match anchor {
            Anchor::Start => HPos::Left,
            Anchor::Middle => HPos::Center,
        };
        let style = style.pos(Pos::new(horizontal, VPos::Center));
        self.root
            .draw(&Text::new(legal(text), units(at), style))
            .map_err(|error| drawing(&error))
    }
}

fn units((x, y): (f64, f64)) -> (i32, i32) {
    ((x * UNITS).round() as i32, (y * UNITS).round() as i32)
}

/// Cuts a line into strokes.
fn dashes(points: &[(f64, f64)], lengths: &[f64]) -> Vec<Vec<(f64, f64)>> {
    let mut strokes = Vec::new();
    let (mut place, mut left) = (0, lengths[0]);
    let mut stroke: Vec<(f64, f64)> = points.first().copied().into_iter().collect();
    for pair in points.windows(2) {
        let ((x, y), (to_x, to_y)) = (pair[0], pair[1]);
        let length = (to_x - x).hypot(to_y - y);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let at = (x + (to_x - x) * done / length, y + (to_y - y) * done / length);
            stroke.push(at);
            // Strokes have even places, gaps odd ones.
            let finished = std::mem::replace(&mut stroke, vec![at]);
            if place % 2 == 0 {
                strokes.push(finished);
            }
            place = (place + 1) % lengths.len();
            left = lengths[place];
        }
        left -= length - done;
        stroke.push((to_x, to_y));
    }
    if place % 2 == 0 && stroke.len() > 1 {
        strokes.push(stroke);
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_go_round_corners() {
        let strokes = dashes(&[(0.0, 0.0), (5.0, 0.0), (5.0, 6.0)], &[4.0, 2.0]);
        assert_eq!(
            strokes,
            [vec![(0.0, 0.0), (4.0, 0.0)], vec![(5.0, 1.0), (5.0, 5.0)]]
        );
    }

    #[test]
    fn texts_are_escaped() {
        assert_eq!(escape("a < b & \u{1}"), "a &lt; b &amp; \u{fffd}");
    }
}
