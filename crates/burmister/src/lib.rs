//! TODO docs
mod bessel;
mod elliptic;
mod gauss;
mod half_space;
mod lamina;
mod layered_half_space;
mod matrix;
mod oscillatory;
mod panel;
mod remainder;
mod stack;
mod statistics;
mod transform;

pub use layered_half_space::{DEFAULT_ACCURACY, LayeredHalfSpace};
pub use statistics::Statistics;

/// The model's name in errors.
const MODEL: &str = "layered half-space";
