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
    /// The same on a mesh finer than the first, at this tolerance.
    pub const FINER: (usize, f64) = (1_000_000_000, 0.01);
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
    /// What the error is beside the difference to a mesh twice as fine, at second order.
    pub const VERIFIED: f64 = 4.0 / 3.0;
    /// A larger error than this, or the tolerance if that is larger still, is no answer.
    pub const DOUBTFUL: f64 = 0.1;
    /// Forces below this share of the largest one of the run are compared with that share of it,
    /// and movements of an end below this share of the duct's largest.
    pub const SMALL: f64 = 0.1;
    /// The length of cable \[m\] on which friction holds a force that does not count.
    pub const SHORT: f64 = 0.01;
}

/// Which method a plan takes, and its rough time.
pub mod methods {
    /// Measured time a node's update takes \[s\] on one core of about 3 GHz: without inertia, and
    /// explicit.
    pub const QUASI_STATIC_SECONDS: f64 = 1.1e-8;
    pub const EXPLICIT_SECONDS: f64 = 1e-9;
    /// Time steps of the explicit solver per step of a vehicle, as a rule.
    pub const EXPLICIT_STEPS: f64 = 40.0;
    /// Periods that are simulated at the start, and then for every factor e of periods: half of all
    /// scenes need fewer, and nearly all.
    pub const TYPICAL_PERIODS: (f64, f64) = (12.0, 2.2);
    pub const MOST_PERIODS: (f64, f64) = (20.0, 8.0);
    /// As a rule where a period has more than so many vehicles: most of what jumps would have to
    /// follow happens within the first one.
    pub const MANY: usize = 48;
    pub const TYPICAL_LONG_PERIODS: (f64, f64) = (4.5, 0.3);
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
    /// Where every pass is simulated although jumps are possible, it takes no longer than this
    /// \[s\].
    pub const LONGEST_SECONDS: f64 = 60.0;
    /// Longest run with the sigmoid law that is begun without the scene naming a method \[s\].
    pub const LONGEST_WITHOUT_REST: f64 = 600.0;
    /// What an even order leaves wrong as a rule where vehicles come in random order: 3 to 4 % of
    /// early forces.
    pub const DRAWN_ERROR: f64 = 0.04;
}

/// Periods that stand in for the traffic.
pub mod periods {
    /// More kinds than this that differ by their load alone have others that stand in for them.
    pub const KINDS: usize = 12;
    /// Stand-ins for them.
    pub const STAND_INS: usize = 48;
    /// In random order a period of at most so many vehicles is taken as it is, and with heat it may
    /// be longer than a day.
    pub const FEW: usize = 12;
    /// A mix is near where every vehicle's share is right within this share of itself; of longer
    /// ones within the factor the nearest is taken.
    pub const NEAR: f64 = 0.05;
    pub const LONGER: f64 = 1.25;
    /// It has at least so many vehicles: in shorter ones too few of those follow each other that do
    /// in the traffic, and its largest forces are missed.
    pub const LEAST: usize = 100;
    /// A mix that has the shares exactly is taken where it is at most so many times as long as a
    /// near one, or so short: a near one is compared with another, and hardly shows which vehicles
    /// follow each other in the traffic.
    pub const EXACT: usize = 2;
    pub const SHORT: usize = 600;
    /// Another mix is looked for among those that are at most twice as long, or so long.
    pub const OTHERS: usize = 48;
}

/// Which passes stand for listed ones.
pub mod listing {
    /// Passes at the beginning in which the scene's own vehicles drive, at least; at the end, and
    /// the last of them that show those vehicles: the first ones still follow other vehicles.
    pub const FIRST: u64 = 100;
    pub const LAST: u64 = 150;
    pub const LAST_SHOWN: u64 = 12;
    /// Periods that jumps need at least beside those at the beginning and the end.
    pub const PERIODS_OF_A_JUMP: u64 = 3;
    /// Passes of a longer period whose mean stands for it, evenly over it.
    pub const OF_A_MEAN: u64 = 48;
    /// Passes that are nearly alike and are compared with each other.
    pub const ALIKE: usize = 4;
    /// A pass is shown by one that is at most this share of its number away: forces change on the
    /// scale of that number.
    pub const AWAY: f64 = 0.03;
    /// Or at most so many passes.
    pub const NEAR: u64 = 12;
    /// And follows at least so many vehicles that are the same: what came before them hardly counts
    /// any more.
    pub const DEEP: usize = 60;
}

/// Jumps over passes, and draws of a random order.
pub mod jumps {
    /// Periods after which a run with jumps takes no more of them, of few vehicles and of many.
    pub const PATIENCE: u64 = 600;
    pub const FEW: u64 = 12;
    pub const PATIENCE_WITH_MANY: u64 = 12;
    /// Share of the tolerance by which a row may depend on which pass of a period shows it.
    pub const DOUBTFUL: f64 = 0.5;
    /// Error of a single jump beside the tolerance to begin with, and length of the first jump
    /// beside the periods before it; the largest such error.
    pub const FIRST: (f64, f64) = (6.0, 0.8);
    pub const LARGEST: f64 = 0.06;
    /// What both are multiplied by, and how often at most. Cut to a third the errors of 237 random
    /// scenes are no smaller, and an eighth more passes are simulated.
    pub const FINER: f64 = 0.5;
    pub const FINEST: usize = 8;
    /// Share of the tolerance that jumps may take, and at least where the mesh leaves less.
    pub const SHARE: f64 = 0.5;
    pub const LEAST_SHARE: f64 = 0.35;
    /// Periods simulated at the start: of one or two vehicles, of more, and fewer of many, about so
    /// many passes in all.
    pub const FIRST_PERIODS: u64 = 8;
    pub const FIRST_LONG_PERIODS: u64 = 5;
    pub const LONG: usize = 3;
    pub const FEWEST_FIRST_PERIODS: u64 = 2;
    pub const FIRST_PASSES: usize = 200;
    /// And at most where only early jumps are off; and passes in them at most.
    pub const MOST_FIRST_PERIODS: u64 = 48;
    pub const MOST_FIRST_PASSES: u64 = 200;
    /// Jumps are looked for on the level below the first, where they cost a fourth, unless the duct
    /// is so many depths short: that costs little, and the few nodes that a coarser mesh gives it
    /// behave differently. Those over the traffic's own periods of more than so many vehicles are
    /// looked for on the level below that one, which spares a sixth of the time of a million
    /// passes, and so are draws. What stand-ins change depends more on the mesh.
    pub const SHORT: f64 = 20.0;
    pub const MANY: usize = 48;
    /// Finer jumps take about so many times the passes. No finer ones are looked for where they
    /// would take more nodes than this on the first level: some ten seconds.
    pub const COST_OF_FINER: usize = 2;
    pub const MAX_NODE_UPDATES: usize = 1_000_000_000;
    /// Draws of a random order at least, at most, and as long as they take no more nodes than this.
    pub const FEWEST_DRAWS: usize = 4;
    pub const MOST_DRAWS: usize = 24;
    pub const MAX_DRAWN_UPDATES: usize = 500_000_000;
    /// Standard errors that are stated as the error.
    pub const STATED: f64 = 2.0;
    /// Random runs, their passes, and how many of these forget the order before.
    pub const RUNS: u64 = 8;
    pub const PASSES: usize = 90;
    pub const FORGOTTEN: usize = 30;
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
    /// Share of the tolerance that days with few simulated periods may take.
    pub const SHARE: f64 = 0.5;
    /// Typical errors of the forces with 3, 6, 12, … nodes a depth, below which none is stated, and
    /// the share of the difference to a mesh half as fine that is the error: measured on nine
    /// scenes up to 24 nodes. From 12 on differences fall by a factor of 4 to 14.
    pub const TYPICAL: [f64; 4] = [5e-2, 1.2e-2, 1.5e-3, 4e-4];
    pub const COARSEST: f64 = 3.0;
    pub const RESOLVED: usize = 2;
    pub const WEIGHT: f64 = 0.4;
    pub const WEIGHT_UNRESOLVED: f64 = 2.0;
    /// Parts of a period with which days begin that are compared.
    pub const QUARTERS: usize = 4;
    /// Share of the tolerance that jumps over days may take, and the most that they take: slow
    /// two-way creep adds up what larger ones miss.
    pub const JUMPS_SHARE: f64 = 0.5;
    pub const MOST: f64 = 5e-3;
    /// Up to so many passes a day all are simulated on a day with real ones; and where a day has no
    /// whole sequence.
    pub const FEW: u64 = 100;
    /// Days simulated after the first one, before any is jumped over.
    pub const FIRST_DAYS: u64 = 3;
    /// Days simulated after which no more are jumped over, and after which the run gives up.
    pub const MOST_DAYS: (u64, u64) = (150, 1000);
    /// Nodes per length scale of the motion at most: real passes measure what the law misses. Of
    /// sixteen random scenes none states another error than with as fine a law as 24 nodes make,
    /// and forces differ by less than 0.1 %; a short duct, with a mesh far finer, would be minutes
    /// in it.
    pub const FINEST: f64 = 6.0;
    /// Periods that it takes: the first one brings the cable into the state that lasts.
    pub const PERIODS: usize = 2;
}

/// Where forces level off.
pub mod saturation {
    /// Gains whose ratio is above this do not level off yet.
    pub const LARGEST_RATIO: f64 = 0.5;
    /// Largest part of the saturated force that may be extrapolated.
    pub const LARGEST_REMAINDER: f64 = 0.03;
    /// Fewest passes from which anything can be said.
    pub const FEWEST_PASSES: usize = 12;
    /// One in so many of the passes, the last of them, shows the largest force now, and what
    /// vehicles in random order do.
    pub const WINDOW: usize = 12;
    /// A force already reached may exceed the saturation by this share of it, which is no more than
    /// an extrapolation's error.
    pub const NEARLY: f64 = 0.02;
    /// Of a period's passes, those that leave this share of the largest force at least show how it
    /// grows.
    pub const TELLS: f64 = 0.5;
    /// A force below this share of the largest in any pass is none.
    pub const NOTHING: f64 = 1e-3;
}
