//! The homogeneous half-space as a model of the ground.

use std::f64::consts::TAU;

use ground_field::{Displacement, GroundError, GroundField, Soil, SurfaceLoad, check_place};

use crate::disc;
use crate::shape::distance;

const MODEL: &str = "boussinesq half-space";

/// One isotropic elastic soil without end below a flat surface.
///
/// - **Point load** P, with R² = r² + z² (K. L. Johnson, *Contact Mechanics* (1985), eq. 3.18), exact to rounding:
///
///   ```text
///   u_r = (1+ν)P/(2πE) · [ r z/R³ − (1−2ν) r/(R(R+z)) ]
///   u_z = (1+ν)P/(2πE) · [ z²/R³ + 2(1−ν)/R ]
///   ```
/// - **Uniform pressure on a disc**: the same integrated over the disc, everywhere: inside and outside, on the rim, on the
///   surface and below. Exact up to rounding, below 1e-12 of the peak of the component at that depth; far from the disc
///   the error is that small relative to the value itself. As the contact radius goes to 0 the disc's field goes over
///   into the point load's smoothly.
///
/// Poisson's ratio 0.5 (incompressible) is included.
///
/// # At the load itself
///
/// The displacement under a point load grows as 1/R. At R = 0 there is none, and [`GroundError::Singular`] says so, as it
/// does where the value would exceed the largest number. A disc has no such point: its displacement is finite and
/// continuous everywhere, the rim included. A load of force 0 displaces nothing anywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    soil: Soil,
    /// (1+ν)/(2πE) \[1/Pa\].
    compliance: f64,
}

impl HalfSpace {
    /// A half-space of `soil`.
    pub fn new(soil: Soil) -> Self {
        Self {
            soil,
            compliance: (1.0 + soil.poisson_ratio()) / (TAU * soil.young_modulus()),
        }
    }

    /// The soil.
    pub fn soil(self) -> Soil {
        self.soil
    }

    /// Stress under a point load P = `force` \[N\] at horizontal distance `radius` and `depth` \[m\]; with R² = r² + z²
    ///
    /// ```text
    /// σ_r = P/(2π) · [ (1−2ν)/(R(R+z)) − 3r²z/R⁵ ]          σ_z = −3Pz³/(2πR⁵)
    /// σ_θ = (1−2ν)P/(2π) · [ z/R³ − 1/(R(R+z)) ]            τ_rz = −3Prz²/(2πR⁵)
    /// ```
    ///
    /// (K. L. Johnson, *Contact Mechanics* (1985), eq. 3.20). It does not depend on Young's modulus.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless all three are finite and not negative; [`GroundError::Singular`] at the
    /// load.
    pub fn point_stress(self, force: f64, radius: f64, depth: f64) -> Result<Stress, GroundError> {
        let load = SurfaceLoad::point(force)?;
        check_place(radius, depth)?;
        if load.force() == 0.0 {
            return Ok(Stress::default());
        }
        let distance = distance(radius, depth);
        let (sine, cosine) = (radius / distance, depth / distance);
        let free = 1.0 - 2.0 * self.soil.poisson_ratio();
        let scale = force / TAU / distance / distance;
        let stress = Stress {
            radial: scale * (free / (1.0 + cosine) - 3.0 * sine * sine * cosine),
            vertical: scale * -3.0 * cosine * cosine * cosine,
            hoop: scale * free * (cosine - 1.0 / (1.0 + cosine)),
            shear: scale * -3.0 * sine * cosine * cosine,
        };
        let finite = [stress.radial, stress.vertical, stress.hoop, stress.shear].map(f64::is_finite);
        if finite == [true; 4] {
            Ok(stress)
        } else {
            Err(singular(radius, depth))
        }
    }
}

/// Stress at a point of the ground in cylindrical components about the load's axis \[Pa\], tension positive.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Stress {
    /// σ_r, outward from the axis.
    pub radial: f64,
    /// σ_z.
    pub vertical: f64,
    /// σ_θ, around the axis.
    pub hoop: f64,
    /// τ_rz.
    pub shear: f64,
}

impl GroundField for HalfSpace {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        check_place(radius, depth)?;
        if load.force() == 0.0 {
            return Ok(Displacement::ZERO);
        }
        let (shape, length) = disc::shape(load, radius, depth);
        let scale = self.compliance * load.force() / length;
        let displacement = shape.displacement(scale, self.soil.poisson_ratio());
        if displacement.is_finite() {
            Ok(displacement)
        } else {
            Err(singular(radius, depth))
        }
    }
}

#[cold]
fn singular(radius: f64, depth: f64) -> GroundError {
    GroundError::Singular {
        model: MODEL,
        radius,
        depth,
    }
}
