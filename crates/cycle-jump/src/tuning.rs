//! Numbers found by experiment.
//!
//! If nothing else is said they were halved and doubled on sixty random cables of 5 to 80 m,
//! with one to three vehicles in one or two directions in periods of up to five, springs, clamps
//! and any friction. A hundred million passes with a tolerance of 1 % take 2320 simulated passes in
//! all, at most 32 periods. Of the first 600 passes, against all of them simulated, the worst force
//! is 0.18 % off in the mean and 1.8 % at most.

/// Length of the slope's sliding mean \[length scales of the duct's motion\]. Half: at most 2.2 %
/// off; twice: 1.4 %, with 1 % more passes.
pub const SLOPE_WIDTH: f64 = 2.5;

/// Weight of the last slope where friction hardly changed, relative to where it changed most. Half:
/// the same; twice: at most 2.6 % off.
pub const REGULARISATION: f64 = 0.02;

/// Minimum share of the last slope that is kept. Half: 2 % more passes on ten cables; none: 3 %.
pub const SLOPE_FALL: f64 = 0.8;

/// Change of the advance relative to its prediction above which a jump overshot and the slope
/// rises. Twice: 2 % more passes; without this rule 11 %, and up to 69 periods.
pub const OVERSHOOT: f64 = 1.3;

/// Substeps of a flow. Where a flow ends depends on its last and longest ones: with 4 or 16 the
/// same.
pub const SUBSTEPS: i32 = 8;

/// Length of each substep relative to the one before. With 1.25 or 2 the same.
pub const SUBSTEP_GROWTH: f64 = 1.5;

/// A shorter jump \[periods\] is not worth its check: a period is simulated. Half: 7 % fewer passes
/// and 2.9 % off at most; twice: 8 % more.
pub const SHORTEST_JUMP: u64 = 4;

/// Growth of the next jump's length after a simulated period. With 1.6 3 % fewer passes and 2.7 %
/// off at most.
pub const GROWTH_BETWEEN: f64 = 1.3;

/// Share of the length that its error would allow a jump. Half: 13 % more passes; twice: 3.4 % off
/// at most, and one of ten other cables gets nowhere.
pub const CAUTION: f64 = 0.85;

/// Error of a jump, relative to the tolerance, above which it is rejected. Half: 3 % more passes
/// and 0.14 % off in the mean; twice: 3 % fewer and 0.26 %.
pub const MAX_ERROR: f64 = 2.0;

/// The same for a jump of another run, on another mesh, where it cost no more than twice the
/// tolerance. A rejected jump ends the guidance, and both runs differ by their jumps too.
pub const MAX_ERROR_GUIDED: f64 = 4.0;

/// Change of forces and movements still to come, as a share of the tolerance, that does not count.
/// Twice: 2 % fewer passes, and of a hundred passes with rounds of equal vehicles up to 0.3 % off
/// at the end; half: 2 % more.
pub const NEGLIGIBLE: f64 = 0.1;

/// Tolerance of jumps beyond the last pass, relative to that before: where the forces lead hardly
/// depends on the way but near shakedown. A quarter of a tolerance takes 1.4 to 1.6 times the
/// passes, on twenty cables.
pub const TOLERANCE_BEYOND: f64 = 4.0;

/// Passes within a jump of the vehicles that show the largest of something are recorded so far
/// apart, as a ratio. Forces grow at most as the root of the number of passes: a largest one is
/// missed by 5 %.
pub const PEAK_RATIO: f64 = 1.1;

/// Maximum number of vehicles of a round that is looked for in a period. With 6 or 24 the same for rounds of
/// one.
pub const LONGEST_ROUND: usize = 12;

/// Changes from round to round fall more slowly than geometrically: what is still to come is so
/// many times the sum of a geometric series. Half or twice: the same for rounds of one vehicle.
pub const ROUND_TAIL: f64 = 3.0;

/// Periods that are simulated one by one on the first morning, when the cable is as laid. Half or
/// twice: the errors of six cables over their days are no larger; with one, a force is 0.9 % off
/// under heavy traffic, where it is right with four.
pub const MORNING: u64 = 8;

/// Growth of the distance between simulated periods after them. With 1.25 six more of about ninety
/// are simulated, with 2 two fewer; errors are no larger.
pub const MORNING_GROWTH: f64 = 1.5;

/// Periods after a corner of the temperature at which one is simulated: the cable turns within a
/// few. Of 30 m with corners, 800 passes a day and 48 other periods a force is 1.1 % off; with
/// every second of these 1.3 %, with as many between them 0.2 % and a seventh more passes, with the
/// first alone 9 %.
pub const AFTER_A_CORNER: [u64; 6] = [0, 1, 2, 4, 8, 16];

/// What the locked law misses goes on after a simulated period so fast, relative to its change from
/// the one before. Of fifteen cables it takes the largest error of a force from 1.5 to 1.1 %, where
/// nothing goes on, and 0.64 to 0.17 % at best; with all of it, 1, one is 16 % off.
pub const DEFECT_GROWTH: f64 = 0.5;
