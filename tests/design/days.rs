//! Heat and slopes count, and a cable that leaves its duct is told.

use creepage::{Limited, Place, Scene};

use super::grid::{WARM, check_none, designed, held, reached, scene};

#[test]
fn heat_counts_with_its_hottest_force_and_its_coldest_movement() {
    let (warm, cold) = (scene(&WARM), scene(&WARM[..2]));
    let places = [Place::Downstream];
    let fixed = |scene: &Scene| reached(&held(scene, &[]), places[0], Limited::Force);
    assert!(fixed(&warm) > 1.5 * fixed(&cold));
    // The limit that traffic alone keeps with a fixed end asks for a spring where the cable is heated.
    let limit = [(places[0], Limited::Force, 1.2 * fixed(&cold))];
    let without = designed(&cold, &places, &limit).answer.expect("kept");
    assert_eq!(without.stiffness_n_per_m, None);
    let with = designed(&warm, &places, &limit).answer.expect("kept");
    let stiffness = with.stiffness_n_per_m.expect("a spring");
    let run = held(&warm, &[(places[0], stiffness)]);
    let days = &run.heat.as_ref().expect("heat").all_days;
    // It is the force of the day, not that after passes.
    assert!(with.force_n <= limit[0].2 && with.force_n >= days.downstream_max_n);
    // A movement is that of the coldest hour where it is the larger one: the end is drawn in.
    let moved = reached(&run, places[0], Limited::Movement);
    // The test takes it from the force on the spring, the design from the end itself: the same but for rounding.
    assert!((with.downstream_movement_m / moved - 1.0).abs() < 1e-12);
    let both = [limit[0], (places[0], Limited::Movement, 0.6 * moved)];
    check_none(&warm, &places, &both);
}

#[test]
fn a_cable_that_leaves_the_duct_is_called_so() {
    // Steeper than friction holds, with the upper end free: what holds it carries what friction does not, and moves by force over stiffness.
    let scene = scene(&["duct.slope=-30 deg", "ends.downstream.spring=1 kN/m"]);
    let all = [(Place::Downstream, Limited::Force, 1e9)];
    let design = designed(&scene, &[Place::Clamp(13.0)], &all);
    for point in &design.curve {
        assert_eq!(point.leaves_duct, point.movement_m > 0.01 * scene.duct.length);
        assert_eq!(point.within_limits, !point.leaves_duct);
    }
    let (soft, stiff) = (&design.curve[0], &design.curve[design.curve.len() - 1]);
    assert!(soft.leaves_duct && !stiff.leaves_duct);
}
