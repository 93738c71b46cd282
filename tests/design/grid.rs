//! Runs that know nothing of the search: a grid of them, against which a design is held.

use creepage::design::{Design, DesignOptions, design};
use creepage::scene::{End, Restraint};
use creepage::{Limited, Limits, PassRecord, Place, Run, Scene};

use crate::scenes::{largest, upper};

/// A short scene on a mesh that is good enough: limits are kept and broken on the same one.
pub fn scene(more: &[&str]) -> Scene {
    let short = [
        "traffic.passes=6",
        "duct.length=15 m",
        "solver.node_spacing=0.3 m",
    ];
    upper(&[&short, more].concat())
}

/// A limit: where, of what, how much.
pub type Given = (Place, Limited, f64);

pub fn limits(all: &[Given]) -> Limits {
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

pub fn designed(scene: &Scene, places: &[Place], all: &[Given]) -> Design {
    let mut options = DesignOptions::new(places[0], limits(all));
    options.places = places.to_vec();
    design(scene, &options).unwrap_or_else(|error| panic!("{places:?}, {all:?}: {error}"))
}

/// The scene with a spring at each place, run.
pub fn held(scene: &Scene, springs: &[(Place, f64)]) -> Run {
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
                scene.restraints.push(Restraint::new(position, stiffness));
            }
            Place::Clamp(_) => {}
        }
    }
    creepage::run(&scene).expect("an answer")
}

/// What `run` has at a place, from its tables and not by what the search calls.
pub fn reached(run: &Run, place: Place, quantity: Limited) -> f64 {
    if let Place::Clamp(position) = place {
        let mut clamps = run.restraints.iter();
        let Some(clamp) = clamps.find(|clamp| clamp.position_m == position) else {
            return 0.0;
        };
        let force = largest(clamp.during_passes_n.iter().copied());
        return match quantity {
            Limited::Force => force,
            Limited::Movement => force / clamp.stiffness_n_per_m,
        };
    }
    let end = usize::from(place == Place::Downstream);
    let at_rest = |pass: &PassRecord| [pass.upstream_force_n, pass.downstream_force_n][end];
    let moved = |pass: &PassRecord| [pass.upstream_displacement_m, pass.downstream_displacement_m][end];
    let during = |pass: &PassRecord| {
        let upstream = [pass.upstream_peak_n, pass.upstream_least_n];
        [upstream, [pass.downstream_peak_n, pass.downstream_least_n]][end]
    };
    // What an end's spring moves by per force, as the last pass leaves it; of a free or fixed end nothing.
    let last = run.passes.last().filter(|last| at_rest(last) != 0.0);
    let per_force = last.map_or(0.0, |last| moved(last) / at_rest(last));
    let passes = run.passes.iter().flat_map(|pass| match quantity {
        Limited::Force => [at_rest(pass), during(pass)[0], during(pass)[1]],
        Limited::Movement => [
            moved(pass),
            per_force * during(pass)[0],
            per_force * during(pass)[1],
        ],
    });
    let days = run.heat.iter().flat_map(|heat| {
        let day = &heat.all_days;
        match quantity {
            Limited::Force => {
                let upstream = [day.upstream_max_n, day.upstream_min_n];
                [upstream, [day.downstream_max_n, day.downstream_min_n]][end]
            }
            Limited::Movement => {
                let upstream = [day.upstream_displacement_max_m, day.upstream_displacement_min_m];
                let downstream = [
                    day.downstream_displacement_max_m,
                    day.downstream_displacement_min_m,
                ];
                [upstream, downstream][end]
            }
        }
    });
    largest(passes.chain(days))
}

pub fn excess(run: &Run, all: &[Given]) -> f64 {
    let share = |&(place, quantity, limit): &Given| reached(run, place, quantity) / limit;
    largest(all.iter().map(share))
}

/// Stiffnesses of a grid, with none and, at ends alone, a fixed one.
pub fn grid(scene: &Scene, places: &[Place]) -> Vec<f64> {
    let own = scene.cable.axial_stiffness / scene.duct.length;
    let powers = (-4..=3).map(|i| own * 10_f64.powf(0.5 * f64::from(i) + 0.13));
    let are_ends = !places.iter().any(|place| matches!(place, Place::Clamp(_)));
    let fixed = are_ends.then_some(f64::INFINITY);
    std::iter::once(0.0).chain(powers).chain(fixed).collect()
}

/// The scene with springs of one stiffness, run.
pub fn sprung(scene: &Scene, places: &[Place], stiffness: f64) -> Run {
    let springs: Vec<_> = places.iter().map(|place| (*place, stiffness)).collect();
    held(scene, &springs)
}

/// Checks a design that keeps its limits: by a run of its own, and none outside its range does.
pub fn check_range(scene: &Scene, places: &[Place], all: &[Given]) -> Design {
    let design = designed(scene, places, all);
    let answer = design.answer.as_ref().expect("an answer");
    let springs = answer.springs.iter().map(|spring| spring.place);
    assert!(springs.eq(places.iter().copied()));
    let stiffness = answer.stiffness_n_per_m.expect("springs");
    let own = excess(&sprung(scene, places, stiffness), all);
    assert!(own <= 1.0 && (own - design.excess()).abs() < 1e-9, "{own}");
    let (from, to) = design.range_n_per_m.expect("a range");
    let is_within = from <= stiffness && to.is_none_or(|to| from < to && stiffness <= to);
    assert!(is_within, "{from} {stiffness} {to:?}");
    for beside in [0.98 * from, 1.02 * to.unwrap_or(0.0)] {
        let share = excess(&sprung(scene, places, beside), all);
        assert!(beside == 0.0 || share > 1.0, "{beside}: {share}");
    }
    design
}

/// Checks a design of which nothing keeps the limits against a grid: a run of its own says the same of the nearest, and no point of the grid
/// is nearer or keeps them.
pub fn check_none(scene: &Scene, places: &[Place], all: &[Given]) -> Design {
    let design = designed(scene, places, all);
    assert!(design.runs < 90, "{} runs", design.runs);
    let nearest = design.nearest.as_ref().expect("the nearest");
    let stiffness = nearest.stiffness_n_per_m.unwrap_or(f64::INFINITY);
    let own = excess(&sprung(scene, places, stiffness), all);
    assert!((own - design.excess()).abs() < 1e-9 * own, "{own}");
    let runs = grid(scene, places).into_iter();
    let excesses = runs.map(|stiffness| excess(&sprung(scene, places, stiffness), all));
    let grid = excesses.fold(f64::INFINITY, f64::min);
    assert!(design.answer.is_none() && own > 1.0 && grid > 1.0, "{own} {grid}");
    assert!(own <= 1.03 * grid, "{own} against {grid}");
    assert!(!design.binding.is_empty());
    let mut binding = design.binding.iter();
    assert!(binding.all(|limit| limit.value / limit.limit >= 0.95 * own));
    design
}

/// Few vehicles a day and 20 K of heat.
pub const WARM: [&str; 5] = [
    "traffic.passes=8",
    "traffic.per_day=4",
    "heat.expansion=17e-6 1/K",
    "heat.daily_swing=20 K",
    "solver.node_spacing=0.3 m",
];

pub const BOTH: [Place; 2] = [Place::Upstream, Place::Downstream];
