//! Places where a cable is held, what may be limited there, and what a run reaches.

use serde::{Deserialize, Serialize};

use super::differences::{SMALL, larger};
use super::record::{PassRecord, Run};
use super::units::Units;
use creepage_plan::shown::exact;
use creepage_scene::{CableEnd, Scene};
use ground_field::Direction;

/// Clamps nearer to each other than this are at one place \[m\].
const SAME_PLACE: f64 = 1e-6;

/// Share of the duct's length by which an end moves that means no more than that the cable leaves
/// the duct.
const LEAVES: f64 = 0.01;

/// Share of the largest force that an end must bear the other way after the last pass for the cable to creep backward.
const BACKWARD: f64 = 0.05;

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
    /// A clamp at this position along the duct \[m\], in addition to those of the scene.
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

impl Limited {
    /// Of a force and a movement that which is meant.
    pub fn of<T>(self, [force, movement]: [T; 2]) -> T {
        match self {
            Self::Force => force,
            Self::Movement => movement,
        }
    }
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
        end.of([Self::Upstream, Self::Downstream])
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.shown_in(&Units::default()))
    }
}

/// A pass or the last one of a day, and a force \[N\] or movement \[m\] at one place: with the cable
/// at rest, and while a vehicle is above the duct if that is larger. Forces on ends have a sign.
type Value = (u64, [f64; 2]);

impl Run {
    /// The largest force \[N\] or movement \[m\] at `place` in size, of all listed passes and all
    /// days: also the force during passes, and the movement of an end's spring or of a clamp then;
    /// in random order, where passes between jumps are means, with the scatter of single ones. Zero
    /// if there is no such clamp.
    pub fn largest(&self, place: impl Into<Place>, quantity: Limited) -> f64 {
        self.farthest(place.into(), quantity).abs()
    }

    /// The same with its sign.
    pub(super) fn farthest(&self, place: Place, quantity: Limited) -> f64 {
        let values = self.values(place, quantity);
        values.fold(0.0, |most, (_, [_, largest])| larger(most, largest))
    }

    /// Warns where the cable leaves its duct.
    pub(crate) fn warn_where_it_leaves(&mut self, scene: &Scene) {
        let most = largest_movement_in_duct(scene);
        let leaves = |end: &CableEnd| self.largest(*end, Limited::Movement) > most;
        if let Some(end) = CableEnd::ALL.into_iter().find(leaves) {
            let (end, percent) = (end.name(), 100.0 * LEAVES);
            self.warnings.push(format!(
                "the {end} end moves by more than {percent} % of the duct's length: the cable leaves the duct, and larger movements say \
                 no more than that"
            ));
        }
    }

    /// Warns of a cable that creeps against the only direction of traffic, where neither weight nor heat does that.
    pub(crate) fn warn_where_it_creeps_back(&mut self, scene: &Scene) {
        let forward = scene.vehicles[0].direction;
        let one_way = scene.vehicles.iter().all(|vehicle| vehicle.direction == forward);
        let is_pulled_otherwise = scene.body_force() != 0.0 || scene.heat.is_some() || self.start.is_some();
        let Some(last) = self.passes.last().filter(|_| one_way && !is_pulled_otherwise) else {
            return;
        };
        let sign = if forward == Direction::Forward { 1.0 } else { -1.0 };
        let pushed = sign * (last.downstream_force_n - last.upstream_force_n);
        let moved = sign * (last.upstream_displacement_m + last.downstream_displacement_m);
        let largest = self.largest_on_ends(Limited::Force);
        let (is_held, is_pushed_back) = (largest > 0.0, pushed < -BACKWARD * largest);
        if is_pushed_back && moved <= 0.0 || !is_held && moved < -self.duct_motion.peak_longitudinal_m {
            self.warnings.push(
                "the cable creeps against the traffic: where axles stand so far apart that the backward slip of one falls into the forward \
                 slip of the next, a soft cable near the state in which nothing creeps moves backward; check the places of the wheels"
                    .to_owned(),
            );
        }
    }

    /// The estimated error of [`Run::largest`] \[N or m\]. It is a share of the largest force at
    /// `place`, or of a tenth of the largest at any place if that is more; and of the largest
    /// movement of an end.
    pub(super) fn error_of_largest(&self, place: Place, quantity: Limited) -> f64 {
        let of = match (quantity, place) {
            (Limited::Force, _) => SMALL * self.largest_force(),
            (Limited::Movement, Place::Clamp(_)) => {
                let clamps = self.restraints.iter();
                let clamps = clamps.filter(|clamp| place.is_clamp_at(clamp.position_m));
                let stiffnesses = clamps.map(|clamp| clamp.stiffness_n_per_m);
                SMALL * self.largest_force() / stiffnesses.fold(f64::INFINITY, f64::min)
            }
            (Limited::Movement, _) => self.largest_on_ends(quantity),
        };
        let error = &self.error_estimate;
        quantity.of([error.relative, error.parts.movement]) * of.max(self.largest(place, quantity))
    }

    fn largest_on_ends(&self, quantity: Limited) -> f64 {
        let [upstream, downstream] = CableEnd::ALL.map(|end| self.largest(end, quantity));
        upstream.max(downstream)
    }

    /// The largest force on an end, on a clamp, or inside the cable after a listed pass, in size
    /// \[N\].
    fn largest_force(&self) -> f64 {
        let clamps = self.restraints.iter().map(|clamp| Place::Clamp(clamp.position_m));
        let on_clamps = clamps.map(|place| self.largest(place, Limited::Force));
        let inside = self.passes.iter().map(|record| record.max_compression_n);
        let on_ends = self.largest_on_ends(Limited::Force);
        on_clamps.chain(inside).fold(on_ends, f64::max)
    }

    /// What there is at `place` in all listed passes, on all days, and in the other passes that show more.
    pub(super) fn values(&self, place: Place, quantity: Limited) -> impl Iterator<Item = Value> {
        let last = self.passes.last().map_or(u64::MAX, |record| record.pass);
        let listed = self.passes.iter().enumerate().map(move |(index, record)| {
            let clamps = self.restraints.iter();
            let forces = clamps.map(|clamp| [clamp.after_passes_n[index], clamp.during_passes_n[index]]);
            let [at_rest, largest] = match place.end() {
                Some(end) => self.on_end(record, end, quantity, self.scatter(end, record)),
                None => self.on_clamps(place, quantity, record.pass, forces),
            };
            // On days of heat passes between simulated ones have the peaks of others.
            let has_peaks = self.heat.is_none() || !record.interpolated;
            (record.pass, [at_rest, if has_peaks { largest } else { at_rest }])
        });
        let extremes = self.extremes.iter().map(move |extreme| {
            let forces = extreme.restraints_n.iter().zip(&extreme.restraint_peaks_n);
            let forces = forces.map(|(after, peak)| [*after, *peak]);
            let pass = extreme.after.pass;
            let both = match place.end() {
                Some(end) => self.on_end(&extreme.after, end, quantity, 0.0),
                None => self.on_clamps(place, quantity, pass, forces),
            };
            (pass.min(last), both)
        });
        let days = self.heat.iter().flat_map(move |heat| {
            let days = self.days.iter().chain([&heat.all_days]);
            days.map(move |day| {
                let pass = last.min(day.day * heat.passes_per_day);
                let clamps = day.restraints.iter();
                let forces = clamps.map(|clamp| [larger(clamp.max_n, clamp.min_n); 2]);
                let both = match place.end() {
                    Some(end) => [quantity.of([day.largest_force(end), day.movement(end)]); 2],
                    None => self.on_clamps(place, quantity, pass, forces),
                };
                (pass, both)
            })
        });
        listed.chain(extremes).chain(days)
    }

    /// The largest in size of the clamps at `place`, of all clamps with these `forces` at rest and
    /// during `pass`.
    fn on_clamps(
        &self,
        place: Place,
        quantity: Limited,
        pass: u64,
        forces: impl Iterator<Item = [f64; 2]>,
    ) -> [f64; 2] {
        let row = self.passes.partition_point(|record| record.pass <= pass);
        let clamps = self.restraints.iter().zip(forces);
        let clamps = clamps.filter(|(clamp, _)| place.is_clamp_at(clamp.position_m));
        let values = clamps.map(|(clamp, forces)| {
            let slips = &clamp.slipped_after_passes_m;
            let slipped = slips.get(row.saturating_sub(1)).copied().or(clamp.slipped_m);
            forces.map(|force| match quantity {
                Limited::Force => force.abs(),
                Limited::Movement => force.abs() / clamp.stiffness_n_per_m + slipped.unwrap_or(0.0).abs(),
            })
        });
        values.fold([0.0; 2], |[a, b], [c, d]| [c.max(a), d.max(b)])
    }

    /// What there is at an end after the pass of `record`, and during it if that is larger; single
    /// passes may show `scatter` more force than this one. During a pass an end on a spring moves
    /// with its force; how far a free one moves to and fro then, some micrometres, is left out.
    fn on_end(&self, record: &PassRecord, end: CableEnd, quantity: Limited, scatter: f64) -> [f64; 2] {
        let after = record.force_after(end);
        if quantity == Limited::Force {
            return [after, record.largest_force(end)].map(|force| force + scatter.copysign(force));
        }
        let spring = end.of([self.upstream_spring_n_per_m, self.downstream_spring_n_per_m]);
        let (outward, spring) = (end.of([-1.0, 1.0]), spring.unwrap_or(f64::INFINITY));
        let moved = |force: f64| (record.displacement(end) + outward * (force - after) / spring).abs();
        let during = record.extremes(end).map(moved);
        [moved(after), during.into_iter().fold(moved(after), f64::max)]
    }
}

impl PassRecord {
    /// The force on an end that is largest in size after the pass and during it \[N\].
    pub fn largest_force(&self, end: CableEnd) -> f64 {
        let [least, peak] = self.extremes(end);
        larger(larger(self.force_after(end), peak), least)
    }

    /// The least and the largest force on an end during the pass \[N\].
    pub fn extremes(&self, end: CableEnd) -> [f64; 2] {
        end.of([
            [self.upstream_least_n, self.upstream_peak_n],
            [self.downstream_least_n, self.downstream_peak_n],
        ])
    }

    /// Force on an end after the pass \[N\].
    pub fn force_after(&self, end: CableEnd) -> f64 {
        end.of([self.upstream_force_n, self.downstream_force_n])
    }

    /// Displacement of an end after the pass \[m\].
    pub fn displacement(&self, end: CableEnd) -> f64 {
        end.of([self.upstream_displacement_m, self.downstream_displacement_m])
    }
}

#[cfg(test)]
mod tests {
    use crate::{Limited, Limits, Place, run};
    use creepage_scene::{CableEnd, Scene};

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
