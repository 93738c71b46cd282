//! Displacements of layered elastic ground under a vertical surface load: Burmister's problem, to an asked accuracy.
//!
//! [`LayeredHalfSpace`] is the model: bonded layers on a half-space or on rock, solved by Hankel transform; its equations, accuracy and
//! limits stand there.
//!
//! Inside, `lamina` and `stack` solve one wavenumber, `image` and `remainder` subtract closed forms, `panel` represents what is left,
//! `oscillatory` and `levin` integrate it, and `transform` adds up the error.

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

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
