//! Reference lines and bands, and texts in the plot.

use super::canvas::{Canvas, Point, Rect, Stroke, TEXT, check_room, text_width};
use super::frame::Frame;
use super::series::clip;
use crate::error::FigureError;
use crate::palette::{Colour, INK};
use crate::series::{Along, Kind, Reference, Series};

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

/// Draws the label at one of the two ends of the line or band, on one of its sides, where it hides least of the `series`.
pub fn draw_label(
    canvas: &mut Canvas,
    frame: &Frame,
    reference: &Reference,
    series: &[Series],
) -> Result<(), FigureError> {
    let Some(rect) = place(frame, reference).filter(|_| !reference.label.is_empty()) else {
        return Ok(());
    };
    let (plot, half) = (frame.plot, 0.5 * text_width(&reference.label, TEXT) + MARGIN);
    let places = match reference.along {
        Along::Horizontal => {
            let (above, below) = (rect.top - 0.75 * TEXT, rect.top + 0.75 * TEXT);
            let (left, right) = (plot.left + half, plot.right - half);
            [(right, above), (left, above), (right, below), (left, below)]
        }
        Along::Vertical => {
            let from_end = [0.9 * TEXT, 2.4 * TEXT];
            let [high, low] = from_end.map(|y| plot.top + y);
            let [bottom, above] = from_end.map(|y| plot.bottom - y);
            [high, bottom, low, above].map(|y| (rect.centre().0, y))
        }
    };
    let hidden = |place: &Point| -> usize {
        let ground = Rect::around(moved_inside(plot, *place, half), half, 0.75 * TEXT);
        series.iter().map(|series| hidden_by(frame, ground, series)).sum()
    };
    // The first of the best.
    let best = places.into_iter().min_by_key(hidden).unwrap_or(places[0]);
    // A light colour does for a band, not for a text.
    let line = reference.is_line();
    let colour = if line { reference.colour } else { INK };
    draw_text(canvas, plot, &reference.label, best, colour)
}

/// How many points and pieces of lines of `series` lie under the `ground` of a text.
fn hidden_by(frame: &Frame, ground: Rect, series: &Series) -> usize {
    let places: Vec<Point> = series.points.iter().map(|point| frame.at(*point)).collect();
    let points = places.iter().filter(|place| ground.holds(**place)).count();
    let is_hidden = |pair: &&[Point]| series.kind != Kind::Points && clip(pair[0], pair[1], ground).is_some();
    points + places.windows(2).filter(is_hidden).count()
}

/// Draws `text` centred at `at`, moved so that it stays in the plot.
pub fn draw_text(
    canvas: &mut Canvas,
    plot: Rect,
    text: &str,
    at: Point,
    colour: Colour,
) -> Result<(), FigureError> {
    let half = 0.5 * text_width(text, TEXT) + MARGIN;
    check_room(text, 2.0 * half, plot.width())?;
    canvas.text_on_white(text, moved_inside(plot, at, half), colour);
    Ok(())
}

/// `at`, moved so that a text of half-width `half` \[px\] stays in the plot.
fn moved_inside(plot: Rect, at: Point, half: f64) -> Point {
    let x = at.0.min(plot.right - half).max(plot.left + half);
    (x, at.1.clamp(plot.top + 0.7 * TEXT, plot.bottom - 0.7 * TEXT))
}
