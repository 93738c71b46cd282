//! Does a cable creep: what a plan says of it, and the ceiling against forces.

use creepage::occurrence::Occurrence;

use crate::scenes::{assert_near, run, upper as scene};

fn expected(overrides: &[&str]) -> Occurrence {
    let plan = creepage::plan(&scene(overrides)).expect("a plan").report();
    plan.occurrence.expect("a half-space is known before the run")
}

/// 27.2 N/m · (1.2 m)²/(8.01 MN · 15.19 µm) = 0.322.
#[test]
fn the_plan_tells_the_number_of_the_experiment() {
    let upper = expected(&[]);
    assert_near(upper.q_number, 0.322, 3e-3, upper);
    assert!(upper.creeps() && !upper.rough, "{upper:?}");
    // f* L alone, the ends' part left out, is within 5 % of the independent 527.84 N.
    assert_near(upper.locked_share * 27.2 * 30.0, 527.84, 0.05, ());
}

/// From the least friction to too much of it, no force is above the ceiling, and the largest is not far below it.
#[test]
fn no_friction_makes_more_than_the_ceiling() {
    let frictions = ["0.1", "0.25", "0.4", "0.6", "1.0"].map(|mu| {
        let friction = format!("friction.dynamic_coefficient={mu}");
        let overrides = [&*friction, "traffic.passes=400", "solver.tolerance=5 %"];
        let run = run(&scene(&overrides));
        (run.passes[399].downstream_force_n, expected(&overrides).ceiling_n)
    });
    let ceiling = frictions[0].1;
    let largest = frictions.iter().fold(0.0, |most: f64, found| most.max(found.0));
    assert!(frictions.iter().all(|found| found.1 == ceiling), "{frictions:?}");
    assert!((0.7 * ceiling..ceiling).contains(&largest), "{largest} N");
}

/// A stiff ground, a deep duct or a soft cable.
#[test]
fn above_three_nothing_creeps() {
    let number = expected(&["cable.axial_stiffness=0.6e6 N"]);
    assert!(number.q_number > 4.0 && !number.creeps(), "{number:?}");
    assert_eq!((number.locked_share, number.first_advance_m), (0.0, 0.0));
}

#[test]
fn other_scenes_are_called_rough() {
    for rough in [
        "ground.layers.0.poisson_ratio=0.3",
        "duct.lateral_offset=0.5 m",
        "ground.rigid_base_depth=10 m",
        r#"restraints=[{position="10 m", stiffness="1 MN/m"}]"#,
        r#"vehicles.0.wheels=[{x="0 m", y="0 m", load="5 tf"}, {x="-5 m", y="0 m", load="15 tf"}]"#,
        r#"vehicles.0.wheels=[{x="0 m", y="0 m", load="20 tf", contact_radius="0.15 m"}]"#,
    ] {
        assert!(expected(&[rough]).rough, "{rough}");
    }
}

/// The largest D_l counts: a second, lighter vehicle changes nothing but that the numbers are rough.
#[test]
fn the_heaviest_of_several_vehicles_counts() {
    let two = r#"vehicles=[{name="light", load="5 tf", speed="40 km/h"}, {name="heavy", load="20 tf", speed="40 km/h"}]"#;
    let (one, several) = (expected(&[]), expected(&[two]));
    assert_near(several.q_number, one.q_number, 1e-6, several);
    assert!(several.rough);
}
