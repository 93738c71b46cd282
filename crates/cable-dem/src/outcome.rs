//! What a pass reports: forces, peaks, movements, and what it cost.

use crate::extremes::extremes;
use crate::{CableError, CableState, DuctedCable, EndForces, Statistics};

/// What one pass did.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct PassOutcome {
    /// Force on each end after the pass \[N\], compression positive.
    pub force: EndForces,
    /// Largest force on each end during the pass \[N\].
    pub peak: EndForces,
    /// Smallest force on each end during the pass \[N\]: the largest tension where it is negative.
    pub lowest: EndForces,
    /// Largest compression along the cable after the pass \[N\].
    pub max_compression: f64,
    /// Largest tension along the cable after the pass \[N\], negative where all of it is compressed.
    pub max_tension: f64,
    /// Displacement at x = 0 after the pass \[m\].
    pub upstream_displacement: f64,
    /// Displacement at x = length after the pass \[m\].
    pub downstream_displacement: f64,
    /// Force of the cable on each of its clamps after the pass \[N\], positive toward growing x, in the order of
    /// [`DuctedCable::restraints`].
    pub restraints: Vec<f64>,
    /// Least and largest force on each of them during the pass and after it \[N\].
    pub restraint_ranges: Vec<[f64; 2]>,
    /// How far each of them has slipped after the pass \[m\].
    pub restraint_slips: Vec<f64>,
    /// Work that slip has turned into heat \[J\].
    pub dissipated: f64,
    /// What the pass cost.
    pub statistics: Statistics,
}

impl PassOutcome {
    /// What a cable at rest shows: forces and movements of `state`, no peaks beyond them, no heat, no work.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the cable is as long as the state's mesh.
    pub fn at_rest(cable: &DuctedCable, state: &CableState) -> Result<Self, CableError> {
        Recorder::new(cable, state)?.outcome(cable, state, state.end_forces(cable)?)
    }

    /// The same with the cable moved as a whole by `distance` \[m\].
    #[must_use]
    pub fn moved(mut self, distance: f64) -> Self {
        self.upstream_displacement += distance;
        self.downstream_displacement += distance;
        self
    }

    /// The sum of `parts`, each with its weight: a mean, or what lies between two passes. Clamps that a part does not have bear
    /// nothing in it. What the parts cost is left out.
    pub fn combined(parts: &[(f64, &Self)]) -> Self {
        let of_clamps = |of: fn(&Self) -> &[f64]| -> Vec<f64> {
            let count = parts.iter().map(|(_, part)| of(part).len()).max().unwrap_or(0);
            let force = |part: &Self, i: usize| of(part).get(i).copied().unwrap_or(0.0);
            let sum = |i| parts.iter().map(|(weight, part)| weight * force(part, i)).sum();
            (0..count).map(sum).collect()
        };
        let sum = |of: fn(&Self) -> f64| parts.iter().map(|(weight, part)| weight * of(part)).sum();
        Self {
            force: EndForces {
                upstream: sum(|o| o.force.upstream),
                downstream: sum(|o| o.force.downstream),
            },
            peak: EndForces {
                upstream: sum(|o| o.peak.upstream),
                downstream: sum(|o| o.peak.downstream),
            },
            lowest: EndForces {
                upstream: sum(|o| o.lowest.upstream),
                downstream: sum(|o| o.lowest.downstream),
            },
            max_compression: sum(|o| o.max_compression),
            max_tension: sum(|o| o.max_tension),
            upstream_displacement: sum(|o| o.upstream_displacement),
            downstream_displacement: sum(|o| o.downstream_displacement),
            restraints: of_clamps(|o| &o.restraints),
            restraint_slips: of_clamps(|o| &o.restraint_slips),
            restraint_ranges: of_clamps(|o| o.restraint_ranges.as_flattened())
                .chunks_exact(2)
                .map(|range| [range[0], range[1]])
                .collect(),
            dissipated: sum(|o| o.dissipated),
            statistics: Statistics::default(),
        }
    }
}

/// What gathers as the vehicle passes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Recorder {
    pub peak: EndForces,
    pub lowest: EndForces,
    /// Least and largest force on every clamp \[N\].
    clamps: Vec<[f64; 2]>,
    pub dissipated: f64,
    pub statistics: Statistics,
}

impl Recorder {
    /// The recorder of a pass over `cable` that begins in `state`.
    pub fn new(cable: &DuctedCable, state: &CableState) -> Result<Self, CableError> {
        let start = state.end_forces(cable)?;
        let clamps = state.restraint_forces(cable)?.into_iter();
        Ok(Self {
            peak: start,
            lowest: start,
            clamps: clamps.map(|force| [force; 2]).collect(),
            dissipated: 0.0,
            statistics: Statistics::default(),
        })
    }

    pub fn record(&mut self, force: EndForces) {
        self.peak.upstream = self.peak.upstream.max(force.upstream);
        self.peak.downstream = self.peak.downstream.max(force.downstream);
        self.lowest.upstream = self.lowest.upstream.min(force.upstream);
        self.lowest.downstream = self.lowest.downstream.min(force.downstream);
    }

    /// Records the `forces` on all clamps \[N\].
    pub fn record_clamps(&mut self, forces: &[f64]) {
        for (range, &force) in self.clamps.iter_mut().zip(forces) {
            *range = [range[0].min(force), range[1].max(force)];
        }
    }

    /// The outcome of a pass that left the cable in `state` with `force` on its ends.
    pub fn outcome(
        mut self,
        cable: &DuctedCable,
        state: &CableState,
        force: EndForces,
    ) -> Result<PassOutcome, CableError> {
        self.record(force);
        let restraints = state.restraint_forces(cable)?;
        self.record_clamps(&restraints);
        let (least, largest) = [force.upstream, force.downstream]
            .into_iter()
            .fold(extremes(state, cable), |(least, largest), force| {
                (least.min(force), largest.max(force))
            });
        Ok(PassOutcome {
            force,
            peak: self.peak,
            lowest: self.lowest,
            max_compression: largest,
            max_tension: -least,
            upstream_displacement: state.displacement()[0],
            downstream_displacement: state.displacement()[state.displacement().len() - 1],
            restraints,
            restraint_ranges: self.clamps,
            restraint_slips: state.clamp_slips(cable),
            dissipated: self.dissipated,
            statistics: self.statistics,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::PassOutcome;

    #[test]
    fn a_part_without_a_clamp_bears_nothing_at_it() {
        let part = |restraints: &[f64]| PassOutcome {
            restraints: restraints.to_vec(),
            ..PassOutcome::default()
        };
        let (none, one, two) = (part(&[]), part(&[8.0]), part(&[4.0, 2.0]));
        let sum = PassOutcome::combined(&[(0.5, &one), (0.25, &two), (0.25, &none)]);
        assert_eq!(sum.restraints, [5.0, 0.5]);
        assert_eq!(
            PassOutcome::combined(&[(0.25, &none), (1.0, &one)]).restraints,
            [8.0]
        );
        assert!(PassOutcome::combined(&[]).restraints.is_empty());
    }
}
