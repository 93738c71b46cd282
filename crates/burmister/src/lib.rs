//! Displacements of layered elastic ground under a vertical surface load: Burmister's problem, to an asked accuracy.
//!
//! # Problem
//!
//! Bonded, isotropic, linear elastic layers lie on a half-space or on rock. A point load or a uniform pressure on a disc acts
//! on the surface. [`LayeredHalfSpace`] gives the displacement at any radius and depth through the trait
//! [`GroundField`](ground_field::GroundField).
//!
//! # Equations
//!
//! By the Hankel transform, with wavenumber m,
//!
//! ```text
//! u_r(r, z) = ∫ U(m, z) J1(mr) p(m) m dm,   u_z(r, z) = ∫ W(m, z) J0(mr) p(m) m dm,   0 < m < ∞
//! p = P/2π (point),   p = P J1(ma)/(π m a) (disc of radius a)
//! ```
//!
//! 1. **Per wavenumber** U and W follow from the impedance (traction over displacement), carried layer by layer from the base to the
//!    surface and back to the depth, without growing exponentials and without cancellation in thin layers (`lamina`, `stack`).
//! 2. **Closed form first**: half-spaces with known fields are subtracted, chosen so that the remainder vanishes for m → 0 and
//!    decays fast for m → ∞; far points keep their relative accuracy, and the surface needs no slowly converging integral
//!    (`image`, `remainder`).
//! 3. **Panels**: the remainder is represented by Chebyshev series on intervals that halve themselves until they suffice, and toward m = 0
//!    until no length of the ground can hide below the first sample. That costs a few hundred wavenumbers, whatever the number of radii (`panel`).
//! 4. **Per radius** each panel is integrated against the Bessel functions by a Gauss rule whose size follows from an error bound,
//!    or, where they turn often, by Levin's method at a cost that does not depend on the radius (`oscillatory`).
//! 5. **The error** is added up from all of these, with rounding, and compared with the peak (`transform`).
//!
//! # Accuracy
//!
//! The asked accuracy, 1e-8 unless [`LayeredHalfSpace::with_accuracy`] says otherwise, is a share of the peak over the radius of
//! |`u_r`| (for `u_r`) and |`u_z`| (for `u_z`) at the depth of the point: `u_r` changes its sign with r, so an error relative to its value has
//! no meaning. What cannot be had is [`GroundError::Accuracy`](ground_field::GroundError::Accuracy), never a worse value. The
//! error sum is dominated by bounds: the true error is usually a hundred times smaller. The peak is the field's, under the load: far to the
//! side, where next to nothing moves, the accuracy is a larger share of what is left.
//!
//! # Assumptions and limits
//!
//! Small displacements, static load, layers bonded without slip, uniform soil in each layer (a graded one is
//! [`GroundError::Unsupported`](ground_field::GroundError::Unsupported)). ν from 0 to 0.5, both included. Tested for
//! modulus contrasts up to 1e6 between neighbours and 1e8 in all, layers of 1 mm to 5 km, up to twenty layers, any
//! depth including interfaces, radii from 0 to thousands of kilometres. A point load's own point is
//! [`GroundError::Singular`](ground_field::GroundError::Singular). At and below a rigid base the displacement is zero.
//!
//! # References
//!
//! - D. M. Burmister, The general theory of stresses and displacements in layered soil systems, J. Appl. Phys. 16 (1945)
//!   89–94, 126–127, 296–302.
//! - K. L. Johnson, Contact Mechanics, Cambridge University Press (1985), chapter 3.
//! - D. Levin, Procedures for computing one- and two-dimensional integrals of functions with rapid irregular
//!   oscillations, Math. Comp. 38 (1982) 531–538.

mod bessel;
mod gauss;
mod image;
mod lamina;
mod layered_half_space;
mod levin;
mod matrix;
mod odemark_error;
mod oscillatory;
mod panel;
mod remainder;
mod stack;
mod statistics;
mod transform;

pub use layered_half_space::{DEFAULT_ACCURACY, LayeredHalfSpace};
pub use odemark_error::{OdemarkErrorBound, odemark_error_bound};
pub use statistics::Statistics;

/// The model's name in errors.
const MODEL: &str = "layered half-space";

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
