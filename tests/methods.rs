//! The scene's `solver.method`: which one a scene gets, and that they agree.

use boussinesq::HalfSpace;
use creepage::{Error, RunOptions, Scene};
use ground_field::{Displacement, GroundError, GroundField, Soil, SurfaceLoad};

use crate::answers::common::{assert_within, is_told, staged};
use crate::scenes::{self, assert_near, force_after, largest, upper as scene};

fn run(overrides: &[&str]) -> creepage::Run {
    scenes::run(&scene(overrides))
}

/// Where leaving inertia out costs more than the tolerance, plan and run say so and what to do; beyond what is an answer, the run refuses.
#[test]
fn inertia_beyond_the_tolerance_is_said_with_a_remedy() {
    let fast = |speed: &str| {
        let speed = format!("vehicles.0.speed={speed}");
        scene(&["traffic.passes=3", &speed, "solver.tolerance=1 %"])
    };
    let remedy = "solver.method = \"explicit\" computes it";
    let said = |warnings: &[String]| warnings.iter().any(|warning| warning.contains(remedy));
    let planned = |scene: &Scene| creepage::plan(scene).expect("a plan").report().warnings;
    assert!(!said(&planned(&fast("40 km/h"))));
    let scene = fast("400 km/h");
    assert!(said(&planned(&scene)));
    let run = scenes::run(&scene);
    assert!(said(&run.warnings), "{:?}", run.warnings);
    let parts = run.error_estimate.parts;
    assert!(parts.inertia > 0.01 && parts.mesh < parts.inertia, "{parts:?}");
    let error = creepage::run(&fast("1500 km/h")).expect_err("no answer");
    assert!(error.to_string().contains(remedy), "{error}");
}

#[test]
fn friction_is_shown_by_every_method() {
    for method in ["quasi-static", "explicit", "pass-law"] {
        let method = format!("solver.method={method}");
        let slip = run(&["traffic.passes=5", "solver.tolerance=5 %", &method]).slip_lengths;
        let length = slip.map(|slip| slip.forward + slip.backward);
        assert!(length.is_some_and(|length| length > 1.0), "{method}: {length:?}");
    }
}

/// Jumps need a state of rest, and nothing else.
#[test]
fn jumps_take_any_duct_but_no_law_without_memory() {
    let jumps = "solver.method=pass-law";
    let short = run(&[jumps, "duct.length=5 m", "traffic.passes=1000000"]);
    assert!(short.cost.simulated_passes < 100, "{:?}", short.cost);
    let forgetful = scene(&[jumps, "friction.law=sigmoid"]);
    assert_eq!(unfit(&forgetful), "solver.method");
}

/// The key of the scene that is unfit.
fn unfit(scene: &Scene) -> &'static str {
    match creepage::run(scene) {
        Err(Error::Unfit { key, .. }) => key,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_sigmoid_warns_of_its_leak_and_stops_where_all_leaks_away() {
    let viscous = ["friction.law=sigmoid", "traffic.passes=1"];
    let steep = ["friction.shape_factor=1e9", "duct.length=20 m"];
    assert!(is_told(&run(&[viscous, steep].concat()), "sigmoid"));
    // The force has leaked away before the vehicle has left.
    assert_eq!(unfit(&scene(&viscous)), "friction.law");
}

#[test]
fn a_time_step_beyond_the_limit_is_refused() {
    let long = ["solver.method=explicit", "solver.time_step=10 ms"];
    let error = creepage::run(&scene(&long)).expect_err("unstable");
    assert!(error.to_string().contains("limit"), "{error}");
}

/// A half-space twice as soft as the one it holds.
struct Softer(HalfSpace);

impl GroundField for Softer {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        Ok(self.0.displacement(load, radius, depth)? * 2.0)
    }
}

#[test]
fn a_ground_model_of_ones_own_takes_the_scenes_place() {
    let own = Softer(HalfSpace::new(Soil::new(800e6, 0.4).expect("a soil")));
    let options = RunOptions {
        ground: Some(&own),
        ..RunOptions::default()
    };
    let own = creepage::run_with(&scene(&["traffic.passes=3"]), &options).expect("an answer");
    let soft = run(&["traffic.passes=3", "ground.layers.0.young_modulus=400 MPa"]);
    assert_eq!(own.plan.ground, "own");
    assert_near(force_after(&own, 3), force_after(&soft, 3), 1e-4, ());
}

#[test]
fn a_run_is_looked_at_in_stages() {
    let scene = scene(&["traffic.passes=4", "solver.node_spacing=0.2 m"]);
    let run = staged(&scene, &[1, 4, 9]);
    assert!(run.stages.iter().map(|stage| stage.pass).eq([1, 4]));
    // Looking changes nothing.
    let mut unseen = run.clone();
    unseen.stages.clear();
    assert_eq!(unseen, staged(&scene, &[]));
    assert_eq!(run.stages[1].force_profile, run.force_profile);
    let mut first = scene.clone();
    first.traffic.passes = 1;
    let first = creepage::run(&first).expect("an answer");
    assert_eq!(run.stages[0].force_profile, first.force_profile);

    let limit = scene.friction.dynamic_coefficient * scene.normal_load();
    for stage in &run.stages {
        let friction = stage.friction.as_ref().expect("seen");
        assert!((friction.vehicle_position_m - 15.0).abs() <= run.plan.vehicle_step_m);
        assert_eq!(friction.positions_m.len(), friction.friction_n_per_m.len());
        let most = largest(friction.friction_n_per_m.iter().copied());
        assert_near(most, limit, 1e-6, "N/m");
    }
    let last = run.stages[1].friction.as_ref().expect("seen");
    assert_eq!(Some(last.slip_lengths), run.slip_lengths);
}

#[test]
fn stages_between_jumps_end_with_the_answer() {
    let scene = scene(&["traffic.passes=300", "solver.method=pass-law"]);
    let run = staged(&scene, &[1, 300]);
    assert_eq!(run.stages.len(), 2);
    let (last, profile) = (&run.stages[1].force_profile, &run.force_profile);
    assert_eq!(last.positions_m, profile.positions_m);
    let largest = largest(profile.force_n.iter().copied());
    for (a, b) in last.force_n.iter().zip(&profile.force_n) {
        assert_within(*a, *b, 1e-3 * largest, "N");
    }
    assert!(run.stages[0].force_profile.force_n[0].abs() < largest);
}

/// Where both ends are free, a clamp holds what the cable pulls: errors are shares of that, and not of the little that is compressed.
#[test]
fn a_clamp_between_free_ends_is_judged_by_what_it_holds() {
    let held = [
        "ends.upstream=free",
        "ends.downstream=free",
        "restraints=[{position=5,stiffness=1e6}]",
        "traffic.passes=4",
    ];
    let planned = run(&held);
    let stated = planned.error_estimate.relative;
    assert!(stated <= 0.01, "{stated}");
    let clamp = planned.restraints[0].force_n.abs();
    assert!(clamp > 10.0, "{clamp}");
    let mesh = ["solver.node_spacing=0.4 m", "solver.vehicle_step=0.2 m"];
    let coarse = run(&[&held[..], &mesh].concat());
    let stated = coarse.error_estimate.relative;
    assert!(stated.is_finite());
    assert_near(coarse.restraints[0].force_n.abs(), clamp, stated, "N");
}
