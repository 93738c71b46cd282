//! The example on Table 3: what it computes and what it says.

use creepage::scene::Scene;

use super::common::{johnson, soil};

#[allow(dead_code, reason = "its main is the example's own")]
#[path = "../../examples/table_3.rs"]
mod example;

/// max|u_r| of Boussinesq's formula by ternary search, apart from the code that finds peaks for a duct.
fn peak(modulus: f64, force: f64, depth: f64) -> f64 {
    let u = |r: f64| johnson(soil(modulus, 0.4), force, r, depth).radial;
    // u_r grows from the axis to its maximum between 0.2 and 2 depths, and falls beyond.
    let (mut low, mut high) = (0.2 * depth, 2.0 * depth);
    for _ in 0..200 {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if u(left) < u(right) {
            low = left;
        } else {
            high = right;
        }
    }
    // Near the load u_r is outward, and there is no larger inward one farther out for ν = 0.4.
    u(0.5 * (low + high))
}

#[test]
fn one_modulus_gives_the_stated_peak_at_each_depth() {
    let rows = example::rows().expect("rows");
    assert_eq!(rows.len(), 3);
    for (row, (depth, weight)) in rows.iter().zip([(0.6, 8.57), (1.5, 20.0), (2.0, 27.17)]) {
        assert_eq!((row.depth, row.weight), (depth, weight));
        let force = weight * 9806.65;
        let on_subgrade = peak(800e6, force, depth);
        assert!((row.peak_on_subgrade / on_subgrade - 1.0).abs() < 1e-8, "{row:?}");
        assert!(
            (peak(row.modulus, force, depth) / 35.7e-6 - 1.0).abs() < 1e-8,
            "{row:?}"
        );
        assert!((row.peak / 35.7e-6 - 1.0).abs() < 1e-8, "{row:?}");
    }
}

/// The finding: one soil about a third as stiff as the subgrade of Table 1 explains all three depths within 5 %.
#[test]
fn the_moduli_are_close_to_one_another() {
    let moduli: Vec<f64> = example::rows()
        .expect("rows")
        .iter()
        .map(|row| row.modulus * 1e-6)
        .collect();
    let mean = moduli.iter().sum::<f64>() / 3.0;
    assert!((270.0..292.0).contains(&mean), "{moduli:?}");
    for modulus in moduli {
        assert!((270.0..292.0).contains(&modulus), "{modulus} MPa");
        assert!((modulus / mean - 1.0).abs() < 0.05, "{modulus} of {mean} MPa");
    }
}

/// What the example says a scene can say: `longitudinal_peak` takes the place of the modulus.
#[test]
fn a_scene_scaled_to_the_peak_is_the_scene_with_that_modulus() {
    for row in example::rows().expect("rows") {
        let scene = |ground: &str| {
            let text = format!(
                r#"
[duct]
length = "300 m"
depth = {}
[ground]
{ground}
poisson_ratio = 0.4
[cable]
weight = "108.8 N/m"
axial_stiffness = "8.01e6 N"
normal_load_factor = 1.0
[friction]
law = "coulomb"
dynamic_coefficient = 0.3
[ends]
upstream = "fixed"
downstream = "fixed"
[[vehicles]]
load = "{} tf"
speed = "40 km/h"
[traffic]
passes = 1
"#,
                row.depth, row.weight
            );
            Scene::from_toml("table-3.toml", &text).expect("scene")
        };
        let scaled = scene("longitudinal_peak = \"35.7 um\"\n[[ground.layers]]\nyoung_modulus = \"800 MPa\"");
        let softer = scene(&format!("[[ground.layers]]\nyoung_modulus = {}", row.modulus));
        let positions: Vec<f64> = (-40..=40).map(|k| 0.2 * f64::from(k)).collect();
        let [scaled, softer] =
            [scaled, softer].map(|scene| creepage::profile_at(&scene, &positions).expect("profile"));
        for (a, b) in scaled.longitudinal_m.iter().zip(&softer.longitudinal_m) {
            assert!((a - b).abs() < 1e-7 * 35.7e-6, "{a} {b}");
        }
        for (a, b) in scaled.vertical_m.iter().zip(&softer.vertical_m) {
            assert!((a - b).abs() < 1e-7 * softer.vertical_m[40], "{a} {b}");
        }
    }
}
