//! Fits parameters of a model to data, and says what the data can and cannot tell.
//!
//! *Problem.* A load cell measured the force on a cable joint after many passes; a model predicts it from a friction
//! coefficient μ_d, the shape factor b of friction, the stiffness of the ground. Which values fit, and how sure is that?
//! The crate knows nothing of cables: a [`Model`] maps parameters to predictions, for one series of data or several
//! jointly.
//!
//! *Equations.* The sum of losses ρ of the standardised residuals, plus the squared distances from prior knowledge, is
//! minimised ([`Loss`]). A coarse scan finds a start, Levenberg–Marquardt refines it, driven by argmin's executor, and a second descent
//! from elsewhere checks it. Standard errors come from the Jacobian at the optimum; intervals from the
//! profile likelihood, with Student's t where the noise was estimated. An interval that the data do not close stays open, and
//! the parameter is called not [`identifiable`](Estimate::identifiable). Where a run of the model takes long,
//! [`Calibration::fit_emulated`] gives the same answer with a part of the runs.
//!
//! *Assumptions.* Independent noise, Gaussian but for the outliers that a robust loss is there for; predictions that
//! are smooth in the parameters but for a small known ripple ([`Options::relative_noise`]). Errors of the model itself are in
//! the intervals only where it is given a [`Discrepancy`].
//!
//! *References.* D. M. Bates, D. G. Watts, Nonlinear Regression Analysis and Its Applications, 1988; P. J. Huber, Robust Statistics,
//! 1981; A. Raue et al., "Structural and practical identifiability analysis", Bioinformatics 25 (2009) 1923.
//!
//! ```
//! use calibrate::{Calibration, ModelError, Parameter, Scale};
//!
//! // A force that levels off: F = F_s (1 − e^(−n/τ)), after 5, 10, 20, 40, 80 passes.
//! let passes = [5.0, 10.0, 20.0, 40.0, 80.0];
//! let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
//!     Ok(passes.iter().map(|n: &f64| p[0] * (1.0 - (-n / p[1]).exp())).collect())
//! };
//! let measured = vec![124.0, 214.0, 351.0, 472.0, 541.0];
//!
//! let parameters = vec![
//!     Parameter::new("saturated_force", 100.0, 2000.0, Scale::Linear)?,
//!     Parameter::new("passes", 1.0, 1000.0, Scale::Logarithmic)?,
//! ];
//! let fit = Calibration::new(&model, parameters, measured)?.fit()?;
//! let force = &fit.estimates[0];
//! assert!(force.identifiable && force.interval.contains(550.0));
//! # Ok::<(), calibrate::CalibrationError>(())
//! ```

mod answer;
mod calibration;
mod descent;
mod deviance;
mod discrepancy;
mod elsewhere;
mod emulated;
mod emulator;
mod error;
mod estimate;
mod evaluator;
mod fit;
mod interval;
mod kriging;
mod lack_of_fit;
mod loss;
mod model;
mod noise_rounds;
mod options;
mod parameter;
mod point;
mod search;
mod solution;
mod station;
mod step;
mod uncertainty;
mod warning;
mod whitening;

pub use calibration::Calibration;
pub use discrepancy::Discrepancy;
pub use emulator::Emulator;
pub use error::CalibrationError;
pub use estimate::{Estimate, Interval};
pub use fit::Fit;
pub use lack_of_fit::{
    TermTest, probability_of_gain, probability_of_scatter, probability_of_signs, probability_of_size,
};
pub use loss::Loss;
pub use model::{Model, ModelError, Part};
pub use options::{Options, Profiles};
pub use parameter::{Parameter, Prior, Scale};
pub use warning::Warning;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
