//! Places where a cable is held, what may be limited there, and what a run reaches.

use serde::{Deserialize, Serialize};

use super::cable_end::CableEnd;
use super::heat::DayExtremes;
use super::record::{ExtremePass, RestraintRecord, Run};
use super::units::Units;
use crate::shown::exact;

/// Clamps nearer to each other than this are at one place \[m\].
const SAME_PLACE: f64 = 1e-6;

/// Where a cable is held.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// At the upstream end, in place of what holds it in the scene.
    Upstream,
    /// At the downstream end, in place of what holds it in the scene.
    Downstream,
    /// A clamp at this position along the duct \[m\], beside what is in the scene.
    Clamp(f64),
}

/// What is limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Limited {
    /// Force on an end after passes and during them, on a clamp after passes \[N\].
    Force,
    /// Displacement of the end, or of the cable at the clamp, after passes \[m\].
    Movement,
}

impl Place {
    /// Whether it is the clamp at `position` \[m\].
    pub fn is_clamp_at(self, position: f64) -> bool {
        matches!(self, Self::Clamp(own) if (own - position).abs() <= SAME_PLACE)
    }

    /// It in words, in units of a reader.
    pub(super) fn shown_in(self, units: &Units) -> String {
        match self {
            Self::Upstream => "upstream end".to_owned(),
            Self::Downstream => "downstream end".to_owned(),
            Self::Clamp(position) => {
                let position = exact(units.length.of_si(position));
                format!("clamp at {position} {}", units.length.symbol())
            }
        }
    }
}

impl From<CableEnd> for Place {
    fn from(end: CableEnd) -> Self {
        match end {
            CableEnd::Upstream => Self::Upstream,
            CableEnd::Downstream => Self::Downstream,
        }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.shown_in(&Units::default()))
    }
}

impl Run {
    /// The largest force \[N\] or movement \[m\] at `place` in size, of all listed passes and all days: of an end also the force during
    /// passes and the movement of its spring, of a clamp those after them; in random order, where passes between jumps are means, with the scatter of single ones. Zero
    /// where there is no such clamp.
    pub fn largest(&self, place: impl Into<Place>, quantity: Limited) -> f64 {
        let place = place.into();
        let passes = (0..self.passes.len()).map(|index| self.in_pass(place, quantity, index));
        let days = self
            .heat
            .iter()
            .map(|heat| self.on_day(place, quantity, &heat.all_days));
        let extremes = self.extremes.iter();
        let extremes = extremes.map(|pass| self.in_extreme(place, quantity, pass));
        passes.chain(days).chain(extremes).fold(0.0, f64::max)
    }

    /// The same in a pass beside the listed ones.
    pub(super) fn in_extreme(&self, place: Place, quantity: Limited, pass: &ExtremePass) -> f64 {
        let at_end = |end: CableEnd| match quantity {
            Limited::Force => end.largest_force(&pass.after),
            Limited::Movement => end.largest_movement(&pass.after),
        };
        match place {
            Place::Upstream => at_end(CableEnd::Upstream),
            Place::Downstream => at_end(CableEnd::Downstream),
            Place::Clamp(_) => self.on_clamps(place, quantity, |clamp, _| pass.restraints_n[clamp].abs()),
        }
    }

    /// The same without what happens while a vehicle is above the duct.
    pub(super) fn largest_at_rest(&self, place: Place, quantity: Limited) -> f64 {
        let end = match place {
            Place::Upstream => CableEnd::Upstream,
            Place::Downstream => CableEnd::Downstream,
            Place::Clamp(_) => return self.largest(place, quantity),
        };
        let passes = self.passes.iter();
        let passes = passes.map(|record| match quantity {
            Limited::Force => end.force_after(record) + self.scatter(end, record),
            Limited::Movement => end.movement(record),
        });
        let days = self.heat.iter();
        let days = days.map(|heat| self.on_day(place, quantity, &heat.all_days));
        let extremes = self.extremes.iter().map(|pass| match quantity {
            Limited::Force => end.force_after(&pass.after),
            Limited::Movement => end.movement(&pass.after),
        });
        passes.chain(days).chain(extremes).fold(0.0, f64::max)
    }

    /// The same in the pass at `index` of the listed ones.
    pub(super) fn in_pass(&self, place: Place, quantity: Limited, index: usize) -> f64 {
        let record = &self.passes[index];
        // On days of heat passes between simulated ones have the peaks of others.
        let during = self.heat.is_none() || !record.interpolated;
        let at_end = |end: CableEnd| match quantity {
            Limited::Force if during => end.largest_force(record) + self.scatter(end, record),
            Limited::Movement if during => end.largest_movement(record),
            Limited::Force => end.force_after(record),
            Limited::Movement => end.movement(record),
        };
        match place {
            Place::Upstream => at_end(CableEnd::Upstream),
            Place::Downstream => at_end(CableEnd::Downstream),
            Place::Clamp(_) => self.on_clamps(place, quantity, |_, clamp| clamp.after_passes_n[index].abs()),
        }
    }

    /// The same over one of its days, when heat is hardest between passes.
    pub(super) fn on_day(&self, place: Place, quantity: Limited, day: &DayExtremes) -> f64 {
        let at_end = |end: CableEnd| match quantity {
            Limited::Force => day.largest_force(end),
            Limited::Movement => day.movement(end),
        };
        match place {
            Place::Upstream => at_end(CableEnd::Upstream),
            Place::Downstream => at_end(CableEnd::Downstream),
            Place::Clamp(_) => self.on_clamps(place, quantity, |clamp, _| {
                let range = day.restraints[clamp];
                range.max_n.abs().max(range.min_n.abs())
            }),
        }
    }

    /// The largest of the clamps at `place`, from the force on each.
    fn on_clamps(
        &self,
        place: Place,
        quantity: Limited,
        force: impl Fn(usize, &RestraintRecord) -> f64,
    ) -> f64 {
        let clamps = self.restraints.iter().enumerate();
        clamps
            .filter(|(_, clamp)| place.is_clamp_at(clamp.position_m))
            .map(|(index, clamp)| match quantity {
                Limited::Force => force(index, clamp),
                Limited::Movement => force(index, clamp) / clamp.stiffness_n_per_m,
            })
            .fold(0.0, f64::max)
    }
}
