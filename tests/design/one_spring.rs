//! One spring or clamp.

use creepage::design::{Design, DesignOptions, Limits, Place, design};
use creepage::scene::End;
use creepage::{Limited, Run, Scene};

use super::grid::{self, largest_of_ends};

fn scene() -> Scene {
    grid::scene(&["traffic.passes=12", "solver.node_spacing=0.25 m"])
}

fn designed(scene: &Scene, place: Place, force_n: f64, movement_m: Option<f64>) -> Design {
    let limits = Limits::both(Some(force_n), movement_m);
    design(scene, &DesignOptions::new(place, limits)).unwrap()
}

fn largest_force(run: &Run) -> f64 {
    largest_of_ends(run, Limited::Force)
}

fn largest_movement(run: &Run) -> f64 {
    largest_of_ends(run, Limited::Movement)
}

fn held(scene: &Scene, stiffness: f64) -> Run {
    grid::held(scene, &[(Place::Downstream, stiffness)])
}

#[test]
fn a_softer_spring_trades_force_for_movement() {
    let design = designed(&scene(), Place::Downstream, 150.0, None);
    let curve = &design.curve;
    assert!(curve.len() >= 11);
    assert_eq!((curve[0].stiffness_n_per_m, curve[0].force_n), (Some(0.0), 0.0));
    assert_eq!(curve[curve.len() - 1].stiffness_n_per_m, None);
    for pair in curve.windows(2) {
        let allowed = 1.0 + 2.0 * (pair[0].error_estimate + pair[1].error_estimate);
        assert!(pair[0].force_n <= allowed * pair[1].force_n, "{pair:?}");
        assert!(pair[1].movement_m <= allowed * pair[0].movement_m, "{pair:?}");
    }
}

#[test]
fn the_answer_keeps_the_limit_and_a_stiffer_spring_does_not() {
    let scene = scene();
    for limit in [100.0, 200.0] {
        let design = designed(&scene, Place::Downstream, limit, None);
        let answer = design.answer.unwrap();
        let stiffness = answer.stiffness_n_per_m.unwrap();
        let run = held(&scene, stiffness);
        assert_eq!(largest_force(&run), answer.force_n);
        assert_eq!(largest_movement(&run), answer.movement_m);
        assert!(answer.force_n <= limit && answer.within_limits);
        assert!(largest_force(&held(&scene, 1.02 * stiffness)) > limit);
        assert_eq!(design.range_n_per_m, Some((0.0, Some(stiffness))));
        // A spring carries what it was compressed by.
        let last = run.passes.last().unwrap();
        assert!((last.downstream_force_n / (stiffness * last.downstream_displacement_m) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn both_limits_leave_a_range_or_none() {
    let scene = scene();
    let free = designed(&scene, Place::Downstream, 1.0, None);
    // Movement with a spring that just keeps 200 N, a little loosened.
    let tight = designed(&scene, Place::Downstream, 200.0, None).answer.unwrap();
    let limit = 1.1 * tight.movement_m;
    let design = designed(&scene, Place::Downstream, 200.0, Some(limit));
    let (from, to) = design.range_n_per_m.unwrap();
    let to = to.unwrap();
    let answer = design.answer.unwrap();
    let stiffness = answer.stiffness_n_per_m.unwrap();
    assert!(from < stiffness && stiffness < to);
    assert!(answer.force_n <= 200.0 && answer.movement_m <= limit);
    assert!(largest_movement(&held(&scene, 0.98 * from)) > limit);
    assert!(largest_force(&held(&scene, 1.02 * to)) > 200.0);

    let none = designed(&scene, Place::Downstream, 200.0, Some(0.8 * tight.movement_m));
    assert_eq!((none.range_n_per_m, none.answer), (None, None));
    assert!(none.curve.iter().all(|point| !point.within_limits));
    assert!(free.curve[0].within_limits);
}

/// Ten million passes drive a cable that nothing holds out of its duct: a limit of force alone is no leave to do so.
#[test]
fn no_answer_lets_the_cable_leave_the_duct() {
    let mut scene = scene();
    scene.traffic.passes = 10_000_000;
    let design = designed(&scene, Place::Downstream, 10.0, None);
    assert!(design.curve[0].leaves_duct, "{:?}", design.curve[0]);
    assert!(design.answer.is_none(), "{:?}", design.answer);
    let nearest = design.nearest.expect("a spring");
    assert!(!nearest.leaves_duct && !nearest.within_limits, "{nearest:?}");
    assert!(nearest.stiffness_n_per_m.is_none_or(|stiffness| stiffness > 0.0));
}

#[test]
fn a_clamp_is_as_soft_as_the_limit_allows() {
    let scene = scene();
    let fixed = largest_force(&creepage::run(&scene).unwrap());
    let limit = 0.5 * fixed;
    let place = Place::Clamp(14.0);
    let design = designed(&scene, place, limit, None);
    let answer = design.answer.unwrap();
    let stiffness = answer.stiffness_n_per_m.unwrap();
    assert!(answer.force_n <= limit && answer.clamp_force_n.unwrap() > 0.0);
    assert_eq!(design.range_n_per_m, Some((stiffness, None)));
    let clamped = |stiffness: f64| {
        let mut scene = scene.clone();
        scene
            .restraints
            .push(creepage::scene::Restraint::new(14.0, stiffness));
        largest_force(&creepage::run(&scene).unwrap())
    };
    assert_eq!(clamped(stiffness), answer.force_n);
    assert!(clamped(0.98 * stiffness) > limit);
    // None is needed where the ends keep the limit without one.
    let none = designed(&scene, place, 2.0 * fixed, None);
    assert_eq!(none.answer.unwrap().stiffness_n_per_m, Some(0.0));
}

#[test]
fn answers_are_read_as_they_were_written() {
    let limits = Limits::both(Some(150.0), None);
    let design = design(&scene(), &DesignOptions::new(Place::Clamp(7.5), limits)).unwrap();
    let text = serde_json::to_string(&design).unwrap();
    assert_eq!(serde_json::from_str::<Design>(&text).unwrap(), design);
    let mut run = creepage::run(&scene()).unwrap();
    // It has a file of its own.
    (run.state, run.shown) = (None, None);
    let text = serde_json::to_string(&run).unwrap();
    assert_eq!(serde_json::from_str::<Run>(&text).unwrap(), run);
}

#[test]
fn a_spring_moves_with_the_force_on_it_during_a_pass() {
    let stiffness = 1e6;
    let mut held = scene();
    held.ends.downstream = End::Spring(stiffness);
    held.traffic.passes = 2;
    let run = creepage::run(&held).unwrap();
    let peak = run
        .passes
        .iter()
        .map(|pass| pass.downstream_peak_n)
        .fold(0.0, f64::max);
    let after = run
        .passes
        .iter()
        .map(|pass| pass.downstream_force_n)
        .fold(0.0, f64::max);
    assert!(peak > 1.005 * after, "{peak} {after}");
    let limit = 0.5 * (peak + after) / stiffness;
    let verdicts = Limits::both(None, Some(limit)).verdicts(&run);
    let spring = verdicts
        .iter()
        .find(|verdict| verdict.end == Place::Downstream)
        .unwrap();
    assert!(
        (spring.largest / (peak / stiffness) - 1.0).abs() < 1e-9,
        "{spring:?}"
    );
    assert!(
        spring.during_a_pass && spring.reached_after.is_some(),
        "{spring:?}"
    );
}

#[test]
fn a_limit_that_more_passes_exceed_is_told() {
    let overrides = ["traffic.passes=52", "solver.method=pass-law"];
    let scene = creepage::SceneFile::read("examples/scenes/full-scale-upper.toml")
        .and_then(|file| file.with(&overrides)?.scene())
        .unwrap();
    let run = creepage::run(&scene).unwrap();
    let level = run.saturation.as_ref().unwrap().downstream_force_n;
    let told = |limit: f64| {
        let verdicts = Limits::both(Some(limit), None).verdicts(&run);
        let end = verdicts
            .into_iter()
            .find(|verdict| verdict.end == Place::Downstream)
            .unwrap();
        (end.reached_after.is_some(), end.levels_off_above, end.to_string())
    };
    let (exceeded, above, words) = told(level - 1.0);
    assert!(!exceeded && above == Some(level), "{words}");
    assert!(words.contains("with more passes it levels off at"), "{words}");
    assert_eq!(told(level + 1.0).1, None);
    assert_eq!(told(400.0).1, None, "these passes exceed it");
}
