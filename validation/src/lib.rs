//! The laboratory behind docs/charts.md: what is measured here against independent or far finer answers.
//!
//! [`charts`] draw accuracy against cost, [`stability`] maps where methods fail, [`whole_range`] judges random scenes, and
//! [`occurrence`] computes the table of the crate `creepage-plan`. The other modules are what they share.

#![allow(
    missing_docs,
    clippy::missing_errors_doc,
    clippy::missing_panics_doc,
    reason = "a laboratory is read as source"
)]

pub mod bilinear;
pub mod cable_map;
pub mod charts;
pub mod computations;
pub mod ground_map;
pub mod ground_reference;
pub mod map;
pub mod occurrence;
pub mod passes;
pub mod precision;
pub mod stability;
pub mod stopwatch;
pub mod table;
pub mod whole_range;

use std::error::Error;
use std::path::{Path, PathBuf};

use creepage::{Scene, SceneFile};

/// What can go wrong in the laboratory.
pub type Failure = Box<dyn Error + Send + Sync>;

/// A file of the repository.
pub fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// The full-scale experiment's upper cable with some keys set.
pub fn upper(set: &[impl AsRef<str>]) -> Result<Scene, Failure> {
    let set: Vec<&str> = set.iter().map(AsRef::as_ref).collect();
    Ok(SceneFile::read(file("examples/scenes/full-scale-upper.toml"))?
        .with(&set)?
        .scene()?)
}

/// The largest size of these numbers.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| most.max(value.abs()))
}
