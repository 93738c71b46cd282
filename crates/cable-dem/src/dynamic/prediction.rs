//! Contact states as the vehicle sees them.
//!
//! The pattern of slip travels with the vehicle: what a node did when it last stood at some distance from it, the next
//! node will most likely do when it gets there. The active set started from that needs one or two solves.

use ground_field::Direction;

use crate::Mesh;
use crate::quasi_static::Contact;

/// Contact states on the lattice of distances from the vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct Prediction {
    by_distance: Vec<Contact>,
    /// Lattice index of the first node.
    first: usize,
    /// Lattice points between nodes.
    phases: usize,
    /// Lattice points per step of the vehicle.
    stride: usize,
    forward: bool,
}

impl Prediction {
    /// Forgets all, and stands at the start of a pass of so many `steps`.
    pub fn start(&mut self, mesh: &Mesh, direction: Direction, steps: usize) {
        self.phases = mesh.phases();
        self.stride = mesh.stride();
        self.forward = direction == Direction::Forward;
        self.first = if self.forward { steps * self.stride } else { 0 };
        self.by_distance.clear();
        self.by_distance
            .resize(steps * self.stride + mesh.nodes() * self.phases, Contact::Stuck);
    }

    /// Moves the vehicle by one step.
    pub fn advance(&mut self) {
        if self.forward {
            self.first = self.first.saturating_sub(self.stride);
        } else {
            self.first += self.stride;
        }
    }

    /// Writes the predicted states to `contacts`.
    pub fn read(&self, contacts: &mut [Contact]) {
        let there = self
            .by_distance
            .iter()
            .skip(self.first)
            .step_by(self.phases.max(1));
        for (contact, predicted) in contacts.iter_mut().zip(there) {
            *contact = *predicted;
        }
    }

    /// Remembers the states of the step just solved.
    pub fn write(&mut self, contacts: &[Contact]) {
        let there = self
            .by_distance
            .iter_mut()
            .skip(self.first)
            .step_by(self.phases.max(1));
        for (contact, remembered) in contacts.iter().zip(there) {
            *remembered = *contact;
        }
    }
}
