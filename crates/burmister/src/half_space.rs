//! The uniform half-space: its transform and its closed forms, which the layered field is measured against.
//!
//! Transform of a unit surface pressure (times m): (−(1−2ν) + mz, 2(1−ν) + mz) e^{−mz} / 2μ.
//!
//! Point load: Boussinesq, as in K. L. Johnson, Contact Mechanics (1985), eq. 3.18. Uniform pressure on a disc of radius a,
//! with the integrals I(μ, ν; λ) of [`lipschitz_hankel`]:
//!
//! ```text
//! u_r = P/(2πμa) (−(1−2ν) I(1,1;−1) + z I(1,1;0))
//! u_z = P/(2πμa) (2(1−ν) I(1,0;−1) + z I(1,0;0))
//! ```
//!
//! Far from the disc, at distance R, these are differences of large terms that lose (R/a)² in digits; there the mean of
//! point loads over the disc replaces them, with an angular rule of n and a radial rule of 4 points, whose error is of the
//! order (a/R)^n.

use std::f64::consts::{FRAC_1_PI, PI};

use ground_field::{Displacement, Soil, SurfaceLoad};

use crate::gauss::rule_of_class;
use crate::lipschitz_hankel::lipschitz_hankel;

/// A half-space of one soil, looked at in one depth, with a weight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfSpace {
    pub weight: f64,
    pub soil: Soil,
    pub depth: f64,
}

/// Distance, in contact radii, from which a disc is a mean of 8 × 4 point loads (and their mirror images): 8^−16 = 4e-15.
const FAR: f64 = 8.0;
/// The same for 5 × 4 point loads: 30^−10 = 2e-15.
const VERY_FAR: f64 = 30.0;
/// Rounding errors as a share of the vertical displacement, nearer and farther than `FAR`; tested below.
const NEAR_ROUNDING: f64 = 2e-13;
const FAR_ROUNDING: f64 = 1e-14;

impl HalfSpace {
    /// m times the transform of (`u_r`, `u_z`) under a unit surface pressure, \[1/Pa\].
    pub fn transform(&self, wavenumber: f64) -> (f64, f64) {
        let nu = self.soil.poisson_ratio();
        let x = wavenumber * self.depth;
        let scale = self.weight * (-x).exp() / (2.0 * self.soil.shear_modulus());
        (scale * (x - (1.0 - 2.0 * nu)), scale * (x + 2.0 * (1.0 - nu)))
    }

    /// Displacement under `load`; not finite where it is singular.
    pub fn displacement(&self, load: SurfaceLoad, radius: f64) -> Displacement {
        let mut closed = if load.is_point() {
            self.under_point(radius)
        } else {
            self.under_disc(load.contact_radius(), radius)
        };
        if radius == 0.0 {
            closed.radial = 0.0;
        }
        closed * (self.weight * load.force())
    }

    /// Rounding error of [`HalfSpace::displacement`], radial and vertical, where that is `value`.
    pub fn rounding(&self, load: SurfaceLoad, radius: f64, value: Displacement) -> (f64, f64) {
        let reach = load.contact_radius();
        let distance = radius.hypot(self.depth);
        let size = value.vertical.abs();
        if distance > FAR * reach {
            let lever = ((radius + reach) / distance).min(1.0);
            (FAR_ROUNDING * size * lever, FAR_ROUNDING * size)
        } else {
            (NEAR_ROUNDING * size, NEAR_ROUNDING * size)
        }
    }

    fn under_point(&self, r: f64) -> Displacement {
        let nu = self.soil.poisson_ratio();
        let z = self.depth;
        let distance = (r * r + z * z).sqrt();
        let scale = FRAC_1_PI / (4.0 * self.soil.shear_modulus() * distance);
        let (sine, cosine) = (r / distance, z / distance);
        Displacement {
            radial: scale * (sine * cosine - (1.0 - 2.0 * nu) * r / (distance + z)),
            vertical: scale * (cosine * cosine + 2.0 * (1.0 - nu)),
        }
    }

    fn under_disc(&self, a: f64, r: f64) -> Displacement {
        let nu = self.soil.poisson_ratio();
        let z = self.depth;
        let distance = r.hypot(z) / a;
        if distance > VERY_FAR {
            return self.mean_of_points(5, a, r);
        }
        if distance > FAR {
            return self.mean_of_points(8, a, r);
        }
        let i = lipschitz_hankel(a, r, z);
        let scale = 1.0 / (2.0 * PI * self.soil.shear_modulus() * a);
        Displacement {
            radial: scale * (i.z_i110 - (1.0 - 2.0 * nu) * i.i11_minus_1),
            vertical: scale * (i.z_i100 + 2.0 * (1.0 - nu) * i.i10_minus_1),
        }
    }

    /// Mean over the disc of point loads at twice `angles` angles and 4 radii: midpoint rule in the angle, Gauss–Legendre
    /// in the square of the radius.
    fn mean_of_points(&self, angles: usize, a: f64, r: f64) -> Displacement {
        let mut mean = Displacement::ZERO;
        for j in 0..angles {
            let cosine = (PI * (j as f64 + 0.5) / angles as f64).cos();
            for &(t, weight) in rule_of_class(0) {
                let square = 0.5 * a * a * (1.0 + t);
                // From the point load to the field point, along the radius.
                let along = r - square.sqrt() * cosine;
                let distance = (r * r + square - 2.0 * r * square.sqrt() * cosine)
                    .max(0.0)
                    .sqrt();
                let part = self.under_point(distance);
                let share = 0.5 * weight / angles as f64;
                mean.vertical += share * part.vertical;
                if distance > 0.0 {
                    mean.radial += share * part.radial * along / distance;
                }
            }
        }
        mean
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(nu: f64, depth: f64) -> HalfSpace {
        HalfSpace {
            weight: 1.0,
            soil: Soil::new(1e8, nu).expect("soil"),
            depth,
        }
    }

    /// Uniform pressure q on a disc of radius a, on the axis: `u_z` = (1+ν) q/E · (…), Johnson section 3.4.
    #[test]
    fn disc_on_its_axis() {
        let (a, nu) = (0.15, 0.35);
        let load = SurfaceLoad::new(1e4, a).expect("load");
        for z in [0.0, 1e-6, 0.05, 0.3, 5.0] {
            let field = unit(nu, z);
            let distance = a.hypot(z);
            let q = load.pressure();
            let expected =
                (1.0 + nu) / 1e8 * q * (2.0 * (1.0 - nu) * (distance - z) + z * (1.0 - z / distance));
            let got = field.displacement(load, 0.0);
            assert!(
                (got.vertical - expected).abs() < 1e-13 * expected.abs(),
                "z = {z}"
            );
            assert!(got.radial.abs() < 1e-14 * expected.abs());
        }
    }

    /// At the edge of the disc on the surface: `u_z` = 4(1−ν²) q a/(π E), `u_r` = −(1−2ν)(1+ν) q a/(2E) (Johnson 3.30, 3.33).
    #[test]
    fn disc_at_its_edge() {
        let (a, nu) = (0.15, 0.35);
        let load = SurfaceLoad::new(1e4, a).expect("load");
        let q = load.pressure();
        let got = unit(nu, 0.0).displacement(load, a);
        let vertical = 4.0 * (1.0 - nu * nu) * q * a / (PI * 1e8);
        let radial = -(1.0 - 2.0 * nu) * (1.0 + nu) * q * a / (2.0 * 1e8);
        assert!((got.vertical - vertical).abs() < 1e-14 * vertical);
        assert!((got.radial - radial).abs() < 1e-14 * radial.abs());
        // Continuous across the edge, at depth and just below the surface.
        for z in [1e-7, 1e-3, 0.2] {
            let field = unit(nu, z);
            let at = field.displacement(load, a);
            for r in [a * (1.0 - 1e-12), a * (1.0 + 1e-12)] {
                let near = field.displacement(load, r);
                // The displacement's slope under the edge is logarithmic or finite.
                assert!((near.vertical - at.vertical).abs() < 1e-9 * vertical, "z = {z}");
                assert!((near.radial - at.radial).abs() < 1e-9 * vertical, "z = {z}");
            }
        }
    }

    /// A disc is the mean of point loads on it.
    #[test]
    fn disc_is_a_mean_of_points() {
        let a = 0.4;
        let disc = SurfaceLoad::new(1e4, a).expect("load");
        let point = SurfaceLoad::point(1e4).expect("load");
        for (r, z) in [(0.0, 0.5), (0.3, 0.7), (0.4, 0.5), (0.9, 0.3), (30.0, 1.0)] {
            let field = unit(0.3, z);
            let angles = 240;
            let (mut radial, mut vertical) = (0.0, 0.0);
            let rule = crate::gauss::rule(64);
            for (t, w) in &rule {
                let ring = 0.5 * a * (1.0 + t);
                for j in 0..angles {
                    let phi = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(angles);
                    let (x, y) = (r - ring * phi.cos(), ring * phi.sin());
                    let distance = x.hypot(y);
                    let part = field.displacement(point, distance) * (w * ring / (a * f64::from(angles)));
                    vertical += part.vertical;
                    radial += part.radial * x / distance;
                }
            }
            let got = field.displacement(disc, r);
            assert!(
                (got.vertical - vertical).abs() < 1e-11 * vertical.abs(),
                "{r} {z}"
            );
            assert!((got.radial - radial).abs() < 1e-11 * vertical.abs(), "{r} {z}");
        }
    }

    /// The three evaluations of a disc agree where they meet.
    #[test]
    fn near_and_far_forms_agree() {
        let a = 0.15;
        for nu in [0.0, 0.5] {
            for angle in [0.0_f64, 0.4, 1.0, 1.5, 1.57] {
                let at = |distance: f64| (unit(nu, a * distance * angle.cos()), a * distance * angle.sin());
                let (field, r) = at(FAR);
                let i = lipschitz_hankel(a, r, field.depth);
                let scale = 1.0 / (2.0 * PI * field.soil.shear_modulus() * a);
                let radial = scale * (i.z_i110 - (1.0 - 2.0 * nu) * i.i11_minus_1);
                let vertical = scale * (i.z_i100 + 2.0 * (1.0 - nu) * i.i10_minus_1);
                let mean = field.mean_of_points(8, a, r);
                assert!(
                    (mean.radial - radial).abs() < NEAR_ROUNDING * vertical,
                    "{nu} {angle}"
                );
                assert!(
                    (mean.vertical - vertical).abs() < NEAR_ROUNDING * vertical,
                    "{nu} {angle}"
                );
                let (field, r) = at(VERY_FAR);
                let (five, eight) = (field.mean_of_points(5, a, r), field.mean_of_points(8, a, r));
                assert!(
                    (five.radial - eight.radial).abs() < FAR_ROUNDING * eight.vertical,
                    "{nu} {angle}"
                );
                assert!(
                    (five.vertical - eight.vertical).abs() < FAR_ROUNDING * eight.vertical,
                    "{nu} {angle}"
                );
            }
        }
    }
}
