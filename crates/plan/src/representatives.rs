//! Few vehicles in place of many kinds that differ by their load alone, such as the axles of a
//! histogram.
//!
//! Sorted by load, the traffic is cut into equal shares, and each gets one of the kinds: that whose
//! advance is nearest to the mean over the share, with what is left over carried on to the next. So
//! the stand-ins advance the cable as far in the mean as all kinds do, the rare heavy ones
//! included. The advance is that of one of the first passes, from the table of
//! [`occurrence`](crate::occurrence): rough on other ground than its own, but only its course over
//! the load counts.

use ground_field::DuctMotion;

use crate::ground::load_ratio;
use crate::occurrence;
use creepage_scene::Scene;

/// How far a pass of each kind advances a cable that nothing holds \[m\], where the scene's
/// vehicles differ by their load alone.
pub fn advances(scene: &Scene, motions: &[DuctMotion]) -> Option<Vec<f64>> {
    let (first, others) = scene.vehicles.split_first()?;
    if others.iter().any(|other| load_ratio(other, first).is_none()) {
        return None;
    }
    let peaks = motions.iter().map(DuctMotion::peak_longitudinal);
    let number = scene.friction_limit() * scene.duct.depth.powi(2) / scene.cable.axial_stiffness;
    let advance = |peak: f64| peak * occurrence::at(number / peak).advance_share;
    let advances: Vec<f64> = peaks.clone().map(advance).collect();
    // If nothing creeps it makes no difference.
    let creeps = advances.iter().any(|&advance| advance > 0.0);
    Some(if creeps { advances } else { peaks.collect() })
}

/// How many of each kind are among `length` stand-ins for kinds with these shares, which sum to 1.
pub fn counts(shares: &[f64], advances: &[f64], length: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..shares.len()).filter(|&kind| shares[kind] > 0.0).collect();
    order.sort_by(|&a, &b| advances[a].total_cmp(&advances[b]));
    let mut counts = vec![0; shares.len()];
    let mut carried = 0.0;
    for stratum in 0..length {
        let [from, to] = [stratum, stratum + 1].map(|edge| edge as f64 / length as f64);
        let (mut below, mut mean) = (0.0, 0.0);
        for &kind in &order {
            let above = below + shares[kind];
            let inside = (above.min(to) - below.max(from)).max(0.0);
            mean += inside * length as f64 * advances[kind];
            below = above;
        }
        let wanted = mean + carried;
        let off = |&kind: &usize| (advances[kind] - wanted).abs();
        let nearest = order.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(kind) = nearest {
            counts[kind] += 1;
            carried = wanted - advances[kind];
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean is kept to within half the step between kinds, spread over all stand-ins.
    #[test]
    fn stand_ins_keep_the_mean_with_rare_heavy_kinds_too() {
        let advances: Vec<f64> = (0..50).map(|k| f64::from(k) * f64::from(k)).collect();
        for decay in [0.02, 0.1, 0.5] {
            let raw: Vec<f64> = (0..50).map(|k| (-decay * f64::from(k)).exp()).collect();
            let total: f64 = raw.iter().sum();
            let shares: Vec<f64> = raw.iter().map(|share| share / total).collect();
            let mean: f64 = shares
                .iter()
                .zip(&advances)
                .map(|(share, advance)| share * advance)
                .sum();
            for length in [6, 12] {
                let counts = counts(&shares, &advances, length);
                assert_eq!(counts.iter().sum::<usize>(), length);
                let kept = counts
                    .iter()
                    .zip(&advances)
                    .map(|(&count, advance)| count as f64 * advance);
                let kept = kept.sum::<f64>() / length as f64;
                assert!((kept - mean).abs() * (length as f64) < 50.0, "{kept} for {mean}");
            }
        }
    }

    #[test]
    fn equal_kinds_stand_for_themselves() {
        assert_eq!(counts(&[0.25; 4], &[1.0, 3.0, 2.0, 9.0], 12), [3; 4]);
    }
}
