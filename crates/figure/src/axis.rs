//! An axis as data: its label with the unit, whether it is linear or logarithmic, and what it spans.

use crate::error::FigureError;
use crate::scale::{Scale, Tick, round_range};

/// One axis of a [`Chart`](crate::Chart).
#[derive(Debug, Clone, PartialEq, Default)]
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
            ..Self::default()
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
        let ticks = ticks.into_iter();
        self.ticks = ticks.map(|(value, label)| (value, label.into())).collect();
        self
    }

    /// Whether each of the `values` of `what` has a place on this axis.
    pub(crate) fn check(&self, what: &str, values: impl IntoIterator<Item = f64>) -> Result<(), FigureError> {
        let is_wrong = |value: f64| !value.is_finite() || (self.logarithmic && value <= 0.0);
        let wrong = values.into_iter().enumerate().find(|(_, value)| is_wrong(*value));
        wrong.map_or(Ok(()), |(index, value)| {
            let what = what.to_owned();
            Err(FigureError::NoPlace { what, index, value })
        })
    }

    /// Whether the centres of the cells ascend and have places on this axis.
    pub(crate) fn check_cells(&self) -> Result<(), FigureError> {
        self.check(&self.label, self.centres.iter().copied())?;
        let mut pairs = self.centres.windows(2);
        pairs.try_for_each(|pair| self.check_range((pair[0], pair[1])))
    }

    /// Whether both ends of a range and what lies between them are numbers that this axis can hold.
    fn check_range(&self, (from, to): (f64, f64)) -> Result<(), FigureError> {
        let span = if self.logarithmic { to / from } else { to - from };
        if from < to && span.is_finite() && (!self.logarithmic || from > 0.0) {
            return Ok(());
        }
        let axis = self.label.clone();
        Err(FigureError::BadRange { axis, from, to })
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

    /// The scale of this axis, fitted to `data` unless it has cells or a range, with about `ticks` labelled ticks.
    pub(crate) fn scale(&self, data: impl Iterator<Item = f64>, ticks: usize) -> Result<Scale, FigureError> {
        let borders = self.borders();
        let range = match (self.range, borders.as_slice()) {
            (Some(range), _) => range,
            (None, [first, .., last]) => (*first, *last),
            _ => {
                let none = (f64::INFINITY, f64::NEG_INFINITY);
                let data = data.fold(none, |(low, high), value| (low.min(value), high.max(value)));
                round_range(data, self.logarithmic, ticks)
            }
        };
        self.check_range(range)?;
        let scale = Scale::new(range, self.logarithmic, ticks);
        let own = self.ticks.is_empty();
        Ok(if own { scale } else { scale.with_ticks(&self.ticks) })
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
