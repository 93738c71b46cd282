//! How fast adhesion changes: how far the vehicle can drive before it changes by so much.

/// Nodes side by side, or lattice points, that are looked at together.
pub(super) const BLOCK: usize = 32;

/// How fast the adhesion of a node changes as the vehicle drives.
#[derive(Debug, Clone)]
pub(super) struct Rates {
    /// Of a block of lattice points and both beside it: the largest change from a point of the lattice to the next \[N/m\].
    around: Vec<f64>,
    phases: usize,
}

impl Rates {
    /// Of the adhesion \[N/m\] on a lattice, phase by phase.
    pub fn new(adhesion: &[&[f64]]) -> Self {
        let phases = adhesion.len();
        let mut largest = vec![0.0_f64; adhesion[0].len().div_ceil(BLOCK) + 2];
        for (k, phase) in adhesion.iter().enumerate() {
            // The last phase is followed by the next point of the first one.
            let next = &adhesion[(k + 1) % phases][usize::from(k + 1 == phases)..];
            for (point, (a, b)) in phase.iter().zip(next).enumerate() {
                let largest = &mut largest[point / BLOCK + 1];
                *largest = largest.max((b - a).abs());
            }
        }
        let around = largest.windows(3);
        Self {
            around: around.map(|rates| rates[0].max(rates[1]).max(rates[2])).collect(),
            phases,
        }
    }

    /// How many lattice units the vehicle can drive before the adhesion of any node of a block, the first of which stands at lattice point
    /// `first`, changes by more than `slack` \[N/m\]; at most a block's length, over which the block does not leave the points around.
    pub fn lasts(&self, first: usize, slack: f64) -> i64 {
        let most = (BLOCK * self.phases) as f64;
        (slack / self.around[first / BLOCK]).min(most) as i64
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// On a lattice that is flat but for some steep places.
        #[test]
        fn adhesion_lasts_as_long_as_it_is_said_to(
            steep in prop::collection::vec((0..600_usize, -1.0..1.0_f64), 1..12),
            phases in 1..5_usize,
            first in 40..100_usize,
            phase in 0..5_usize,
            slack in 0.0..0.5_f64,
        ) {
            let lattice = 200 * phases;
            let mut value = 0.0;
            let values: Vec<f64> = (0..lattice)
                .map(|at| {
                    let steps = steep.iter().filter(|(place, _)| *place % lattice == at);
                    value += 1e-3 + steps.map(|(_, step)| step).sum::<f64>();
                    value
                })
                .collect();
            let by_phase: Vec<Vec<f64>> =
                (0..phases).map(|phase| values[phase..].iter().step_by(phases).copied().collect()).collect();
            let rates = Rates::new(&by_phase.iter().map(|phase| &phase[..]).collect::<Vec<_>>());
            let lasts = rates.lasts(first, slack);
            prop_assert!((0..=(BLOCK * phases) as i64).contains(&lasts));
            for node in 0..BLOCK {
                let now = (first + node) * phases + phase % phases;
                for driven in 0..=lasts as usize {
                    let change = (values[now - driven] - values[now]).abs();
                    prop_assert!(change <= slack + 1e-12, "node {node} changes by {change} after {driven}");
                }
            }
        }
    }
}
