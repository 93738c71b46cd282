//! A half-space of one soil, looked at in a depth of its own and with a weight: what is subtracted from the layered field.
//!
//! Its displacement is the closed form of the crate `boussinesq`, for a point load and for a disc. Its transform under a unit surface
//! pressure, times m, is
//!
//! ```text
//! (U, W) m = (−(1−2ν) + mz, 2(1−ν) + mz) e^(−mz) / 2μ
//! ```

use boussinesq::HalfSpace;
use ground_field::{Displacement, GroundError, GroundField, Soil, SurfaceLoad};

/// Rounding error of the closed form, as a share of the vertical displacement.
const ROUNDING: f64 = 2e-14;

/// A displacement with its error.
pub(crate) type Bounded = (Displacement, Displacement);

/// A weighted half-space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Image {
    weight: f64,
    half_space: HalfSpace,
    depth: f64,
}

impl Image {
    pub fn new(weight: f64, soil: Soil, depth: f64) -> Self {
        Self {
            weight,
            half_space: HalfSpace::new(soil),
            depth,
        }
    }

    /// m times the transform of (`u_r`, `u_z`) under a unit surface pressure, \[1/Pa\].
    pub fn transform(&self, wavenumber: f64) -> Displacement {
        let soil = self.half_space.soil();
        let nu = soil.poisson_ratio();
        let x = wavenumber * self.depth;
        let scale = self.weight * (-x).exp() / (2.0 * soil.shear_modulus());
        Displacement {
            radial: scale * (x - (1.0 - 2.0 * nu)),
            vertical: scale * (x + 2.0 * (1.0 - nu)),
        }
    }

    /// Displacement under `load`, and its rounding error.
    ///
    /// # Errors
    ///
    /// [`GroundError::Singular`] if a point load acts.
    pub fn displacement(&self, load: SurfaceLoad, radius: f64) -> Result<Bounded, GroundError> {
        let value = self.half_space.displacement(load, radius, self.depth)? * self.weight;
        let size = ROUNDING * value.vertical.abs();
        // Deep below the load nothing moves aside, and the rounding is that of the small motion.
        let reach = radius + load.contact_radius();
        let lever = reach / reach.hypot(self.depth).max(f64::MIN_POSITIVE);
        let rounding = Displacement {
            radial: size * lever,
            vertical: size,
        };
        Ok((value, rounding))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On the axis the integral of the transform over m is elementary: 2π `u_z`/P = ∫ W m dm = (2(1−ν) + 1)/(2μz).
    #[test]
    fn transform_and_closed_form_belong_together() {
        let image = Image::new(-0.7, Soil::new(1e8, 0.3).expect("soil"), 1.3);
        let rule = crate::gauss::rule_of_class(19);
        // m from 0 to 40/z, in eight pieces.
        let half = 20.0 / 1.3 / 8.0;
        let integral: f64 = (0..8)
            .flat_map(|i| {
                rule.iter()
                    .map(move |&(t, w)| (half * (2.0 * f64::from(i) + 1.0 + t), half * w))
            })
            .map(|(m, w)| w * image.transform(m).vertical)
            .sum();
        let load = SurfaceLoad::point(std::f64::consts::TAU).expect("load");
        let (value, _) = image.displacement(load, 0.0).expect("value");
        assert!((value.vertical - integral).abs() < 1e-13 * integral.abs());
    }
}
