//! Physical laws the half-space must keep, whatever the numbers.

#![allow(clippy::doc_markdown, reason = "u_r in the text is a formula, not code")]

use boussinesq::HalfSpace;
use ground_field::{Displacement, GroundField, SurfaceLoad};
use proptest::prelude::*;
use testkit::gauss_legendre::rings;

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
    fn linear_in_the_force(
        nu in 0.0..=0.5, contact in 0.0..0.5_f64, r in 0.0..5.0_f64, z in 0.01..5.0_f64, one in 1.0..1e6_f64, two in 1.0..1e6_f64,
    ) {
        let ground = ground(1e8, nu);
        let sum = at(ground, one, contact, r, z) + at(ground, two, contact, r, z);
        prop_assert!(alike(at(ground, one + two, contact, r, z), sum));
    }

    #[test]
    fn inverse_in_the_modulus(
        nu in 0.0..=0.5, contact in 0.0..0.5_f64, r in 0.0..5.0_f64, z in 0.01..5.0_f64, factor in 1e-3..1e3_f64,
    ) {
        let soft = at(ground(1e8, nu), 1e5, contact, r, z);
        let stiff = at(ground(1e8 * factor, nu), 1e5, contact, r, z);
        prop_assert!(alike(soft, stiff * factor));
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

    #[test]
    fn nothing_moves_sideways_on_the_axis(nu in 0.0..=0.5, contact in 0.0..0.5_f64, z in 0.001..50.0_f64) {
        prop_assert_eq!(at(ground(1e8, nu), 1e5, contact, 0.0, z).radial, 0.0);
    }

    /// Under the disc's own pressure the ground goes down, everywhere.
    #[test]
    fn the_ground_goes_down(nu in 0.0..=0.5, contact in 0.01..0.5_f64, r in 0.0..50.0_f64, z in 0.0..50.0_f64) {
        prop_assert!(at(ground(1e8, nu), 1e5, contact, r, z).vertical > 0.0);
    }

    /// u_r > 0 (ground pushed outward) exactly where z/R · (1 + z/R) > 1 − 2ν; on the surface it never is.
    #[test]
    fn sign_of_the_radial_displacement(nu in 0.0..=0.5, r in 0.01..50.0_f64, z in 0.0..50.0_f64) {
        let cosine = z / r.hypot(z);
        let margin: f64 = cosine * (1.0 + cosine) - (1.0 - 2.0 * nu);
        prop_assume!(margin.abs() > 1e-12);
        prop_assert_eq!(at(ground(1e8, nu), 1e5, 0.0, r, z).radial > 0.0, margin > 0.0);
    }

    /// Betti–Maxwell on the surface: what pressure on disc 1 does on average under disc 2 is what pressure on disc 2 does
    /// on average under disc 1. With disc 2 shrunk to a point: the mean of the point load's settlement over disc 1 is the
    /// disc's settlement at that point. Outside the disc, by the 64-point rule around rings and Gauss–Legendre across them.
    #[test]
    fn reciprocity(nu in 0.0..=0.5, ratio in 2.0..20.0_f64) {
        let ground = ground(1e8, nu);
        let contact = 0.2;
        let r = ratio * contact;
        let mut mean = 0.0;
        for (share, weight) in rings(6) {
            let s = contact * share;
            for k in 0..64 {
                let angle = std::f64::consts::TAU * f64::from(k) / 64.0;
                let distance = (r - s * angle.cos()).hypot(s * angle.sin());
                mean += weight / 64.0 * at(ground, 1e5, 0.0, distance, 0.0).vertical;
            }
        }
        let disc = at(ground, 1e5, contact, r, 0.0).vertical;
        prop_assert!((mean / disc - 1.0).abs() < 1e-8, "{mean} and {disc}");
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
