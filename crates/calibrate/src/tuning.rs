//! Numbers found by experiment, with the fits of `validation/tests/calibration_coverage.rs`, which this workspace keeps:
//! friction and shape factor of a cable from 60 readings, twelve truths. Runs are those of a fit in the mean.

/// First runs for each parameter of the model and one more. Half of them learn as much later and may
/// overlook a valley.
pub(crate) const FIRST_RUNS: usize = 8;
/// Length of correlation of an emulator, as a share of a parameter's range. Where runs lie as close as they
/// do around an optimum it hardly matters.
pub(crate) const LENGTH: f64 = 0.5;
/// Minimum and maximum nugget, in the variance of the predictions; between them it is the square of the
/// model's relative noise. With 1e-8, a model without noise is not followed to 1e-6 of its parameters
/// (tests/closed_form.rs). A larger one takes what a model really does at short range for noise.
pub(crate) const NUGGETS: (f64, f64) = (1e-12, 1e-8);
/// Standard error far from the only run, in that of all readings together: which ends run first on a finer
/// model. With 3 none did, and an end of the shipped series was half a standard error off.
pub(crate) const UNKNOWN: f64 = 10.0;
/// Places of the emulator that are scanned for each parameter of the model and one more, and descents from
/// the best. A wave of unknown length, with many minima (tests/closed_form.rs), needs half of them.
pub(crate) const SCAN: usize = 64;
pub(crate) const STARTS: usize = 4;
/// Farthest step of a free variable: a third of the way from the middle of its range to a bound.
pub(crate) const LONGEST_STEP: f64 = 2.0;
/// Change of the noise's scale, as a share, at which the rounds of fit and scale end.
pub(crate) const SCALE_TOLERANCE: f64 = 0.01;
/// Fall of the deviance that makes another optimum the better one: a quarter of a standard error.
pub(crate) const BETTER: f64 = 0.05;
/// Distance, in standard errors, by which an optimum may move once the model has run there. With 0.05
/// estimates are off by as much (tests/terms.rs).
pub(crate) const SETTLED: f64 = 0.02;
/// The same with a ripple between runs that is larger.
pub(crate) const FAR: f64 = 0.2;
/// Values of a parameter at which its profile is computed, the estimate among them.
pub(crate) const GRID: usize = 41;
/// Distance of the other free variables at neighbouring values from which on they may have jumped to
/// another valley, and are fitted from both sides.
pub(crate) const JUMP: f64 = 0.5;
/// Accuracy of the root of the rise at an end, as a share of it. The end itself is interpolated, ten times
/// as exactly.
pub(crate) const ACCURACY: f64 = 0.03;
/// Standard error of the readings by the emulator, in those of all readings together, up to which an end is
/// believed without a run.
pub(crate) const SURE: f64 = 0.15;
/// The same for a low place elsewhere: half of it takes four runs more of fifty and finds no more.
pub(crate) const HIDDEN: f64 = 0.5;
/// Root of the rise from which a place counts as high: no doubt makes it as good as the optimum.
pub(crate) const HIGH: f64 = 5.0;
