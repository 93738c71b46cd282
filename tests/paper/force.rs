//! Section 4: the force on the load cell.

use crate::figure_12::{CABLES, SPEEDS, forces, with_inertia};
use crate::load_and_deflection::{LOADS, outcome};

/// Figure 12: about 550 N for the upper, 900 N for the lower cable.
#[test]
fn saturation() {
    let last = |file: &str| {
        let forces = forces(file, &[]).expect("forces");
        assert_eq!(forces.len(), 200);
        // It has levelled off: less than 1 % more in the last fifty passes.
        assert!(
            forces[199] / forces[149] < 1.01,
            "{} {}",
            forces[149],
            forces[199]
        );
        forces[199]
    };
    // 542 N and 711 N: an independent full-chain program on the same scenes, converged to 0.1 N.
    let (upper, lower) = (last(CABLES[0].1), last(CABLES[1].1));
    assert!((upper / 542.3 - 1.0).abs() < 2e-3, "{upper} N");
    assert!((lower / 711.0 - 1.0).abs() < 2e-3, "{lower} N");
    // The paper's 550 N is "about": within 2 %. The 900 N are not reached; docs/validation.md says why.
    assert!((upper / CABLES[0].2 - 1.0).abs() < 0.02);
    assert!(lower < 0.85 * CABLES[1].2);
}

/// The measured deflection goes up to 140 µm; the paper's 900 N ask for more ground motion than 800 MPa allow.
#[test]
fn a_softer_ground_lifts_the_lower_cable_and_hardly_the_upper() {
    let at = |cable: usize, deflection| {
        outcome(CABLES[cable].1, None, Some(deflection))
            .expect("outcome")
            .force
    };
    let (soft, softer) = (at(1, 100.0), at(1, 140.0));
    assert!(softer > 1.15 * soft && softer < 900.0, "{soft} {softer}");
    let (soft, softer) = (at(0, 100.0), at(0, 140.0));
    assert!((1.03..1.10).contains(&(softer / soft)), "{soft} {softer}");
}

/// Axles spread the load: on the same ground nearly nothing is left of the lower cable's force.
#[test]
fn the_load_as_axles() {
    let lower = |load, deflection| outcome(CABLES[1].1, load, deflection).expect("outcome");
    let (point, axles) = (lower(LOADS[0].1, None), lower(LOADS[1].1, None));
    assert!(axles.force < 0.1 * point.force, "{axles:?} {point:?}");
    // As many newtons drive on both: it is their distance that lowers the deflection.
    assert!(axles.deflection < 0.65 * point.deflection, "{axles:?} {point:?}");
    let scaled = lower(LOADS[1].1, Some(140.0));
    assert!(
        scaled.force > 4.0 * axles.force && scaled.force < 0.5 * 900.0,
        "{scaled:?}"
    );
}

/// The force does not depend on the speed, with inertia in the solver. Six passes; the example
/// runs all 200.
#[test]
fn the_speed_does_not_matter() {
    for (name, file, _) in CABLES {
        let at = |speed| {
            let mut overrides = with_inertia(speed).to_vec();
            overrides.push("traffic.passes=6".into());
            forces(file, &overrides).expect("forces")
        };
        let [slow, middle, fast] = SPEEDS.map(at);
        let quasi_static = forces(file, &["traffic.passes=6".into()]).expect("forces");
        for pass in 0..6 {
            for force in [slow[pass], middle[pass], fast[pass]] {
                // (v/c)² is 2e-4 at 40 km/h; the two solvers step differently.
                assert!(
                    (force / quasi_static[pass] - 1.0).abs() < 2e-3,
                    "{name}, pass {}: {force}",
                    pass + 1
                );
            }
        }
    }
}
