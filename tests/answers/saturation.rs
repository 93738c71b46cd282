//! What is called saturation: no less than a force already reached, no more than friction carries, as the table has it.

use creepage::scene::SolverMethod;
use creepage::{PassRecord, Run, Scene};

use super::common::{LOWER_AXLES, UPPER, answer, by, limit, reached, scene, upper};
use crate::scenes::assert_near;

/// The larger in size of the ends' forces.
fn at_the_ends(record: &PassRecord) -> f64 {
    if record.upstream_force_n.abs() > record.downstream_force_n.abs() {
        record.upstream_force_n
    } else {
        record.downstream_force_n
    }
}

/// Where the table reaches 95 % of the saturation, that is the pass told; where the pass told lies in the table, it is reached.
#[track_caller]
fn assert_as_the_table_has_it(scene: &Scene, run: &Run) {
    let Some(saturation) = run.saturation else { return };
    assert!(saturation.force_n.abs() >= reached(scene, &run.passes));
    let share = |record: &PassRecord| at_the_ends(record) / saturation.force_n;
    let first = run.passes.iter().find(|record| share(record) >= 0.95);
    let told = saturation.passes_to_95_percent;
    match first {
        Some(first) => assert_eq!(told, first.pass, "{saturation:?}"),
        None => assert!(told > scene.traffic.passes, "{saturation:?}"),
    }
}

/// Springs of 10 kN/m give way by centimetres before they press: thousands of passes, as the table shows, and not sixty.
#[test]
fn springs_that_give_way_delay_it_by_thousands_of_passes() {
    let scene = upper(&[
        "ends = { upstream = { spring = 1e4 }, downstream = { spring = 1e4 } }",
        "traffic = { passes = 1000000 }",
    ]);
    let run = answer(&scene).expect("an answer");
    assert_as_the_table_has_it(&scene, &run);
    let saturation = run.saturation.expect("it levels off");
    // Each end has to give way by F/k, and no pass takes the cable farther than the duct goes forward in all: twice its peak from
    // one extreme to the other, and little more at farther turns.
    let forward = 2.2 * run.duct_motion.peak_longitudinal_m;
    let fewest = 0.95 * saturation.force_n.abs() / 1e4 / forward;
    let told = saturation.passes_to_95_percent as f64;
    assert!(told >= fewest, "{told}, {fewest} at least");
}

#[test]
fn it_is_no_less_than_what_was_reached_and_no_more_than_friction_carries() {
    for (length, passes, method) in [
        (30.0, 200, SolverMethod::QuasiStatic),
        (30.0, 300, SolverMethod::PassLaw),
        (60.0, 2000, SolverMethod::PassLaw),
        (60.0, 200_000, SolverMethod::Auto),
        (250.0, 1_000_000, SolverMethod::Auto),
    ] {
        let mut scene = by(&upper(&[]), method);
        (scene.duct.length, scene.traffic.passes) = (length, passes);
        scene.solver.tolerance = 0.02;
        let run = answer(&scene).expect("an answer");
        assert_as_the_table_has_it(&scene, &run);
        let saturation = run.saturation.expect("it levels off");
        assert!(saturation.force_n > 0.0, "the truck pushes downstream");
        assert!(saturation.force_n <= limit(&scene) * scene.duct.length);
    }
}

/// Two directions by turns: each pass leaves another force on the end, and the larger one is what a joint has to bear.
#[test]
fn two_way_traffic_shows_the_largest_force_of_an_end() {
    for (upstream, returning) in [("fixed", "12 tf"), ("free", "12 tf"), ("fixed", "5 tf")] {
        let scene = two_way(upstream, returning);
        let run = answer(&scene).expect("an answer");
        assert_as_the_table_has_it(&scene, &run);
        let saturation = run.saturation.expect("it levels off");
        let [one, other] = [238, 239].map(|pass| at_the_ends(&run.passes[pass]).abs());
        let (least, largest) = (one.min(other), one.max(other));
        // The passes of a period differ.
        assert!(least < 0.9 * largest, "{one} {other}");
        assert_near(saturation.force_n.abs(), largest, 0.01, saturation);
    }
    // Of equal trucks the first one leaves more than all that follow: no level that the force rises to.
    let scene = two_way("fixed", "20 tf");
    let run = answer(&scene).expect("an answer");
    let last = run.passes[238..].iter().map(at_the_ends).fold(0.0, f64::max);
    assert!(at_the_ends(&run.passes[0]) > 1.1 * last, "{last} N");
    assert_eq!(run.saturation, None);
}

/// 20 tf forward and another truck back by turns over 15 m.
fn two_way(upstream: &str, returning: &str) -> Scene {
    let vehicles = format!(
        "vehicles = [{{ name = \"a\", speed = \"40 km/h\", load = \"20 tf\" }}, \
         {{ name = \"b\", speed = \"40 km/h\", load = \"{returning}\", direction = \"reverse\" }}]"
    );
    let ends = format!("ends = {{ upstream = \"{upstream}\", downstream = \"fixed\" }}");
    let duct = "duct = { length = 15, depth = 1.2 }";
    let solver = "solver = { method = \"quasi-static\", tolerance = 0.05 }";
    upper(&[duct, &vehicles, &ends, solver, "traffic = { passes = 240 }"])
}

/// What an end shows by turns in the end is nothing of how the force grows before.
#[test]
fn what_alternates_in_the_end_is_foreseen_from_early_passes() {
    let vehicles = "vehicles = [{ name = \"a\", speed = \"40 km/h\", load = \"20 tf\" }, \
                    { name = \"b\", speed = \"40 km/h\", load = \"19 tf\" }]";
    let mut scene = by(&upper(&[vehicles]), SolverMethod::PassLaw);
    scene.solver.tolerance = 0.05;
    scene.traffic.passes = 400;
    let late = answer(&scene).expect("an answer");
    let period: Vec<f64> = late.passes[398..].iter().map(at_the_ends).collect();
    let (least, largest) = (period[0].min(period[1]), period[0].max(period[1]));
    scene.traffic.passes = 100;
    let early = answer(&scene).expect("an answer");
    // The force still rises.
    assert!(reached(&scene, &early.passes) < 0.99 * least);
    let range = early.range.expect("it levels off");
    assert_near(range.downstream_min_n, least, 0.02, &period);
    assert_near(range.downstream_max_n, largest, 0.02, &period);
}

/// Of millions of passes the largest force of an end is that of the vehicle that leaves most, whichever comes last.
#[test]
fn the_largest_of_long_traffic_is_that_of_all_its_vehicles() {
    let mut scene = two_way("free", "12 tf");
    scene.solver.method = SolverMethod::Auto;
    scene.traffic.passes = 3_000_000;
    let run = answer(&scene).expect("an answer");
    let range = run.range.expect("it levels off");
    let after = |record: &PassRecord| record.downstream_force_n;
    let last = run.passes.iter().rev().take(2).map(after).fold(0.0, f64::max);
    assert_near(last, range.downstream_max_n, 1e-3, range);
}

/// Near shakedown the force falls from the first pass on: it has no level that it rises to.
#[test]
fn a_falling_force_has_none() {
    for base in ["", "rigid_base_depth = 12, "] {
        let ground =
            format!("ground = {{ {base}layers = [{{ young_modulus = \"800 MPa\", poisson_ratio = 0.4 }}] }}");
        let rough = ["solver = { tolerance = 0.1 }", "traffic = { passes = 60 }"];
        let scene = scene(&[&UPPER, &LOWER_AXLES, &[&ground], &rough]);
        let run = answer(&scene).expect("an answer");
        let force = |pass: usize| run.passes[pass - 1].downstream_force_n;
        assert!(force(60) < 0.9 * force(1), "{} N after {} N", force(60), force(1));
        assert_eq!(run.saturation, None);
    }
}
