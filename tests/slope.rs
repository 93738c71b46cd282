//! Ducts that slope, through scenes: key, units, every method, and what is said of them.

use creepage::{Run, Scene};

use crate::scenes::{self, assert_near, force_after as force, upper as scene, upper_file};

fn run(overrides: &[&str]) -> Run {
    scenes::run(&scene(overrides))
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
            assert_near(force(&found, pass), expected, 0.003, (&slope, pass));
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
    assert_near(run.passes[0].upstream_force_n, expected, 1e-3, ());
}

#[test]
fn a_slope_that_nothing_holds_is_refused_at_its_key() {
    let free = "ends.downstream=free";
    let refused = |overrides: &[&str]| {
        let error = upper_file(overrides).scene().expect_err("a wrong scene");
        error.to_string()
    };
    let message = refused(&["duct.slope=30 %", free]);
    // What draws the cable, and what friction holds.
    assert!(
        message.contains("937.9 N") && message.contains("781.6 N"),
        "{message}"
    );
    assert!(refused(&["duct.slope=1 %", free, "friction.dynamic_coefficient=0"]).contains("`duct.slope`"));
    assert_eq!(scene(&["duct.slope=24 %", free]).duct.slope, 0.24);
    let clamp = "restraints=[{ position = 3, stiffness = 1e6 }]";
    assert_eq!(scene(&["duct.slope=30 %", free, clamp]).duct.slope, 0.3);
}

#[test]
fn the_plan_adds_the_weight_to_its_ceiling() {
    let scene = scene(&["duct.slope=5 %", "traffic.passes=3"]);
    let expected = |scene: &Scene| {
        let plan = creepage::plan(scene).expect("a plan").report();
        plan.occurrence.expect("a duct that moves")
    };
    let (level, sloping) = (expected(&self::scene(&[])), expected(&scene));
    assert!(!level.rough && sloping.rough);
    let weight = scene.body_force().abs() * 30.0;
    assert!((sloping.ceiling_n - level.ceiling_n - weight).abs() < 1e-9);
}
