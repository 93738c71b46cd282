//! What the error of an answer comes from.

/// What the estimated error of an answer comes from, or most of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorSource {
    /// Node spacing and vehicle step.
    Mesh,
    /// The ground's displacement.
    Ground,
    /// Inertia, where it is left out.
    Inertia,
    /// The road beyond where vehicles are followed.
    Road,
    /// Passes that are not simulated.
    Passes,
    /// Days of which few passes are simulated, or none.
    Days,
}

use ErrorSource::{Days, Ground, Inertia, Mesh, Passes, Road};

impl ErrorSource {
    /// All of them; the error of an answer is their sum.
    pub const ALL: [Self; 6] = [Mesh, Ground, Inertia, Road, Passes, Days];

    /// Whether it comes from what is not simulated.
    pub fn is_skipping(self) -> bool {
        matches!(self, Passes | Days)
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Mesh => "mesh",
            Ground => "ground",
            Inertia => "inertia",
            Road => "road",
            Passes => "passes not simulated",
            Days => "days not simulated",
        }
    }

    /// What makes it smaller.
    pub fn remedy(self) -> &'static str {
        match self {
            Mesh => "a smaller solver.node_spacing may help, or a larger solver.tolerance",
            Ground => "another ground.model may help, or a larger solver.tolerance",
            Inertia => "solver.method = \"explicit\" computes it",
            Road => "without solver.approach vehicles are followed far enough",
            Passes | Days => "solver.method = \"quasi-static\" simulates every one",
        }
    }
}
