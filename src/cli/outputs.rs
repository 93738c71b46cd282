//! Where the answer of a command goes: to the terminal, as JSON, as a table, to files.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::failure::Failure;
use super::signals;
use crate::output::{Files, Output};

/// What stands for standard output in place of a file.
const STDOUT: &str = "-";
/// Endings of names by which other programs open a file.
const FORMATS: [&str; 10] = [
    "csv", "docx", "html", "json", "ods", "pdf", "png", "svg", "xls", "xlsx",
];

#[derive(Debug, clap::Args)]
pub struct OutputArguments {
    #[command(flatten)]
    json: Json,
    /// Write a table to this file; with - only the table is printed
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    force: Force,
}

#[derive(Debug, Clone, Copy, clap::Args)]
pub struct Json {
    /// Print only JSON to standard output
    #[arg(long)]
    json: bool,
}

/// Whether files that are not this command's own are replaced.
#[derive(Debug, clap::Args)]
pub struct Force {
    /// Overwrite any file. Without it, only a file whose name ends as the output's does is overwritten (by
    /// `new`, none). Input files never are
    #[arg(long)]
    pub force: bool,
}

impl Force {
    /// What a command reads and writes. When the process is stopped, nothing half written is left.
    pub fn files<'p>(&self, read: impl IntoIterator<Item = &'p Path>) -> Files {
        signals::listen();
        Files::reading(read, self.force)
    }
}

impl Json {
    /// Prints the answer as one JSON document or by `print`.
    pub fn print<T: Serialize + ?Sized>(
        self,
        answer: &T,
        print: impl FnOnce() -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if !self.json {
            return print();
        }
        // Through a string, so that a document is written whole or not at all.
        let text = serde_json::to_string_pretty(answer).map_err(io::Error::from)?;
        Ok(writeln!(io::stdout().lock(), "{text}")?)
    }
}

/// The file at `path`, which can be written and has no name of another format; before hours of computing, and an older one stays as it is till
/// then. `allowed` says what `argument` takes.
pub fn output(
    files: &mut Files,
    argument: &'static str,
    path: &Path,
    ending: &'static str,
    allowed: &str,
) -> Result<Output, Failure> {
    let output = files.output(path, ending)?;
    let own = path.extension().unwrap_or_default();
    let is_other = |other: &&str| *other != ending && own.eq_ignore_ascii_case(other);
    // Excel opens a workbook under its own ending alone.
    let is_strange = ending == "xlsx" && !own.is_empty() && !own.eq_ignore_ascii_case(ending);
    if is_strange || FORMATS.iter().any(is_other) {
        return Err(Failure::usage(argument, path.display().to_string(), allowed));
    }
    Ok(output)
}

/// The same where a file is named at all, of what stands in no row with the answer: it is not standard output.
pub fn further_output(
    files: &mut Files,
    argument: &'static str,
    path: Option<&Path>,
    ending: &'static str,
    allowed: &str,
) -> Result<Option<Output>, Failure> {
    let Some(path) = path else { return Ok(None) };
    let output = output(files, argument, path, ending, allowed)?;
    if path == Path::new(STDOUT) || output.is_standard_output() {
        let found = format!("`{}`, standard output", path.display());
        return Err(Failure::usage(argument, found, allowed));
    }
    Ok(Some(output))
}

/// Where the answer and its table go.
pub struct Destination {
    json: Json,
    table: Option<Output>,
    /// Whether the table goes to standard output in place of the answer.
    is_table_alone: bool,
}

impl OutputArguments {
    /// What a command reads and writes.
    pub fn files<'p>(&self, read: impl IntoIterator<Item = &'p Path>) -> Files {
        self.force.files(read)
    }

    /// Makes sure before hours of computing that the table can be written.
    pub fn destination(&self, files: &mut Files) -> Result<Destination, Failure> {
        let allowed = "a table of text, such as forces.csv; `creepage run` writes a workbook with --xlsx";
        let is_table_alone = self.csv.as_deref() == Some(Path::new(STDOUT));
        let path = self.csv.as_deref().filter(|_| !is_table_alone);
        let table = path.map(|path| output(files, "--csv", path, "csv", allowed));
        let table = table.transpose()?;
        let is_on_stdout = is_table_alone || table.as_ref().is_some_and(Output::is_standard_output);
        if self.json.json && is_on_stdout {
            let found = "standard output, where --json prints";
            return Err(Failure::usage("--csv", found, "another file with --json"));
        }
        Ok(Destination {
            json: self.json,
            table,
            is_table_alone,
        })
    }
}

impl Destination {
    /// Writes the answer and its table, one row a record with the record's fields as columns.
    pub fn write<T: Serialize, R: Serialize>(
        &self,
        answer: &T,
        rows: impl IntoIterator<Item = R>,
        print: impl FnOnce() -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if self.is_table_alone {
            return Ok(io::stdout().lock().write_all(&csv(rows)?)?);
        }
        if let Some(file) = &self.table {
            file.write(&csv(rows)?)?;
        }
        self.json.print(answer, print)
    }
}

fn csv<R: Serialize>(rows: impl IntoIterator<Item = R>) -> Result<Vec<u8>, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).map_err(io::Error::from)?;
    }
    Ok(writer.into_inner().map_err(csv::IntoInnerError::into_error)?)
}
