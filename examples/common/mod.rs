//! What the examples share: scenes, and where figures go.
#![allow(dead_code, reason = "every example uses its own part")]

use std::error::Error;
use std::path::{Path, PathBuf};

use creepage::Scene;

/// What can go wrong in an example.
pub type Failure = Box<dyn Error>;

/// The repository's root.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A scene of `examples/scenes`, with `KEY=VALUE` overrides.
///
/// # Errors
///
/// Those of the scene.
pub fn scene(name: &str, overrides: &[String]) -> Result<Scene, Failure> {
    let path = root().join("examples/scenes").join(name);
    Ok(creepage::SceneFile::read(&path).and_then(|file| file.with(overrides)?.scene())?)
}

/// Writes `svg` as `name` into the folder named by the first argument, docs/figures without one, and says so.
///
/// # Errors
///
/// Those of the file system.
pub fn save(name: &str, svg: &str) -> Result<(), Failure> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(|| root().join("docs/figures"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join(name), svg)?;
    println!("\nFigure: {name}");
    Ok(())
}

/// Evenly spaced numbers from `from` to `to`, both included.
pub fn even(from: f64, to: f64, steps: u32) -> impl Iterator<Item = f64> + Clone {
    (0..=steps).map(move |k| from + (to - from) * f64::from(k) / f64::from(steps))
}
