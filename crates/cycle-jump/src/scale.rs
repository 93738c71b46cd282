//! What counts as large in a run: errors are shares of the largest force and movement so far.

use cable_dem::{PassOutcome, RestingCable};

use crate::period::largest;

/// A force \[N\] and a movement \[m\]; or shares of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    pub force: f64,
    pub movement: f64,
}

impl Scale {
    /// Takes account of the forces at rest after a pass, and of how far it left the ends.
    pub fn see(&mut self, outcome: &PassOutcome) {
        let (up, down) = (outcome.force.upstream, outcome.force.downstream);
        let forces = [outcome.max_compression, outcome.max_tension, up, down];
        self.force = self.force.max(largest(&forces));
        let ends = [outcome.upstream_displacement, outcome.downstream_displacement];
        self.movement = self.movement.max(largest(&ends));
    }

    /// What a `change` \[m\] of the displacements changes, as shares of the scale.
    pub fn shares(&self, cable: &RestingCable, change: &[f64]) -> Self {
        Self {
            force: cable.largest_force(change) / self.force,
            movement: largest(change) / self.movement,
        }
    }

    /// The larger of both.
    pub fn worse(&self) -> f64 {
        self.force.max(self.movement)
    }
}
