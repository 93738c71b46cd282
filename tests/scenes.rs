//! Scenes and runs as most tests need them.

use std::fmt::Debug;

use creepage::{PassRecord, Run, Scene, SceneFile};

use crate::command::UPPER;

/// The full-scale experiment's upper cable, with overrides on top.
#[track_caller]
pub fn upper_file(overrides: &[&str]) -> SceneFile {
    let file = SceneFile::read(UPPER).and_then(|file| file.with(overrides));
    file.unwrap_or_else(|error| panic!("{overrides:?}: {error}"))
}

#[track_caller]
pub fn upper(overrides: &[&str]) -> Scene {
    let scene = upper_file(overrides).scene();
    scene.unwrap_or_else(|error| panic!("{overrides:?}: {error}"))
}

/// The scene of a text, with overrides on top.
#[track_caller]
pub fn scene_of(text: &str, overrides: &[&str]) -> Scene {
    let file = SceneFile::from_toml("scene.toml", text).and_then(|file| file.with(overrides));
    let scene = file.and_then(|file| file.scene());
    scene.unwrap_or_else(|error| panic!("{overrides:?}: {error}"))
}

#[track_caller]
pub fn run(scene: &Scene) -> Run {
    creepage::run(scene).unwrap_or_else(|error| panic!("{error}"))
}

pub fn last(run: &Run) -> &PassRecord {
    run.passes.last().expect("a pass")
}

/// The force downstream after each pass that the run lists \[N\].
pub fn forces(run: &Run) -> Vec<f64> {
    run.passes.iter().map(|pass| pass.downstream_force_n).collect()
}

/// The force downstream after the pass of this number \[N\].
#[track_caller]
pub fn force_after(run: &Run, pass: u64) -> f64 {
    let record = run.passes.iter().find(|record| record.pass == pass);
    record.expect("a listed pass").downstream_force_n
}

/// The largest size of these numbers.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// Asserts that `found` is the expected number within a share of it.
#[track_caller]
pub fn assert_near(found: f64, expected: f64, share: f64, what: impl Debug) {
    let off = (found - expected).abs();
    assert!(off <= share * expected.abs(), "{what:?}: {found}, not {expected}");
}

/// What is computed by so many threads.
pub fn by_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads").install(work)
}
