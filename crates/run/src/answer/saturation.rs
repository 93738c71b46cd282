//! Where the force levels off.
//!
//! With jumps the cable is followed until nothing changes from period to period any more. Where
//! every pass is simulated, the force at a third, two thirds and all of the passes gives two gains;
//! of vehicles that alternate, the largest in size counts. Where the second is much smaller than
//! the first, the gains shrink geometrically, and what is still to come is their remaining sum
//! (Aitken's Δ²; A. C. Aitken, Proc. R. Soc. Edinburgh 46 (1926) 289). Early on the force grows
//! like √n: the gains' ratio is above 0.7 and nothing can be said yet.

use cable_dem::{Order, PassOutcome};
use cycle_jump::{Beyond, Record};

use super::balance;
use super::differences::{larger, largest_force};
use super::record::{ForceRange, Saturation};
use crate::tuning::saturation::{LARGEST_RATIO, LARGEST_REMAINDER, TELLS};
use creepage_plan::Period;
use creepage_scene::{CableEnd, End, Scene};

/// Minimum number of passes from which anything can be said.
const MIN_PASSES: usize = 12;
/// One in so many of the passes, the last of them, shows the largest force now, and what
/// vehicles in random order do.
const WINDOW: usize = 12;
/// A force already reached may exceed the saturation by this share of it, which is no more than
/// an extrapolation's error.
const NEARLY: f64 = 0.02;
/// A force below this share of the largest in any pass is none.
const NOTHING: f64 = 1e-3;

/// Share of the saturated force whose pass is stated.
pub const LEVEL: f64 = 0.95;

/// Minimum and maximum value of a force over a period \[N\].
type Range = (f64, f64);

/// Where the forces of a run lead: over `records`, all passes or listed ones, and `beyond` them;
/// and the forces on the ends once nothing changes any more, over the vehicles of a `period`.
pub fn saturation(
    scene: &Scene,
    period: &Period,
    records: &[Record],
    beyond: Option<&Beyond>,
) -> (Option<Saturation>, Option<ForceRange>) {
    // Vehicles in random order show what they do in many passes only.
    let passes = match scene.order() {
        Order::Random { .. } => period.len().max(records.len() / WINDOW),
        _ => period.len(),
    };
    let peaks = records.iter().map(|record| largest_force(&record.outcome));
    let course = Course {
        scene,
        period,
        passes,
        records,
        beyond,
        scale: peaks.fold(0.0, f64::max),
    };
    let [upstream, downstream] = CableEnd::ALL.map(|end| end.held_in(scene) != End::Free);
    let leads_to = |counts: bool, force: fn(&PassOutcome) -> f64| {
        let nothing = Some((0.0, 0.0));
        if counts { course.leads_to(force) } else { nothing }
    };
    let on_ends = leads_to(upstream, |outcome| outcome.force.upstream)
        .zip(leads_to(downstream, |outcome| outcome.force.downstream));
    let inside = leads_to(!upstream && !downstream, |outcome| outcome.max_compression);
    let saturation = on_ends.zip(inside).and_then(|((upstream, downstream), inside)| {
        course.levels_off([downstream, upstream, inside].map(|(a, b)| larger(a, b)))
    });
    let range = on_ends.map(|(upstream, downstream)| ForceRange {
        downstream_min_n: downstream.0,
        downstream_max_n: downstream.1,
        upstream_min_n: upstream.0,
        upstream_max_n: upstream.1,
    });
    (saturation, range)
}

/// The course of the forces of a run.
struct Course<'a> {
    scene: &'a Scene,
    period: &'a Period,
    /// Passes over which they are looked at.
    passes: usize,
    records: &'a [Record],
    beyond: Option<&'a Beyond>,
    /// A force that counts as large \[N\].
    scale: f64,
}

impl Course<'_> {
    /// Range of a force over a period once nothing changes any more; with the largest that was
    /// reached, if that is hardly larger.
    fn leads_to(&self, force: fn(&PassOutcome) -> f64) -> Option<Range> {
        let forces = self.records.iter().map(|record| force(&record.outcome));
        let (least, most) = match self.beyond {
            Some(beyond) => range(beyond.period.iter().map(force))?,
            // Listed passes grow ever farther apart: their gains say nothing.
            None if self.records.last()?.pass != self.records.len() as u64 => return None,
            None => extrapolate(&forces.clone().collect::<Vec<_>>(), self.passes, self.scale)?,
        };
        let reached = forces.fold(0.0, larger);
        let largest = larger(least, most).abs();
        let is_near = (largest..=(1.0 + NEARLY) * largest).contains(&reached.abs());
        let with_reached = (least.min(reached), most.max(reached));
        Some(if is_near { with_reached } else { (least, most) })
    }

    /// The force of a pass by which the saturation is stated: the largest on an end, or inside a
    /// cable that nothing holds.
    fn shown(&self, outcome: &PassOutcome) -> f64 {
        match (self.scene.ends.upstream, self.scene.ends.downstream) {
            (End::Free, End::Free) => outcome.max_compression,
            _ => larger(outcome.force.upstream, outcome.force.downstream),
        }
    }

    /// The saturation at the forces `largest` on the downstream end, the upstream end and inside
    /// the cable: no more than friction can carry to an end whose other end is free. `None` if it
    /// is negligible compared with the largest force, or if the force falls.
    fn levels_off(&self, largest: [f64; 3]) -> Option<Saturation> {
        let force_n = largest.into_iter().fold(0.0, larger);
        let ends = CableEnd::ALL.map(|end| end.held_in(self.scene));
        let one_free = ends.contains(&End::Free) && self.scene.restraints.is_empty();
        let reached = self.records.iter().map(|record| self.shown(&record.outcome));
        let negligible = force_n.abs() < NOTHING * self.scale;
        let impossible =
            one_free && force_n.abs() > (1.0 + balance::MARGIN) * balance::carried(self.scene, force_n.abs());
        let falls = reached.fold(0.0, larger).abs() > (1.0 + NEARLY) * force_n.abs();
        if negligible || impossible || falls {
            return None;
        }
        Some(Saturation {
            force_n,
            passes_to_95_percent: self.reaches(force_n)?.pass,
            downstream_force_n: largest[0],
            upstream_force_n: largest[1],
        })
    }

    /// The first pass that leaves 95 % of the saturated `force` \[N\].
    fn reaches(&self, force: f64) -> Option<&Record> {
        let is_there = |record: &Record, end: f64| self.shown(&record.outcome) / (LEVEL * end) >= 1.0;
        // Of vehicles that stand in for the traffic, a row after the first ones is the mean of a
        // period: it leads to the mean.
        let leads_to = match self.beyond {
            Some(Beyond { period, .. }) if !self.period.is_own() => {
                period.iter().map(|outcome| self.shown(outcome)).sum::<f64>() / period.len() as f64
            }
            _ => force,
        };
        let first = self.beyond.map_or(0, |_| self.period.first.len() as u64);
        let mut later_rows = self.records.iter().filter(|record| record.pass > first);
        let within = later_rows.find(|record| is_there(record, leads_to));
        // Beyond them a pass leads to what the same pass of the last period leaves; if that is
        // little, it says nothing.
        let later = |beyond: &'_ Beyond, record: &Record| {
            let phase = (record.pass - 1) % beyond.period.len() as u64;
            let end = self.shown(&beyond.period[phase as usize]);
            end.abs() >= TELLS * force.abs() && is_there(record, end)
        };
        within.or_else(|| {
            let beyond = self.beyond?;
            beyond.records.iter().find(|record| later(beyond, record))
        })
    }
}

fn range(values: impl Iterator<Item = f64>) -> Option<Range> {
    let wider = |(least, most): Range, value: f64| (least.min(value), most.max(value));
    values
        .map(|value| (value, value))
        .reduce(|range, (value, _)| wider(range, value))
}

/// Range over the last `period` of `forces` \[N\], one entry a pass, with what is still to come;
/// `scale` \[N\] is a force that counts as large here.
fn extrapolate(forces: &[f64], period: usize, scale: f64) -> Option<Range> {
    let count = forces.len();
    if count < MIN_PASSES.max(3 * period) {
        return None;
    }
    // The largest of a few passes: of vehicles that alternate, each leaves another force.
    let width = (count / WINDOW).max(period);
    let largest = |end: usize| forces[end - width..end].iter().copied().fold(0.0, larger);
    let (first, second, third) = (largest(count / 3), largest(2 * count / 3), largest(count));
    let (early, late) = (second - first, third - second);
    let remainder = if third.abs() < NOTHING * scale || late.abs() <= 1e-4 * third.abs() {
        0.0
    } else {
        let ratio = late / early;
        if !(0.0..=LARGEST_RATIO).contains(&ratio) {
            return None;
        }
        late * ratio / (1.0 - ratio)
    };
    if remainder.abs() > LARGEST_REMAINDER * (third + remainder).abs() {
        return None;
    }
    range(forces[count - period..].iter().map(|force| force + remainder))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_geometric_approach_is_extrapolated_to_its_limit() {
        let forces: Vec<f64> = (1..=60).map(|n| 500.0 * (1.0 - 0.93_f64.powi(n))).collect();
        let (_, most) = extrapolate(&forces, 1, 500.0).expect("it levels off");
        assert!((most / 500.0 - 1.0).abs() < 0.01, "{most}");
    }

    #[test]
    fn growth_with_the_root_of_the_passes_does_not_level_off() {
        let forces: Vec<f64> = (1..=2000).map(|n| f64::from(n).sqrt()).collect();
        assert_eq!(extrapolate(&forces, 1, 1.0), None);
        assert_eq!(extrapolate(&forces[..5], 1, 1.0), None);
    }

    #[test]
    fn tension_levels_off_like_compression_and_nothing_like_nothing() {
        let forces: Vec<f64> = (1..=60).map(|n| -500.0 * (1.0 - 0.9_f64.powi(n))).collect();
        let (least, _) = extrapolate(&forces, 1, 500.0).expect("it levels off");
        assert!((least + 500.0).abs() < 5.0);
        assert_eq!(extrapolate(&[0.0; 60], 1, 500.0), Some((0.0, 0.0)));
    }
}
