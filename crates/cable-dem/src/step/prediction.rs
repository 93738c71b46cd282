//! Contact states as the vehicle sees them.
//!
//! The pattern of slip travels with the vehicle: what a node did when it last stood at some distance from it, the next node will
//! most likely do when it gets there. Measured over mixed traffic of 600 passes, there is 1.3 to 2.2 times the work without
//! this guess; where a sheath shears it hardly matters.

use super::problem::{Contact, Stretch};

/// Contact states on a lattice of distances from the vehicle. Node i stands at lattice point `first` + i · `phases`, where `first` is
/// given with the vehicle's position.
#[derive(Debug, Clone, Default)]
pub(crate) struct Prediction {
    by_distance: Vec<Contact>,
    phases: usize,
}

impl Prediction {
    /// With so many lattice `points`, `phases` of them from one node to the next, all stuck.
    pub fn new(points: usize, phases: usize) -> Self {
        Self {
            by_distance: vec![Contact::Stuck; points],
            phases,
        }
    }

    /// Writes the predicted states of the nodes in `stretch` to `contacts`.
    pub fn read(&self, first: usize, stretch: Stretch, contacts: &mut [Contact]) {
        for node in stretch.nodes() {
            contacts[node] = self.by_distance[first + node * self.phases];
        }
    }

    /// Remembers the states of the nodes in `stretch` from a step that was solved.
    pub fn write(&mut self, first: usize, stretch: Stretch, contacts: &[Contact]) {
        for node in stretch.nodes() {
            self.by_distance[first + node * self.phases] = contacts[node];
        }
    }
}
