//! Two springs at once, clamps and their limits, heat and slopes: each answer against a grid of runs that know nothing of the search.

use creepage::design::{Design, DesignOptions, best, design};
use creepage::scene::{End, Restraint};
use creepage::{Limited, Limits, Place, Run, Scene, SceneFile};

/// A short scene on a mesh that is good enough: limits are kept and broken on the same one.
fn scene(more: &[&str]) -> Scene {
    let short = [
        "traffic.passes=6",
        "duct.length=15 m",
        "solver.node_spacing=0.3 m",
    ];
    let overrides = [&short, more].concat();
    SceneFile::read("examples/scenes/full-scale-upper.toml")
        .and_then(|file| file.with(&overrides)?.scene())
        .expect("a valid scene")
}

/// A limit: where, of what, how much.
type Given = (Place, Limited, f64);

fn limits(all: &[Given]) -> Limits {
    let mut limits = Limits::default();
    for &(place, quantity, limit) in all {
        let of = match place {
            Place::Upstream => &mut limits.upstream,
            Place::Downstream => &mut limits.downstream,
            Place::Clamp(position_m) => {
                limits.clamps.push(creepage::ClampLimits {
                    position_m,
                    limits: creepage::EndLimits::default(),
                });
                &mut limits.clamps.last_mut().expect("just pushed").limits
            }
        };
        match quantity {
            Limited::Force => of.force_n = Some(limit),
            Limited::Movement => of.movement_m = Some(limit),
        }
    }
    limits
}

fn designed(scene: &Scene, places: &[Place], all: &[Given]) -> Design {
    let mut options = DesignOptions::new(places[0], limits(all));
    options.second = places.get(1).copied();
    design(scene, &options).unwrap_or_else(|error| panic!("{places:?}, {all:?}: {error}"))
}

/// The scene with a spring at each place, run.
fn held(scene: &Scene, springs: &[(Place, f64)]) -> Run {
    let mut scene = scene.clone();
    for &(place, stiffness) in springs {
        let end = match stiffness {
            0.0 => End::Free,
            f64::INFINITY => End::Fixed,
            _ => End::Spring(stiffness),
        };
        match place {
            Place::Upstream => scene.ends.upstream = end,
            Place::Downstream => scene.ends.downstream = end,
            Place::Clamp(position) if stiffness > 0.0 => {
                scene.restraints.push(Restraint { position, stiffness })
            }
            Place::Clamp(_) => {}
        }
    }
    creepage::run(&scene).expect("an answer")
}

/// What `run` has at a place, from its tables and not by what the search calls.
fn reached(run: &Run, place: Place, quantity: Limited) -> f64 {
    let most =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most: f64, value| most.max(value.abs()));
    let days = || run.heat.iter().map(|heat| &heat.all_days);
    match (place, quantity) {
        (Place::Upstream, Limited::Force) => most(
            &mut run
                .passes
                .iter()
                .flat_map(|pass| [pass.upstream_force_n, pass.upstream_peak_n])
                .chain(days().flat_map(|day| [day.upstream_max_n, day.upstream_min_n])),
        ),
        (Place::Downstream, Limited::Force) => most(
            &mut run
                .passes
                .iter()
                .flat_map(|pass| [pass.downstream_force_n, pass.downstream_peak_n])
                .chain(days().flat_map(|day| [day.downstream_max_n, day.downstream_min_n])),
        ),
        (Place::Upstream, Limited::Movement) => most(
            &mut run.passes.iter().map(|pass| pass.upstream_displacement_m).chain(
                days().flat_map(|day| [day.upstream_displacement_max_m, day.upstream_displacement_min_m]),
            ),
        ),
        (Place::Downstream, Limited::Movement) => most(
            &mut run
                .passes
                .iter()
                .map(|pass| pass.downstream_displacement_m)
                .chain(days().flat_map(|day| {
                    [
                        day.downstream_displacement_max_m,
                        day.downstream_displacement_min_m,
                    ]
                })),
        ),
        (Place::Clamp(position), _) => {
            let mut clamps = run.restraints.iter();
            let clamp = clamps.find(|clamp| clamp.position_m == position);
            clamp.map_or(0.0, |clamp| {
                let force = most(&mut clamp.after_passes_n.iter().copied());
                match quantity {
                    Limited::Force => force,
                    Limited::Movement => force / clamp.stiffness_n_per_m,
                }
            })
        }
    }
}

fn excess(run: &Run, all: &[Given]) -> f64 {
    let shares = all
        .iter()
        .map(|&(place, quantity, limit)| reached(run, place, quantity) / limit);
    shares.fold(0.0, f64::max)
}

/// Stiffnesses of a grid, with none and, at ends, a fixed one.
fn grid(scene: &Scene, place: Place) -> Vec<f64> {
    let own = scene.cable.axial_stiffness / scene.duct.length;
    let powers = (-4..=3).map(|i| own * 10_f64.powf(0.5 * f64::from(i) + 0.13));
    let fixed = (!matches!(place, Place::Clamp(_))).then_some(f64::INFINITY);
    std::iter::once(0.0).chain(powers).chain(fixed).collect()
}

/// The least of the largest shares of a limit over a grid of all springs.
fn best_of_grid(scene: &Scene, places: &[Place], all: &[Given]) -> f64 {
    let mut least = f64::INFINITY;
    for first in grid(scene, places[0]) {
        let seconds = places.get(1).map_or(vec![None], |place| {
            grid(scene, *place)
                .into_iter()
                .map(|k| Some((*place, k)))
                .collect()
        });
        for second in seconds {
            let springs: Vec<_> = [(places[0], first)].into_iter().chain(second).collect();
            least = least.min(excess(&held(scene, &springs), all));
        }
    }
    least
}

/// Checks a design against a grid: an answer keeps the limits in a run of its own and is among the best, and where there is none no point
/// of the grid keeps them either.
fn check(scene: &Scene, places: &[Place], all: &[Given], kept: bool) -> Design {
    let design = designed(scene, places, all);
    assert!(design.runs < 90, "{} runs", design.runs);
    let found = design.found().expect("an answer or the nearest");
    let springs: Vec<_> = found
        .springs
        .iter()
        .map(|spring| (spring.place, spring.stiffness()))
        .collect();
    let own = excess(&held(scene, &springs), all);
    assert!(
        (own - design.excess()).abs() < 1e-9 * own,
        "{own} {}",
        design.excess()
    );
    let grid = best_of_grid(scene, places, all);
    assert_eq!(design.answer.is_some(), kept, "{own} {grid}");
    assert_eq!(own <= 1.0, kept);
    assert!(own <= 1.03 * grid, "{own} against {grid}");
    assert!(kept || grid > 1.0);
    assert!(!design.binding.is_empty());
    for limit in &design.binding {
        assert!(limit.value / limit.limit >= 0.95 * own, "{limit:?}");
    }
    design
}

const BOTH: [Place; 2] = [Place::Upstream, Place::Downstream];

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
    let moved = |run: &Run| {
        BOTH.map(|place| reached(run, place, Limited::Movement))
            .into_iter()
            .fold(0.0, f64::max)
    };
    for first in grid(&scene, BOTH[0]) {
        for second in grid(&scene, BOTH[1]) {
            let run = held(&scene, &[(BOTH[0], first), (BOTH[1], second)]);
            let keeps = excess(&run, &limits) <= 1.0;
            assert!(
                !keeps || moved(&run) > 0.97 * found.movement_m,
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

#[test]
fn a_clamp_has_limits_of_its_own() {
    let scene = scene(&[]);
    let clamp = Place::Clamp(13.0);
    let free = reached(&held(&scene, &[]), Place::Downstream, Limited::Force);
    let end = (Place::Downstream, Limited::Force, 0.7 * free);
    // The softest clamp that is good enough for the end.
    let soft = designed(&scene, &[clamp], &[end]).answer.expect("a clamp");
    let force = soft.value(clamp, Limited::Force);
    assert_eq!(soft.clamps[0].force_n, force);
    // With less than that on it there is none; with more there is a range, whose ends are the two limits.
    check(
        &scene,
        &[clamp],
        &[end, (clamp, Limited::Force, 0.6 * force)],
        false,
    );
    let both = designed(&scene, &[clamp], &[end, (clamp, Limited::Force, 1.2 * force)]);
    let (from, to) = both.range_n_per_m.expect("a range");
    let to = to.expect("an upper end");
    assert!(
        from < to && both.binding.len() == 2,
        "{from} {to} {:?}",
        both.binding
    );
    let stiffer = held(&scene, &[(clamp, 1.05 * to)]);
    assert!(reached(&stiffer, clamp, Limited::Force) > 1.2 * force);
    // Where it may move little it has to be stiff.
    let moved = (
        clamp,
        Limited::Movement,
        0.5 * soft.value(clamp, Limited::Movement),
    );
    let stiff = designed(&scene, &[clamp], &[moved]).answer.expect("a clamp");
    assert!(stiff.stiffness_n_per_m > soft.stiffness_n_per_m);
    let run = held(&scene, &[(clamp, stiff.stiffness_n_per_m.expect("a clamp"))]);
    assert!(reached(&run, clamp, Limited::Movement) <= moved.2);
}

#[test]
fn of_several_clamps_the_softest_is_the_best() {
    let scene = scene(&[]);
    let free = reached(&held(&scene, &[]), Place::Downstream, Limited::Force);
    let end = [(Place::Downstream, Limited::Force, 0.6 * free)];
    let designs = [5.0, 11.0, 14.0].map(|position| designed(&scene, &[Place::Clamp(position)], &end));
    let found = best(&designs).expect("one");
    let stiffness = |design: &Design| design.answer.as_ref().and_then(|answer| answer.stiffness_n_per_m);
    let all: Vec<f64> = designs.iter().filter_map(stiffness).collect();
    assert!(all.len() > 1, "{all:?}");
    assert_eq!(stiffness(found), all.into_iter().reduce(f64::min));
}

/// Few vehicles a day and 20 K of heat.
const WARM: [&str; 5] = [
    "traffic.passes=16",
    "traffic.per_day=8",
    "heat.expansion=17e-6 1/K",
    "heat.daily_swing=20 K",
    "solver.node_spacing=0.3 m",
];

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
    assert_eq!(with.downstream_movement_m, moved);
    let both = [limit[0], (places[0], Limited::Movement, 0.6 * moved)];
    check(&warm, &places, &both, false);
}

#[test]
fn a_slope_counts() {
    let (level, steep) = (scene(&[]), scene(&["duct.slope=-12 deg"]));
    let places = [Place::Downstream];
    let fixed = |scene: &Scene| reached(&held(scene, &[]), places[0], Limited::Force);
    assert!(
        fixed(&steep) > 1.1 * fixed(&level),
        "{} {}",
        fixed(&steep),
        fixed(&level)
    );
    let limit = [(places[0], Limited::Force, fixed(&level))];
    assert_eq!(
        designed(&level, &places, &limit)
            .answer
            .expect("kept")
            .stiffness_n_per_m,
        None
    );
    let spring = designed(&steep, &places, &limit).answer.expect("kept");
    let stiffness = spring.stiffness_n_per_m.expect("a spring");
    assert!(excess(&held(&steep, &[(places[0], stiffness)]), &limit) <= 1.0);
    assert!(excess(&held(&steep, &[(places[0], 1.05 * stiffness)]), &limit) > 1.0);
}

#[test]
fn a_cable_that_leaves_the_duct_is_called_so() {
    // Downhill, and steeper than friction holds: nothing stops it but the ends.
    let scene = scene(&["duct.slope=-12 deg"]);
    let limit = [(Place::Downstream, Limited::Force, 1.0)];
    let design = designed(&scene, &[Place::Downstream], &limit);
    for point in &design.curve {
        assert_eq!(point.leaves_duct, point.movement_m > 0.01 * scene.duct.length);
    }
}

#[test]
fn limits_and_places_that_have_no_meaning_are_refused() {
    let scene = scene(&[]);
    let end = (Place::Downstream, Limited::Force, 100.0);
    for (places, all) in [
        (&BOTH[..], &[][..]),
        (&[Place::Upstream, Place::Upstream], &[end]),
        (&[Place::Upstream, Place::Clamp(16.0)], &[end]),
        (&[Place::Upstream], &[(Place::Clamp(3.0), Limited::Force, 1.0)]),
        (&[Place::Clamp(3.0)], &[(Place::Clamp(3.0), Limited::Force, -1.0)]),
    ] {
        let mut options = DesignOptions::new(places[0], limits(all));
        options.second = places.get(1).copied();
        let refused = design(&scene, &options);
        assert!(
            refused.is_err_and(|error| error.is_bad_input()),
            "{places:?} {all:?}"
        );
    }
}
