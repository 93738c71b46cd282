//! Numbers that were found by experiment, each with what it was fitted to and, if that was
//! measured, what is lost if it is half or twice as large. All others of this crate are
//! definitions, accuracies or limits of an answer, and stand where they are used.

/// The ground and the road.
pub mod ground {
    /// A motion that is less wider than this than its duct is deep counts as so wide: a coarser
    /// mesh would save little.
    pub const SMOOTHER: f64 = 1.25;
    /// The road is looked at over a hundred times the distance from wheel to duct, and ten times
    /// the thickness of the layers.
    pub const FARTHEST_DISTANCES: f64 = 100.0;
    pub const FARTHEST_THICKNESSES: f64 = 10.0;
    /// But no farther than this \[m\].
    pub const FARTHEST: f64 = 3000.0;
    /// Vehicles are followed so many times as far as the farthest place where the motion turns.
    pub const BEYOND_THE_TURN: f64 = 1.5;
    /// Length of the cable on which the advance against locked friction is measured where heat
    /// makes that necessary, as a multiple of that over which the duct's motion changes.
    pub const LAW_LENGTH: f64 = 24.0;
}

/// Meshes, and the error that they leave.
pub mod meshes {
    /// Typical errors of the force on each level: medians of 200 random scenes, rounded up,
    /// measured against far finer runs (`validation/tests/honest.rs`). No error is stated below them.
    pub const TYPICAL: [f64; 7] = [5e-2, 3e-2, 6e-3, 1.5e-3, 4e-4, 1e-4, 2e-5];
    /// A length scale is at most so many slip lengths.
    pub const SLIPS: f64 = 2.0;
    /// Length of cable solved per vehicle step, averaged over repeated solves \[length scales\];
    /// right within a factor of three.
    pub const MOVED: f64 = 8.0;
    /// Maximum work of all passes on one mesh, in updates of a node: about twenty seconds. Before a
    /// run is refused it may be more.
    pub const MAX_NODE_UPDATES: usize = 2_000_000_000;
}

/// Which method a plan takes, and its rough time.
pub mod methods {
    /// Measured time a node's update takes \[s\] on one core of about 3 GHz: without inertia, and
    /// explicit.
    pub const QUASI_STATIC_SECONDS: f64 = 1.1e-8;
    pub const EXPLICIT_SECONDS: f64 = 8e-9;
    /// Periods that are simulated at the start, and then for every factor e of periods: half of all
    /// scenes need fewer, and nearly all.
    pub const TYPICAL_PERIODS: (f64, f64) = (12.0, 2.2);
    pub const MAX_PERIODS: (f64, f64) = (20.0, 8.0);
    /// Periods of a day that are simulated where the cable is heated every day, and days with them
    /// until one is like the one before.
    pub const PERIODS_A_DAY: f64 = 24.0;
    pub const DAYS: f64 = 9.0;
    /// A run takes about so many times the passes on its first mesh: those on coarser ones, and
    /// jumps that are looked for before.
    pub const EVERY_PASS_MESHES: f64 = 1.4;
    pub const JUMP_MESHES: f64 = 2.0;
    /// Jumps are taken where they spare this share of the passes.
    pub const SPARED: f64 = 0.3;
    /// What an even order leaves wrong as a rule where vehicles come in random order: 3 to 4 % of
    /// early forces.
    pub const DRAWN_ERROR: f64 = 0.04;
}

/// Periods that stand in for the traffic.
pub mod periods {
    /// More kinds than this that differ by their load alone have others that stand in for them. In
    /// random order a period of at most so many vehicles is taken as it is, and with heat it may be
    /// longer than a day.
    pub const FEW: usize = 12;
    /// Stand-ins for them.
    pub const STAND_INS: usize = 48;
    /// A mix is near where every vehicle's share is right within this share of itself.
    pub const NEAR: f64 = 0.05;
    /// The nearest of all that are at most so many times as long is taken.
    pub const LONGER: f64 = 1.25;
    /// It has at least so many vehicles: in shorter ones too few of those follow each other that do
    /// in the traffic, and its largest forces are missed.
    pub const MIN_VEHICLES: usize = 100;
    /// A mix that has the shares exactly is taken where it is at most so many times as long as a
    /// near one, or so short: a near one is compared with another, and hardly shows which vehicles
    /// follow each other in the traffic.
    pub const EXACT: usize = 2;
    pub const SHORT: usize = 600;
}
