//! Physical laws the half-space must keep, whatever the numbers.

#![allow(clippy::doc_markdown, reason = "u_r in the text is a formula, not code")]

use boussinesq::HalfSpace;
use ground_field::{Displacement, GroundField, SurfaceLoad};
use proptest::prelude::*;

fn ground(young_modulus: f64, poisson_ratio: f64) -> HalfSpace {
    HalfSpace::new(testkit::soil(young_modulus, poisson_ratio))
}

fn at(ground: HalfSpace, force: f64, contact: f64, radius: f64, depth: f64) -> Displacement {
    let load = SurfaceLoad::new(force, contact).expect("a valid load");
    ground.displacement(load, radius, depth).expect("a regular point")
}

/// Whether two displacements agree to rounding, as a share of the larger component.
fn alike(one: Displacement, two: Displacement) -> bool {
    let size = one.vertical.abs().max(one.radial.abs());
    let difference = one - two;
    difference.radial.abs().max(difference.vertical.abs()) <= 1e-13 * size
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn linear_in_the_force_and_inverse_in_the_modulus(
        nu in 0.0..=0.5, contact in 0.0..0.5_f64, r in 0.0..5.0_f64, z in 0.01..5.0_f64,
        one in 1.0..1e6_f64, two in 1.0..1e6_f64, factor in 1e-3..1e3_f64,
    ) {
        let soft = ground(1e8, nu);
        let (both, alone) = (at(soft, one + two, contact, r, z), at(soft, one, contact, r, z));
        prop_assert!(alike(both, alone + at(soft, two, contact, r, z)));
        prop_assert!(alike(alone, at(ground(1e8 * factor, nu), one, contact, r, z) * factor));
    }

    /// All lengths times s and the force times s², at the same pressure: displacements times s.
    #[test]
    fn geometric_scaling(
        nu in 0.0..=0.5, contact in 0.0..0.5_f64, r in 0.0..5.0_f64, z in 0.01..5.0_f64, exponent in -20..20_i32,
    ) {
        // A power of two, so that the ratio of radius and contact radius is the same to the last digit.
        let s = 2.0_f64.powi(exponent);
        let here = at(ground(1e8, nu), 1e5, contact, r, z);
        let there = at(ground(1e8, nu), 1e5 * s * s, contact * s, r * s, z * s);
        prop_assert!(alike(here * s, there));
    }

    /// Under the disc's own pressure the ground goes down, everywhere, and on the axis nowhere else.
    #[test]
    fn the_ground_goes_down(nu in 0.0..=0.5, contact in 0.0..0.5_f64, r in 0.001..50.0_f64, z in 0.001..50.0_f64) {
        let ground = ground(1e8, nu);
        prop_assert!(at(ground, 1e5, contact, r, z).vertical > 0.0);
        prop_assert!(at(ground, 1e5, contact, r, 0.0).vertical > 0.0);
        prop_assert_eq!(at(ground, 1e5, contact, 0.0, z).radial, 0.0);
    }

    /// u_r > 0 (ground pushed outward) exactly where z/R · (1 + z/R) > 1 − 2ν; on the surface it never is.
    #[test]
    fn sign_of_the_radial_displacement(nu in 0.0..=0.5, r in 0.01..50.0_f64, z in 0.0..50.0_f64) {
        let cosine = z / r.hypot(z);
        let margin: f64 = cosine * (1.0 + cosine) - (1.0 - 2.0 * nu);
        prop_assume!(margin.abs() > 1e-12);
        prop_assert_eq!(at(ground(1e8, nu), 1e5, 0.0, r, z).radial > 0.0, margin > 0.0);
    }

    /// Ordinary numbers are never refused.
    #[test]
    fn ordinary_places_have_values(
        nu in 0.0..=0.5, contact in -9.0..2.0_f64, r in -9.0..4.0_f64, z in -9.0..4.0_f64,
    ) {
        let value = at(ground(1e8, nu), 1e5, 10.0_f64.powf(contact), 10.0_f64.powf(r), 10.0_f64.powf(z));
        prop_assert!(value.is_finite());
    }
}
