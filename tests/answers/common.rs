//! Scenes as text, and what no answer may break.

use std::fmt::Debug;

use creepage::scene::{End, SolverMethod};
use creepage::{Error, PassRecord, Run, RunOptions, Scene};

use crate::scenes::{self, largest};

/// The full-scale experiment's upper cable in a duct of 60 m: half-space of 800 MPa, free upstream, fixed downstream, 20 tf.
pub const UPPER: [&str; 8] = [
    "duct = { length = 60, depth = 1.2 }",
    "ground = { layers = [{ young_modulus = \"800 MPa\", poisson_ratio = 0.4 }] }",
    "cable = { weight = 108.8, axial_stiffness = 8.01e6 }",
    "friction = { dynamic_coefficient = 0.25, shape_factor = 7352941.0 }",
    "ends = { upstream = \"free\", downstream = \"fixed\" }",
    "vehicles = [{ speed = \"40 km/h\", load = \"20 tf\" }]",
    "traffic = { passes = 600 }",
    "solver = { method = \"auto\" }",
];

/// The full-scale experiment's lower cable under the same 20 tf on three axles, whose friction all but holds it: 30 m.
pub const LOWER_AXLES: [&str; 5] = [
    "duct = { length = 30, depth = 1.2 }",
    "cable = { weight = 108.8, axial_stiffness = 8.01e6, normal_load_factor = 1.5 }",
    "friction = { dynamic_coefficient = 0.27, shape_factor = 4538852.6 }",
    "vehicles = [{ speed = \"40 km/h\", wheels = [{ x = 0, load = \"5.5 tf\" }, { x = -5, load = \"7.25 tf\" }, { x = -6.3, load = \"7.25 tf\" }] }]",
    "traffic = { passes = 200 }",
];

/// The scene of `lines`; a later line takes the place of an earlier one with the same key.
pub fn scene(lines: &[&[&str]]) -> Scene {
    let key = |line: &str| line.split_once(" = ").map(|(key, _)| key.to_owned());
    let mut text: Vec<&str> = Vec::new();
    for &line in lines.iter().copied().flatten() {
        text.retain(|other| key(other) != key(line));
        text.push(line);
    }
    Scene::from_toml("scene", &text.join("\n")).expect("a valid scene")
}

/// [`UPPER`] with other lines.
pub fn upper(lines: &[&str]) -> Scene {
    scene(&[&UPPER, lines])
}

/// Asserts that `found` is the expected number within `allowed`.
#[track_caller]
pub fn assert_within(found: f64, expected: f64, allowed: f64, what: impl Debug) {
    let off = (found - expected).abs();
    assert!(off <= allowed, "{what:?}: {found}, not {expected}");
}

/// The run of a scene with a look at the cable after the passes `stages`.
pub fn staged(scene: &Scene, stages: &[u64]) -> Run {
    let options = RunOptions {
        stages,
        ..RunOptions::default()
    };
    creepage::run_with(scene, &options).expect("an answer")
}

/// Whether a warning of the run says so.
pub fn is_told(run: &Run, words: &str) -> bool {
    run.warnings.iter().any(|warning| warning.contains(words))
}

/// The most that friction carries per metre \[N/m\].
pub fn limit(scene: &Scene) -> f64 {
    scene.friction.dynamic_coefficient * scene.normal_load()
}

/// An answer that can be true, or a typed error that says what else to try.
#[track_caller]
pub fn answer(scene: &Scene) -> Option<Run> {
    looked_at(scene, &[])
}

/// The same with a look at the cable after the passes `stages`.
#[track_caller]
pub fn looked_at(scene: &Scene, stages: &[u64]) -> Option<Run> {
    let options = RunOptions {
        stages,
        ..RunOptions::default()
    };
    match creepage::run_with(scene, &options) {
        Ok(run) => {
            assert_possible(scene, &run);
            Some(run)
        }
        Err(error) => {
            let is_unfit = matches!(error, Error::TooManyNodes { .. } | Error::Unfit { .. });
            let is_unsure = matches!(error, Error::Inaccurate { .. } | Error::NoAnswer { .. });
            assert!(
                is_unfit || is_unsure || matches!(error, Error::Jumps(_)),
                "{error:?}"
            );
            let text = error.to_string();
            let named = ["solver.", "traffic.", "duct.", "friction."];
            assert!(named.iter().any(|key| text.contains(key)), "no way out: {text}");
            None
        }
    }
}

/// What friction, ends and clamps allow, finite numbers, and an error that is one.
#[track_caller]
pub fn assert_possible(scene: &Scene, run: &Run) {
    let whole = serde_json::to_value(run).expect("a document");
    assert_finite(&whole, "run");

    let allowed = 0.1_f64.max(scene.solver.tolerance);
    let stated = &run.error_estimate;
    // Any error is allowed of forces that are small relative to friction on a length as the duct is deep.
    let largest = run.passes.iter().map(largest_force).fold(0.0, f64::max);
    let small = 0.1 * scene.duct.depth * scene.friction_limit() / largest;
    let possible = 0.0..=allowed.max(small);
    assert!(possible.contains(&stated.relative), "{stated:?}");
    assert_eq!(stated.relative > allowed, is_told(run, "so small"));
    // A movement that is not known so well, as of an end that hardly moves, is told.
    let within = stated.parts.movement <= scene.solver.tolerance;
    assert!(within || is_told(run, "of the movement"), "{stated:?}");

    let (first, last) = (run.passes[0].pass, scenes::last(run).pass);
    assert_eq!((first, last), (1, scene.traffic.passes));
    assert_ends(scene, &run.passes);
    assert_balance(scene, run);
    if let Some(saturation) = run.saturation {
        let reached = reached(scene, &run.passes);
        assert!(saturation.force_n.abs() >= reached, "{saturation:?}");
    }
}

/// Every leaf of the document that is a number is one; only what may be missing is null.
#[track_caller]
fn assert_finite(value: &serde_json::Value, place: &str) {
    use serde_json::Value;
    match value {
        Value::Array(values) => values.iter().for_each(|value| assert_finite(value, place)),
        Value::Object(fields) => fields.iter().for_each(|(name, value)| assert_finite(value, name)),
        Value::Null => {
            let missing = ["saturation", "slip_lengths", "dissipated_energy_j", "friction"];
            assert!(missing.contains(&place), "{place} is no number");
        }
        _ => {}
    }
}

/// A free end carries nothing, a fixed one does not move, a spring carries what it is compressed by; and what the ends carry
/// differs by no more than friction holds, if there are no clamps.
#[track_caller]
fn assert_ends(scene: &Scene, passes: &[PassRecord]) {
    let friction = limit(scene) * scene.duct.length;
    let largest = passes.iter().map(largest_force).fold(1e-9, f64::max);
    for record in passes {
        let (upstream, downstream) = (record.upstream_force_n, record.downstream_force_n);
        let (back, ahead) = (-record.upstream_displacement_m, record.downstream_displacement_m);
        let ends = &scene.ends;
        for (end, force, inward) in [
            (ends.upstream, upstream, back),
            (ends.downstream, downstream, ahead),
        ] {
            // The law of many passes rounds its ends to a hundredth.
            match end {
                End::Free => assert!(force.abs() <= 0.01 * largest, "{record:?}"),
                End::Fixed => assert!(inward.abs() <= 1e-9, "{record:?}"),
                End::Spring(stiffness) => {
                    assert_within(force, stiffness * inward, 0.01 * largest, record);
                }
            }
        }
        if scene.restraints.is_empty() {
            assert_within(downstream, upstream, 1.01 * friction, record);
        }
    }
}

/// Along the cable the force changes by no more than friction and the clamps between carry.
#[track_caller]
fn assert_balance(scene: &Scene, run: &Run) {
    let profile = &run.force_profile;
    let largest = largest(profile.force_n.iter().copied());
    let places = profile.positions_m.windows(2).zip(profile.force_n.windows(2));
    for (x, force) in places {
        let friction = 1.01 * limit(scene) * (x[1] - x[0]);
        // A clamp is shared by the two nodes beside it, so by the elements before and after them.
        let near = 1.5 * (x[1] - x[0]);
        let near = x[0] - near..=x[1] + near;
        let clamps = run
            .restraints
            .iter()
            .filter(|clamp| near.contains(&clamp.position_m));
        let clamps: f64 = clamps.map(|clamp| clamp.force_n.abs()).sum();
        let allowed = friction + 1.001 * clamps + 1e-9 * largest;
        assert_within(force[1], force[0], allowed, x);
    }
}

pub fn largest_force(record: &PassRecord) -> f64 {
    let peaks = [record.upstream_peak_n, record.downstream_peak_n];
    largest(forces_after(record).into_iter().chain(peaks))
}

/// Forces on the ends and the compression in the cable after a pass \[N\].
pub fn forces_after(record: &PassRecord) -> [f64; 3] {
    [
        record.upstream_force_n,
        record.downstream_force_n,
        record.max_compression_n,
    ]
}

/// The largest force in size that a held end shows after any pass; inside the cable where both ends are free.
pub fn reached(scene: &Scene, passes: &[PassRecord]) -> f64 {
    let free = (scene.ends.upstream, scene.ends.downstream) == (End::Free, End::Free);
    let force = |record: &PassRecord| {
        if free {
            record.max_compression_n.abs()
        } else {
            record.upstream_force_n.abs().max(record.downstream_force_n.abs())
        }
    };
    passes.iter().map(force).fold(0.0, f64::max)
}

/// The scene by another method.
pub fn by(scene: &Scene, method: SolverMethod) -> Scene {
    let mut scene = scene.clone();
    scene.solver.method = method;
    scene
}
