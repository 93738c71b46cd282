//! Contact states as the vehicle sees them.
//!
//! The pattern of slip travels with the vehicle: what a node did when it last stood at some distance from it, the next node will
//! most likely do when it gets there. Measured over six passes under Coulomb's law, the dynamic solver does 1.4 to 2.6 times the
//! work without this guess, the quasi-static one 1.1 to 1.45 times; where a sheath shears it hardly matters.

use super::chain::{Contact, Stretch};

/// Contact states on a lattice of distances from the vehicle. Node i stands at lattice point `first` + i · `phases`, where `first` is
/// given with the vehicle's position.
#[derive(Debug, Clone, Default)]
pub(crate) struct Prediction {
    by_distance: Vec<Contact>,
    phases: usize,
}

impl Prediction {
    /// Makes room for `points` lattice points, `phases` of them per node spacing; new ones are stuck.
    pub fn fit(&mut self, points: usize, phases: usize) {
        self.by_distance.resize(points, Contact::Stuck);
        self.phases = phases;
    }

    /// Writes the predicted states of the nodes in `stretch` to `contacts`.
    pub fn read(&self, first: usize, stretch: Stretch, contacts: &mut [Contact]) {
        for node in stretch.nodes() {
            contacts[node] = self.by_distance[first + node * self.phases];
        }
    }

    /// Remembers the states of the nodes in `stretch` from a step that was solved. Returned: how many of them it would have got wrong.
    pub fn write(&mut self, first: usize, stretch: Stretch, contacts: &[Contact]) -> usize {
        let mut wrong = 0;
        for node in stretch.nodes() {
            let guess = &mut self.by_distance[first + node * self.phases];
            wrong += usize::from(*guess != contacts[node]);
            *guess = contacts[node];
        }
        wrong
    }
}
