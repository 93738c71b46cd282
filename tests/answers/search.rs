//! Jumps over sequences of any length, and a motion that is known far out.

use super::common::upper;

/// A sequence is computed as it is, however long: written out sixty times it is the same traffic.
#[test]
fn a_long_sequence_is_computed_as_it_is() {
    let vehicles =
        "vehicles = [{ name = \"a\", speed = 11.1, load = 1e5 }, { name = \"b\", speed = 11.1, load = 5e4 }]";
    let of_length = |length: usize| {
        let sequence: Vec<&str> = (0..length)
            .map(|place| if place % 3 == 0 { "b" } else { "a" })
            .collect();
        let traffic = format!("traffic = {{ passes = 5000, sequence = {sequence:?} }}");
        let scene = upper(&["duct = { length = 10, depth = 1.2 }", vehicles, &traffic]);
        let run = creepage::run(&scene).expect("an answer");
        let last = run.passes.last().expect("a pass").downstream_force_n;
        (last, run.error_estimate.relative)
    };
    let ((short, said), (long, also_said)) = (of_length(3), of_length(180));
    assert!(
        (long / short - 1.0).abs() <= said + also_said,
        "{short} {long} {said} {also_said}"
    );
}

/// The motion turns far out on the road here, so far that the vehicle is followed beyond where it was once known.
#[test]
fn the_motion_is_known_as_far_as_vehicles_are_followed() {
    let scene = upper(&[
        "duct = { length = 84.6, depth = 3.25 }",
        "ground = { layers = [{ thickness = 0.465, young_modulus = 58e6, poisson_ratio = 0.35 }, \
         { thickness = 0.073, young_modulus = 1610e6, poisson_ratio = 0.35 }, { young_modulus = 993e6, poisson_ratio = 0.49 }] }",
        "vehicles = [{ speed = 11.1, load = 37265 }]",
        "traffic = { passes = 2 }",
        "solver = { tolerance = 0.05 }",
    ]);
    creepage::run(&scene).expect("an answer");
}
