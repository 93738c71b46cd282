//! Closed forms for elastic ground under a vertical surface load.
//!
//! [`HalfSpace`] is Boussinesq's answer for one soil without end: exact, for a point load and for uniform pressure on a
//! disc, at every point.
//! It implements [`GroundField`](ground_field::GroundField), as does every model of the ground.
//!
//! ```
//! use boussinesq::HalfSpace;
//! use ground_field::{GroundField, Soil, SurfaceLoad};
//!
//! let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
//! let wheel = SurfaceLoad::new(49e3, 0.15)?;
//! let moved = ground.displacement(wheel, 0.8, 1.2)?;
//! assert!(moved.radial > 0.0 && moved.vertical > moved.radial);
//! # Ok::<(), ground_field::GroundError>(())
//! ```
//!
//! # Axes, signs, units
//!
//! SI (m, N, Pa). `z` points down from the surface, a load presses down; a radial displacement is positive outward, a
//! vertical one positive down.

#![allow(
    clippy::doc_markdown,
    reason = "u_r and k_c in the text are formulas, not code"
)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;

mod disc;
mod elliptic;
mod half_space;
mod shape;

pub use half_space::{HalfSpace, Stress};
