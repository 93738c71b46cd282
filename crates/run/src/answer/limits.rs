//! Limits of force and movement at ends and clamps, and what a run makes of them.

use serde::{Deserialize, Serialize};

use super::place::{Limited, Place};
use super::record::Run;
use super::units::{FORCE_DIGIT, MOVEMENT_DIGIT, Units, in_unit};
use creepage_plan::shown::{without_zeros, words_if};
use creepage_scene::{CableEnd, Unit};

/// What must not be exceeded at one place; of either sign.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct EndLimits {
    /// Largest force \[N\], positive, if it is limited.
    pub force_n: Option<f64>,
    /// Largest displacement \[m\], positive, if it is limited.
    pub movement_m: Option<f64>,
}

/// What must not be exceeded at one clamp.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ClampLimits {
    /// Its position along the duct \[m\].
    pub position_m: f64,
    /// Its limits.
    #[serde(flatten)]
    pub limits: EndLimits,
}

/// What must not be exceeded at the two ends and at clamps.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Limits {
    /// At x = 0.
    pub upstream: EndLimits,
    /// At x = length.
    pub downstream: EndLimits,
    /// At clamps.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub clamps: Vec<ClampLimits>,
}

/// When something happened.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Reached {
    /// Number of the pass: of very long traffic the first of those that are listed.
    pub pass: u64,
    /// The time after it \[years\], where the vehicles a day are known.
    pub years: Option<f64>,
}

/// One limit and what a run reaches.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The end or clamp.
    pub end: Place,
    /// What is limited there.
    pub quantity: Limited,
    /// The limit \[N or m\].
    pub limit: f64,
    /// The largest in size of all listed passes \[N or m\].
    pub largest: f64,
    /// Whether the largest force pulls the end; else it presses on it.
    pub pulled: bool,
    /// Whether it is larger than all that passes and heat leave: while a vehicle is above the duct.
    pub during_a_pass: bool,
    /// The first pass that exceeds the limit; `None` if none does.
    pub reached_after: Option<Reached>,
    /// Where no pass exceeds the limit: the force after a pass \[N\] at which more passes level
    /// off, if that is above the limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levels_off_above: Option<f64>,
    /// Whether limit and largest are nearer to each other than the estimated error.
    pub doubtful: bool,
}

impl Limited {
    /// What is limited at a place, in words.
    pub fn at(self, place: impl Into<Place>) -> String {
        let place = place.into();
        match (self, place) {
            (Self::Force, _) => format!("force on the {place}"),
            (Self::Movement, Place::Clamp(_)) => format!("movement at the {place}"),
            (Self::Movement, _) => format!("movement of the {place}"),
        }
    }

    /// Its unit for a reader, and the last digit that is shown of it \[N or m\].
    fn unit_in(self, units: &Units) -> (Unit, f64) {
        self.of([(units.force, FORCE_DIGIT), (units.movement, MOVEMENT_DIGIT)])
    }

    /// The symbol of that unit.
    pub fn symbol_in(self, units: &Units) -> &'static str {
        self.unit_in(units).0.symbol()
    }

    /// A value of it in that unit, as many digits as 0.1 N or 0.1 µm needs.
    pub fn number_in(self, units: &Units, value: f64) -> String {
        let (unit, digit) = self.unit_in(units);
        in_unit(value, unit, digit)
    }

    /// The same with the unit.
    pub fn shown_in(self, units: &Units, value: f64) -> String {
        format!("{} {}", self.number_in(units, value), self.symbol_in(units))
    }

    /// The same of a value that was given: "20 kN", not "20.0000 kN".
    pub fn given_in(self, units: &Units, value: f64) -> String {
        let number = self.number_in(units, value);
        format!("{} {}", without_zeros(&number), self.symbol_in(units))
    }
}

impl Limits {
    /// The same limits of both ends.
    pub fn both(force_n: Option<f64>, movement_m: Option<f64>) -> Self {
        let end = EndLimits { force_n, movement_m };
        Self {
            upstream: end,
            downstream: end,
            clamps: Vec::new(),
        }
    }

    /// The limits of one end.
    pub fn of(&self, end: CableEnd) -> &EndLimits {
        end.of([&self.upstream, &self.downstream])
    }

    /// The same, to be set.
    pub fn of_mut(&mut self, end: CableEnd) -> &mut EndLimits {
        end.of([&mut self.upstream, &mut self.downstream])
    }

    /// Every limit that is given.
    pub fn all(&self) -> impl Iterator<Item = (Place, Limited, f64)> {
        let of = |(place, limits): (Place, EndLimits)| {
            let EndLimits { force_n, movement_m } = limits;
            [(Limited::Force, force_n), (Limited::Movement, movement_m)]
                .into_iter()
                .filter_map(move |(quantity, limit)| Some((place, quantity, limit?)))
        };
        let ends = CableEnd::ALL.map(|end| (end.into(), *self.of(end)));
        let clamps = self.clamps.iter();
        let clamps = clamps.map(|clamp| (Place::Clamp(clamp.position_m), clamp.limits));
        ends.into_iter().chain(clamps).flat_map(of)
    }

    /// What `run` makes of each limit.
    pub fn verdicts(&self, run: &Run) -> Vec<Verdict> {
        let verdict = |(place, quantity, limit)| Verdict::new(run, place, quantity, limit);
        self.all().map(verdict).collect()
    }
}

impl Verdict {
    fn new(run: &Run, place: Place, quantity: Limited, limit: f64) -> Self {
        let farthest = run.farthest(place, quantity);
        let (pulled, largest) = (quantity == Limited::Force && farthest < 0.0, farthest.abs());
        let values = || run.values(place, quantity);
        let at_rest = values().map(|(_, [at_rest, _])| at_rest.abs());
        let exceeding = values().filter(|(_, [_, largest])| largest.abs() > limit);
        let first = exceeding.map(|(pass, _)| pass).min();
        let years = |pass| {
            let listed = run.passes.iter().rfind(|record| record.pass <= pass)?;
            Some(listed.years? * pass as f64 / listed.pass as f64)
        };
        let level = run.saturation.zip(place.end());
        let level = level.map(|(level, end)| end.of([level.upstream_force_n, level.downstream_force_n]));
        let levels_off = quantity == Limited::Force && first.is_none() && run.heat.is_none();
        Self {
            end: place,
            quantity,
            limit,
            largest,
            pulled,
            during_a_pass: largest > at_rest.fold(0.0, f64::max),
            reached_after: first.map(|pass| Reached {
                pass,
                years: years(pass),
            }),
            levels_off_above: level.filter(|level| levels_off && level.abs() > limit),
            doubtful: (largest - limit).abs() <= run.error_of_largest(place, quantity),
        }
    }

    /// Whether the computed passes exceed the limit.
    pub fn is_exceeded(&self) -> bool {
        self.reached_after.is_some()
    }

    /// All of them in a line: "2 of 4 limits exceeded"; nothing without any.
    pub fn summary(verdicts: &[Self]) -> String {
        let exceeded = verdicts.iter().filter(|verdict| verdict.is_exceeded()).count();
        match (exceeded, verdicts.len()) {
            (_, 0) => String::new(),
            (0, 1) => "the limit is kept".to_owned(),
            (0, all) => format!("all {all} limits kept"),
            (exceeded, all) => format!("{exceeded} of {all} limits exceeded"),
        }
    }

    /// In words, in units of a reader.
    pub fn shown(&self, units: &Units) -> String {
        self.shown_with(units, |value| self.quantity.shown_in(units, value))
    }

    /// The same with values written by `shown`.
    pub fn shown_with(&self, units: &Units, shown: impl Fn(f64) -> String) -> String {
        let largest = shown(self.largest);
        let when = words_if(self.during_a_pass, " during a pass");
        let limit = self.quantity.given_in(units, self.limit);
        let place = self.end.shown_in(units);
        let what = match (self.quantity, self.end) {
            (Limited::Force, Place::Clamp(_)) => format!("the {place} bears"),
            (Limited::Force, _) if self.pulled => format!("the {place} is pulled with"),
            (Limited::Force, _) => format!("the {place} is pressed with"),
            (Limited::Movement, Place::Clamp(_)) => format!("the cable at the {place} moves by"),
            (Limited::Movement, _) => format!("the {place} moves by"),
        };
        let verdict = match self.reached_after {
            Some(Reached { pass, years }) => {
                let time = years.map_or_else(String::new, |years| format!(", {}", super::after(years)));
                let first = format!("first at pass {pass}{time}");
                format!("limit exceeded: {what} up to {largest}{when}, limit {limit}, {first}")
            }
            None => format!("limit kept: {what} at most {largest}{when}, limit {limit}"),
        };
        let level = self.levels_off_above.map_or_else(String::new, |level| {
            let level = shown(level);
            format!("; with more passes it levels off at {level}, above the limit")
        });
        let doubt = words_if(self.doubtful, "; nearer to the limit than the estimated error");
        format!("{verdict}{level}{doubt}")
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.shown(&Units::default()))
    }
}
