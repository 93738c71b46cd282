//! The example on Table 3: what it computes and what it says.

use super::common::{johnson, soil};
use crate::answers::common::assert_within;
use crate::scenes::{assert_near, upper};

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
        assert_near(row.peak_on_subgrade, peak(800e6, force, depth), 1e-8, row);
        assert_near(peak(row.modulus, force, depth), 35.7e-6, 1e-8, row);
        assert_near(row.peak, 35.7e-6, 1e-8, row);
    }
    // The finding: one soil about a third as stiff as the subgrade of Table 1 explains all three depths within 5 %.
    let mean = rows.iter().map(|row| row.modulus).sum::<f64>() / 3.0;
    for row in &rows {
        assert!((270e6..292e6).contains(&row.modulus), "{row:?}");
        assert_near(row.modulus, mean, 0.05, row);
    }
}

/// What the example says a scene can say: `longitudinal_peak` takes the place of the modulus.
#[test]
fn a_scene_scaled_to_the_peak_is_the_scene_with_that_modulus() {
    for row in example::rows().expect("rows") {
        let (depth, load) = (row.depth, row.weight);
        let (depth, load) = (
            format!("duct.depth={depth} m"),
            format!("vehicles.0.load={load} tf"),
        );
        let scene = |ground: &str| upper(&["duct.length=300 m", &depth, &load, ground]);
        let scaled = scene("ground.longitudinal_peak=35.7 um");
        let softer = scene(&format!("ground.layers.0.young_modulus={}", row.modulus));
        let positions: Vec<f64> = (-40..=40).map(|k| 0.2 * f64::from(k)).collect();
        let [scaled, softer] =
            [scaled, softer].map(|scene| creepage::profile_at(&scene, &positions).expect("profile"));
        for (k, position) in positions.iter().enumerate() {
            let along = softer.longitudinal_m[k];
            assert_within(scaled.longitudinal_m[k], along, 1e-7 * 35.7e-6, position);
            let allowed = 1e-7 * softer.vertical_m[40];
            assert_within(scaled.vertical_m[k], softer.vertical_m[k], allowed, position);
        }
    }
}
