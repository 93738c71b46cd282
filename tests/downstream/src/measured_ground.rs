//! Ground whose modulus was measured at some depths.
//!
//! *Problem.* A borehole gives Young's modulus at a few depths. How does that ground move below a wheel?
//!
//! *Equation.* The vertical stress in the ground hardly depends on a modulus that varies slowly with depth, so that the vertical
//! strain is that of a homogeneous half-space divided by the local modulus. Below that idea lies the approximation used here: with
//! U(r, z) the displacement of a half-space of unit modulus (Boussinesq; K. L. Johnson, Contact Mechanics, 1985, eq. 3.18),
//!
//! u_z(r, z) = ∫_z^∞ −∂U_z/∂ζ dζ / E(ζ) = Σ_k \[U_z(r, z_k) − U_z(r, z_{k+1})\] / E_k,   u_r(r, z) = U_r(r, z)/E(z),
//!
//! with the depths z_k at which E changes and z_0 = z. One modulus throughout gives back Boussinesq exactly.
//!
//! *Limits.* Slow variation with depth, Poisson's ratio 0.5.

use creepage::boussinesq::HalfSpace;
use creepage::ground_field::{Displacement, GroundError, GroundField, Soil, SurfaceLoad, checked};

/// Incompressible ground with a modulus from a table.
#[derive(Debug, Clone)]
pub struct MeasuredGround {
    /// Depth of the top of each stretch \[m\], and its Young's modulus \[Pa\]; the last goes down without end.
    stretches: Vec<(f64, f64)>,
    /// Half-space of 1 Pa.
    unit: HalfSpace,
}

impl MeasuredGround {
    /// Ground with Young's modulus `stretches[k].1` \[Pa\] from the depth `stretches[k].0` \[m\] down to the next.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless the depths begin at 0 and grow and the moduli are finite and positive.
    pub fn new(stretches: Vec<(f64, f64)>) -> Result<Self, GroundError> {
        let first = stretches.first().map_or(f64::NAN, |stretch| stretch.0);
        checked("first depth", first, "0", |depth| depth == 0.0)?;
        for pair in stretches.windows(2) {
            checked("depth", pair[1].0, "below the one before", |depth| {
                depth > pair[0].0
            })?;
        }
        for &(_, modulus) in &stretches {
            checked("young_modulus", modulus, "finite and positive", |value| {
                value > 0.0
            })?;
        }
        let unit = HalfSpace::new(Soil::new(1.0, 0.5)?);
        Ok(Self { stretches, unit })
    }
}

impl GroundField for MeasuredGround {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        let at = |depth| self.unit.displacement(load, radius, depth);
        let here = self.stretches.partition_point(|&(top, _)| top <= depth).max(1) - 1;
        let (mut sum, mut upper) = (0.0, at(depth)?);
        for (k, &(_, modulus)) in self.stretches.iter().enumerate().skip(here) {
            let lower = match self.stretches.get(k + 1) {
                Some(&(top, _)) => at(top)?,
                None => Displacement::ZERO,
            };
            sum += (upper - lower).vertical / modulus;
            upper = lower;
        }
        let radial = at(depth)?.radial / self.stretches[here].1;
        Ok(Displacement {
            radial,
            vertical: sum,
        })
    }
}
