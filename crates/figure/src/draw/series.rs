//! A series inside its frame.

use super::canvas::{Canvas, Point, Rect, Stroke};
use super::frame::Frame;
use super::mark;
use crate::palette::{DASHES, PALETTE, WHITE};
use crate::series::{Kind, Series};

/// Width of lines \[px\].
const LINE_WIDTH: f64 = 2.2;
/// Opacity of filled areas.
const SHADE: f64 = 0.25;

/// A series with the look that it has in its chart.
pub struct Shown<'a> {
    pub series: &'a Series,
    line: Stroke,
    marker: usize,
    /// White on both sides of the line, which shows it on any ground.
    halo: bool,
}

impl<'a> Shown<'a> {
    /// The `index`-th series of its chart, from 0; on coloured cells or not.
    pub fn new(series: &'a Series, index: usize, on_cells: bool) -> Self {
        // The first colours of series are also those of classes: lines on cells are black.
        let colour = series
            .colour
            .unwrap_or(if on_cells { PALETTE.len() - 1 } else { index });
        let colour = PALETTE[colour % PALETTE.len()];
        let dash = DASHES[series.dash.unwrap_or(index) % DASHES.len()];
        Self {
            series,
            line: Stroke {
                colour,
                width: LINE_WIDTH,
                dash,
            },
            marker: series.marker.unwrap_or(index),
            halo: on_cells,
        }
    }

    /// Draws the series, cut off at the frame.
    pub fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        let plot = frame.plot;
        let mut points: Vec<Point> = self.series.points.iter().map(|point| frame.at(*point)).collect();
        let parts = inside(&points, plot);
        // On a logarithmic axis zero lies infinitely far down.
        let zero = frame.y(0.0).clamp(plot.top, plot.bottom);
        points.retain(|point| plot.holds(*point));
        self.draw_parts(canvas, &parts, zero, &points);
    }

    /// What the legend shows of it, `width` \[px\] wide from `(x, y)` on.
    pub fn draw_sample(&self, canvas: &mut Canvas, (x, y): Point, width: f64) {
        let line = vec![(x, y), (x + width, y)];
        self.draw_parts(canvas, &[line], y + 8.0, &[(x + 0.5 * width, y)]);
    }

    /// Draws what the kind of series has: areas between parts of the line and `zero` \[px\], these parts, markers at the points.
    fn draw_parts(&self, canvas: &mut Canvas, parts: &[Vec<Point>], zero: f64, points: &[Point]) {
        let (kind, colour) = (self.series.kind, self.line.colour);
        for part in parts.iter().filter(|_| kind == Kind::Area) {
            let ends = [(part[part.len() - 1].0, zero), (part[0].0, zero)];
            canvas.area(&[part, &ends[..]].concat(), colour, SHADE);
        }
        for part in parts.iter().filter(|_| kind != Kind::Points) {
            if self.halo {
                canvas.line(part, Stroke::solid(WHITE, 2.5 * LINE_WIDTH));
            }
            canvas.line(part, self.line);
        }
        let has_markers = matches!(kind, Kind::Points | Kind::LinePoints);
        for point in points.iter().filter(|_| has_markers) {
            mark::marker(canvas, self.marker, *point, colour);
        }
    }
}

/// The parts of a line inside `frame`.
fn inside(points: &[Point], frame: Rect) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2) {
        let Some((from, to)) = clip(pair[0], pair[1], frame) else {
            continue;
        };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// The part of a segment inside `frame` (Y.-D. Liang, B. A. Barsky, ACM Transactions on Graphics 3, 1984).
pub fn clip(from: Point, to: Point, frame: Rect) -> Option<(Point, Point)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (slope, room) in [
        (-dx, from.0 - frame.left),
        (dx, frame.right - from.0),
        (-dy, from.1 - frame.top),
        (dy, frame.bottom - from.1),
    ] {
        if slope == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if slope < 0.0 {
            enter = enter.max(room / slope);
        } else {
            leave = leave.min(room / slope);
        }
    }
    let at = |t: f64| (from.0 + t * dx, from.1 + t * dy);
    // Ends inside stay as they are, to the last digit. A segment that only touches the frame is none.
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave == 1.0 { to } else { at(leave) };
    (enter < leave).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_frame() {
        let frame = Rect {
            left: 0.0,
            top: 0.0,
            right: 1.0,
            bottom: 1.0,
        };
        let parts = |points: &[Point]| inside(points, frame);
        assert_eq!(
            parts(&[(-1.0, 0.5), (0.5, 0.5), (0.5, 2.0), (0.75, 2.0), (0.75, 0.0)]),
            [
                vec![(0.0, 0.5), (0.5, 0.5), (0.5, 1.0)],
                vec![(0.75, 1.0), (0.75, 0.0)]
            ]
        );
        assert!(parts(&[(-1.0, 0.5), (0.5, 2.5)]).is_empty());
        // A point on the frame itself.
        assert_eq!(
            parts(&[(-0.1, 0.2), (0.0, 0.3), (1.0, 0.3), (1.1, 0.3)]),
            [vec![(0.0, 0.3), (1.0, 0.3)]]
        );
    }
}
