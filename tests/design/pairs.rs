//! Two springs, or a spring and a clamp, of one stiffness.

use creepage::design::{DesignOptions, design};
use creepage::{Limited, Place, Scene};

use super::grid::{BOTH, Given, check_none, check_range, designed, held, limits, reached, scene, sprung};

/// Limits of force and movement at both ends, `tight` times those that are not hard to keep.
fn of_both(scene: &Scene, tight: f64) -> [Given; 4] {
    let fixed = held(scene, &BOTH.map(|place| (place, f64::INFINITY)));
    let free = held(scene, &[(BOTH[0], 0.0), (BOTH[1], 0.0)]);
    let force = |place| 0.6 * tight * reached(&fixed, place, Limited::Force);
    let movement = |place| 0.6 * tight * reached(&free, place, Limited::Movement);
    [
        (BOTH[0], Limited::Force, force(BOTH[0])),
        (BOTH[1], Limited::Force, force(BOTH[1])),
        (BOTH[0], Limited::Movement, movement(BOTH[0])),
        (BOTH[1], Limited::Movement, movement(BOTH[1])),
    ]
}

#[test]
fn two_springs_keep_the_limits_or_come_nearest() {
    let scene = scene(&[]);
    check_range(&scene, &BOTH, &of_both(&scene, 1.2));
    let none = check_none(&scene, &BOTH, &of_both(&scene, 0.2));
    // A change of the springs makes it worse.
    assert!(none.binding.len() > 1, "{:?}", none.binding);
    assert_eq!(none.range_n_per_m, None);
}

#[test]
fn a_spring_and_a_clamp_are_found_together() {
    let scene = scene(&[]);
    let places = [Place::Downstream, Place::Clamp(12.0)];
    let force = reached(&held(&scene, &[]), Place::Downstream, Limited::Force);
    let limits = |share: f64| {
        [
            (places[0], Limited::Force, share * force),
            (places[0], Limited::Movement, share * 1e-3),
            (places[1], Limited::Force, share * force),
        ]
    };
    check_range(&scene, &places, &limits(0.6));
    check_none(&scene, &places, &limits(0.1));
    // As stiff as was tried where anything does: no clamp is fixed.
    let wide = check_range(&scene, &places, &limits(100.0));
    assert!(wide.range_n_per_m.is_some_and(|(_, to)| to.is_none()));
}

#[test]
fn where_only_forces_are_limited_two_springs_are_as_stiff_as_they_allow() {
    let scene = scene(&[]);
    let fixed = held(&scene, &BOTH.map(|place| (place, f64::INFINITY)));
    let force = |place| reached(&fixed, place, Limited::Force);
    let half = BOTH.map(|place| (place, Limited::Force, 0.5 * force(place)));
    check_range(&scene, &BOTH, &half);
    // And where the limits are wide, both are fixed.
    let wide = BOTH.map(|place| (place, Limited::Force, 1e5));
    let answer = designed(&scene, &BOTH, &wide).answer.expect("kept");
    let mut springs = answer.springs.iter();
    assert!(springs.all(|spring| spring.stiffness_n_per_m.is_none()));
}

/// Limits that the springs hardly keep: if none is found, it is known only if the nearest is farther from them than its error.
#[test]
fn springs_that_hardly_keep_the_limits_are_found() {
    let scene = scene(&[]);
    let springs = sprung(&scene, &BOTH, 2e5);
    let within = |share: f64| {
        let of = |place, quantity| (place, quantity, share * reached(&springs, place, quantity));
        let force = BOTH.map(|place| of(place, Limited::Force));
        let movement = BOTH.map(|place| of(place, Limited::Movement));
        designed(&scene, &BOTH, &[force, movement].concat())
    };
    let found = within(1.004);
    let stiffness = found.answer.as_ref().and_then(|answer| answer.stiffness_n_per_m);
    let apart = stiffness.expect("2e5 N/m keep them") / 2e5 - 1.0;
    assert!(apart.abs() < 0.02 && found.doubt().is_none(), "{apart}");
    let hardly = within(0.996);
    assert!(hardly.answer.is_none() && hardly.excess() < 1.006);
    assert!(hardly.doubt().is_some());
    let none = within(0.8);
    assert!(none.answer.is_none() && none.doubt().is_none());
}

#[test]
fn limits_and_places_that_have_no_meaning_are_refused() {
    let scene = scene(&[]);
    let force = |limit| (Place::Downstream, Limited::Force, limit);
    let movement = |limit| (Place::Downstream, Limited::Movement, limit);
    let clamp = |limit| (Place::Clamp(3.0), Limited::Force, limit);
    for (places, all) in [
        (&BOTH[..], &[][..]),
        (&BOTH[..1], &[]),
        (&[], &[force(100.0)]),
        (&[BOTH[0], BOTH[0]], &[force(100.0)]),
        (&[BOTH[0], Place::Clamp(16.0)], &[force(100.0)]),
        (&[BOTH[0], BOTH[1], Place::Clamp(3.0)], &[force(100.0)]),
        (&[Place::Clamp(15.5)], &[force(1.0)]),
        (&[Place::Clamp(f64::NAN)], &[force(1.0)]),
        (&BOTH[..1], &[clamp(1.0)]),
        (&[Place::Clamp(3.0)], &[clamp(-1.0)]),
        (&BOTH[1..], &[force(0.0)]),
        (&BOTH[1..], &[force(f64::NAN)]),
        (&BOTH[..1], &[force(f64::INFINITY)]),
        (&BOTH[1..], &[force(1.0), movement(-1.0)]),
        (&BOTH[1..], &[force(1.0), movement(f64::NAN)]),
    ] {
        let mut options = DesignOptions::new(BOTH[0], limits(all));
        options.places = places.to_vec();
        let refused = design(&scene, &options).is_err_and(|error| error.is_bad_input());
        assert!(refused, "{places:?} {all:?}");
    }
}
