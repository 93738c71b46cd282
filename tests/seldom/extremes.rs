//! Largest forces of vehicles that come seldom, for verdicts.

use creepage::scene::SolverMethod;
use creepage::{CableEnd, Limited, Limits, Run, Scene};

use super::scenes::by;

/// Vehicles by their share and load \[kN\], over a duct whose downstream end is fixed.
fn scene(vehicles: &[(f64, f64)], traffic: &str) -> Scene {
    let vehicles: Vec<String> = vehicles
        .iter()
        .enumerate()
        .map(|(kind, (share, load))| {
            format!("{{ name = \"v{kind}\", speed = 11, load = \"{load} kN\", share = {share} }}")
        })
        .collect();
    let text = format!(
        r#"
        duct = {{ length = 20, depth = 1.2 }}
        ground = {{ layers = [{{ young_modulus = "300 MPa", poisson_ratio = 0.4 }}] }}
        cable = {{ weight = 108.8, axial_stiffness = 8.01e6 }}
        friction = {{ dynamic_coefficient = 0.3, shape_factor = 6e6 }}
        ends = {{ upstream = "free", downstream = "fixed" }}
        vehicles = [{}]
        traffic = {{ {traffic} }}
        "#,
        vehicles.join(", ")
    );
    Scene::from_toml("scene", &text).expect("a valid scene")
}

fn largest(run: &Run) -> f64 {
    run.largest(CableEnd::Downstream, Limited::Force)
}

/// A long sequence of which few passes are listed: its one special transport decides the verdict, and when the limit is exceeded.
#[test]
fn a_limit_is_judged_by_all_passes_of_a_long_sequence() {
    let mut sequence = vec!["\"v0\""; 97];
    sequence[61] = "\"v1\"";
    let traffic = |passes: u64| format!("passes = {passes}, sequence = [{}]", sequence.join(", "));
    let scene = |passes| scene(&[(1.0, 40.0), (1.0, 400.0)], &traffic(passes));
    let every = by(&scene(12_000), SolverMethod::QuasiStatic).expect("an answer");
    let found = by(&scene(1_000_000), SolverMethod::PassLaw).expect("an answer");
    let error = found.error_estimate.relative;
    assert!(
        (largest(&found) / largest(&every) - 1.0).abs() <= error,
        "{} {} {error}",
        largest(&found),
        largest(&every)
    );

    let limits = Limits::both(Some(0.98 * largest(&every)), None);
    let reached = |run: &Run| {
        let verdicts = limits.verdicts(run);
        let mut reached = verdicts.iter().filter_map(|verdict| verdict.reached_after);
        reached.next().expect("a limit that is exceeded").pass as f64
    };
    let (found, right) = (reached(&found), reached(&every));
    assert!((found / right - 1.0).abs() <= 0.2, "{found} {right}");
}

/// A vehicle that is too seldom for any period is judged by one pass of its own; one that never comes is named.
#[test]
fn vehicles_that_are_too_seldom_for_a_period_are_judged() {
    let of = |passes: u64| scene(&[(1.0, 40.0), (1e-5, 400.0)], &format!("passes = {passes}"));
    let run = by(&of(1_000_000), SolverMethod::Auto).expect("an answer");
    let alone = by(&scene(&[(1.0, 40.0)], "passes = 1000000"), SolverMethod::Auto).expect("an answer");
    assert!(
        largest(&run) > 1.2 * largest(&alone),
        "{} {}",
        largest(&run),
        largest(&alone)
    );
    assert!(run.extremes.iter().any(|extreme| extreme.vehicle == "v1"));
    let names = |run: &Run| run.warnings.iter().any(|warning| warning.contains("\"v1\""));
    assert!(!names(&run));
    let few = by(&of(1000), SolverMethod::Auto).expect("an answer");
    assert!(names(&few), "{:?}", few.warnings);
}

/// The common vehicle drives the other way: the seldom one decides where the cable goes.
#[test]
fn a_seldom_vehicle_against_the_common_direction_counts() {
    let mut scene = scene(&[(100.0, 40.0), (1.0, 400.0)], "passes = 3000");
    scene.vehicles[0].direction = ground_field::Direction::Reverse;
    let every = by(&scene, SolverMethod::QuasiStatic).expect("an answer");
    let found = by(&scene, SolverMethod::PassLaw).expect("an answer");
    let last = |run: &Run| run.passes.last().expect("a pass").downstream_force_n;
    let error = found.error_estimate.relative;
    assert!(
        last(&every).abs() > 50.0 && (last(&found) / last(&every) - 1.0).abs() <= error,
        "{} {} {error}",
        last(&found),
        last(&every)
    );
}
