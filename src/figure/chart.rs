//! A chart: series over two axes.

use super::axis::Axis;
use super::draw;
use super::series::{Along, Kind, Note, Reference, Series};
use super::{FigureError, Panels};

/// Width and height of a figure with one panel \[px\].
pub(super) const SIZE: (f64, f64) = (800.0, 500.0);

/// Series of points over two axes, with references and notes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    pub(super) title: String,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) series: Vec<Series>,
    pub(super) references: Vec<Reference>,
    pub(super) notes: Vec<Note>,
}

impl Chart {
    /// An empty chart. The title may be empty too.
    #[must_use]
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            series: Vec::new(),
            references: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Adds a series; the later is drawn above the earlier.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds a reference line or band, drawn below the series.
    #[must_use]
    pub fn refer(mut self, reference: Reference) -> Self {
        self.references.push(reference);
        self
    }

    /// Adds a text.
    #[must_use]
    pub fn note(mut self, note: Note) -> Self {
        self.notes.push(note);
        self
    }

    /// The chart as an SVG of 800 by 500 px.
    ///
    /// # Errors
    ///
    /// [`FigureError`] without data, with numbers that are not finite or have no place on a logarithmic axis, and where a
    /// text has no room.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        Panels::new("")
            .panel_size(SIZE.0, SIZE.1)
            .with(self.clone())
            .to_svg()
    }

    pub(super) fn check(&self) -> Result<(), FigureError> {
        if self.series.is_empty() {
            return Err(FigureError::Empty {
                what: format!("chart \"{}\"", self.title),
            });
        }
        self.series.iter().try_for_each(Series::check)?;
        self.references.iter().try_for_each(Reference::check)?;
        self.notes.iter().try_for_each(Note::check)?;
        for series in &self.series {
            let mut on_axes = series
                .points
                .iter()
                .flat_map(|&(x, y)| [(&self.x, x), (&self.y, y)]);
            if let Some((_, value)) = on_axes.find(|(axis, value)| axis.logarithmic && *value <= 0.0) {
                return Err(FigureError::NotPositive {
                    what: format!("series \"{}\"", series.name),
                    value,
                });
            }
        }
        let on_axes = self
            .references
            .iter()
            .flat_map(|reference| {
                let axis = match reference.along {
                    Along::Horizontal => &self.y,
                    Along::Vertical => &self.x,
                };
                [(axis, reference.from), (axis, reference.to)]
            })
            .chain(
                self.notes
                    .iter()
                    .flat_map(|note| [(&self.x, note.at.0), (&self.y, note.at.1)]),
            );
        for (axis, value) in on_axes {
            if axis.logarithmic && value <= 0.0 {
                return Err(FigureError::NotPositive {
                    what: axis.label.clone(),
                    value,
                });
            }
        }
        Ok(())
    }

    /// Abscissae the x axis has to hold.
    pub(super) fn abscissae(&self) -> impl Iterator<Item = f64> {
        self.series
            .iter()
            .flat_map(|series| series.points.iter().map(|point| point.0))
            .chain(self.referred(Along::Vertical))
    }

    /// Ordinates the y axis has to hold: areas reach down to zero.
    pub(super) fn ordinates(&self) -> impl Iterator<Item = f64> {
        let areas = self.series.iter().any(|series| series.kind == Kind::Area);
        self.series
            .iter()
            .flat_map(|series| series.points.iter().map(|point| point.1))
            .chain(self.referred(Along::Horizontal))
            .chain((areas && !self.y.logarithmic).then_some(0.0))
    }

    fn referred(&self, along: Along) -> impl Iterator<Item = f64> {
        let there = self
            .references
            .iter()
            .filter(move |reference| reference.along == along);
        there.flat_map(|reference| [reference.from, reference.to])
    }

    pub(super) fn draw(&self, canvas: &draw::Canvas<'_>, outer: draw::Rect) -> Result<(), FigureError> {
        draw::chart(self, canvas, outer)
    }
}
