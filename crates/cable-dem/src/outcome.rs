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
    /// Minimum and maximum force on each of them during the pass and after it \[N\].
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
        let (force, restraints) = (state.end_forces(cable)?, state.restraint_forces(cable)?);
        let (least, largest) = extremes(state, cable);
        Ok(Self {
            max_compression: largest.max(force.upstream).max(force.downstream),
            max_tension: -least.min(force.upstream).min(force.downstream),
            upstream_displacement: state.displacement[0],
            downstream_displacement: state.displacement[state.displacement.len() - 1],
            restraint_slips: state.clamp_slips(cable),
            ..Self::of_forces(force, restraints)
        })
    }

    /// What is known from forces on the ends and the `restraints` \[N\] alone, before they change.
    pub(crate) fn of_forces(force: EndForces, restraints: Vec<f64>) -> Self {
        Self {
            force,
            peak: force,
            lowest: force,
            restraint_ranges: restraints.iter().map(|force| [*force; 2]).collect(),
            restraints,
            ..Self::default()
        }
    }

    /// Takes account of forces on the ends \[N\] during the pass.
    pub(crate) fn see(&mut self, force: EndForces) {
        self.peak.upstream = self.peak.upstream.max(force.upstream);
        self.peak.downstream = self.peak.downstream.max(force.downstream);
        self.lowest.upstream = self.lowest.upstream.min(force.upstream);
        self.lowest.downstream = self.lowest.downstream.min(force.downstream);
    }

    /// The same for the `forces` on all clamps \[N\].
    pub(crate) fn see_clamps(&mut self, forces: &[f64]) {
        for (range, &force) in self.restraint_ranges.iter_mut().zip(forces) {
            *range = [range[0].min(force), range[1].max(force)];
        }
    }

    /// Ends the pass, which left the cable in `state`.
    pub(crate) fn ended(mut self, cable: &DuctedCable, state: &CableState) -> Result<Self, CableError> {
        let rest = Self::at_rest(cable, state)?;
        self.see(rest.force);
        self.see_clamps(&rest.restraints);
        Ok(Self {
            peak: self.peak,
            lowest: self.lowest,
            restraint_ranges: self.restraint_ranges,
            dissipated: self.dissipated,
            statistics: self.statistics,
            ..rest
        })
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
        let end = |of: &dyn Fn(&Self) -> f64| parts.iter().map(|(weight, part)| weight * of(part)).sum();
        let ends = |of: fn(&Self) -> EndForces| EndForces {
            upstream: end(&|part| of(part).upstream),
            downstream: end(&|part| of(part).downstream),
        };
        Self {
            force: ends(|o| o.force),
            peak: ends(|o| o.peak),
            lowest: ends(|o| o.lowest),
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
