//! Every case of the reference tables, to the default accuracy of 1e-8 of the peak at each depth.

use super::common::{case, error, table};
use burmister::DEFAULT_ACCURACY;

fn meets_its_accuracy(file: &str, alone: (&str, f64)) {
    let rows = table(file, alone);
    assert!(!rows.is_empty());
    let mut misses = Vec::new();
    for row in rows {
        let (ground, load) = case(&row.case);
        let radii: Vec<f64> = row.points.iter().map(|point| point.0).collect();
        let (values, statistics) = ground
            .displacements_with_statistics(load, &radii, row.depth)
            .unwrap_or_else(|e| panic!("{} z = {}: {e}", row.case, row.depth));
        let (radial, vertical) = error(&row.points, &values);
        if std::env::var_os("BURMISTER_SHOW").is_some() {
            println!(
                "{:20} z {:5}: u_r {radial:.1e} u_z {vertical:.1e} {statistics:?}",
                row.case, row.depth
            );
        }
        if !(radial <= DEFAULT_ACCURACY && vertical <= DEFAULT_ACCURACY) {
            misses.push(format!(
                "{} z = {}: u_r {radial:.1e}, u_z {vertical:.1e}",
                row.case, row.depth
            ));
        }
    }
    assert!(misses.is_empty(), "{misses:#?}");
}

#[test]
fn layered_grounds() {
    meets_its_accuracy("computed_layered.csv", ("", 0.0));
}

#[test]
fn point_loads() {
    meets_its_accuracy("computed_point_load.csv", ("", 0.0));
}

#[test]
fn rigid_bases() {
    meets_its_accuracy("computed_rigid_base.csv", ("", 0.0));
}

#[test]
fn two_hundred_radii() {
    meets_its_accuracy("computed_task3_z1200_200pts.csv", ("task3", 1.2));
}
