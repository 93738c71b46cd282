//! Ducts that slope, through scenes: key, units, every method, and what is said of them.

use creepage::report::{Report, ReportOptions};
use creepage::scene::SceneFile;
use creepage::{CalibrateOptions, Readings, Run, Scene};

const UPPER: &str = include_str!("../examples/scenes/full-scale-upper.toml");

fn scene(overrides: &[&str]) -> Scene {
    SceneFile::from_toml("upper.toml", UPPER)
        .and_then(|file| file.with(overrides))
        .and_then(|file| file.scene())
        .expect("a valid scene")
}

fn refused(overrides: &[&str]) -> String {
    let file = SceneFile::from_toml("upper.toml", UPPER).and_then(|file| file.with(overrides));
    let error = file.and_then(|file| file.scene()).expect_err("a wrong scene");
    error.to_string()
}

fn run(overrides: &[&str]) -> Run {
    creepage::run(&scene(overrides)).unwrap_or_else(|error| panic!("{overrides:?}: {error}"))
}

/// Force downstream after the pass of this number.
fn force(run: &Run, pass: u64) -> f64 {
    let record = run.passes.iter().find(|record| record.pass == pass);
    record.expect("a listed pass").downstream_force_n
}

const MESH: [&str; 2] = ["solver.node_spacing=0.1 m", "solver.vehicle_step=0.05 m"];

/// Reference solutions with an independent full-chain program on this mesh; its sheath has q b/2 = 1e8 N/m² whatever the slope.
#[test]
fn a_scene_on_a_slope_gives_the_forces_of_an_independent_program() {
    let up: [(u64, f64); 5] = [(1, 80.28), (2, 109.09), (10, 212.8), (20, 281.15), (100, 364.24)];
    let down: [(u64, f64); 5] = [(1, 121.2), (2, 168.32), (10, 346.1), (20, 469.39), (100, 689.84)];
    for (slope, expected) in [("5 %", up), ("-2.862405226 deg", down)] {
        let slope = format!("duct.slope={slope}");
        let changes = [
            MESH[0],
            MESH[1],
            &slope,
            "solver.method=quasi-static",
            "traffic.passes=100",
        ];
        let found = run(&changes);
        for (pass, expected) in expected {
            let found = force(&found, pass);
            assert!(
                (found / expected - 1.0).abs() < 0.003,
                "{slope}, {pass}: {found} N, {expected} N"
            );
        }
    }
}

#[test]
fn jumps_follow_every_pass_on_a_slope() {
    for slope in ["duct.slope=4 %", "duct.slope=-4 %"] {
        let both_ways = "vehicles=[{ speed = 10, load = \"20 tf\" }, { name = \"back\", speed = 10, load = \"15 tf\", direction = \"reverse\" }]";
        for traffic in ["duct.depth=1.2 m", both_ways] {
            let common = [
                slope,
                traffic,
                "traffic.passes=200",
                "solver.tolerance=0.05",
                MESH[0],
                MESH[1],
            ];
            let by = |method: &str| run(&[&common[..], &[method]].concat());
            let (every, jumps) = (by("solver.method=quasi-static"), by("solver.method=pass-law"));
            let largest = every
                .passes
                .iter()
                .fold(0.0_f64, |most, record| most.max(record.downstream_force_n.abs()));
            for record in &jumps.passes {
                let simulated = force(&every, record.pass);
                let off = (record.downstream_force_n - simulated).abs();
                assert!(
                    off < 0.02 * largest,
                    "{slope}, {traffic}, {}: {off} N of {largest} N",
                    record.pass
                );
            }
        }
    }
}

#[test]
fn the_explicit_method_agrees_on_a_slope() {
    let changes = [
        "duct.slope=-6 %",
        "duct.length=12 m",
        "traffic.passes=3",
        "solver.tolerance=0.02",
    ];
    let by = |method: &str| force(&run(&[&changes[..], &[method]].concat()), 3);
    let still = by("solver.method=quasi-static");
    let moving = by("solver.method=explicit");
    assert!((moving / still - 1.0).abs() < 0.02, "{moving} N, {still} N");
}

/// The other way up, with ends and traffic the other way round.
#[test]
fn the_mirror_image_of_a_scene_gives_the_mirror_image_of_the_answer() {
    let here = run(&["duct.slope=3 %", "traffic.passes=20"]);
    let there = run(&[
        "duct.slope=-3 %",
        "traffic.passes=20",
        "ends.upstream=fixed",
        "ends.downstream=free",
        "vehicles.0.direction=reverse",
    ]);
    for (one, other) in here.passes.iter().zip(&there.passes) {
        assert!((one.downstream_force_n - other.upstream_force_n).abs() < 1e-4 * one.downstream_force_n);
        let (one, other) = (one.upstream_displacement_m, other.downstream_displacement_m);
        assert!((one + other).abs() < 1e-4 * one.abs(), "{one} m, {other} m");
    }
}

#[test]
fn steeper_than_friction_the_weight_rests_on_the_lower_end() {
    let run = run(&[
        "duct.slope=40 %",
        "ends.upstream=fixed",
        "ends.downstream=free",
        "friction.law=coulomb",
        "vehicles.0.load=1 N",
        "traffic.passes=1",
    ]);
    let (sine, cosine) = (0.4_f64.atan().sin(), 0.4_f64.atan().cos());
    let expected = 108.8 * (sine - 0.25 * cosine) * 30.0;
    let found = run.passes[0].upstream_force_n;
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} N, {expected} N");
}

#[test]
fn without_friction_the_whole_weight_does() {
    let run = run(&["duct.slope=-40 %", "friction.dynamic_coefficient=0"]);
    let expected = 108.8 * 0.4_f64.atan().sin() * 30.0;
    assert!((force(&run, 200) / expected - 1.0).abs() < 1e-9);
}

#[test]
fn a_slope_that_nothing_holds_is_refused_at_its_key() {
    let free = "ends.downstream=free";
    let message = refused(&["duct.slope=30 %", free]);
    assert!(
        message.starts_with("--set duct.slope=30 %: `duct.slope`: found slopes between free ends that draw the cable with 937.9 N"),
        "{message}"
    );
    assert!(
        message.contains("less than friction and clamps hold, 781.6 N, or an end"),
        "{message}"
    );
    assert!(refused(&["duct.slope=1 %", free, "friction.dynamic_coefficient=0"]).contains("`duct.slope`"));
    assert_eq!(scene(&["duct.slope=24 %", free]).duct.slope, 0.24);
    let clamp = "restraints=[{ position = 3, stiffness = 1e6 }]";
    assert_eq!(scene(&["duct.slope=30 %", free, clamp]).duct.slope, 0.3);
}

#[test]
fn a_slope_is_written_and_read_again() {
    let scene = scene(&["duct.slope=1.7 deg"]);
    assert!((scene.duct.slope - 1.7_f64.to_radians().tan()).abs() < 1e-15);
    assert_eq!(
        Scene::from_toml("again.toml", &scene.to_toml()).expect("a scene"),
        scene
    );
}

/// What a fit finds is what the readings were made with.
#[test]
fn a_fit_on_a_slope_finds_its_friction() {
    let made = run(&[
        "duct.slope=-5 %",
        "friction.dynamic_coefficient=0.28",
        "traffic.passes=40",
    ]);
    let rows = made
        .passes
        .iter()
        .map(|record| format!("{},{}\n", record.pass, record.downstream_force_n));
    let text = format!("pass,force_n\n{}", rows.collect::<String>());
    let readings = Readings::from_csv("made.csv", text.as_bytes()).expect("readings");
    let scene = scene(&["duct.slope=-5 %", "traffic.passes=40"]);
    let fit = creepage::calibrate(&scene, &readings, &CalibrateOptions::default());
    let found = fit.expect("a fit").parameters[0].value;
    assert!((found - 0.28).abs() < 0.005, "{found}");
}

#[test]
fn the_plan_and_the_report_say_that_the_duct_slopes() {
    let scene = scene(&["duct.slope=5 %", "traffic.passes=3"]);
    let expected = |scene: &Scene| {
        let plan = creepage::plan(scene).expect("a plan").report();
        plan.occurrence.expect("a duct that moves")
    };
    let (level, sloping) = (expected(&self::scene(&[])), expected(&scene));
    assert!(!level.rough && sloping.rough);
    assert!((sloping.ceiling_n - level.ceiling_n - scene.body_force().abs() * 30.0).abs() < 1e-9);
    let report = Report::new(&scene, &ReportOptions::default()).expect("a report");
    let page = report.to_html();
    assert!(page.contains("it rises with x by 5 %, and 5.433 N/m of the cable’s weight draw it down"));
}
