//! Displacements printed for other programs; origin and trust in `tests/data/README.md`.

use std::collections::HashMap;

use boussinesq::HalfSpace;
use burmister::LayeredHalfSpace;
use ground_field::{Base, GroundField, SoilProfile};
use layered_fem::LayeredFem;

use super::common::{FEM_ACCURACY, load, profile, soil};
use crate::answers::common::assert_within;

const MILLIMETRE: f64 = 1e-3;
const INCH: f64 = 0.0254;
/// Pound-force per square inch \[Pa\].
const PSI: f64 = 6894.757;

fn rows(file: &str) -> Vec<HashMap<String, String>> {
    let path = format!("{}/tests/data/{file}", env!("CARGO_MANIFEST_DIR"));
    let mut reader = csv::Reader::from_path(path).expect("table");
    reader.deserialize().map(|row| row.expect("row")).collect()
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().expect("number")
}

/// Force of a pressure \[Pa\] on a disc \[m\].
fn force(pressure: f64, radius: f64) -> f64 {
    std::f64::consts::PI * radius * radius * pressure
}

fn ellea3() -> SoilProfile {
    profile(
        &[(0.15, soil(3e9, 0.30)), (0.6, soil(2e8, 0.35))],
        Base::HalfSpace(soil(4e7, 0.40)),
    )
}

/// Displacement (x, y, z) under discs at `centres`, each with 1.1 MPa on a radius of 150 mm.
fn superposed(field: &dyn GroundField, centres: &[(f64, f64)], place: [f64; 3]) -> [f64; 3] {
    let wheel = load(force(1.1e6, 0.15), 0.15);
    centres.iter().fold([0.0; 3], |sum, centre| {
        let (x, y) = (place[0] - centre.0, place[1] - centre.1);
        let radius = x.hypot(y);
        let u = field.displacement(wheel, radius, place[2]).expect("displacement");
        // On the axis nothing moves sideways.
        let share = if radius > 0.0 { u.radial / radius } else { 0.0 };
        [sum[0] + share * x, sum[1] + share * y, sum[2] + u.vertical]
    })
}

/// The printed digits end at 1e-4 mm and are cut, not rounded, and the program is right to about 1e-5 mm.
const ELLEA_DIGITS: f64 = 1.2e-4 * MILLIMETRE;

#[test]
fn ellea1_three_layers_and_half_space() {
    let layered = LayeredHalfSpace::new(&ellea3()).expect("layers");
    let elements = LayeredFem::new(&ellea3(), FEM_ACCURACY).expect("elements");
    let uniform = HalfSpace::new(soil(2e8, 0.35));
    let single = [(0.0, 0.0)];
    let dual = [(0.0, 0.15), (0.0, -0.15)];
    let mut seen = 0;
    for row in rows("published_ellea1_displacement.csv") {
        let place = ["x_mm", "y_mm", "z_mm"].map(|column| number(&row, column) * MILLIMETRE);
        let printed = ["ux_mm", "uy_mm", "uz_mm"].map(|column| number(&row, column) * MILLIMETRE);
        let (field, centres): (&dyn GroundField, &[_]) = match row["system"].as_str() {
            "ellea3_single" => (&layered, &single),
            "ellea3_dual" => (&layered, &dual),
            "ellea_hs" => (&uniform, &single),
            other => panic!("unknown system {other}"),
        };
        let found = superposed(field, centres, place);
        for axis in 0..3 {
            assert_within(found[axis], printed[axis], ELLEA_DIGITS, &row);
        }
        // Finite elements where a duct may lie; to their own accuracy of the peak at that depth.
        if row["system"] == "ellea3_dual" && place[2] >= 0.5 {
            let found = superposed(&elements, &dual, place)[2];
            let allowed = FEM_ACCURACY * printed[2] + ELLEA_DIGITS;
            assert_within(found, printed[2], allowed, &row);
        }
        seen += 1;
    }
    assert_eq!(seen, 88);
}

#[test]
fn kenpave_three_layers() {
    let (upper, lower) = (soil(500e3 * PSI, 0.35), soil(40e3 * PSI, 0.40));
    let base = Base::HalfSpace(soil(10e3 * PSI, 0.45));
    let ground = profile(&[(6.0 * INCH, upper), (10.0 * INCH, lower)], base);
    let layered = LayeredHalfSpace::new(&ground).expect("layers");
    let elements = LayeredFem::new(&ground, FEM_ACCURACY).expect("elements");
    let radius = 5.99 * INCH;
    let wheel = load(force(100.0 * PSI, radius), radius);
    let mut seen = 0;
    for row in rows("published_kenpave_settlement.csv") {
        let depth = number(&row, "z_in") * INCH;
        let printed = number(&row, "uz_in") * INCH;
        let found = layered.displacement(wheel, 0.0, depth).expect("value").vertical;
        // Five decimals of an inch, rounded; the last one may stray by one.
        assert_within(found, printed, 1.5e-5 * INCH, &row);
        if depth >= 0.5 {
            let found = elements.displacement(wheel, 0.0, depth).expect("value").vertical;
            assert_within(found, printed, FEM_ACCURACY * printed + 1.5e-5 * INCH, &row);
        }
        seen += 1;
    }
    assert_eq!(seen, 29);
}
