//! Section 4: the force on the load cell.

use std::sync::OnceLock;

use boussinesq::HalfSpace;
use burmister::LayeredHalfSpace;
use cable_dem::{CableState, DuctedCable, Friction, Mesh, Passage, QuasiStatic};
use creepage::Scene;
use ground_field::{DuctLine, DuctMotion, GroundField};

use super::figure_12::{CABLES, SPEEDS, common::scene, forces, with_inertia};
use super::load_and_deflection::{GROUNDS, LOADS, Outcome, WITHIN, on, outcome_within};

/// Followed so far beyond the duct's ends \[m\]: past the outermost turn of D_l of all vehicles here.
const APPROACH: f64 = 30.0;

/// Forces at the load cell after every pass on one given mesh, from the crates alone: `spacing` and half of it as the vehicle's
/// step \[m\], D_l of `ground` under the scene's first vehicle scaled to the scene's deflection, if it has one \[m\].
fn chain(scene: &Scene, ground: &dyn GroundField, deflection: Option<f64>, spacing: f64) -> Vec<f64> {
    let (length, line) = (
        scene.duct.length,
        DuctLine::new(scene.duct.depth, 0.0).expect("a line"),
    );
    let reach = length + 2.0 * APPROACH;
    let motion = DuctMotion::new(
        ground,
        &scene.vehicles[0].vehicle().expect("a vehicle"),
        line,
        reach,
        1e-7,
    )
    .expect("a motion");
    let factor = deflection.map_or(1.0, |peak| peak / motion.peak_vertical());
    let motion = motion.scaled(factor).expect("a motion");
    let limit = scene.friction.dynamic_coefficient * scene.normal_load();
    let friction = Friction::new(scene.friction.law(), limit).expect("friction");
    let cable = DuctedCable::new(length, scene.cable.axial_stiffness, friction)
        .and_then(|cable| cable.with_ends(scene.ends.upstream, scene.ends.downstream))
        .expect("a cable");
    let mesh = Mesh::new(length, spacing, 0.5 * spacing).expect("a mesh");
    let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a passage");
    let mut solver = QuasiStatic::new(cable, mesh).expect("a solver");
    let mut state = CableState::at_rest(&mesh);
    (0..scene.traffic.passes)
        .map(|_| {
            solver
                .pass(&passage, &mut state)
                .expect("a pass")
                .force
                .downstream
        })
        .collect()
}

fn half_space(scene: &Scene) -> HalfSpace {
    HalfSpace::new(
        scene
            .ground
            .profile()
            .expect("layers")
            .homogeneous()
            .expect("one soil"),
    )
}

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

#[test]
fn both_cables_agree_with_an_independent_program() {
    for (cable, wanted) in INDEPENDENT.into_iter().enumerate() {
        let (name, file, _) = CABLES[cable];
        let scene = scene(file, &[]).expect("a scene");
        let on_that_mesh = chain(&scene, &half_space(&scene), None, 0.1);
        let planned = planned(cable);
        for (pass, wanted) in AFTER.into_iter().zip(wanted) {
            for (found, within) in [(on_that_mesh[pass - 1], 2e-3), (planned[pass - 1], 5e-3)] {
                assert!(
                    (found / wanted - 1.0).abs() < within,
                    "{name}, pass {pass}: {found} N, not {wanted}"
                );
            }
        }
    }
}

/// Near shakedown too, where a duct that jumps between passes gave two to five times as much: three axles, lower cable, 25.1,
/// 18.8 and 19.3 N after 1, 20 and 60 passes by the same independent program.
#[test]
fn three_axles_near_shakedown_agree_with_an_independent_program() {
    let axles = LOADS[1].1.expect("axles").to_owned();
    let scene = scene(CABLES[1].1, &[axles, "traffic.passes=60".into()]).expect("a scene");
    let found = chain(&scene, &half_space(&scene), None, 0.1);
    for (pass, wanted) in [(1, 25.1), (20, 18.8), (60, 19.3)] {
        assert!(
            // Rounded to 0.1 N as well.
            (found[pass - 1] - wanted).abs() < 5e-3 * wanted + 0.05,
            "pass {pass}: {} N, not {wanted}",
            found[pass - 1]
        );
    }
}

/// Table 1 on rock at 8 m (preset `kashiro`), scaled to 90, 115 and 140 µm, after 200 passes: the same independent program
/// with nodes 0.2 m apart, a mesh on which it is about 1 % low.
#[test]
fn the_ground_of_table_1_on_rock_agrees_with_an_independent_program() {
    for ((name, file, _), wanted) in CABLES.iter().zip([[539.0, 575.0, 594.0], [704.0, 805.0, 861.0]]) {
        let preset = GROUNDS[1].1.expect("a preset").to_owned();
        let scene = scene(file, &[preset]).expect("a scene");
        let ground = LayeredHalfSpace::new(&scene.ground.profile().expect("layers")).expect("layers");
        for (deflection, wanted) in WITHIN.into_iter().zip(wanted) {
            let at = |spacing| chain(&scene, &ground, Some(1e-6 * deflection), spacing)[199];
            let (coarse, fine) = (at(0.2), at(0.1));
            assert!(
                (coarse / wanted - 1.0).abs() < 0.01,
                "{name}, {deflection} µm: {coarse} N, not {wanted}"
            );
            assert!(
                (fine / wanted - 1.0).abs() < 0.015,
                "{name}, {deflection} µm, fine: {fine} N, not {wanted}"
            );
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
        assert!(
            forces[199] / forces[149] < 1.01,
            "{} {}",
            forces[149],
            forces[199]
        );
        forces[199]
    };
    // On a half-space the upper cable stays below the paper's "about 550 N"; on a ground that goes down by the paper's 90 µm and along by
    // its 16 µm it is within 2 %. The 900 N are not reached; docs/validation.md says why.
    let (upper, lower) = (last(0), last(1));
    assert!(upper < CABLES[0].2 && lower < 0.85 * CABLES[1].2);
    let as_in_the_paper = on_rock(0)[0];
    assert_eq!(WITHIN[0], 90.0);
    assert!((as_in_the_paper.longitudinal / 16.0 - 1.0).abs() < 0.01);
    assert!(
        (as_in_the_paper.force / CABLES[0].2 - 1.0).abs() < 0.02,
        "{as_in_the_paper:?}"
    );
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
    let scaled = lower(LOADS[1].1, Some(140.0));
    assert!(
        scaled.force > 4.0 * axles.force && scaled.force < 0.5 * 900.0,
        "{scaled:?}"
    );
}

/// The force does not depend on the speed, with inertia in the solver. Two passes; the example
/// runs all 200.
#[test]
fn the_speed_does_not_matter() {
    // One mesh for both solvers: what differs is inertia.
    let mesh = ["traffic.passes=2", "solver.node_spacing=0.1 m"].map(str::to_owned);
    for (name, file, _) in CABLES {
        let at = |speed| {
            let mut overrides = with_inertia(speed).to_vec();
            overrides.extend(mesh.clone());
            forces(file, &overrides).expect("forces")
        };
        let [slow, middle, fast] = SPEEDS.map(at);
        let quasi_static = forces(file, &mesh).expect("forces");
        for pass in 0..2 {
            for force in [slow[pass], middle[pass], fast[pass]] {
                // (v/c)² is 2e-4 at 40 km/h; explicit steps leave the swing of nodes as they are passed, half a percent.
                assert!(
                    (force / quasi_static[pass] - 1.0).abs() < 5e-3,
                    "{name}, pass {}: {force}",
                    pass + 1
                );
            }
        }
    }
}
