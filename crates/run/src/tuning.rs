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
    /// measured against far finer runs (`tests/planner/honest.rs`). No error is stated below them.
    pub const TYPICAL: [f64; 7] = [5e-2, 3e-2, 6e-3, 1.5e-3, 4e-4, 1e-4, 2e-5];
    /// A length scale is at most so many slip lengths.
    pub const SLIPS: f64 = 2.0;
    /// Length of cable solved per vehicle step, averaged over repeated solves \[length scales\];
    /// right within a factor of three.
    pub const MOVED: f64 = 8.0;
    /// Most nodes eliminated in all passes on one mesh: about ten seconds.
    pub const MAX_NODE_UPDATES: usize = 2_000_000_000;
    /// A mesh twice as fine takes about this many times the node updates.
    pub const REFINEMENT_COST: usize = 4;
    /// What is left to the mesh at least, as a share of the tolerance, or of the largest other
    /// error if that is beyond it.
    pub const LEAST_SHARE: f64 = 0.5;
    /// Share of the work that finding jumps is taken for.
    pub const FINDING: f64 = 0.3;
    /// The coarsest level on which it is seen whether anything slips: 24 nodes a depth.
    pub const SHARP: usize = 3;
    /// What counts of the differences between meshes as error: of the last one, the one before, and
    /// so on. Fitted to 200 random scenes (`tests/planner/honest.rs`), so that the true error is
    /// larger in one or two of a hundred.
    pub const WEIGHTS: [f64; 4] = [1.5, 0.35, 0.12, 0.04];
    /// The same from 40 passes on, where chance agreement is unlikely.
    pub const WEIGHTS_OF_MANY: [f64; 4] = [1.5, 0.2, 0.06, 0.02];
    pub const MANY: usize = 40;
    /// Weight of the only difference.
    pub const WEIGHT_ALONE: f64 = 3.0;
}

/// Which method a plan takes, and its rough time.
pub mod methods {
    /// Measured time a node's update takes \[s\] on one core of about 3 GHz: without inertia, and
    /// explicit.
    pub const QUASI_STATIC_SECONDS: f64 = 1.1e-8;
    pub const EXPLICIT_SECONDS: f64 = 1e-9;
    /// Periods that are simulated at the start, and then for every factor e of periods: half of all
    /// scenes need fewer, and nearly all.
    pub const TYPICAL_PERIODS: (f64, f64) = (12.0, 2.2);
    pub const MOST_PERIODS: (f64, f64) = (20.0, 8.0);
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
    /// It has at least so many vehicles: in shorter ones too few of those follow each other that do
    /// in the traffic, and its largest forces are missed.
    pub const LEAST: usize = 100;
    /// A mix that has the shares exactly is taken where it is at most so many times as long as a
    /// near one, or so short: a near one is compared with another, and hardly shows which vehicles
    /// follow each other in the traffic.
    pub const EXACT: usize = 2;
    pub const SHORT: usize = 600;
}

/// Jumps over passes, and draws of a random order.
pub mod jumps {
    /// Passes after which a run takes no more jumps, and fewest and most periods of them.
    pub const PATIENCE: (u64, u64, u64) = (7200, 12, 600);
    /// Error of a single jump beside the tolerance to begin with, and length of the first jump
    /// beside the periods before it; the largest such error.
    pub const FIRST: (f64, f64) = (6.0, 0.8);
    pub const LARGEST: f64 = 0.06;
    /// Share of the tolerance that jumps may take: the first mesh leaves about as much.
    pub const SHARE: f64 = 0.4;
    /// Passes simulated at the start, about, and fewest and most periods of them.
    pub const FIRST_PASSES: usize = 120;
    pub const FEWEST_FIRST_PERIODS: u64 = 2;
    pub const MOST_FIRST_PERIODS: u64 = 8;
    /// Jumps are looked for on the level below the first, where they cost a fourth, unless the duct
    /// is so many depths short.
    pub const SHORT: f64 = 20.0;
}

/// Days of heat.
pub mod days {
    /// Simulated periods a day to begin with.
    pub const FIRST_PERIODS: u64 = 16;
    /// They are looked for so many levels below the first, where a pass costs a sixteenth.
    pub const COARSER: usize = 2;
    /// What half as many simulated periods a day change, times this, is the error of as many: of
    /// fifteen scenes with 24 and 48 or more it covers all, but a movement that was off by 0.18 %.
    pub const CAUTION: f64 = 2.0;
    /// Share of the tolerance that days with few simulated periods may take, and jumps over days.
    pub const SHARE: f64 = 0.5;
    /// Typical errors of the forces with 3, 6, 12, … nodes a depth, below which none is stated, and
    /// the share of the difference to a mesh half as fine that is the error: measured on nine
    /// scenes up to 24 nodes. From 12 on differences fall by a factor of 4 to 14.
    pub const TYPICAL: [f64; 4] = [5e-2, 1.2e-2, 1.5e-3, 4e-4];
    pub const RESOLVED: usize = 2;
    pub const WEIGHT: f64 = 0.4;
    pub const WEIGHT_UNRESOLVED: f64 = 2.0;
    /// The most that jumps over days may take: slow two-way creep adds up what larger ones miss.
    pub const MOST: f64 = 5e-3;
    /// Up to so many passes a day all are simulated on a day with real ones; and where a day has no
    /// whole sequence.
    pub const FEW: u64 = 100;
    /// Nodes per length scale of the motion at most: real passes measure what the law misses. Of
    /// sixteen random scenes none states another error than with as fine a law as 24 nodes make,
    /// and forces differ by less than 0.1 %; a short duct, with a mesh far finer, would be minutes
    /// in it.
    pub const FINEST: f64 = 6.0;
}

/// Where forces level off.
pub mod saturation {
    /// Gains whose ratio is above this do not level off yet.
    pub const LARGEST_RATIO: f64 = 0.5;
    /// Largest part of the saturated force that may be extrapolated.
    pub const LARGEST_REMAINDER: f64 = 0.03;
    /// Of a period's passes, those that leave this share of the largest force at least show how it
    /// grows.
    pub const TELLS: f64 = 0.5;
}
