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
        let force = state.end_forces(cable)?;
        Recorder::new(force).outcome(cable, state, force)
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
        let clamps = parts
            .iter()
            .map(|(_, part)| part.restraints.len())
            .max()
            .unwrap_or(0);
        let clamp = |i: usize| {
            let force = |part: &Self| part.restraints.get(i).copied().unwrap_or(0.0);
            parts.iter().map(|(weight, part)| weight * force(part)).sum()
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
            restraints: (0..clamps).map(clamp).collect(),
            dissipated: sum(|o| o.dissipated),
            statistics: Statistics::default(),
        }
    }
}

/// What gathers as the vehicle passes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recorder {
    pub peak: EndForces,
    pub lowest: EndForces,
    pub dissipated: f64,
    pub statistics: Statistics,
}

impl Recorder {
    pub fn new(start: EndForces) -> Self {
        Self {
            peak: start,
            lowest: start,
            dissipated: 0.0,
            statistics: Statistics::default(),
        }
    }

    pub fn record(&mut self, force: EndForces) {
        self.peak.upstream = self.peak.upstream.max(force.upstream);
        self.peak.downstream = self.peak.downstream.max(force.downstream);
        self.lowest.upstream = self.lowest.upstream.min(force.upstream);
        self.lowest.downstream = self.lowest.downstream.min(force.downstream);
    }

    /// Seen in the mirror the ends change places; compression stays compression.
    pub fn mirror(&mut self) {
        std::mem::swap(&mut self.peak.upstream, &mut self.peak.downstream);
        std::mem::swap(&mut self.lowest.upstream, &mut self.lowest.downstream);
    }

    /// The outcome of a pass that left the cable in `state` with `force` on its ends.
    pub fn outcome(
        mut self,
        cable: &DuctedCable,
        state: &CableState,
        force: EndForces,
    ) -> Result<PassOutcome, CableError> {
        self.record(force);
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
            restraints: state.restraint_forces(cable)?,
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
