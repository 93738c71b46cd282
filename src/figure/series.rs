//! What stands in a chart: series of points, reference lines, bands and notes.

use super::FigureError;
use super::palette::{DASHES, PALETTE};

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Line,
    Points,
    LinePoints,
    Step,
    Area,
}

/// Points with a name.
///
/// Colour, dash and marker follow from the place of the series in its chart, unless [`look`](Series::look) and the like say
/// otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) points: Vec<(f64, f64)>,
    pub(super) colour: Option<usize>,
    pub(super) dash: Option<usize>,
    pub(super) marker: Option<usize>,
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
    #[must_use]
    pub fn line(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::Line, points)
    }

    /// A marker at each point.
    #[must_use]
    pub fn points(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::Points, points)
    }

    /// A line with a marker at each point.
    #[must_use]
    pub fn line_points(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::LinePoints, points)
    }

    /// Keeps each value until the next point.
    #[must_use]
    pub fn step(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::Step, points)
    }

    /// A line with the area down to zero (on a logarithmic axis: to its beginning) filled.
    #[must_use]
    pub fn area(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, Kind::Area, points)
    }

    /// Colour, dash and marker of the `index`-th series, from 0.
    #[must_use]
    pub fn look(mut self, index: usize) -> Self {
        self.colour = Some(index);
        self.dash = Some(index);
        self.marker = Some(index);
        self
    }

    /// Colour of the `index`-th series, from 0.
    #[must_use]
    pub fn colour(mut self, index: usize) -> Self {
        self.colour = Some(index);
        self
    }

    /// Marker of the `index`-th series, from 0.
    #[must_use]
    pub fn marker(mut self, index: usize) -> Self {
        self.marker = Some(index);
        self
    }

    /// A line without gaps.
    #[must_use]
    pub fn solid(mut self) -> Self {
        self.dash = Some(0);
        self
    }

    /// A dashed line.
    #[must_use]
    pub fn dashed(mut self) -> Self {
        self.dash = Some(1);
        self
    }

    /// A dotted line.
    #[must_use]
    pub fn dotted(mut self) -> Self {
        self.dash = Some(2);
        self
    }

    /// With the looks it has as the `index`-th of its chart.
    pub(super) fn at_place(&self, index: usize) -> Self {
        Self {
            colour: Some(self.colour.unwrap_or(index) % PALETTE.len()),
            dash: Some(self.dash.unwrap_or(index) % DASHES.len()),
            marker: Some(self.marker.unwrap_or(index)),
            ..self.clone()
        }
    }

    pub(super) fn check(&self) -> Result<(), FigureError> {
        let what = || format!("series \"{}\"", self.name);
        if self.points.is_empty() {
            return Err(FigureError::Empty { what: what() });
        }
        for (index, &(x, y)) in self.points.iter().enumerate() {
            for value in [x, y] {
                if !value.is_finite() {
                    return Err(FigureError::NotFinite {
                        what: what(),
                        index,
                        value,
                    });
                }
            }
        }
        Ok(())
    }
}

/// Which axis a reference line or band belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Along {
    /// At values of y, across the whole width.
    Horizontal,
    /// At values of x, over the whole height.
    Vertical,
}

/// A line or band across the whole plot, with a label.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    pub(super) along: Along,
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) label: String,
    pub(super) colour: Option<usize>,
}

impl Reference {
    fn new(along: Along, from: f64, to: f64, label: impl Into<String>) -> Self {
        Self {
            along,
            from,
            to,
            label: label.into(),
            colour: None,
        }
    }

    /// A horizontal line at `y`.
    #[must_use]
    pub fn horizontal(y: f64, label: impl Into<String>) -> Self {
        Self::new(Along::Horizontal, y, y, label)
    }

    /// A vertical line at `x`.
    #[must_use]
    pub fn vertical(x: f64, label: impl Into<String>) -> Self {
        Self::new(Along::Vertical, x, x, label)
    }

    /// A band between two values of y.
    #[must_use]
    pub fn horizontal_band(from: f64, to: f64, label: impl Into<String>) -> Self {
        Self::new(Along::Horizontal, from.min(to), to.max(from), label)
    }

    /// A band between two values of x.
    #[must_use]
    pub fn vertical_band(from: f64, to: f64, label: impl Into<String>) -> Self {
        Self::new(Along::Vertical, from.min(to), to.max(from), label)
    }

    /// Colour of the `index`-th series, from 0; grey otherwise.
    #[must_use]
    pub fn colour(mut self, index: usize) -> Self {
        self.colour = Some(index % PALETTE.len());
        self
    }

    pub(super) fn check(&self) -> Result<(), FigureError> {
        for (index, value) in [self.from, self.to].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(FigureError::NotFinite {
                    what: format!("reference \"{}\"", self.label),
                    index,
                    value,
                });
            }
        }
        Ok(())
    }
}

/// A text at a point of the chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Note {
    pub(super) at: (f64, f64),
    pub(super) text: String,
}

impl Note {
    /// `text` centred at (x, y); it is moved as far as it takes to stay in the plot.
    #[must_use]
    pub fn new(x: f64, y: f64, text: impl Into<String>) -> Self {
        Self {
            at: (x, y),
            text: text.into(),
        }
    }

    pub(super) fn check(&self) -> Result<(), FigureError> {
        for (index, value) in [self.at.0, self.at.1].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(FigureError::NotFinite {
                    what: format!("note \"{}\"", self.text),
                    index,
                    value,
                });
            }
        }
        Ok(())
    }
}
