//! Ducts that slope, through scenes: key, units, and what is said of them.

use creepage::Scene;

use crate::scenes::{self, assert_near, upper as scene, upper_file};

#[test]
fn steeper_than_friction_the_weight_rests_on_the_lower_end() {
    let ends = ["ends.upstream=fixed", "ends.downstream=free"];
    let nothing_else = ["friction.law=coulomb", "vehicles.0.load=1 N", "traffic.passes=1"];
    let run = scenes::run(&scene(&[&["duct.slope=40 %"], &ends[..], &nothing_else].concat()));
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
    assert!(message.contains("937.9 N") && message.contains("781.6 N"));
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
