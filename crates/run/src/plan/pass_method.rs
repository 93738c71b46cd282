//! The ways in which passes are computed.

/// How all passes are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PassMethod {
    /// Every pass is simulated.
    EveryPass(CableMethod),
    /// Few are, with jumps between them.
    Jumps(CableMethod),
}

/// Solver of the cable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CableMethod {
    QuasiStatic,
    Explicit,
}

impl PassMethod {
    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::EveryPass(method) => method.name(),
            Self::Jumps(_) => "pass-law",
        }
    }

    /// The solver of the passes that are simulated.
    pub fn cable_method(self) -> CableMethod {
        match self {
            Self::EveryPass(method) | Self::Jumps(method) => method,
        }
    }

    pub fn has_inertia(self) -> bool {
        self.cable_method() != CableMethod::QuasiStatic
    }
}

impl CableMethod {
    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::QuasiStatic => "quasi-static",
            Self::Explicit => "explicit",
        }
    }
}
