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

impl ErrorSource {
    /// All of them; the error of an answer is their sum.
    pub const ALL: [Self; 6] = [
        Self::Mesh,
        Self::Ground,
        Self::Inertia,
        Self::Road,
        Self::Passes,
        Self::Days,
    ];

    /// Whether it comes from what is not simulated.
    pub fn is_skipping(self) -> bool {
        matches!(self, Self::Passes | Self::Days)
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        self.words().0
    }

    /// What makes it smaller.
    pub fn remedy(self) -> &'static str {
        self.words().1
    }

    fn words(self) -> (&'static str, &'static str) {
        const EVERY_PASS: &str = "solver.method = \"quasi-static\" simulates every one";
        match self {
            Self::Mesh => (
                "mesh",
                "a smaller solver.node_spacing may help, or a larger solver.tolerance",
            ),
            Self::Ground => (
                "ground",
                "another ground.model may help, or a larger solver.tolerance",
            ),
            Self::Inertia => ("inertia", "solver.method = \"explicit\" computes it"),
            Self::Road => ("road", "without solver.approach vehicles are followed far enough"),
            Self::Passes => ("passes not simulated", EVERY_PASS),
            Self::Days => ("days not simulated", EVERY_PASS),
        }
    }
}
