//! One spring or clamp.

use creepage::design::{Design, DesignOptions, Limits, Place, design};
use creepage::{Limited, Run};

use super::grid::{BOTH, Given, check_none, check_range, designed, held, reached, scene, sprung};
use crate::scenes::{forces, largest, last, run, upper};

const END: [Place; 1] = [Place::Downstream];

/// A limit of force at both ends.
fn force(limit: f64) -> [Given; 2] {
    BOTH.map(|place| (place, Limited::Force, limit))
}

#[test]
fn a_softer_spring_trades_force_for_movement() {
    let design = designed(&scene(&[]), &END, &force(150.0));
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
fn the_answer_keeps_the_limits_and_a_spring_beside_its_range_does_not() {
    let scene = scene(&[]);
    for limit in [80.0, 140.0] {
        let design = check_range(&scene, &END, &force(limit));
        assert!(design.range_n_per_m.is_some_and(|(from, _)| from == 0.0));
    }
    // Movement with a spring that just keeps 140 N, a little loosened and tightened.
    let tight = designed(&scene, &END, &force(140.0)).answer.unwrap().movement_m;
    let limits = |share: f64| {
        [
            &force(140.0)[..],
            &BOTH.map(|place| (place, Limited::Movement, share * tight)),
        ]
        .concat()
    };
    check_range(&scene, &END, &limits(1.1));
    let none = check_none(&scene, &END, &limits(0.8));
    assert_eq!(none.range_n_per_m, None);
    assert!(none.curve.iter().all(|point| !point.within_limits));
}

/// Ten million passes drive a cable that nothing holds out of its duct: a limit of force alone is no leave to do so.
#[test]
fn no_answer_lets_the_cable_leave_the_duct() {
    let design = designed(&scene(&["traffic.passes=10000000"]), &END, &force(10.0));
    assert!(design.curve[0].leaves_duct, "{:?}", design.curve[0]);
    assert!(design.answer.is_none(), "{:?}", design.answer);
    let nearest = design.nearest.expect("a spring");
    assert!(!nearest.leaves_duct && !nearest.within_limits, "{nearest:?}");
    assert!(nearest.stiffness_n_per_m.is_none_or(|stiffness| stiffness > 0.0));
}

#[test]
fn a_clamp_is_as_soft_as_the_limit_allows() {
    let (scene, clamp) = (scene(&[]), [Place::Clamp(14.0)]);
    let fixed = reached(&held(&scene, &[]), Place::Downstream, Limited::Force);
    let design = check_range(&scene, &clamp, &force(0.5 * fixed));
    let answer = design.answer.unwrap();
    assert!(answer.clamp_force_n.is_some_and(|force| force > 0.0));
    let range = answer.stiffness_n_per_m.map(|from| (from, None));
    assert_eq!(design.range_n_per_m, range);
    // None is needed where the ends keep the limit without one.
    let none = designed(&scene, &clamp, &force(2.0 * fixed));
    assert_eq!(none.answer.unwrap().stiffness_n_per_m, Some(0.0));
}

#[test]
fn answers_are_read_as_they_were_written() {
    let limits = Limits::both(Some(150.0), None);
    let design = design(&scene(&[]), &DesignOptions::new(Place::Clamp(7.5), limits)).unwrap();
    let text = serde_json::to_string(&design).unwrap();
    assert_eq!(serde_json::from_str::<Design>(&text).unwrap(), design);
    let mut run = run(&scene(&[]));
    // It has a file of its own.
    (run.state, run.shown) = (None, None);
    let text = serde_json::to_string(&run).unwrap();
    assert_eq!(serde_json::from_str::<Run>(&text).unwrap(), run);
}

#[test]
fn a_spring_moves_with_the_force_on_it_during_a_pass() {
    let stiffness = 1e6;
    let run = sprung(&scene(&["traffic.passes=2"]), &END, stiffness);
    // It carries what it was compressed by.
    let carried = last(&run).downstream_force_n / (stiffness * last(&run).downstream_displacement_m);
    assert!((carried - 1.0).abs() < 1e-6);
    let peak = largest(run.passes.iter().map(|pass| pass.downstream_peak_n));
    let after = largest(forces(&run));
    assert!(peak > 1.005 * after, "{peak} {after}");
    let limit = 0.5 * (peak + after) / stiffness;
    let spring = Limits::both(None, Some(limit)).verdicts(&run)[1];
    assert_eq!(spring.end, Place::Downstream);
    assert!((spring.largest / (peak / stiffness) - 1.0).abs() < 1e-9);
    assert!(spring.during_a_pass && spring.reached_after.is_some());
}

#[test]
fn a_limit_that_more_passes_exceed_is_told() {
    let run = run(&upper(&["traffic.passes=52", "solver.method=pass-law"]));
    let level = run.saturation.as_ref().unwrap().downstream_force_n;
    let told = |limit: f64| Limits::both(Some(limit), None).verdicts(&run)[1];
    let above = told(level - 1.0);
    assert!(above.reached_after.is_none() && above.levels_off_above == Some(level));
    assert!(above.to_string().contains("with more passes it levels off at"));
    assert_eq!(told(level + 1.0).levels_off_above, None);
    assert_eq!(told(400.0).levels_off_above, None, "these passes exceed it");
}
