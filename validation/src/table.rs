//! Tables, each with the program of its numbers in its first line.

use std::fs::File;
use std::path::Path;
use std::process::Command;

use crate::Failure;

/// Writes a table, after a line that names the program of its numbers.
pub fn write(file: &Path, table: &str) -> Result<(), Failure> {
    let (version, commit) = (
        env!("CARGO_PKG_VERSION"),
        commit().unwrap_or_else(|| "unknown".to_owned()),
    );
    Ok(std::fs::write(
        file,
        format!("# creepage {version}, commit {commit}\n{table}"),
    )?)
}

/// A table without that line.
pub fn read(file: &Path) -> Result<csv::Reader<File>, csv::Error> {
    csv::ReaderBuilder::new().comment(Some(b'#')).from_path(file)
}

/// The last commit of the program's sources, and whether they have changed since; `None` if git does not say.
fn commit() -> Option<String> {
    const SOURCES: [&str; 4] = ["--", "src", "crates/*/src/*", "Cargo.lock"];
    let git = |arguments: &[&str]| {
        let mut git = Command::new("git");
        let output = git
            .current_dir(crate::file(""))
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
