//! Section 4: the force on the load cell.

use std::sync::OnceLock;

use super::figure_12::{CABLES, SPEEDS, forces, with_inertia};
use super::load_and_deflection::{GROUNDS, LOADS, Outcome, WITHIN, on, outcome_within};
use crate::scenes::assert_near;

/// Forces of both cables' scenes as the plan has it, computed once for all tests.
fn planned(cable: usize) -> &'static [f64] {
    static FORCES: [OnceLock<Vec<f64>>; 2] = [const { OnceLock::new() }; 2];
    FORCES[cable].get_or_init(|| forces(CABLES[cable].1, &[]).expect("forces"))
}

/// On Table 1's layers over rock, scaled to each deflection of [`WITHIN`], computed once for all tests.
fn on_rock(cable: usize) -> &'static [Outcome; 3] {
    static OUTCOMES: [OnceLock<[Outcome; 3]>; 2] = [const { OnceLock::new() }; 2];
    let on_rock = |deflection| on(CABLES[cable].1, None, GROUNDS[1].1, Some(deflection)).expect("outcome");
    OUTCOMES[cable].get_or_init(|| WITHIN.map(on_rock))
}

/// To 5 %, where what is asserted has more room: the forces are within 0.5 % of those to 1 %, at a tenth of the work.
fn roughly(cable: usize, load: Option<&str>, deflection: Option<f64>) -> Outcome {
    outcome_within("5 %", CABLES[cable].1, load, deflection).expect("outcome")
}

/// An independent full-chain program on the same scenes with the ground at rest between passes, nodes 0.1 m apart and steps of
/// 0.05 m: forces after passes 1, 5, 10, 60 and 200 \[N\].
const INDEPENDENT: [[f64; 5]; 2] = [
    [102.08, 210.46, 283.68, 519.70, 527.84],
    [110.43, 214.68, 287.11, 600.16, 692.22],
];
const AFTER: [usize; 5] = [1, 5, 10, 60, 200];

/// On one given mesh `quasi_static::reference` of the cable's crate holds both, and three axles near shakedown, to that program.
#[test]
fn both_cables_agree_with_an_independent_program() {
    for (cable, wanted) in INDEPENDENT.into_iter().enumerate() {
        for (pass, wanted) in AFTER.into_iter().zip(wanted) {
            assert_near(planned(cable)[pass - 1], wanted, 5e-3, (cable, pass));
        }
    }
}

/// Table 1 on rock at 8 m (preset `kashiro`), scaled to 90, 115 and 140 µm, after 200 passes: the same independent program
/// with nodes 0.2 m apart, a mesh on which it is about 1 % low.
#[test]
fn the_ground_of_table_1_on_rock_agrees_with_an_independent_program() {
    let mesh = [
        "solver.node_spacing=0.2 m",
        "solver.vehicle_step=0.1 m",
        "solver.tolerance=20 %",
    ];
    for (cable, wanted) in [[539.0, 575.0, 594.0], [704.0, 805.0, 861.0]]
        .into_iter()
        .enumerate()
    {
        let (name, file, _) = CABLES[cable];
        for ((deflection, wanted), planned) in WITHIN.into_iter().zip(wanted).zip(on_rock(cable)) {
            let peak = format!("ground.vertical_peak={deflection} um");
            let ground = [GROUNDS[1].1.expect("a preset"), &peak, "ground.model=burmister"];
            let overrides = [ground, mesh].concat().into_iter().map(str::to_owned);
            let coarse = forces(file, &overrides.collect::<Vec<_>>()).expect("forces");
            assert_near(coarse[199], wanted, 0.01, (name, deflection));
            assert_near(planned.force, wanted, 0.015, (name, deflection));
        }
    }
}

/// Figure 12: about 550 N for the upper, 900 N for the lower cable.
#[test]
fn saturation() {
    let last = |cable| {
        let forces = planned(cable);
        assert_eq!(forces.len(), 200);
        // It has levelled off: less than 1 % more in the last fifty passes.
        assert!(forces[199] / forces[149] < 1.01, "{:?}", &forces[149..]);
        forces[199]
    };
    // On a half-space the upper cable stays below the paper's "about 550 N"; on a ground that goes down by the paper's 90 µm and along by
    // its 16 µm it is within 2 %. The 900 N are not reached; docs/validation.md says why.
    let (upper, lower) = (last(0), last(1));
    assert!(upper < CABLES[0].2 && lower < 0.85 * CABLES[1].2);
    let as_in_the_paper = on_rock(0)[0];
    assert_eq!(WITHIN[0], 90.0);
    assert_near(as_in_the_paper.longitudinal, 16.0, 0.01, "µm");
    assert_near(as_in_the_paper.force, CABLES[0].2, 0.02, "N");
}

/// On Table 1's layers over rock, scaled to what was measured, the upper cable's 550 N lie within the forces, and the lower
/// cable's 900 N 3 to 22 % above them.
#[test]
fn what_is_left_of_the_lower_cables_gap() {
    let forces = |cable: usize| on_rock(cable).map(|outcome| outcome.force);
    let ([least, _, most], [low, _, high]) = (forces(0), forces(1));
    assert!(least < 550.0 && 550.0 < most, "{least} to {most} N");
    assert!((0.77..0.80).contains(&(low / 900.0)), "{low} N");
    assert!((0.95..0.98).contains(&(high / 900.0)), "{high} N");
}

/// The measured deflection goes up to 140 µm; the paper's 900 N ask for more ground motion than 800 MPa allow.
#[test]
fn a_softer_ground_lifts_the_lower_cable_and_hardly_the_upper() {
    let at = |cable: usize, deflection| roughly(cable, None, Some(deflection)).force;
    let (soft, softer) = (at(1, 100.0), at(1, 140.0));
    assert!(softer > 1.15 * soft && softer < 900.0, "{soft} {softer}");
    let (soft, softer) = (at(0, 100.0), at(0, 140.0));
    assert!((1.03..1.10).contains(&(softer / soft)), "{soft} {softer}");
}

/// Axles spread the load: on the same ground nearly nothing is left of the lower cable's force.
#[test]
fn the_load_as_axles() {
    let lower = |load, deflection| roughly(1, load, deflection);
    let (point, axles) = (lower(LOADS[0].1, None), lower(LOADS[1].1, None));
    assert!(axles.force < 0.1 * point.force, "{axles:?} {point:?}");
    // As many newtons drive on both: it is their distance that lowers the deflection.
    assert!(axles.deflection < 0.65 * point.deflection, "{axles:?} {point:?}");
    let scaled = lower(LOADS[1].1, Some(140.0)).force;
    assert!(scaled > 4.0 * axles.force && scaled < 0.5 * 900.0, "{scaled}");
}

/// The force does not depend on the speed, with inertia in the solver. One pass; the example
/// runs all 200.
#[test]
fn the_speed_does_not_matter() {
    // One mesh for both solvers: what differs is inertia.
    let mesh = ["traffic.passes=1", "solver.node_spacing=0.1 m"].map(str::to_owned);
    for (name, file, _) in CABLES {
        let at = |speed| {
            let mut overrides = with_inertia(speed).to_vec();
            overrides.extend(mesh.clone());
            forces(file, &overrides).expect("forces")
        };
        let [slow, middle, fast] = SPEEDS.map(at);
        let quasi_static = forces(file, &mesh).expect("forces");
        for force in [slow[0], middle[0], fast[0]] {
            // (v/c)² is 2e-4 at 40 km/h; explicit steps leave the swing of nodes as they are passed, half a percent.
            assert_near(force, quasi_static[0], 5e-3, name);
        }
    }
}
