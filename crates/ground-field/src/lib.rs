//! The contract between models of the ground and what lies buried in it.
//!
//! A vertical load on the road surface displaces the ground below. Every model of that ground — a closed form,
//! a Hankel transform, a finite-element mesh, or one of your own — implements [`GroundField`]: the
//! [`Displacement`] at a horizontal distance and a depth under one [`SurfaceLoad`]. Everything else here follows from
//! that by superposition: a [`Vehicle`] is a set of [`Wheel`]s, and the [`DuctMotion`] is what a straight duct at
//! constant depth does while the vehicle drives along it.
//!
//! # Axes, signs, units
//!
//! SI throughout (m, N, Pa, s). `x` runs along the duct, positive in the direction of forward traffic; `y` is horizontal
//! across it; `z` points down from the road surface. A load presses downward. A radial displacement is positive
//! outward, away from the load; a vertical one is positive downward.
//!
//! # Assumptions
//!
//! Linear elastic ground, small displacements, static loads: a vehicle much slower than the ground's shear waves.
//! The duct moves with the ground.

mod displacement;
mod error;
mod field;
mod load;
mod motion;
mod peaks;
mod profile;
mod soil;
mod vehicle;

pub use displacement::Displacement;
pub use error::{GroundError, check_place, checked};
pub use field::GroundField;
pub use load::SurfaceLoad;
pub use motion::{DuctLine, DuctMotion};
pub use profile::RadialProfile;
pub use soil::{Base, Modulus, Soil, SoilLayer, SoilProfile};
pub use vehicle::{Direction, Vehicle, Wheel};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
