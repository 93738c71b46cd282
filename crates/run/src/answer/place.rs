//! Places where a cable is held, what may be limited there, and what a run reaches.

use serde::{Deserialize, Serialize};

use super::heat::{DayExtremes, larger};
use super::record::{ExtremePass, PassRecord, Run};
use super::units::Units;
use crate::scene::{CableEnd, Scene};
use crate::shown::exact;
use crate::tuning::meshes::SMALL;

/// Clamps nearer to each other than this are at one place \[m\].
const SAME_PLACE: f64 = 1e-6;

/// Share of the duct's length by which an end moves that means no more than that the cable leaves
/// the duct.
const LEAVES: f64 = 0.01;

/// The largest movement of an end \[m\] with which the cable of `scene` stays in its duct.
pub fn largest_movement_in_duct(scene: &Scene) -> f64 {
    LEAVES * scene.duct.length
}

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
    /// Force on an end or a clamp, after passes and during them \[N\].
    Force,
    /// Displacement of the end after passes, or of the cable at the clamp also during them \[m\].
    Movement,
}

impl Place {
    /// Whether it is the clamp at `position` \[m\].
    pub fn is_clamp_at(self, position: f64) -> bool {
        matches!(self, Self::Clamp(own) if (own - position).abs() <= SAME_PLACE)
    }

    /// The end that it is, if it is one.
    pub fn end(self) -> Option<CableEnd> {
        match self {
            Self::Upstream => Some(CableEnd::Upstream),
            Self::Downstream => Some(CableEnd::Downstream),
            Self::Clamp(_) => None,
        }
    }

    /// It in words, in units of a reader.
    pub(super) fn shown_in(self, units: &Units) -> String {
        match (self, self.end()) {
            (Self::Clamp(position), _) => {
                let position = exact(units.length.of_si(position));
                format!("clamp at {position} {}", units.length.symbol())
            }
            (_, end) => format!("{} end", end.map_or("", CableEnd::name)),
        }
    }
}

impl From<CableEnd> for Place {
    fn from(end: CableEnd) -> Self {
        end.of([Self::Upstream, Self::Downstream])
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.shown_in(&Units::default()))
    }
}

/// A moment of a run at which forces and movements are known.
#[derive(Clone, Copy)]
pub(super) enum Moment<'r> {
    /// During and after a listed pass, of which this is the index.
    Pass(usize, &'r PassRecord),
    /// During and after a pass beside the listed ones.
    Extreme(&'r ExtremePass),
    /// A day, when heat is hardest between passes.
    Day(&'r DayExtremes),
}

impl Run {
    /// The largest force \[N\] or movement \[m\] at `place` in size, of all listed passes and all
    /// days: also the force during passes, and the movement of an end's spring and of a clamp; in random order, where passes between jumps are means, with the scatter of
    /// single ones. Zero where there is no such clamp.
    pub fn largest(&self, place: impl Into<Place>, quantity: Limited) -> f64 {
        self.farthest(place.into(), quantity).abs()
    }

    /// The same with its sign.
    pub(super) fn farthest(&self, place: Place, quantity: Limited) -> f64 {
        let values = self
            .moments()
            .map(|moment| self.value(place, quantity, moment, self.has_peaks(moment)));
        values.fold(0.0, larger)
    }

    /// The same without what happens while a vehicle is above the duct.
    pub(super) fn largest_at_rest(&self, place: Place, quantity: Limited) -> f64 {
        let values = self
            .moments()
            .map(|moment| self.value(place, quantity, moment, false).abs());
        values.fold(0.0, f64::max)
    }

    /// The estimated error of [`Run::largest`] \[N or m\]. It is a share of the largest force at
    /// `place`, or of a tenth of the largest at any place if that is more; and of the largest
    /// movement of an end.
    pub(super) fn error_of_largest(&self, place: Place, quantity: Limited) -> f64 {
        let largest = |place: Place| self.largest(place, quantity);
        let ends = CableEnd::ALL.map(|end| largest(end.into()));
        let share = match quantity {
            Limited::Force => self.error_estimate.relative,
            Limited::Movement => self.error_estimate.parts.movement,
        };
        let of = match (quantity, place) {
            (Limited::Force, _) => SMALL * self.largest_force(),
            (Limited::Movement, Place::Clamp(_)) => {
                let clamps = self
                    .restraints
                    .iter()
                    .filter(|clamp| place.is_clamp_at(clamp.position_m));
                let softest = clamps.fold(f64::INFINITY, |least, clamp| least.min(clamp.stiffness_n_per_m));
                SMALL * self.largest_force() / softest
            }
            (Limited::Movement, _) => ends[0].max(ends[1]),
        };
        share * of.max(largest(place))
    }

    /// The largest force on an end, on a clamp, or inside the cable after a listed pass, in size
    /// \[N\].
    fn largest_force(&self) -> f64 {
        let clamps = self.restraints.iter().map(|clamp| Place::Clamp(clamp.position_m));
        let places = CableEnd::ALL.map(Place::from).into_iter().chain(clamps);
        let inside = self.passes.iter().map(|record| record.max_compression_n);
        let at_places = places.map(|place| self.largest(place, Limited::Force));
        at_places.chain(inside).fold(0.0, f64::max)
    }

    /// Warns where the cable leaves its duct.
    pub(crate) fn warn_where_it_leaves(&mut self, scene: &Scene) {
        let most = largest_movement_in_duct(scene);
        let leaves = |end: &CableEnd| self.largest(*end, Limited::Movement) > most;
        if let Some(end) = CableEnd::ALL.into_iter().find(leaves) {
            self.warnings.push(format!(
                "the {} end moves by more than {} % of the duct's length: the cable leaves the duct, and larger movements say no more \
                 than that",
                end.name(),
                100.0 * LEAVES
            ));
        }
    }

    fn moments(&self) -> impl Iterator<Item = Moment<'_>> {
        let passes = self.passes.iter().enumerate();
        let passes = passes.map(|(index, record)| Moment::Pass(index, record));
        let days = self.heat.iter().map(|heat| Moment::Day(&heat.all_days));
        passes
            .chain(days)
            .chain(self.extremes.iter().map(Moment::Extreme))
    }

    /// The largest at one moment, in size.
    pub(super) fn at(&self, place: Place, quantity: Limited, moment: Moment<'_>) -> f64 {
        self.value(place, quantity, moment, self.has_peaks(moment)).abs()
    }

    /// Whether forces during a pass are known: on days of heat passes between simulated ones have
    /// the peaks of others.
    fn has_peaks(&self, moment: Moment<'_>) -> bool {
        let is_known = |record: &PassRecord| self.heat.is_none() || !record.interpolated;
        !matches!(moment, Moment::Pass(_, record) if !is_known(record))
    }

    /// The same, with what happens while a vehicle is above the duct if `during`.
    fn value(&self, place: Place, quantity: Limited, moment: Moment<'_>, during: bool) -> f64 {
        let Some(end) = place.end() else {
            return self.on_clamps(place, quantity, moment, during);
        };
        let (record, scatter) = match moment {
            Moment::Day(day) => {
                return match quantity {
                    Limited::Force => day.largest_force(end),
                    Limited::Movement => day.movement(end),
                };
            }
            Moment::Pass(_, record) => (record, self.scatter(end, record)),
            Moment::Extreme(pass) => (&pass.after, 0.0),
        };
        let wider = |force: f64| force + scatter.copysign(force);
        match quantity {
            Limited::Force if during => wider(record.largest_force(end)),
            Limited::Force => wider(record.force_after(end)),
            Limited::Movement if during => record.largest_movement(end),
            Limited::Movement => record.movement(end),
        }
    }

    /// The largest of the clamps at `place`, in size.
    fn on_clamps(&self, place: Place, quantity: Limited, moment: Moment<'_>, during: bool) -> f64 {
        let clamps = self.restraints.iter().enumerate();
        let clamps = clamps.filter(|(_, clamp)| place.is_clamp_at(clamp.position_m));
        let values = clamps.map(|(index, clamp)| {
            let force = match moment {
                Moment::Pass(pass, _) if during => clamp.during_passes_n[pass].abs(),
                Moment::Pass(pass, _) => clamp.after_passes_n[pass].abs(),
                Moment::Extreme(pass) if during => pass.restraint_peaks_n[index].abs(),
                Moment::Extreme(pass) => pass.restraints_n[index].abs(),
                Moment::Day(day) => day.restraints[index]
                    .max_n
                    .abs()
                    .max(day.restraints[index].min_n.abs()),
            };
            match quantity {
                Limited::Force => force,
                Limited::Movement => force / clamp.stiffness_n_per_m + clamp.slipped_m.unwrap_or(0.0).abs(),
            }
        });
        values.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use crate::{CableEnd, Limited, Limits, Place, Scene, run};

    /// The error of the force on an end that bears little is a share of a tenth of the largest
    /// force of all: limits that are nearer than that are doubtful.
    #[test]
    fn a_verdict_on_an_end_that_bears_little_is_doubtful_within_the_error_of_all_forces() {
        let mut scene = Scene::from_file("../../examples/scenes/full-scale-upper.toml").unwrap();
        scene.traffic.passes = 5;
        let mut run = run(&scene).unwrap();
        run.error_estimate.relative = 0.01;
        let largest = run.largest(CableEnd::Downstream, Limited::Force);
        assert_eq!(run.largest(CableEnd::Upstream, Limited::Force), 0.0);
        let doubtful = |limit: f64| {
            let verdicts = Limits::both(Some(limit), None).verdicts(&run);
            let of = |end: Place| {
                verdicts
                    .iter()
                    .find(|verdict| verdict.end == end)
                    .unwrap()
                    .doubtful
            };
            [of(Place::Upstream), of(Place::Downstream)]
        };
        assert_eq!(doubtful(0.000_5 * largest), [true, false]);
        assert_eq!(doubtful(0.002 * largest), [false, false]);
        assert_eq!(doubtful(0.995 * largest), [false, true]);
        assert_eq!(doubtful(1.02 * largest), [false, false]);
    }
}
