//! Answers as JSON and CSV.

use std::io::Write;
use std::path::Path;

use serde::Serialize;

use super::arguments::{Force, OutputArguments};
use super::{Failure, signals};
use crate::output::{Files, Kind, Output};
use crate::{Profile, finite};

/// What a command reads and writes. When the process is stopped, nothing half written is left.
pub fn files<'p>(read: impl IntoIterator<Item = &'p Path>, force: &Force) -> Files {
    signals::clean_up_when_stopped();
    Files::reading(read, force.force)
}

/// Where a table goes.
pub enum Table {
    StandardOutput,
    File(Output),
}

/// The table that is asked for, made sure before hours of computing that it can be written; an older one stays as it is till then.
pub fn table<'p>(
    output: &OutputArguments,
    kind: Kind,
    read: impl IntoIterator<Item = &'p Path>,
) -> Result<Option<Table>, Failure> {
    let Some(file) = &output.csv else { return Ok(None) };
    let table = if output.is_on_stdout() {
        Table::StandardOutput
    } else {
        Table::File(files(read, &output.force).output(file, kind)?)
    };
    let is_standard_output = match &table {
        Table::StandardOutput => true,
        Table::File(file) => file.is_standard_output(),
    };
    if output.json && is_standard_output {
        return Err(Failure::Usage {
            argument: "--csv".into(),
            found: format!("`{}`, standard output, where --json prints", file.display()),
            allowed: "a file beside --json".into(),
        });
    }
    Ok(Some(table))
}

impl Table {
    /// Writes one row a record, with the record's fields as columns.
    pub fn write<T: Serialize>(&self, rows: impl IntoIterator<Item = T>) -> Result<(), Failure> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in rows {
            finite::check(&row)?;
            writer.serialize(row).map_err(std::io::Error::from)?;
        }
        let text = writer.into_inner().map_err(csv::IntoInnerError::into_error)?;
        match self {
            Self::StandardOutput => Ok(std::io::stdout().lock().write_all(&text)?),
            Self::File(file) => Ok(file.write(|out| out.write_all(&text))?),
        }
    }
}

/// One JSON document on standard output.
pub fn json<T: Serialize + ?Sized>(answer: &T) -> Result<(), Failure> {
    finite::check(answer)?;
    let mut out = std::io::stdout().lock();
    // Through a string, so that a document is written whole or not at all.
    let text = serde_json::to_string_pretty(answer)?;
    writeln!(out, "{text}")?;
    Ok(())
}

/// A row of a profile's table.
#[derive(Serialize)]
pub struct Motion {
    position_m: f64,
    longitudinal_m: f64,
    vertical_m: f64,
    longitudinal_velocity_m_per_s: f64,
}

/// One row a position.
pub fn motion(profile: &Profile) -> impl Iterator<Item = Motion> {
    (0..profile.positions_m.len()).map(|i| Motion {
        position_m: profile.positions_m[i],
        longitudinal_m: profile.longitudinal_m[i],
        vertical_m: profile.vertical_m[i],
        longitudinal_velocity_m_per_s: profile.longitudinal_velocity_m_per_s[i],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_document_and_no_table_holds_a_number_that_is_none() {
        let row = Motion {
            position_m: 0.0,
            longitudinal_m: f64::NAN,
            vertical_m: 0.0,
            longitudinal_velocity_m_per_s: 0.0,
        };
        let failures = [
            json(&row),
            json(&[Some(f64::INFINITY)]),
            Table::StandardOutput.write([row]),
        ];
        for failure in failures {
            let Err(Failure::Analysis(error)) = failure else {
                panic!("it was written");
            };
            assert!(
                matches!(error, crate::Error::NotFinite { .. }) && !error.is_bad_input(),
                "{error}"
            );
        }
    }
}
