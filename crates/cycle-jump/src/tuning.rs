//! Numbers found by experiment.

/// Length of the slope's sliding mean \[length scales of the duct's motion\].
pub const SLOPE_WIDTH: f64 = 2.5;
pub const REGULARISATION: f64 = 0.02;
pub const SLOPE_FALL: f64 = 0.8;
pub const OVERSHOOT: f64 = 1.3;
pub const SUBSTEPS: i32 = 8;
pub const SUBSTEP_GROWTH: f64 = 1.5;
pub const SHORTEST_JUMP: u64 = 4;
pub const GROWTH_BETWEEN: f64 = 1.3;
pub const CAUTION: f64 = 0.85;
pub const MAX_ERROR: f64 = 2.0;
pub const MAX_ERROR_GUIDED: f64 = 4.0;
pub const NEGLIGIBLE: f64 = 0.1;
pub const TOLERANCE_BEYOND: f64 = 4.0;
pub const NOTICEABLE: f64 = 1e-3;
pub const ROW_RATIO: f64 = 1.03;
pub const PEAK_RATIO: f64 = 1.1;
pub const LONG_PERIOD: usize = 48;
pub const LONGEST_ROUND: usize = 12;
pub const MIN_ROUNDS: usize = 8;
pub const ROUND_TAIL: f64 = 3.0;
pub const NEARLY_ALL: f64 = 0.5;
pub const MORNING: u64 = 8;
pub const MORNING_GROWTH: f64 = 1.5;
pub const AFTER_A_CORNER: [u64; 6] = [0, 1, 2, 4, 8, 16];
pub const DEFECT_GROWTH: f64 = 0.5;
