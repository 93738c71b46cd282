//! Numbers that were found by experiment, each with what it was fitted to and, if that was
//! measured, what is lost if it is half or twice as large. All others of this crate are
//! definitions, accuracies or limits of an answer, and stand where they are used.

/// Meshes, and the error that they leave.
pub mod meshes {
    /// A mesh twice as fine takes about this many times the node updates.
    pub const REFINEMENT_COST: usize = 4;
    /// What is left to the mesh at least, as a share of the tolerance, or of the largest other
    /// error if that is beyond it.
    pub const MIN_SHARE: f64 = 0.5;
    /// Share of the work that finding jumps is taken for.
    pub const FINDING: f64 = 0.3;
    /// The coarsest level on which it is seen whether anything slips: 24 nodes a depth.
    pub const SHARP: usize = 3;
    /// What counts of the differences between meshes as error: of the last one, the one before, and
    /// so on. Fitted to 200 random scenes (`validation/tests/honest.rs`), so that the true error is
    /// larger in one or two of a hundred.
    pub const WEIGHTS: [f64; 4] = [1.5, 0.35, 0.12, 0.04];
    /// The same from 40 passes on, where chance agreement is unlikely.
    pub const WEIGHTS_OF_MANY: [f64; 4] = [1.5, 0.2, 0.06, 0.02];
    pub const MANY: usize = 40;
    /// Weight of the only difference.
    pub const WEIGHT_ALONE: f64 = 3.0;
}

/// Jumps over passes, and draws of a random order.
pub mod jumps {
    /// Passes after which a run takes no more jumps, and fewest and most periods of them.
    pub const PATIENCE: (u64, u64, u64) = (7200, 12, 600);
    /// Error of a single jump relative to the tolerance to begin with, and length of the first jump
    /// relative to the periods before it; the largest such error.
    pub const FIRST: (f64, f64) = (6.0, 0.8);
    pub const LARGEST: f64 = 0.06;
    /// Share of the tolerance that jumps may take: the first mesh leaves about as much.
    pub const SHARE: f64 = 0.4;
    /// The error of jumps grows at most so many times from the mesh they were found on to the last:
    /// if as many as they missed, forces are stated up to five times as far off as they are, and if
    /// not at all, movements of two in thirty random scenes are twice as far off as stated.
    pub const MAX_GROWTH: f64 = 2.0;
    /// Passes simulated at the start, about, and fewest and most periods of them.
    pub const FIRST_PASSES: usize = 120;
    pub const MIN_FIRST_PERIODS: u64 = 2;
    pub const MAX_FIRST_PERIODS: u64 = 8;
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
    /// Above this error steps of many periods lead nowhere if twice as many simulated ones bring it
    /// to no less than this share of it. Six random scenes with Q from 2.6 to 54 had errors of 0.2
    /// to 2 whatever was simulated of a day; with all passes real they took a tenth of the time.
    pub const HOPELESS: f64 = 0.1;
    pub const STALLED: f64 = 0.75;
    /// All passes of a day are simulated if so many days are affordable on the first mesh by the
    /// nodes that a pass takes as a rule. Under traffic that moves little it takes a tenth of them:
    /// twenty days, and those six scenes simulated 3 to 19.
    pub const FULL_DAYS: u64 = 2;
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
    pub const MAX_JUMP_ERROR: f64 = 5e-3;
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
