//! Lanes: where a vehicle drives across the road counts by its distance from the duct alone.

use creepage::Scene;

use crate::scenes::{self, run, upper};

const ROAD: [&str; 8] = [
    "duct.length=20 m",
    r#"ground={layers=[{thickness="30 cm", young_modulus="500 MPa", poisson_ratio=0.35}, {young_modulus="100 MPa", poisson_ratio=0.4}]}"#,
    r#"friction={law="coulomb", dynamic_coefficient=0.3}"#,
    r#"vehicles=[{preset="t-25"}]"#,
    "traffic.passes=4",
    "solver.tolerance=0.1",
    "solver.node_spacing=0.2 m",
    "solver.vehicle_step=0.1 m",
];
/// Of single numbers, where both ways of saying a place round differently.
const ROUNDING: f64 = 1e-6;

fn road(overrides: &[&str]) -> Scene {
    upper(&[&ROAD, overrides].concat())
}

fn forces(scene: &Scene) -> Vec<f64> {
    scenes::forces(&run(scene))
}

#[track_caller]
fn assert_same(one: &Scene, other: &Scene) {
    let (one, other) = (forces(one), forces(other));
    for (a, b) in one.iter().zip(&other) {
        assert!((a - b).abs() <= ROUNDING * a.abs(), "{one:?} {other:?}");
    }
}

/// The preset's wheels, shifted by hand.
#[test]
fn a_lane_is_a_shift_of_all_wheels() {
    let wheels = |shift: f64| {
        let wheel = |(x, y, load): (f64, f64, f64)| {
            let y = y + shift;
            format!("{{ x = {x}, y = {y}, load = {load}, contact_radius = 0.1784 }}")
        };
        let axle = |x: f64, load: f64| [(x, 0.875, load), (x, -0.875, load)];
        let all = [axle(4.0, 25e3), axle(0.0, 100e3)].concat();
        let all: Vec<String> = all.into_iter().map(wheel).collect();
        format!("vehicles.0.wheels=[{}]", all.join(","))
    };
    for (direction, lane) in [("forward", 3.5), ("reverse", -1.3)] {
        let direction = format!("vehicles.0.direction={direction}");
        let in_lane = road(&[&direction, &format!("vehicles.0.lateral_offset={lane}")]);
        assert_same(&in_lane, &road(&[&direction, &wheels(lane)]));
        // And of the duct to the other side.
        let beside = format!("duct.lateral_offset={}", -lane);
        assert_same(&in_lane, &road(&[&direction, &beside]));
    }
    // A lane above the duct is none.
    let both = ["vehicles.0.lateral_offset=3.5", "duct.lateral_offset=3.5"];
    assert_same(&road(&both), &road(&[]));
}

#[test]
fn lanes_as_far_on_either_side_are_alike_and_farther_ones_move_the_cable_less() {
    let two = |first: f64, second: f64| {
        let one = format!("{{ preset = \"t-25\", name = \"a\", lateral_offset = {first} }}");
        let other = format!("{{ preset = \"t-25\", name = \"b\", lateral_offset = {second} }}");
        road(&[&format!("vehicles=[{one}, {other}]")])
    };
    assert_same(&two(0.0, 3.5), &two(0.0, -3.5));
    let last = |scene: &Scene| *forces(scene).last().expect("a pass");
    let (above, beside, far) = (last(&two(0.0, 0.0)), last(&two(0.0, 3.5)), last(&two(3.5, 7.0)));
    assert!(above > beside && beside > far.abs(), "{above} {beside} {far}");
}
