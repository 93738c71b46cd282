//! What a pass cost.

/// Counts of work that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Statistics {
    /// Vehicle positions and the return to rest, or steps of time.
    pub steps: usize,
    /// Windows solved.
    pub windows: usize,
    /// Linear solves over a window.
    pub sweeps: usize,
    /// Nodes eliminated in these, or advanced in time.
    pub node_updates: usize,
    /// Windows that the iteration did not solve, so that the exact step was taken.
    pub exact_steps: usize,
    /// Corners of graphs that these touched, each about as much work as a node.
    pub corners: usize,
    /// Most nodes in one window, apart from the steps from rest and to it.
    pub widest_window: usize,
}

impl std::ops::AddAssign for Statistics {
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.windows += other.windows;
        self.sweeps += other.sweeps;
        self.node_updates += other.node_updates;
        self.exact_steps += other.exact_steps;
        self.corners += other.corners;
        self.widest_window = self.widest_window.max(other.widest_window);
    }
}
