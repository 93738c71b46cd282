//! What stands in a chart: series of points, reference lines and bands.

use crate::palette::{Colour, GREY, PALETTE};

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
    pub(crate) colour: Option<usize>,
    pub(crate) dash: Option<usize>,
    pub(crate) marker: Option<usize>,
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
}

/// Which way a reference line or band runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Along {
    /// At values of y, across the whole width.
    Horizontal,
    /// At values of x, over the whole height.
    Vertical,
}

/// A line or band across the whole plot, with a label.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Reference {
    pub(crate) along: Along,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) label: String,
    pub(crate) colour: Colour,
}

impl Reference {
    fn new(along: Along, from: f64, to: f64, label: impl Into<String>) -> Self {
        Self {
            along,
            from,
            to,
            label: label.into(),
            colour: GREY,
        }
    }

    /// A horizontal line at `y`.
    pub fn horizontal(y: f64, label: impl Into<String>) -> Self {
        Self::new(Along::Horizontal, y, y, label)
    }

    /// A vertical line at `x`.
    pub fn vertical(x: f64, label: impl Into<String>) -> Self {
        Self::new(Along::Vertical, x, x, label)
    }

    /// A band between two values of x.
    pub fn vertical_band(from: f64, to: f64, label: impl Into<String>) -> Self {
        Self::new(Along::Vertical, from.min(to), to.max(from), label)
    }

    pub(crate) fn is_line(&self) -> bool {
        self.from == self.to
    }

    /// Colour of the `index`-th series, from 0; grey otherwise.
    pub fn colour(mut self, index: usize) -> Self {
        self.colour = PALETTE[index % PALETTE.len()];
        self
    }
}
