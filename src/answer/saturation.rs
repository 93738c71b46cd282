//! Where the force levels off.
//!
//! The force at a third, two thirds and all of the passes gives two gains; of vehicles that alternate, the largest in size
//! counts. Where the second is much smaller than the first, the gains shrink geometrically, and what is still to come is their
//! remaining sum (Aitken's Δ²; A. C. Aitken, Proc. R. Soc. Edinburgh 46 (1926) 289). Early on the force grows like √n: the
//! gains' ratio is above 0.7 and nothing can be said yet.

use cable_dem::PassOutcome;

use super::balance;
use super::record::{PassRecord, Saturation};
use crate::Scene;
use crate::scene::End;

/// Gains whose ratio is above this do not level off yet.
const LARGEST_RATIO: f64 = 0.5;
/// Largest part of the saturated force that may be extrapolated.
const LARGEST_REMAINDER: f64 = 0.03;
/// Fewest passes from which anything can be said.
const FEWEST_PASSES: usize = 12;
/// Share of the saturated force whose pass is stated.
pub const LEVEL: f64 = 0.95;
/// A force already reached may exceed the saturation by this share of it, which is no more than an extrapolation's error.
const NEARLY: f64 = 0.02;

/// Saturation of the force series `forces` \[N\], one entry a pass; `scale` \[N\] is a force that counts as large here.
pub fn saturation(forces: &[f64], scale: f64) -> Option<Saturation> {
    let count = forces.len();
    if count < FEWEST_PASSES {
        return None;
    }
    // The largest of a few passes: of vehicles that alternate, each leaves another force.
    let width = (count / 12).max(1);
    let largest = |end: usize| {
        let window = forces[end - width..end].iter().copied();
        window.fold(0.0, larger)
    };
    let (first, second, third) = (largest(count / 3), largest(2 * count / 3), largest(count));
    let (early, late) = (second - first, third - second);
    if third.abs() < 1e-3 * scale {
        return None;
    }
    let remainder = if late.abs() <= 1e-4 * third.abs() {
        0.0
    } else {
        let ratio = late / early;
        if !(0.0..=LARGEST_RATIO).contains(&ratio) {
            return None;
        }
        late * ratio / (1.0 - ratio)
    };
    let force = third + remainder;
    if remainder.abs() > LARGEST_REMAINDER * force.abs() {
        return None;
    }
    let reached = forces.iter().position(|f| f / force >= LEVEL)?;
    Some(Saturation {
        force_n: force,
        passes_to_95_percent: reached as u64 + 1,
    })
}

/// The force that a load cell would show: at the end that is held, the larger one of two, and inside the cable where none
/// is; and its largest value while vehicles pass.
pub fn force_series(scene: &Scene, outcomes: &[PassOutcome]) -> (Vec<f64>, f64) {
    let pick = |force: fn(&PassOutcome) -> f64, peak: fn(&PassOutcome) -> f64| {
        let scale = outcomes
            .iter()
            .map(peak)
            .fold(0.0, |largest: f64, p| largest.max(p.abs()));
        (outcomes.iter().map(force).collect::<Vec<_>>(), scale)
    };
    let upstream = || {
        pick(
            |o| o.force.upstream,
            |o| o.peak.upstream.abs().max(o.lowest.upstream.abs()),
        )
    };
    let downstream = || {
        pick(
            |o| o.force.downstream,
            |o| o.peak.downstream.abs().max(o.lowest.downstream.abs()),
        )
    };
    match (scene.ends.upstream, scene.ends.downstream) {
        (End::Free, End::Free) => pick(|o| o.max_compression, |o| o.max_compression),
        (_, End::Free) => upstream(),
        (End::Free, _) => downstream(),
        _ => {
            let last = outcomes
                .last()
                .map_or((0.0, 0.0), |o| (o.force.upstream, o.force.downstream));
            if last.0.abs() > last.1.abs() {
                upstream()
            } else {
                downstream()
            }
        }
    }
}

/// The saturation that `records` bear out: at least what they already reach, if that is nearly it, and no more than friction
/// can carry to an end whose other end is free.
pub fn borne_out(scene: &Scene, records: &[PassRecord], mut saturation: Saturation) -> Option<Saturation> {
    let free = scene.ends.upstream == End::Free || scene.ends.downstream == End::Free;
    let limit = scene.friction_limit() * scene.duct.length;
    if free && scene.restraints.is_empty() && saturation.force_n.abs() > (1.0 + balance::MARGIN) * limit {
        return None;
    }
    let held = scene.ends.upstream != End::Free || scene.ends.downstream != End::Free;
    let force = |record: &PassRecord| {
        if held {
            larger(record.upstream_force_n, record.downstream_force_n)
        } else {
            record.max_compression_n
        }
    };
    let largest = records.iter().map(force).fold(0.0, larger);
    if largest.abs() > saturation.force_n.abs() {
        if largest.abs() > (1.0 + NEARLY) * saturation.force_n.abs() {
            // The force falls from there: it does not level off.
            return None;
        }
        saturation.force_n = largest;
    }
    let share = LEVEL * saturation.force_n;
    let reached = records.iter().find(|record| force(record) / share >= 1.0);
    match (reached, records.last()) {
        (Some(record), _) => saturation.passes_to_95_percent = record.pass,
        // What is said to have been reached has to be among the records.
        (None, Some(last)) if saturation.passes_to_95_percent <= last.pass => return None,
        _ => {}
    }
    Some(saturation)
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
        let found = saturation(&forces, 500.0).expect("it levels off");
        assert!((found.force_n / 500.0 - 1.0).abs() < 0.01, "{found:?}");
        // 1 − 0.93ⁿ ≥ 0.95 from n = ln 0.05 / ln 0.93 = 41.3 on.
        assert!((40..=43).contains(&found.passes_to_95_percent), "{found:?}");
    }

    #[test]
    fn growth_with_the_root_of_the_passes_does_not_level_off() {
        let forces: Vec<f64> = (1..=2000).map(|n| f64::from(n).sqrt()).collect();
        assert_eq!(saturation(&forces, 1.0), None);
        assert_eq!(saturation(&forces[..5], 1.0), None);
    }

    #[test]
    fn tension_levels_off_like_compression_and_nothing_like_nothing() {
        let forces: Vec<f64> = (1..=60).map(|n| -500.0 * (1.0 - 0.9_f64.powi(n))).collect();
        assert!((saturation(&forces, 500.0).expect("it levels off").force_n + 500.0).abs() < 5.0);
        assert_eq!(saturation(&[0.0; 60], 500.0), None);
    }
}
