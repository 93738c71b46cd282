//! What a pass cost.

use crate::tuning::WATCHED_PER_UPDATE;

/// Counts of work that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Statistics {
    /// Vehicle positions and the return to rest, or steps of time.
    pub steps: usize,
    /// Windows solved, or moved by an answer that is known.
    pub windows: usize,
    /// Linear solves over a window.
    pub sweeps: usize,
    /// Nodes eliminated in these or moved so, with what bisections cost, or nodes advanced in time.
    pub node_updates: usize,
    /// Nodes looked at for slip, at every position of a vehicle.
    pub watched: usize,
    /// Windows in which the iteration cycled, so that the contact states were found by bisection of the chain.
    pub cycles: usize,
    /// Maximum number of nodes in one window, apart from the steps from rest and to it.
    pub widest_window: usize,
}

impl Statistics {
    /// All work, in updates of a node.
    pub fn work(&self) -> usize {
        self.node_updates + self.watched / WATCHED_PER_UPDATE
    }
}

impl std::ops::AddAssign for Statistics {
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.windows += other.windows;
        self.sweeps += other.sweeps;
        self.node_updates += other.node_updates;
        self.watched += other.watched;
        self.cycles += other.cycles;
        self.widest_window = self.widest_window.max(other.widest_window);
    }
}
