//! Two springs, or a spring and a clamp.

use creepage::design::{DesignOptions, design};
use creepage::{Limited, Place, Scene, SceneFile};

use super::grid::{
    BOTH, Given, check, designed, excess, grid, held, largest_of_ends, limits, reached, scene,
};

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
fn two_springs_have_the_largest_margin_or_come_nearest() {
    let scene = scene(&[]);
    check(&scene, &BOTH, &of_both(&scene, 1.0), true);
    let none = check(&scene, &BOTH, &of_both(&scene, 0.2), false);
    assert!(
        none.binding.len() > 1,
        "a change of either spring makes it worse: {:?}",
        none.binding
    );
    assert_eq!(none.range_n_per_m, None);
}

#[test]
fn a_spring_and_a_clamp_are_found_together() {
    let scene = scene(&[]);
    let clamp = Place::Clamp(12.0);
    let fixed = held(&scene, &[]);
    let force = reached(&fixed, Place::Downstream, Limited::Force);
    for (share, kept) in [(0.6, true), (0.1, false)] {
        let limits = [
            (Place::Downstream, Limited::Force, share * force),
            (Place::Downstream, Limited::Movement, share * 1e-3),
            (clamp, Limited::Force, share * force),
        ];
        check(&scene, &[Place::Downstream, clamp], &limits, kept);
    }
}

#[test]
fn where_only_forces_are_limited_two_springs_let_the_ends_move_least() {
    let scene = scene(&[]);
    let fixed = held(&scene, &BOTH.map(|place| (place, f64::INFINITY)));
    let limits = BOTH.map(|place| {
        (
            place,
            Limited::Force,
            0.5 * reached(&fixed, place, Limited::Force),
        )
    });
    let found = designed(&scene, &BOTH, &limits)
        .answer
        .expect("free ends keep any force");
    for first in grid(&scene, BOTH[0]) {
        for second in grid(&scene, BOTH[1]) {
            let run = held(&scene, &[(BOTH[0], first), (BOTH[1], second)]);
            let keeps = excess(&run, &limits) <= 1.0;
            assert!(
                !keeps || largest_of_ends(&run, Limited::Movement) > 0.97 * found.movement_m,
                "{first} {second}"
            );
        }
    }
    // And where the limits are wide, both are fixed.
    let wide = BOTH.map(|place| (place, Limited::Force, 1e5));
    let answer = designed(&scene, &BOTH, &wide).answer.expect("kept");
    assert!(
        answer
            .springs
            .iter()
            .all(|spring| spring.stiffness_n_per_m.is_none())
    );
}

/// Springs that are softer by 5 % exceed the movement, and stiffer ones the force.
#[test]
#[ignore = "a quarter of a minute: .ci/run runs it"]
fn springs_that_hardly_keep_the_limits_are_found() {
    let scene = SceneFile::read("examples/scenes/full-scale-upper.toml")
        .and_then(|file| file.with(&["traffic.passes=60"])?.scene())
        .expect("a valid scene");
    let within = |force: f64, movement_mm: f64| {
        let limits = [
            (BOTH[0], Limited::Force, force),
            (BOTH[1], Limited::Force, force),
            (BOTH[0], Limited::Movement, 10e-3),
            (BOTH[1], Limited::Movement, 1e-3 * movement_mm),
        ];
        (designed(&scene, &BOTH, &limits), limits)
    };
    let (found, limits) = within(207.0, 1.035);
    let answer = found.answer.as_ref().expect("2.05e5 and 2.0e5 N/m keep them");
    assert!(found.runs < 64, "{} runs", found.runs);
    assert_eq!(found.doubt(), None);
    // On the mesh of the search, which is that of fixed ends.
    let mut same = scene.clone();
    let plan = held(&scene, &BOTH.map(|place| (place, f64::INFINITY))).plan;
    same.solver.node_spacing = Some(plan.node_spacing_m);
    same.solver.vehicle_step = Some(plan.vehicle_step_m);
    let springs = BOTH.map(|place| {
        let mut springs = answer.springs.iter();
        let spring = springs.find(|spring| spring.place == place).expect("both");
        (place, spring.stiffness())
    });
    let own = excess(&held(&same, &springs), &limits);
    assert!(own <= 1.0 && own > 0.98, "{own}");
    // Where nothing was found, it is known only if the nearest is farther from the limits than its error.
    let (hardly, _) = within(205.5, 1.0275);
    assert!(hardly.answer.is_none() && hardly.excess() < 1.006);
    assert!(hardly.doubt().is_some());
    let (none, _) = within(180.0, 0.9);
    assert!(none.answer.is_none());
    assert_eq!(none.doubt(), None);
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
        let refused = design(&scene, &options);
        assert!(
            refused.is_err_and(|error| error.is_bad_input()),
            "{places:?} {all:?}"
        );
    }
}
