//! The model against exact layered solutions, at the accuracy promised.

use std::collections::HashMap;

use ground_field::GroundField;
use layered_fem::LayeredFem;
use testkit::layered::{Row, system, table};

/// The accuracy promised: half a percent of the peak at depths 0.6–2.0 m and radii to 10 m, on every system.
const PROMISED: f64 = 5e-3;
const REACH: f64 = 10.001;

fn shared() -> Vec<Row> {
    let layered = include_str!("data/computed_layered.csv");
    let point_load = include_str!("data/computed_point_load.csv");
    let texts = [layered, point_load, include_str!("data/computed_rigid_base.csv")];
    let rows = |text| table(text, ("", 0.0));
    texts.into_iter().flat_map(rows).collect()
}

/// Checks the answers at all depths of `rows`, and that the estimate is within `factor` of a bound of the truth.
fn verify(rows: &[Row], accuracy: f64, factor: f64) {
    let mut grounds = HashMap::new();
    for row in rows {
        let (profile, load) = system(&row.case);
        let ground = grounds
            .entry(&row.case)
            .or_insert_with(|| LayeredFem::new(&profile, accuracy).unwrap());
        let found = ground.displacements(load, &row.radii(), row.depth).unwrap();
        let [radial, vertical] = row.errors(&found, REACH);
        let estimate = ground.error_estimate(load, row.depth).unwrap();
        let name = format!("{} at {} m: {radial:.1e}, {vertical:.1e}", row.case, row.depth);
        assert!(radial.max(vertical).max(estimate.largest()) <= accuracy, "{name}");
        assert!(radial <= factor * estimate.radial, "{name}, {estimate:?}");
        assert!(vertical <= factor * estimate.vertical, "{name}, {estimate:?}");
    }
    assert!(rows.len() >= 38, "only {} profiles were compared", rows.len());
}

#[test]
fn systems_are_met_within_the_accuracy_promised() {
    let further = table(include_str!("data/computed_further.csv"), ("", 0.0));
    std::thread::scope(|threads| {
        for (mut rows, accuracy) in [(shared(), PROMISED), (shared(), 1e-3), (further, PROMISED)] {
            rows.retain(|row| (0.59..2.01).contains(&row.depth));
            threads.spawn(move || verify(&rows, accuracy, 1.0));
        }
    });
}

/// Above the depths of ducts, up to the surface and the edge of the disc, the answer is still within the accuracy asked. On the coarse meshes of
/// a loose accuracy, near the load, the estimate bounds the truth to a factor.
#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn shallow_depths_within_five_percent() {
    let mut rows = shared();
    // At the surface of incompressible soil u_r vanishes, and there is no peak to measure it by.
    let has_peak = |row: &Row| row.depth > 0.0 || !["hs2", "pl_hs_E40_nu0.5"].contains(&row.case.as_str());
    rows.retain(|row| row.depth < 0.599 && has_peak(row));
    verify(&rows, 0.05, 1.5);
}
