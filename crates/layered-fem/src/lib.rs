//! Axisymmetric finite elements of layered ground under a wheel.
//!
//! [`LayeredFem`] implements [`ground_field::GroundField`] for every [`ground_field::SoilProfile`]: bonded elastic layers,
//! a Young's modulus that varies linearly with depth within a layer, a half-space or rock below. It answers to the
//! accuracy asked, estimated on every answer, or returns an error.
//!
//! # Problem
//!
//! Static linear elasticity, ∇·σ = 0 with σ = λ(z) (tr ε) I + 2 G(z) ε, under a vertical unit load on the surface; scaled by
//! the force, since the problem is linear. The weak form is solved for (`u_r`, `u_z`) per radian in the half-plane r ≥ 0.
//!
//! # Method
//!
//! - Nine-node quadrilaterals whose dilatation is projected, so that nothing locks as ν → 1/2.
//! - Lines graded as the distance to the load, so that few elements reach hundreds of metres away; the outer boundary moves
//!   as the base half-space's closed form, and beyond it that closed form answers.
//! - The point load's singularity is subtracted in a block of elements around it, and only there.
//! - One sparse Cholesky factorisation a mesh, one solution a contact radius.
//! - Along r the nodal values are joined with continuous second derivative, because friction on a buried cable follows the
//!   second difference of `u_r`.
//! - Two meshes at a time: their difference is the error estimate, and decides whether a third is needed.
//!
//! # Limits
//!
//! Layers are bonded and horizontal; a Poisson's ratio above 0.49999 is replaced by it. The
//! edge of a loaded disc is not meshed: within about a fifth of its radius below the surface the error falls slowly, finer
//! meshes are needed, and for tight accuracies the answer is [`ground_field::GroundError::Accuracy`]. So it is where the
//! largest `u_r` at a depth happens to be tiny, as within a very stiff layer.
//!
//! # References
//!
//! T. J. R. Hughes, *The Finite Element Method* (1987); K. L. Johnson, *Contact Mechanics* (1985); I. M. Smith,
//! D. V. Griffiths, L. Margetts, *Programming the Finite Element Method*, 5th ed. (2014).

mod dissection;
mod element;
mod error;
mod front;
mod grading;
mod half_space;
mod level;
mod line;
mod load;
mod material;
mod mesh;
mod model;
mod options;
mod system;

pub use error::FemError;
pub use model::LayeredFem;
pub use options::{ErrorEstimate, FemOptions, FemStatistics};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
