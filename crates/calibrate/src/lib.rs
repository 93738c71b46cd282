#![doc = include_str!("../README.md")]

mod calibration;
mod covariance;
mod descent;
mod deviance;
mod discrepancy;
mod emulator;
mod error;
mod estimate;
mod fit;
mod kriging;
mod lack_of_fit;
mod learning;
mod likelihood;
mod loss;
mod model;
mod parameter;
mod profile;
mod search;
mod solution;
mod tuning;
mod warning;

pub use calibration::Calibration;
pub use discrepancy::smooth_functions;
pub use emulator::Emulator;
pub use error::CalibrationError;
pub use estimate::{Estimate, Interval};
pub use fit::Fit;
pub use lack_of_fit::{
    probability_of_gain, probability_of_scatter, probability_of_signs, probability_of_size,
};
pub use loss::Loss;
pub use model::{Model, ModelError, Part};
pub use parameter::{Parameter, Prior, Scale};
pub use warning::Warning;
