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
pub mod whole_range;

use std::error::Error;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Command;

use creepage::{Scene, SceneFile};

/// What can go wrong in the laboratory.
pub type Failure = Box<dyn Error + Send + Sync>;

/// A file of the repository.
pub fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// Writes a table, after a line that names the program of its numbers.
pub fn write_table(file: &Path, table: &str) -> Result<(), Failure> {
    let (version, commit) = (
        env!("CARGO_PKG_VERSION"),
        commit().unwrap_or("unknown".to_owned()),
    );
    Ok(std::fs::write(
        file,
        format!("# creepage {version}, commit {commit}\n{table}"),
    )?)
}

/// A table without that line.
pub fn read_table(file: &Path) -> Result<csv::Reader<File>, csv::Error> {
    csv::ReaderBuilder::new().comment(Some(b'#')).from_path(file)
}

/// The last commit of the sources, and whether they have changed since; `None` where git does not say.
fn commit() -> Option<String> {
    const SOURCES: [&str; 5] = ["--", "src", "crates/*/src/*", "validation/src", "Cargo.lock"];
    let git = |arguments: &[&str]| {
        let mut git = Command::new("git");
        let output = git
            .current_dir(file(""))
            .args(arguments)
            .args(SOURCES)
            .output()
            .ok()?;
        let said = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| said.trim().to_owned())
    };
    let changes = git(&["status", "--porcelain"])?;
    let and_changes = if changes.is_empty() { "" } else { " with changes" };
    Some(git(&["log", "-1", "--format=%h"])? + and_changes)
}

/// The full-scale experiment's upper cable with some keys set.
pub fn upper(set: &[impl AsRef<str>]) -> Result<Scene, Failure> {
    let set: Vec<&str> = set.iter().map(AsRef::as_ref).collect();
    Ok(SceneFile::read(file("examples/scenes/full-scale-upper.toml"))?
        .with(&set)?
        .scene()?)
}
