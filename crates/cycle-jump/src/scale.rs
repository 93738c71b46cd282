//! What counts as large in a run: forces and movements are compared with the largest so far.

use cable_dem::{CableError, CableState, PassOutcome, RestingCable};

use crate::period::largest;

/// A force \[N\] and a movement \[m\] that errors are shares of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// \[N\]
    pub force: f64,
    /// \[m\]
    pub movement: f64,
}

impl Scale {
    /// Takes account of what the cable in `state`, moved as a whole by `offset` \[m\], shows.
    pub fn see(&mut self, cable: &RestingCable, state: &CableState, offset: f64) -> Result<(), CableError> {
        let rest = PassOutcome::at_rest(cable.cable(), state)?;
        self.see_outcome(&rest);
        self.movement = self.movement.max(largest(state.displacement()) + offset.abs());
        Ok(())
    }

    /// Takes account of the forces at rest after a pass, and of how far it left the ends.
    pub fn see_outcome(&mut self, seen: &PassOutcome) {
        let ends = [seen.force.upstream, seen.force.downstream];
        let forces = [seen.max_compression, seen.max_tension].into_iter().chain(ends);
        self.force = forces.fold(self.force, |most, force| most.max(force.abs()));
        let ends = [seen.upstream_displacement, seen.downstream_displacement];
        self.movement = ends
            .into_iter()
            .fold(self.movement, |most, moved| most.max(moved.abs()));
    }

    /// What `change` \[m\] of the displacements changes, as shares of the scale.
    pub fn shares(&self, cable: &RestingCable, change: &[f64]) -> Scale {
        Scale {
            force: cable.largest_force(change) / self.force,
            movement: largest(change) / self.movement,
        }
    }
}
