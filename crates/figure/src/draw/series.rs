//! A series inside its frame.

use super::canvas::{Canvas, Point, Stroke};
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
        // On a logarithmic axis zero lies infinitely far down.
        let zero = frame.y(0.0).clamp(plot.top, plot.bottom);
        canvas.clipped(plot, |canvas| self.draw_line(canvas, &points, zero));
        points.retain(|point| plot.holds(*point));
        self.draw_markers(canvas, &points);
    }

    /// What the legend shows of it, `width` \[px\] wide from `(x, y)` on.
    pub fn draw_sample(&self, canvas: &mut Canvas, (x, y): Point, width: f64) {
        self.draw_line(canvas, &[(x, y), (x + width, y)], y + 8.0);
        self.draw_markers(canvas, &[(x + 0.5 * width, y)]);
    }

    /// Draws what the kind of series has of these: the area between the line and `zero` \[px\], and the line.
    fn draw_line(&self, canvas: &mut Canvas, points: &[Point], zero: f64) {
        if let (Kind::Area, [first, .., last]) = (self.series.kind, points) {
            let ends = [(last.0, zero), (first.0, zero)];
            canvas.area(&[points, &ends].concat(), self.line.colour, SHADE);
        }
        if self.series.kind != Kind::Points {
            if self.halo {
                canvas.line(points, Stroke::solid(WHITE, 2.5 * LINE_WIDTH));
            }
            canvas.line(points, self.line);
        }
    }

    fn draw_markers(&self, canvas: &mut Canvas, points: &[Point]) {
        let has_markers = matches!(self.series.kind, Kind::Points | Kind::LinePoints);
        for point in points.iter().filter(|_| has_markers) {
            mark::marker(canvas, self.marker, *point, self.line.colour);
        }
    }
}
