//! Where the force levels off.
//!
//! With jumps the cable is followed until nothing changes from period to period any more. Where every pass is simulated, the
//! force at a third, two thirds and all of the passes gives two gains; of vehicles that alternate, the largest in size counts. Where the
//! second is much smaller than the first, the gains shrink geometrically, and what is still to come is their remaining sum
//! (Aitken's Δ²; A. C. Aitken, Proc. R. Soc. Edinburgh 46 (1926) 289). Early on the force grows like √n: the gains' ratio is
//! above 0.7 and nothing can be said yet.

use cable_dem::{Order, PassOutcome};
use cycle_jump::{Beyond, Record};

use super::balance;
use super::record::{ForceRange, Saturation};
use crate::Scene;
use crate::scene::End;

/// Gains whose ratio is above this do not level off yet.
const LARGEST_RATIO: f64 = 0.5;
/// Largest part of the saturated force that may be extrapolated.
const LARGEST_REMAINDER: f64 = 0.03;
/// Fewest passes from which anything can be said.
const FEWEST_PASSES: usize = 12;
/// One in so many of the passes, the last of them, shows the largest force now, and what vehicles in random order do.
const WINDOW: usize = 12;
/// Share of the saturated force whose pass is stated.
pub const LEVEL: f64 = 0.95;
/// A force already reached may exceed the saturation by this share of it, which is no more than an extrapolation's error.
const NEARLY: f64 = 0.02;
/// Of a period's passes, those that leave this share of the largest force at least show how it grows.
const TELLS: f64 = 0.5;
/// A force below this share of the largest in any pass is none.
const NOTHING: f64 = 1e-3;

/// Least and largest value of a force over a period \[N\].
type Range = (f64, f64);

/// Where the forces of a run lead: over `records`, all passes or listed ones, and `beyond` them; and the forces on the ends once nothing
/// changes any more, over the vehicles of a `period`.
pub fn saturation(
    scene: &Scene,
    period: usize,
    records: &[Record],
    beyond: Option<&Beyond>,
) -> (Option<Saturation>, Option<ForceRange>) {
    let scale = records
        .iter()
        .map(|record| peak(&record.outcome))
        .fold(0.0, f64::max);
    // Vehicles in random order show what they do in many passes only.
    let period = match scene.order() {
        Order::Random { .. } => period.max(records.len() / WINDOW),
        _ => period,
    };
    let level = |force: fn(&PassOutcome) -> f64| {
        if let Some(beyond) = beyond {
            range(beyond.period.iter().map(force))
        } else {
            // Listed passes grow ever farther apart: their gains say nothing.
            if records
                .last()
                .is_none_or(|last| last.pass != records.len() as u64)
            {
                return None;
            }
            let forces: Vec<f64> = records.iter().map(|record| force(&record.outcome)).collect();
            extrapolate(&forces, period, scale)
        }
    };
    let at = |end, force| {
        if end == End::Free {
            Some((0.0, 0.0))
        } else {
            level(force)
        }
    };
    let upstream = at(scene.ends.upstream, |o| o.force.upstream);
    let downstream = at(scene.ends.downstream, |o| o.force.downstream);
    let (Some(upstream), Some(downstream)) = (upstream, downstream) else {
        return (None, None);
    };
    let downstream = at_least_reached(downstream, records, |o| o.force.downstream);
    let upstream = at_least_reached(upstream, records, |o| o.force.upstream);
    let range = ForceRange {
        downstream_min_n: downstream.0,
        downstream_max_n: downstream.1,
        upstream_min_n: upstream.0,
        upstream_max_n: upstream.1,
    };
    let inside = match (scene.ends.upstream, scene.ends.downstream) {
        (End::Free, End::Free) => {
            level(|o| o.max_compression).map(|range| at_least_reached(range, records, |o| o.max_compression))
        }
        _ => Some((0.0, 0.0)),
    };
    let largest =
        inside.map(|inside| [downstream, upstream, inside].map(|(least, most)| larger(least, most)));
    let saturation = largest.and_then(|largest| levels_off(scene, records, beyond, largest, scale));
    (saturation, Some(range))
}

/// The range with the largest force that was reached, if that is hardly larger than all in it.
fn at_least_reached((least, most): Range, records: &[Record], force: fn(&PassOutcome) -> f64) -> Range {
    let reached = records
        .iter()
        .map(|record| force(&record.outcome))
        .fold(0.0, larger);
    let largest = larger(least, most).abs();
    if (largest..=(1.0 + NEARLY) * largest).contains(&reached.abs()) {
        (least.min(reached), most.max(reached))
    } else {
        (least, most)
    }
}

/// The saturation at the forces `largest` on the downstream end, the upstream end and inside the cable: no more than friction can carry to
/// an end whose other end is free. `None` where there is none worth the name beside the force `scale`, or the force falls.
fn levels_off<'a>(
    scene: &Scene,
    records: &'a [Record],
    beyond: Option<&'a Beyond>,
    largest: [f64; 3],
    scale: f64,
) -> Option<Saturation> {
    let force_n = largest.into_iter().fold(0.0, larger);
    let free = [scene.ends.upstream, scene.ends.downstream].map(|end| end == End::Free);
    let limit = balance::carried(scene);
    let one_free = free.contains(&true) && scene.restraints.is_empty();
    let shown = |outcome: &PassOutcome| {
        let PassOutcome {
            force,
            max_compression,
            ..
        } = *outcome;
        if free == [true; 2] {
            max_compression
        } else {
            larger(force.upstream, force.downstream)
        }
    };
    let reached = records
        .iter()
        .map(|record| shown(&record.outcome))
        .fold(0.0, larger);
    let nothing = force_n.abs() < NOTHING * scale;
    let impossible = one_free && force_n.abs() > (1.0 + balance::MARGIN) * limit;
    let falls = reached.abs() > (1.0 + NEARLY) * force_n.abs();
    if nothing || impossible || falls {
        return None;
    }
    // Of vehicles in random order, a row between jumps is the mean of a period: it leads to the mean.
    let leads_to = match (beyond, scene.order()) {
        (Some(Beyond { period, .. }), Order::Random { .. }) => {
            period.iter().map(shown).sum::<f64>() / period.len() as f64
        }
        _ => force_n,
    };
    let is_there = |record: &&Record, end: f64| shown(&record.outcome) / (LEVEL * end) >= 1.0;
    let within = records.iter().find(|record| is_there(record, leads_to));
    // Beyond them a pass leads to what the same pass of the last period leaves; where that is little, it says nothing.
    let later = |beyond: &'a Beyond| {
        let end = |record: &Record| {
            let phase = (record.pass - 1) % beyond.period.len() as u64;
            shown(&beyond.period[phase as usize])
        };
        let tells = |end: f64| end.abs() >= TELLS * force_n.abs();
        beyond
            .records
            .iter()
            .find(|record| tells(end(record)) && is_there(record, end(record)))
    };
    Some(Saturation {
        force_n,
        passes_to_95_percent: within.or_else(|| beyond.and_then(later))?.pass,
        downstream_force_n: largest[0],
        upstream_force_n: largest[1],
    })
}

/// Largest force on an end in a pass, in size.
fn peak(outcome: &PassOutcome) -> f64 {
    let PassOutcome {
        peak,
        lowest,
        max_compression,
        ..
    } = outcome;
    [
        peak.upstream,
        peak.downstream,
        lowest.upstream,
        lowest.downstream,
        *max_compression,
    ]
    .into_iter()
    .fold(0.0, |largest, force| largest.max(force.abs()))
}

fn range(values: impl Iterator<Item = f64>) -> Option<Range> {
    values.fold(None, |range: Option<Range>, value| {
        let (least, most) = range.unwrap_or((value, value));
        Some((least.min(value), most.max(value)))
    })
}

/// Range over the last `period` of `forces` \[N\], one entry a pass, with what is still to come; `scale` \[N\] is a force that counts
/// as large here.
fn extrapolate(forces: &[f64], period: usize, scale: f64) -> Option<Range> {
    let count = forces.len();
    if count < FEWEST_PASSES.max(3 * period) {
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

/// The larger in size of two forces.
pub fn larger(a: f64, b: f64) -> f64 {
    if b.abs() > a.abs() { b } else { a }
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
