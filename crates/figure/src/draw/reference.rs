//! Reference lines and bands with their labels.

use super::canvas::{Canvas, Rect, Stroke, TEXT, check_room, text_width};
use super::frame::Frame;
use crate::error::FigureError;
use crate::palette::INK;
use crate::series::{Along, Reference};

/// Room between a text and the borders of the plot \[px\].
const MARGIN: f64 = 4.0;

/// The part of the plot that the line or band takes, if any; a line has no width.
fn place(frame: &Frame, reference: &Reference) -> Option<Rect> {
    let plot = frame.plot;
    let rect = match reference.along {
        Along::Horizontal => Rect {
            top: frame.y(reference.to),
            bottom: frame.y(reference.from),
            ..plot
        },
        Along::Vertical => Rect {
            left: frame.x(reference.from),
            right: frame.x(reference.to),
            ..plot
        },
    };
    let inside = Rect {
        left: rect.left.max(plot.left),
        top: rect.top.max(plot.top),
        right: rect.right.min(plot.right),
        bottom: rect.bottom.min(plot.bottom),
    };
    (inside.left <= inside.right && inside.top <= inside.bottom).then_some(inside)
}

pub fn draw(canvas: &mut Canvas, frame: &Frame, reference: &Reference) {
    let Some(rect) = place(frame, reference) else {
        return;
    };
    let colour = reference.colour;
    if reference.is_line() {
        let (width, dash) = (1.3, &[6.0, 4.0]);
        let ends = [(rect.left, rect.top), (rect.right, rect.bottom)];
        canvas.line(&ends, Stroke { colour, width, dash });
    } else {
        canvas.rectangle(rect, colour, 0.15);
    }
}

/// Draws the label: right above the end of a horizontal line or band, at the top of a vertical one.
pub fn draw_label(canvas: &mut Canvas, frame: &Frame, reference: &Reference) -> Result<(), FigureError> {
    let Some(rect) = place(frame, reference).filter(|_| !reference.label.is_empty()) else {
        return Ok(());
    };
    let at = match reference.along {
        Along::Horizontal => (rect.right, rect.top - 0.75 * TEXT),
        Along::Vertical => (rect.centre().0, rect.top),
    };
    // A light colour does for a band, not for a text.
    let line = reference.is_line();
    let colour = if line { reference.colour } else { INK };
    let (plot, half) = (frame.plot, 0.5 * text_width(&reference.label, TEXT) + MARGIN);
    check_room(&reference.label, 2.0 * half, plot.width())?;
    let x = at.0.min(plot.right - half).max(plot.left + half);
    let y = at.1.clamp(plot.top + 0.7 * TEXT, plot.bottom - 0.7 * TEXT);
    canvas.text_on_white(&reference.label, (x, y), colour);
    Ok(())
}
