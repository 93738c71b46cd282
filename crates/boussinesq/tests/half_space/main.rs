//! The half-space against independent answers.

#![allow(clippy::doc_markdown, reason = "u_r in the text is a formula, not code")]

mod quadrature;

use boussinesq::{HalfSpace, Stress};
use ground_field::{Displacement, GroundError, GroundField, SurfaceLoad};
use quadrature::{Rule, disc};
use std::f64::consts::PI;

/// The promise: share of the component's peak at that depth.
const PROMISED: f64 = 1e-10;

const E: f64 = 100e6;
const A: f64 = 0.15;
const PRESSURE: f64 = 0.7e6;

fn ground(nu: f64) -> HalfSpace {
    HalfSpace::new(testkit::soil(E, nu))
}

fn wheel() -> SurfaceLoad {
    SurfaceLoad::new(PRESSURE * PI * A * A, A).expect("a valid load")
}

fn point(force: f64) -> SurfaceLoad {
    SurfaceLoad::point(force).expect("a valid load")
}

fn at(ground: &HalfSpace, load: SurfaceLoad, radius: f64, depth: f64) -> Displacement {
    ground.displacement(load, radius, depth).expect("a regular point")
}

/// u_z on the axis of a disc: (1+ν)p/E · [2(1−ν)(√(a²+z²) − z) + z(1 − z/√(a²+z²))], from the point load by elementary
/// integration; Poulos & Davis, Elastic Solutions for Soil and Rock Mechanics (1974), eq. 3.6.
fn axis(nu: f64, z: f64) -> f64 {
    let slant = z.hypot(1.0);
    (1.0 + nu) * (2.0 * (1.0 - nu) / (slant + z) + z / (slant * (slant + z)))
}

#[test]
fn quadrature_agrees_with_the_axis() {
    let rule = Rule::new(16);
    for nu in [0.0, 0.35, 0.5] {
        for z in [0.0, 1e-3, 0.1, 1.0, 3.0, 10.0, 100.0] {
            let [radial, vertical] = disc(&rule, nu, 0.0, z);
            assert!((vertical / axis(nu, z) - 1.0).abs() < 1e-12, "nu {nu}, z {z}");
            assert!(radial.abs() < 1e-12 * vertical);
        }
    }
}

#[test]
fn disc_agrees_with_the_axis() {
    for nu in [0.0, 0.2, 0.35, 0.5] {
        for z in [0.0, 1e-12, 1e-3, 0.1, 1.0, 3.0, 3.999, 4.001, 10.0, 1e3, 1e8] {
            let value = at(&ground(nu), wheel(), 0.0, A * z);
            let exact = PRESSURE * A / E * axis(nu, z);
            assert!((value.vertical / exact - 1.0).abs() < 1e-14, "nu {nu}, z {z}");
            assert_eq!(value.radial, 0.0);
        }
    }
}

/// Everywhere: on the surface and close below it, inside, at and next to the rim, outside, far.
#[test]
fn disc_agrees_with_quadrature() {
    let rule = Rule::new(16);
    #[rustfmt::skip]
    let depths = [0.0, 1e-6, 1e-3, 0.03, 0.2, 0.7, 1.5, 2.5, 3.9, 4.1, 8.0, 14.0, 33.0];
    #[rustfmt::skip]
    let radii = [
        0.0, 1e-9, 1e-3, 0.05, 0.2, 0.5, 0.8, 0.97, 0.999, 1.0 - 1e-7, 1.0, 1.0 + 1e-7, 1.001, 1.05,
        1.5, 2.2, 3.1, 3.99, 4.01, 5.0, 7.0, 12.0, 40.0, 333.0,
    ];
    for nu in [0.0, 0.2, 0.35, 0.5] {
        for z in depths {
            let exact: Vec<_> = radii.iter().map(|&r| disc(&rule, nu, r, z)).collect();
            for component in 0..2 {
                let peak = exact.iter().map(|e| e[component].abs()).fold(0.0, f64::max);
                for (r, e) in radii.iter().zip(&exact) {
                    let value = at(&ground(nu), wheel(), A * r, A * z) * (E / (PRESSURE * A));
                    let value = [value.radial, value.vertical][component];
                    let error = (value - e[component]).abs();
                    let place = format!("component {component}, nu {nu}, r {r}, z {z}");
                    assert!(error <= PROMISED * peak, "{place}: {value:e}");
                }
            }
        }
    }
}

/// Johnson (1985), §3.4(a): centre 2(1−ν²)pa/E, rim 4(1−ν²)pa/(πE), and u_r on the surface inside and outside.
#[test]
fn disc_on_the_surface() {
    for nu in [0.0, 0.3, 0.5] {
        let ground = ground(nu);
        let unit = PRESSURE * A / E;
        let centre = at(&ground, wheel(), 0.0, 0.0).vertical;
        assert!((centre / (2.0 * (1.0 - nu * nu) * unit) - 1.0).abs() < 1e-14);
        let rim = at(&ground, wheel(), A, 0.0).vertical;
        assert!((rim / (4.0 * (1.0 - nu * nu) / PI * unit) - 1.0).abs() < 1e-14);
        for r in [0.3, 0.9, 1.0, 1.1, 2.0, 10.0, 1000.0] {
            let exact = -(1.0 - 2.0 * nu) * (1.0 + nu) / 2.0 * unit * if r < 1.0 { r } else { 1.0 / r };
            let value = at(&ground, wheel(), A * r, 0.0).radial;
            let error = (value - exact).abs();
            assert!(error <= 1e-14 * exact.abs(), "nu {nu}, r {r}: {value}");
        }
    }
}

/// The field is continuous on and around the rim, where its slope is not.
#[test]
fn rim_is_continuous() {
    let ground = ground(0.3);
    let rim = at(&ground, wheel(), A, 0.0);
    for distance in [1e-4, 1e-8, 1e-12, 1e-15, 1e-17, 1e-100, 1e-308] {
        for (r, z) in [(0.0, 1.0), (1.0, 0.0), (-1.0, 0.0), (0.7, 0.7), (-0.7, 0.7)] {
            let value = at(&ground, wheel(), A + distance * r, distance * z);
            let bound = 20.0 * (distance / A) * (A / distance).ln() + 1e-14;
            let difference = value - rim;
            assert!(difference.vertical.abs() < bound * rim.vertical, "at {distance}");
            assert!(difference.radial.abs() < bound * rim.vertical, "at {distance}");
        }
    }
}

#[test]
fn reference_cases() {
    let number = |word: &str| word.parse().expect("a number");
    let numbers = |line: &str| line.split(',').map(number).collect();
    let table = include_str!("../data/half_space.csv");
    let rows: Vec<Vec<f64>> = table.lines().skip(1).map(numbers).collect();
    assert!(rows.len() > 300);
    for row in &rows {
        let same = |other: &&Vec<f64>| other[..4] == row[..4] && other[5] == row[5];
        let of_depth: Vec<_> = rows.iter().filter(same).collect();
        let peak = |column: usize| of_depth.iter().map(|o| o[column].abs()).fold(0.0, f64::max);
        let ground = HalfSpace::new(testkit::soil(row[0], row[1]));
        let load = SurfaceLoad::new(row[2], row[3]).expect("a valid load");
        let value = at(&ground, load, row[4], row[5]);
        for (value, column) in [(value.radial, 6), (value.vertical, 7)] {
            let error = (value - row[column]).abs();
            assert!(error <= PROMISED * peak(column), "{row:?}: {value:e}");
        }
    }
}

/// Far away, and as the contact radius goes to 0, the disc is a point load: the difference is of second order in a/R.
#[test]
fn disc_tends_to_the_point_load() {
    let ground = ground(0.35);
    for (r, z) in [(0.0, 1.2), (0.5, 1.2), (3.0, 0.4), (50.0, 0.0), (1e4, 2.0)] {
        let alone = at(&ground, point(1e5), r, z);
        let distance = f64::hypot(r, z);
        for ratio in [0.5, 0.26, 0.24, 0.1, 1e-2, 1e-4, 1e-8, 1e-20, 1e-300] {
            let load = SurfaceLoad::new(1e5, ratio * distance).expect("a valid load");
            let difference = at(&ground, load, r, z) - alone;
            let bound = 2.0 * ratio * ratio + 4e-15;
            let vertical = difference.vertical.abs() <= bound * alone.vertical;
            // In relative terms too: no digits are lost however far.
            let radial = difference.radial.abs() <= 4.0 * bound * alone.radial.abs();
            assert!(vertical && radial, "{ratio} at {r}, {z}");
        }
    }
}

/// ∂u_r/∂r under a point load: Hooke's law of the stress.
fn point_radial_strain(ground: &HalfSpace, force: f64, r: f64, z: f64) -> Result<f64, GroundError> {
    let stress = ground.point_stress(force, r, z)?;
    let soil = ground.soil();
    Ok((stress.radial - soil.poisson_ratio() * (stress.vertical + stress.hoop)) / soil.young_modulus())
}

/// Slope of `f` at 0 by central differences over ±h and ±2h, extrapolated (Richardson).
fn slope(h: f64, f: impl Fn(f64) -> f64) -> f64 {
    let central = |h: f64| (f(h) - f(-h)) / (2.0 * h);
    (4.0 * central(h) - central(2.0 * h)) / 3.0
}

#[test]
fn radial_strain_is_the_derivative() {
    for nu in [0.0, 0.3, 0.5] {
        let ground = ground(nu);
        let load = point(1e5);
        for (r, z) in [(0.5, 0.0), (0.02, 1.2), (0.5, 1.2), (3.0, 1.2), (40.0, 0.6)] {
            let difference = slope(1e-3 * f64::hypot(r, z), |h| at(&ground, load, r + h, z).radial);
            let strain = point_radial_strain(&ground, 1e5, r, z).expect("a regular point");
            let error = (strain - difference).abs() * (E * (r * r + z * z)) / 1e5;
            assert!(error < 1e-10, "nu {nu}, r {r}, z {z}: {strain} {difference}");
        }
    }
}

#[test]
fn the_load_itself_is_an_error() {
    let ground = ground(0.3);
    let is_singular = |error| matches!(error, GroundError::Singular { .. });
    // On the load, and where the value leaves the range of numbers.
    for radius in [0.0, 5e-324] {
        assert!(
            ground
                .displacement(point(1e5), radius, 0.0)
                .is_err_and(is_singular)
        );
    }
    assert!(ground.point_stress(1e5, 0.0, 0.0).is_err_and(is_singular));
    assert!(at(&ground, point(1e5), 1e-300, 0.0).vertical > 1e290);
    // No force, no displacement.
    assert_eq!(at(&ground, point(0.0), 0.0, 0.0), Displacement::ZERO);
    let unstressed = ground.point_stress(0.0, 0.0, 0.0).expect("no load");
    assert_eq!(unstressed, Stress::default());
    // A disc has no singular point.
    assert!(at(&ground, wheel(), A, 0.0).is_finite());
}

#[test]
fn places_out_of_range_are_errors() {
    let ground = ground(0.3);
    let is_invalid = |error| matches!(error, GroundError::InvalidParameter { .. });
    let (nan, infinite) = (f64::NAN, f64::INFINITY);
    for (r, z) in [(-1.0, 0.0), (0.0, -1.0), (nan, 1.0), (1.0, nan), (infinite, 1.0)] {
        for load in [wheel(), point(1.0)] {
            assert!(ground.displacement(load, r, z).is_err_and(is_invalid));
        }
        assert!(ground.point_stress(1.0, r, z).is_err());
    }
    assert!(ground.point_stress(-1.0, 1.0, 1.0).is_err());
}
