//! Series of points.

use crate::drawing::{Drawing, Point, Stroke};
use crate::frame::Frame;
use crate::mark;
use crate::palette::{Colour, DASHES, PALETTE, WHITE};

/// Width of lines \[px\].
const LINE_WIDTH: f64 = 2.2;
/// Opacity of filled areas.
const SHADE: f64 = 0.25;

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Line,
    Points,
    LinePoints,
    Area,
}

/// Points with a name.
///
/// Colour, dash and marker follow from the index of the series in its chart, unless [`look`](Series::look) and the like set them.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Series {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    pub(crate) points: Vec<(f64, f64)>,
    colour: Option<usize>,
    dash: Option<usize>,
    marker: Option<usize>,
    /// White on both sides of the line, which shows it on any ground.
    halo: bool,
}

impl Series {
    fn new(name: impl Into<String>, kind: Kind, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self {
            name: name.into(),
            kind,
            points: points.into_iter().collect(),
            colour: None,
            dash: None,
            marker: None,
            halo: false,
        }
    }

    /// A line through the points. With an empty name it has no entry in the legend.
    pub fn line(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::Line, points)
    }

    /// A marker at each point.
    pub fn points(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::Points, points)
    }

    /// A line with a marker at each point.
    pub fn line_points(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::LinePoints, points)
    }

    /// A line with the area down to zero (on a logarithmic axis: to its start) filled.
    pub fn area(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::Area, points)
    }

    /// Colour, dash and marker of the `index`-th series, from 0.
    pub fn look(mut self, index: usize) -> Self {
        self.dash = Some(index);
        self.colour(index).marker(index)
    }

    /// Colour of the `index`-th series, from 0.
    pub fn colour(mut self, index: usize) -> Self {
        self.colour = Some(index);
        self
    }

    /// Marker of the `index`-th series, from 0.
    pub fn marker(mut self, index: usize) -> Self {
        self.marker = Some(index);
        self
    }

    /// A line without gaps.
    pub fn solid(mut self) -> Self {
        self.dash = Some(0);
        self
    }

    /// A dashed line.
    pub fn dashed(mut self) -> Self {
        self.dash = Some(1);
        self
    }

    /// A dotted line.
    pub fn dotted(mut self) -> Self {
        self.dash = Some(2);
        self
    }

    /// As the `index`-th series of its chart, from 0, on coloured cells or not; what has been set of its look stays.
    pub(crate) fn placed(mut self, index: usize, on_cells: bool) -> Self {
        // The first colours of series are also those of classes: lines on cells are black.
        let colour = if on_cells { PALETTE.len() - 1 } else { index };
        self.colour.get_or_insert(colour);
        self.dash.get_or_insert(index);
        self.marker.get_or_insert(index);
        self.halo = on_cells;
        self
    }

    /// Draws the series, cut off at the frame.
    pub(crate) fn draw(&self, drawing: &mut Drawing, frame: &Frame) {
        let plot = frame.plot;
        let mut points: Vec<Point> = self.points.iter().map(|point| frame.at(*point)).collect();
        // On a logarithmic axis zero lies infinitely far down.
        let zero = frame.y(0.0).clamp(plot.top, plot.bottom);
        drawing.clipped(plot, |drawing| self.draw_line(drawing, &points, zero));
        points.retain(|point| plot.holds(*point));
        self.draw_markers(drawing, &points);
    }

    /// What the legend shows of it, `width` \[px\] wide from `(x, y)` on.
    pub(crate) fn draw_sample(&self, drawing: &mut Drawing, (x, y): Point, width: f64) {
        self.draw_line(drawing, &[(x, y), (x + width, y)], y + 8.0);
        self.draw_markers(drawing, &[(x + 0.5 * width, y)]);
    }

    /// Draws what the kind of series has of these: the area between the line and `zero` \[px\], and the line.
    fn draw_line(&self, drawing: &mut Drawing, points: &[Point], zero: f64) {
        let colour = self.shown_colour();
        if let (Kind::Area, [first, .., last]) = (self.kind, points) {
            let ends = [(last.0, zero), (first.0, zero)];
            drawing.fill(&[points, &ends].concat(), colour, SHADE);
        }
        if self.kind != Kind::Points {
            if self.halo {
                drawing.stroke(points, Stroke::solid(WHITE, 2.5 * LINE_WIDTH));
            }
            let (width, dash) = (LINE_WIDTH, DASHES[self.dash.unwrap_or(0) % DASHES.len()]);
            drawing.stroke(points, Stroke { colour, width, dash });
        }
    }

    fn draw_markers(&self, drawing: &mut Drawing, points: &[Point]) {
        if matches!(self.kind, Kind::Points | Kind::LinePoints) {
            for point in points {
                mark::marker(drawing, self.marker.unwrap_or(0), *point, self.shown_colour());
            }
        }
    }

    fn shown_colour(&self) -> Colour {
        PALETTE[self.colour.unwrap_or(0) % PALETTE.len()]
    }
}
