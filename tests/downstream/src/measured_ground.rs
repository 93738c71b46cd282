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
//! *Limits.* Slow variation with depth, Poisson's ratio 0.5, and a wheel counts as a point load.

use std::f64::consts::PI;

use ground_field::{Displacement, GroundError, GroundField, SurfaceLoad};

/// Incompressible ground with a modulus from a table.
#[derive(Debug, Clone)]
pub struct MeasuredGround {
    /// Depth of the top of each stretch \[m\], and its Young's modulus \[Pa\]; the last goes down without end.
    stretches: Vec<(f64, f64)>,
}

impl MeasuredGround {
    /// Ground with Young's modulus `stretches[k].1` \[Pa\] from the depth `stretches[k].0` \[m\] down to the next.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless the depths begin at 0 and grow and the moduli are finite and positive.
    pub fn new(stretches: Vec<(f64, f64)>) -> Result<Self, GroundError> {
        let refuse = |name, value, allowed| Err(GroundError::InvalidParameter { name, value, allowed });
        match stretches.first() {
            Some(&(top, _)) if top == 0.0 => {}
            first => return refuse("first depth", first.map_or(f64::NAN, |s| s.0), "0"),
        }
        for (k, &(depth, modulus)) in stretches.iter().enumerate() {
            if !(depth.is_finite() && (k == 0 || depth > stretches[k - 1].0)) {
                return refuse("depth", depth, "finite and below the one before");
            }
            if !(modulus.is_finite() && modulus > 0.0) {
                return refuse("young_modulus", modulus, "finite and positive");
            }
        }
        Ok(Self { stretches })
    }

    /// Young's modulus \[Pa\] at `depth` \[m\].
    pub fn young_modulus(&self, depth: f64) -> f64 {
        let below = self.stretches.partition_point(|&(top, _)| top <= depth);
        self.stretches[below.saturating_sub(1)].1
    }
}

/// U_z under 1 N on a half-space of 1 Pa: 3/(4π) (z²/R³ + 1/R); 0 at infinite depth.
fn unit_vertical(radius: f64, depth: f64) -> f64 {
    let distance = radius.hypot(depth);
    if distance.is_infinite() {
        return 0.0;
    }
    3.0 / (4.0 * PI * distance) * ((depth / distance).powi(2) + 1.0)
}

impl GroundField for MeasuredGround {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        for (name, value) in [("radius", radius), ("depth", depth)] {
            if !(value.is_finite() && value >= 0.0) {
                let allowed = "finite and not negative";
                return Err(GroundError::InvalidParameter { name, value, allowed });
            }
        }
        let distance = radius.hypot(depth);
        if distance == 0.0 {
            let model = "measured ground";
            return Err(GroundError::Singular { model, radius, depth });
        }
        let unit_radial = 3.0 / (4.0 * PI) * radius * depth / distance.powi(3);
        let bottoms = self.stretches[1..].iter().map(|s| s.0).chain([f64::INFINITY]);
        let vertical: f64 = self
            .stretches
            .iter()
            .zip(bottoms)
            .filter(|&(_, bottom)| bottom > depth)
            .map(|(&(top, modulus), bottom)| {
                (unit_vertical(radius, top.max(depth)) - unit_vertical(radius, bottom)) / modulus
            })
            .sum();
        Ok(Displacement {
            radial: load.force() * unit_radial / self.young_modulus(depth),
            vertical: load.force() * vertical,
        })
    }
}
