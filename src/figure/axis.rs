//! An axis as data: its label with the unit, whether it is linear or logarithmic, and its range.

use super::FigureError;
use super::scale::{Scale, TickLabels, is_sound, round_range};

/// One axis of a [`Chart`](super::Chart).
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub(super) label: String,
    pub(super) logarithmic: bool,
    pub(super) range: Option<(f64, f64)>,
    pub(super) tick_labels: TickLabels,
}

impl Axis {
    /// A linear axis; `label` carries the unit, as in "force, N".
    #[must_use]
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            logarithmic: false,
            range: None,
            tick_labels: TickLabels::Number,
        }
    }

    /// A logarithmic axis.
    #[must_use]
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self {
            logarithmic: true,
            ..Self::linear(label)
        }
    }

    /// Runs from `from` to `to`, whatever the data; what lies beyond is cut off.
    #[must_use]
    pub fn range(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from, to));
        self
    }

    /// Labels ticks with SI prefixes of `unit`: "1 µm", "10 ms".
    #[must_use]
    pub fn prefixes(mut self, unit: impl Into<String>) -> Self {
        self.tick_labels = TickLabels::Prefixed(unit.into());
        self
    }

    /// The scale of this axis, fitted to `values` unless it has a range, with about `ticks` labelled ticks.
    pub(super) fn scale(
        &self,
        values: impl Iterator<Item = f64>,
        ticks: usize,
    ) -> Result<Scale, FigureError> {
        let bad = |(from, to)| FigureError::BadRange {
            axis: self.label.clone(),
            from,
            to,
        };
        if let Some(range) = self.range {
            if !is_sound(range, self.logarithmic) {
                return Err(bad(range));
            }
            return Ok(Scale::new(range, self.logarithmic, ticks, &self.tick_labels));
        }
        let (from, to) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        if self.logarithmic && from <= 0.0 {
            return Err(FigureError::NotPositive {
                what: self.label.clone(),
                value: from,
            });
        }
        let range = round_range((from, to), self.logarithmic, ticks);
        if !is_sound(range, self.logarithmic) {
            return Err(bad((from, to)));
        }
        Ok(Scale::new(range, self.logarithmic, ticks, &self.tick_labels))
    }
}
