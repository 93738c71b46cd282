//! Answers as JSON and CSV.

#[cfg(feature = "plot")]
use std::io::ErrorKind;
use std::io::Write;
use std::path::Path;
#[cfg(feature = "plot")]
use std::path::PathBuf;

use serde::Serialize;

use super::Failure;
use super::arguments::{OutputArguments, STDOUT};
use crate::{PassRecord, Profile};

/// Makes sure that the table can be written, before hours of computing; an older table stays as it is.
pub fn writable(output: &OutputArguments) -> Result<(), Failure> {
    let Some(file) = &output.csv else { return Ok(()) };
    if output.is_on_stdout() {
        if output.json {
            return Err(Failure::Usage {
                argument: "--csv".into(),
                found: "`-`, standard output, where --json prints".into(),
                allowed: "a file beside --json".into(),
            });
        }
        return Ok(());
    }
    creatable(file)
}

/// Makes sure that `file` can be written, and leaves what is in it.
pub fn creatable(file: &Path) -> Result<(), Failure> {
    std::fs::OpenOptions::new()
        .append(true)
        .create(true)
        .open(file)
        .map(drop)
        .map_err(|source| unwritable(file, source))
}

/// Writes a text file.
#[cfg(feature = "plot")]
pub fn text(file: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(file, text).map_err(|source| unwritable(file, source))
}

/// A file to be replaced as a whole: what was there stays until the new text is complete.
#[cfg(feature = "plot")]
pub struct Replacement {
    target: PathBuf,
    /// Where the text is written first, beside the target.
    partial: PathBuf,
}

#[cfg(feature = "plot")]
impl Replacement {
    /// Makes sure that `file` can be written, before anything is computed.
    pub fn of(file: &Path) -> Result<Self, Failure> {
        // A link stays one, and what it points to is replaced.
        let target = std::fs::canonicalize(file).unwrap_or_else(|_| file.to_owned());
        let refused = |kind, reason: &str| unwritable(file, std::io::Error::new(kind, reason));
        if target.exists() && !target.is_file() {
            return Err(refused(ErrorKind::InvalidInput, "it is not a file"));
        }
        let Some(name) = target.file_name() else {
            return Err(refused(ErrorKind::InvalidInput, "it has no name"));
        };
        let mut partial = std::ffi::OsString::from(".");
        partial.push(name);
        partial.push(format!(".{}.partial", std::process::id()));
        let partial = target.with_file_name(partial);
        std::fs::write(&partial, "").map_err(|source| unwritable(file, source))?;
        Ok(Self { target, partial })
    }

    /// Puts `text` in the file's place.
    pub fn write(self, text: &str) -> Result<(), Failure> {
        std::fs::write(&self.partial, text)
            .and_then(|()| std::fs::rename(&self.partial, &self.target))
            .map_err(|source| unwritable(&self.target, source))
    }
}

#[cfg(feature = "plot")]
impl Drop for Replacement {
    /// Leaves nothing behind where the text never came.
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.partial);
    }
}

fn unwritable(file: &Path, source: std::io::Error) -> Failure {
    Failure::Unwritable {
        file: file.display().to_string(),
        source,
    }
}

/// One JSON document on standard output.
pub fn json<T: Serialize>(answer: &T) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    // Through a string, so that a document is written whole or not at all.
    let text = serde_json::to_string_pretty(answer)?;
    writeln!(out, "{text}")?;
    Ok(())
}

/// One row a pass.
pub fn passes(file: &Path, passes: &[PassRecord]) -> Result<(), Failure> {
    rows(file, passes.iter())
}

#[derive(Serialize)]
struct ProfileRow {
    position_m: f64,
    longitudinal_m: f64,
    vertical_m: f64,
    longitudinal_velocity_m_per_s: f64,
}

/// One row a position.
pub fn profile(file: &Path, profile: &Profile) -> Result<(), Failure> {
    rows(
        file,
        (0..profile.positions_m.len()).map(|i| ProfileRow {
            position_m: profile.positions_m[i],
            longitudinal_m: profile.longitudinal_m[i],
            vertical_m: profile.vertical_m[i],
            longitudinal_velocity_m_per_s: profile.longitudinal_velocity_m_per_s[i],
        }),
    )
}

/// One row a record, with the record's fields as columns.
pub fn rows<T: Serialize>(file: &Path, rows: impl Iterator<Item = T>) -> Result<(), Failure> {
    let write = || -> Result<(), csv::Error> {
        let out: Box<dyn Write> = if file == Path::new(STDOUT) {
            Box::new(std::io::stdout().lock())
        } else {
            Box::new(std::fs::File::create(file)?)
        };
        let mut writer = csv::Writer::from_writer(out);
        for row in rows {
            writer.serialize(row)?;
        }
        writer.flush()?;
        Ok(())
    };
    write().map_err(|source| {
        if file != Path::new(STDOUT) {
            return Failure::Write {
                file: file.display().to_string(),
                source,
            };
        }
        match source.into_kind() {
            csv::ErrorKind::Io(source) => Failure::Output(source),
            kind => Failure::Output(std::io::Error::other(format!("{kind:?}"))),
        }
    })
}
