//! An axis as data: its label with the unit, whether it is linear or logarithmic, and what it spans.

use crate::error::FigureError;
use crate::scale::{Scale, Tick, is_sound, round_range};

/// One axis of a [`Chart`](crate::Chart).
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) logarithmic: bool,
    range: Option<(f64, f64)>,
    /// Centres of cells, of a map.
    pub(crate) centres: Vec<f64>,
    /// Values that are labelled in place of round numbers, if any.
    ticks: Vec<Tick>,
}

impl Axis {
    /// A linear axis; `label` carries the unit, as in "force, N".
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            logarithmic: false,
            range: None,
            centres: Vec::new(),
            ticks: Vec::new(),
        }
    }

    /// A logarithmic axis.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self {
            logarithmic: true,
            ..Self::linear(label)
        }
    }

    /// An axis of cells with names; their centres are 0, 1, 2, …
    pub fn names<Name: Into<String>>(
        label: impl Into<String>,
        names: impl IntoIterator<Item = Name>,
    ) -> Self {
        let axis = Self::linear(label).ticks((0..).map(f64::from).zip(names));
        let centres: Vec<f64> = axis.ticks.iter().map(|(centre, _)| *centre).collect();
        axis.cells(centres)
    }

    /// Spans `from` to `to`, whatever the data; what lies beyond is cut off.
    pub fn range(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from, to));
        self
    }

    /// Spans cells around ascending centres. Their borders lie half-way between the centres, or between their logarithms.
    pub fn cells(mut self, centres: impl IntoIterator<Item = f64>) -> Self {
        self.centres = centres.into_iter().collect();
        self
    }

    /// Labels these ascending values in place of round numbers; those beyond the axis are left out.
    ///
    /// ```
    /// use plain_figure::{Axis, Chart, Series};
    ///
    /// let time = Axis::logarithmic("time").ticks([(1.0, "1 day"), (365.25, "1 year"), (3652.5, "10 years")]);
    /// let chart = Chart::new("", time, Axis::linear("force, N")).with(Series::line("", [(0.5, 1.0), (400.0, 2.0)]));
    /// let svg = chart.to_svg()?;
    /// assert!(svg.contains("1 day") && svg.contains("1 year") && !svg.contains("10 years"));
    /// # Ok::<(), plain_figure::FigureError>(())
    /// ```
    pub fn ticks<Label: Into<String>>(mut self, ticks: impl IntoIterator<Item = (f64, Label)>) -> Self {
        self.ticks = ticks
            .into_iter()
            .map(|(value, label)| (value, label.into()))
            .collect();
        self
    }

    /// Whether each of the `values` of `what` has a place on this axis.
    pub(crate) fn check(&self, what: &str, values: impl IntoIterator<Item = f64>) -> Result<(), FigureError> {
        let what = || what.to_owned();
        for (index, value) in values.into_iter().enumerate() {
            if !value.is_finite() {
                return Err(FigureError::NotFinite {
                    what: what(),
                    index,
                    value,
                });
            }
            if self.logarithmic && value <= 0.0 {
                return Err(FigureError::NotPositive { what: what(), value });
            }
        }
        Ok(())
    }

    /// Whether the centres of the cells ascend and have places on this axis.
    pub(crate) fn check_cells(&self) -> Result<(), FigureError> {
        self.check(&self.label, self.centres.iter().copied())?;
        match self.centres.windows(2).find(|pair| pair[0] >= pair[1]) {
            None => Ok(()),
            Some(pair) => Err(FigureError::NotAscending {
                axis: self.label.clone(),
                previous: pair[0],
                next: pair[1],
            }),
        }
    }

    /// Borders of the cells: of n cells n + 1. The outer cells are as wide on the outside as on the inside.
    pub(crate) fn borders(&self) -> Vec<f64> {
        let to = |value: &f64| if self.logarithmic { value.ln() } else { *value };
        let from = |place: f64| if self.logarithmic { place.exp() } else { place };
        let places: Vec<f64> = self.centres.iter().map(to).collect();
        let halves: Vec<f64> = places.windows(2).map(|pair| 0.5 * (pair[1] - pair[0])).collect();
        let (Some(first), Some(last)) = (places.first(), places.last()) else {
            return Vec::new();
        };
        let (left, right) = (halves.first().unwrap_or(&0.5), halves.last().unwrap_or(&0.5));
        let between = places.iter().zip(&halves).map(|(place, half)| place + half);
        let inner = std::iter::once(first - left).chain(between);
        inner.chain([last + right]).map(from).collect()
    }

    /// The scale of this axis, fitted to `values` unless it has cells or a range, with about `ticks` labelled ticks.
    pub(crate) fn scale(
        &self,
        values: impl Iterator<Item = f64>,
        ticks: usize,
    ) -> Result<Scale, FigureError> {
        let borders = self.borders();
        let range = match (self.range, borders.as_slice()) {
            (Some(range), _) => range,
            (None, [first, .., last]) => (*first, *last),
            _ => {
                let (least, most) = (f64::INFINITY, f64::NEG_INFINITY);
                let data = values.fold((least, most), |(low, high), v| (low.min(v), high.max(v)));
                round_range(data, self.logarithmic, ticks)
            }
        };
        if !is_sound(range, self.logarithmic) {
            let (axis, (from, to)) = (self.label.clone(), range);
            return Err(FigureError::BadRange { axis, from, to });
        }
        let scale = Scale::new(range, self.logarithmic, ticks);
        Ok(if self.ticks.is_empty() {
            scale
        } else {
            scale.with_ticks(&self.ticks)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_lie_half_way() {
        let borders = |axis: Axis, centres: &[f64]| axis.cells(centres.iter().copied()).borders();
        assert_eq!(borders(Axis::linear("x"), &[1.0, 2.0, 4.0]), [0.5, 1.5, 3.0, 5.0]);
        let decades = borders(Axis::logarithmic("x"), &[1.0, 100.0]);
        for (found, wanted) in decades.iter().zip([0.1, 10.0, 1000.0]) {
            assert!((found / wanted - 1.0).abs() < 1e-14, "{decades:?}");
        }
    }
}
