//! A motion that is known far out.

use super::common::upper;

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
