#![doc = include_str!("../README.md")]

// `lamina` and `stack` solve one wavenumber, `image` and `remainder` subtract closed forms, `panel` represents what is left,
// `oscillatory` and `levin` integrate it, and `transform` adds up the error.
mod bessel;
mod gauss;
mod image;
mod lamina;
mod layered_half_space;
mod levin;
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
