//! Difficult grounds against figures computed in multiple precision by plain transfer matrices
//! (`tests/data/reference_figures.py`): contrasts up to 1e4 between neighbours and 1e8 in all, sheets of 2 mm, layers of 10 m,
//! ν = 0.5, rock, depths within and at interfaces, radii 0 to 50 m.

use super::common::{error, ground, table};
use burmister::{DEFAULT_ACCURACY, LayeredHalfSpace};
use ground_field::{GroundError, SurfaceLoad};

const FORCE: f64 = 100_000.0;

/// Thicknesses \[mm\], moduli \[`MPa`\], Poisson's ratios and contact radius \[mm\], as in the script.
type System<'a> = (&'a str, &'a [f64], &'a [f64], &'a [f64], f64);

const SYSTEMS: [System; 16] = [
    (
        "soft_band",
        &[300.0, 100.0, 500.0],
        &[1000.0, 0.1, 1000.0, 100.0],
        &[0.3, 0.4, 0.25, 0.35],
        150.0,
    ),
    (
        "stiff_sheet_2mm",
        &[200.0, 2.0, 500.0],
        &[100.0, 1e6, 100.0, 50.0],
        &[0.35, 0.3, 0.35, 0.4],
        150.0,
    ),
    (
        "soft_sheet_2mm",
        &[200.0, 2.0, 500.0],
        &[1000.0, 0.1, 1000.0, 500.0],
        &[0.35, 0.5, 0.35, 0.5],
        0.0,
    ),
    (
        "incompressible",
        &[50.0, 300.0, 1000.0],
        &[3000.0, 30.0, 300.0, 60.0],
        &[0.5, 0.5, 0.5, 0.5],
        150.0,
    ),
    (
        "ten_layers",
        &[40.0, 60.0, 120.0, 30.0, 200.0, 300.0, 10.0, 500.0, 700.0, 1000.0],
        &[
            8000.0, 3000.0, 300.0, 9000.0, 80.0, 400.0, 5.0, 250.0, 1000.0, 40.0, 120.0,
        ],
        &[0.35, 0.3, 0.4, 0.2, 0.45, 0.35, 0.5, 0.3, 0.25, 0.49, 0.4],
        120.0,
    ),
    (
        "twenty_layers",
        &[
            20.0, 35.0, 50.0, 2.0, 75.0, 100.0, 150.0, 5.0, 200.0, 250.0, 60.0, 90.0, 300.0, 400.0, 12.0,
            500.0, 650.0, 800.0, 1000.0, 3000.0,
        ],
        &[
            5000.0, 2000.0, 800.0, 20000.0, 300.0, 500.0, 120.0, 2.0, 60.0, 200.0, 4000.0, 50.0, 90.0, 30.0,
            10000.0, 150.0, 70.0, 200.0, 25.0, 400.0, 1000.0,
        ],
        &[
            0.35, 0.35, 0.3, 0.2, 0.35, 0.4, 0.45, 0.5, 0.3, 0.35, 0.25, 0.4, 0.49, 0.35, 0.15, 0.3, 0.35,
            0.4, 0.45, 0.3, 0.25,
        ],
        150.0,
    ),
    ("shallow_rock", &[300.0], &[50.0], &[0.5], 150.0),
    (
        "deep_rock",
        &[10000.0, 10000.0],
        &[100.0, 1000.0],
        &[0.5, 0.3],
        0.0,
    ),
    (
        "soft_on_rock",
        &[50.0, 400.0, 3000.0],
        &[4000.0, 0.4, 4000.0],
        &[0.3, 0.45, 0.2],
        150.0,
    ),
    (
        "thick_contrast",
        &[10000.0, 10000.0],
        &[10000.0, 1.0, 10000.0],
        &[0.2, 0.45, 0.3],
        150.0,
    ),
    (
        "contrast_1e8",
        &[200.0, 300.0],
        &[1e5, 10.0, 1e-3],
        &[0.2, 0.35, 0.45],
        150.0,
    ),
    (
        "sandwich_1e8",
        &[200.0, 300.0, 500.0],
        &[1000.0, 0.1, 1000.0, 0.1],
        &[0.2, 0.35, 0.3, 0.45],
        0.0,
    ),
    ("soft_skin_2mm", &[2.0], &[1.0, 1e4], &[0.5, 0.3], 20.0),
    ("stiff_skin_2mm", &[2.0], &[1e4, 1.0], &[0.3, 0.5], 20.0),
    (
        "surface_stiff",
        &[100.0, 300.0],
        &[5000.0, 100.0, 40.0],
        &[0.3, 0.4, 0.35],
        0.0,
    ),
    (
        "surface_soft",
        &[50.0, 300.0],
        &[5.0, 5000.0, 40.0],
        &[0.45, 0.2, 0.5],
        0.0,
    ),
];

fn system(name: &str) -> (LayeredHalfSpace, SurfaceLoad) {
    let (_, thickness, modulus, ratio, contact) = SYSTEMS
        .into_iter()
        .find(|system| system.0 == name)
        .unwrap_or_else(|| panic!("unknown system {name}"));
    let load = SurfaceLoad::new(FORCE, contact * 1e-3).expect("load");
    (ground(thickness, modulus, ratio), load)
}

/// Checks every depth of every system. `refused` are those that may answer with an error instead.
fn check(accuracy: f64, refused: &[(&str, f64)]) {
    let mut misses = Vec::new();
    for row in table("computed_difficult.csv", ("", 0.0)) {
        let (ground, load) = system(&row.case);
        let ground = ground.with_accuracy(accuracy).expect("accuracy");
        let radii: Vec<f64> = row.points.iter().map(|point| point.0).collect();
        match ground.displacements_with_statistics(load, &radii, row.depth) {
            Ok((values, statistics)) => {
                let (radial, vertical) = error(&row.points, &values);
                if std::env::var_os("BURMISTER_SHOW").is_some() {
                    println!(
                        "{} z {}: {radial:.1e} {vertical:.1e} {statistics:?}",
                        row.case, row.depth
                    );
                }
                if !(radial <= accuracy && vertical <= accuracy) {
                    misses.push(format!(
                        "{} z = {}: {radial:.1e} {vertical:.1e}",
                        row.case, row.depth
                    ));
                }
            }
            Err(GroundError::Accuracy { asked, reached, .. })
                if asked == accuracy
                    && reached > asked
                    && refused.contains(&(row.case.as_str(), row.depth)) => {}
            Err(other) => misses.push(format!("{} z = {}: {other}", row.case, row.depth)),
        }
    }
    assert!(misses.is_empty(), "{misses:#?}");
}

#[test]
fn meet_the_default_accuracy() {
    check(DEFAULT_ACCURACY, &[]);
}

/// Two depths are refused, because rounding cannot be shown to stay below 1e-10 of the smaller peak: a tenth of a millimetre
/// above rock, where incompressible soil moves a thousand times less down than aside, and the middle of a sheet ten thousand times
/// as stiff as the soil around it.
#[test]
fn meet_a_finer_accuracy_or_say_so() {
    check(
        1e-10,
        &[("shallow_rock", 299.9 * 1e-3), ("stiff_sheet_2mm", 201.0 * 1e-3)],
    );
}
