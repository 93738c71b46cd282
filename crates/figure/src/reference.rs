//! Reference lines and bands with their labels.

use crate::drawing::{Drawing, Rect, Stroke, TEXT, check_room};
use crate::error::FigureError;
use crate::frame::Frame;
use crate::palette::{Colour, GREY, INK, PALETTE};

/// Room between a text and the borders of the plot \[px\].
const MARGIN: f64 = 4.0;

/// A line or band across the whole plot, with a label.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Reference {
    /// Whether it stands at values of x, over the whole height; otherwise at values of y, across the whole width.
    pub(crate) is_vertical: bool,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) label: String,
    pub(crate) colour: Colour,
}

impl Reference {
    fn new(is_vertical: bool, from: f64, to: f64, label: impl Into<String>) -> Self {
        Self {
            is_vertical,
            from,
            to,
            label: label.into(),
            colour: GREY,
        }
    }

    /// A horizontal line at `y`.
    pub fn horizontal(y: f64, label: impl Into<String>) -> Self {
        Self::new(false, y, y, label)
    }

    /// A vertical line at `x`.
    pub fn vertical(x: f64, label: impl Into<String>) -> Self {
        Self::new(true, x, x, label)
    }

    /// A band between two values of x.
    pub fn vertical_band(from: f64, to: f64, label: impl Into<String>) -> Self {
        Self::new(true, from.min(to), to.max(from), label)
    }

    /// Colour of the `index`-th series, from 0; grey otherwise.
    pub fn colour(mut self, index: usize) -> Self {
        self.colour = PALETTE[index % PALETTE.len()];
        self
    }

    fn is_line(&self) -> bool {
        self.from == self.to
    }

    /// The part of the plot that the line or band takes, if any; a line has no width.
    fn place(&self, frame: &Frame) -> Option<Rect> {
        let plot = frame.plot;
        let mut place = plot;
        if self.is_vertical {
            place.left = frame.x(self.from).max(plot.left);
            place.right = frame.x(self.to).min(plot.right);
        } else {
            place.top = frame.y(self.to).max(plot.top);
            place.bottom = frame.y(self.from).min(plot.bottom);
        }
        (place.left <= place.right && place.top <= place.bottom).then_some(place)
    }

    pub(crate) fn draw(&self, drawing: &mut Drawing, frame: &Frame) {
        let Some(rect) = self.place(frame) else {
            return;
        };
        let colour = self.colour;
        if self.is_line() {
            let (width, dash) = (1.3, "6 4");
            let ends = [(rect.left, rect.top), (rect.right, rect.bottom)];
            drawing.stroke(&ends, Stroke { colour, width, dash });
        } else {
            drawing.rectangle(rect, colour, 0.15);
        }
    }

    /// Draws the label: right above the end of a horizontal line, at the top of a vertical line or band.
    pub(crate) fn draw_label(&self, drawing: &mut Drawing, frame: &Frame) -> Result<(), FigureError> {
        let Some(rect) = self.place(frame).filter(|_| !self.label.is_empty()) else {
            return Ok(());
        };
        let (x, y) = if self.is_vertical {
            (rect.centre().0, rect.top)
        } else {
            (rect.right, rect.top - 0.75 * TEXT)
        };
        // A light colour does for a band, not for a text.
        let colour = if self.is_line() { self.colour } else { INK };
        let (plot, half) = (frame.plot, 0.5 * Drawing::text_width(&self.label) + MARGIN);
        check_room(&self.label, 2.0 * half, plot.width())?;
        let x = x.min(plot.right - half).max(plot.left + half);
        let y = y.clamp(plot.top + 0.7 * TEXT, plot.bottom - 0.7 * TEXT);
        drawing.text_on_white(&self.label, (x, y), colour);
        Ok(())
    }
}
