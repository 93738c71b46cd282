//! Limits of force and movement at the ends, and what a run makes of them.

use serde::{Deserialize, Serialize};

use super::cable_end::CableEnd;
use super::heat::DayExtremes;
use super::record::{PassRecord, Run};
use super::units::Units;

/// What is limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Limited {
    /// Force on the end, after passes and during them \[N\].
    Force,
    /// Displacement of the end after passes \[m\].
    Movement,
}

/// What must not be exceeded at one end; of either sign.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct EndLimits {
    /// Largest force \[N\], positive, if it is limited.
    pub force_n: Option<f64>,
    /// Largest displacement \[m\], positive, if it is limited.
    pub movement_m: Option<f64>,
}

/// What must not be exceeded at the two ends.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Limits {
    /// At x = 0.
    pub upstream: EndLimits,
    /// At x = length.
    pub downstream: EndLimits,
}

/// When something happened.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Reached {
    /// Number of the pass: of very long traffic the first of those that are listed.
    pub pass: u64,
    /// The time after it \[years\], where the vehicles a day are known.
    pub years: Option<f64>,
}

/// One limit beside what a run reaches.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The end.
    pub end: CableEnd,
    /// What is limited there.
    pub quantity: Limited,
    /// The limit \[N or m\].
    pub limit: f64,
    /// The largest in size of all listed passes \[N or m\].
    pub largest: f64,
    /// The first pass that exceeds the limit; `None` where none does.
    pub reached_after: Option<Reached>,
    /// Whether limit and largest are nearer to each other than the estimated error.
    pub doubtful: bool,
}

impl CableEnd {
    /// Largest force on it after a pass and during it, in size \[N\].
    pub fn largest_force(self, record: &PassRecord) -> f64 {
        let [after, during] = match self {
            Self::Upstream => [record.upstream_force_n, record.upstream_peak_n],
            Self::Downstream => [record.downstream_force_n, record.downstream_peak_n],
        };
        after.abs().max(during.abs())
    }

    /// How far it is displaced after a pass, whichever way \[m\].
    pub fn movement(self, record: &PassRecord) -> f64 {
        match self {
            Self::Upstream => record.upstream_displacement_m.abs(),
            Self::Downstream => record.downstream_displacement_m.abs(),
        }
    }
}

impl Limited {
    /// What is limited at an end, in words.
    pub(crate) fn at(self, end: CableEnd) -> String {
        match self {
            Self::Force => format!("force on the {} end", end.name()),
            Self::Movement => format!("movement of the {} end", end.name()),
        }
    }

    /// A value of it with its unit.
    #[cfg(feature = "cli")]
    pub(crate) fn shown(self, value: f64) -> String {
        self.shown_in(&Units::default(), value)
    }

    /// The same in units of a reader.
    pub(crate) fn shown_in(self, units: &Units, value: f64) -> String {
        match self {
            Self::Force => format!("{} {}", units.force(value), units.force.symbol()),
            Self::Movement => format!("{} {}", units.movement(value), units.movement.symbol()),
        }
    }

    /// The largest of it in a pass, in size.
    fn of(self, end: CableEnd, record: &PassRecord) -> f64 {
        match self {
            Self::Force => end.largest_force(record),
            Self::Movement => end.movement(record),
        }
    }
}

impl Limits {
    /// The same limits of both ends.
    pub fn both(force_n: Option<f64>, movement_m: Option<f64>) -> Self {
        let end = EndLimits { force_n, movement_m };
        Self {
            upstream: end,
            downstream: end,
        }
    }

    /// The limits of one end.
    pub fn of(&self, end: CableEnd) -> &EndLimits {
        match end {
            CableEnd::Upstream => &self.upstream,
            CableEnd::Downstream => &self.downstream,
        }
    }

    /// The same, to be set.
    pub fn of_mut(&mut self, end: CableEnd) -> &mut EndLimits {
        match end {
            CableEnd::Upstream => &mut self.upstream,
            CableEnd::Downstream => &mut self.downstream,
        }
    }

    /// Every limit that is given.
    pub fn all(&self) -> impl Iterator<Item = (CableEnd, Limited, f64)> {
        let of = |end: CableEnd| {
            let EndLimits { force_n, movement_m } = *self.of(end);
            [(Limited::Force, force_n), (Limited::Movement, movement_m)]
                .into_iter()
                .filter_map(move |(quantity, limit)| Some((end, quantity, limit?)))
        };
        CableEnd::ALL.into_iter().flat_map(of)
    }

    /// What `run` makes of each limit.
    pub fn verdicts(&self, run: &Run) -> Vec<Verdict> {
        let verdict = |(end, quantity, limit): (CableEnd, Limited, f64)| {
            let of = |record: &PassRecord| quantity.of(end, record);
            let passes = run.passes.iter().map(of).fold(0.0, f64::max);
            // Heat is hardest between passes.
            let of_day = |day: &DayExtremes| match quantity {
                Limited::Force => day.largest_force(end),
                Limited::Movement => day.movement(end),
            };
            let largest = run
                .heat
                .as_ref()
                .map_or(passes, |heat| passes.max(of_day(&heat.all_days)));
            let pass = run
                .passes
                .iter()
                .find(|record| of(record) > limit)
                .map(|record| record.pass);
            let day = run
                .days
                .iter()
                .find(|day| of_day(day) > limit)
                .zip(run.heat.as_ref());
            let day = day.map(|(day, heat)| day.day * heat.passes_per_day);
            let first = pass.into_iter().chain(day).min();
            let years = |pass| {
                let listed = run.passes.iter().rfind(|record| record.pass <= pass)?;
                Some(listed.years? * pass as f64 / listed.pass as f64)
            };
            let error = match quantity {
                Limited::Force => run.error_estimate.relative,
                Limited::Movement => run.error_estimate.parts.movement,
            };
            Verdict {
                end,
                quantity,
                limit,
                largest,
                reached_after: first.map(|pass| Reached {
                    pass,
                    years: years(pass),
                }),
                doubtful: (largest - limit).abs() <= error * largest,
            }
        };
        self.all().map(verdict).collect()
    }
}

impl Verdict {
    /// In words, in units of a reader.
    pub fn shown(&self, units: &Units) -> String {
        let [limit, largest] = [self.limit, self.largest].map(|value| self.quantity.shown_in(units, value));
        let what = self.quantity.at(self.end);
        let verdict = match self.reached_after {
            Some(Reached { pass, years }) => {
                let time = years.map_or_else(String::new, |years| format!(", {}", super::after(years)));
                format!("limit exceeded: {what} above {limit} from pass {pass} on{time}; largest {largest}")
            }
            None => format!("limit kept: {what} at most {largest} of {limit}"),
        };
        if self.doubtful {
            return format!("{verdict}; nearer to the limit than the estimated error");
        }
        verdict
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.shown(&Units::default()))
    }
}
