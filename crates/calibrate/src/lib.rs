#![doc = include_str!("../README.md")]

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
