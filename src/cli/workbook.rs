//! Workbooks on the command line.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::shared::{STDOUT, has_ending, is_taken};
use crate::output::{Files, Output};
use crate::words::Answer;
use crate::{SceneFile, Verdict, workbook};

#[derive(Debug, clap::Args)]
pub struct WorkbookArguments {
    /// Write an Excel workbook to this file: answer, passes, force along the cable, clamps, days of heat, parts of the error, scene
    #[arg(long, value_name = "FILE.xlsx")]
    xlsx: Option<PathBuf>,
}

/// Where the workbook goes, if there is to be one.
pub struct Destination(Option<Output>);

impl WorkbookArguments {
    /// Makes sure before hours of computing that the workbook can be written.
    pub fn destination(&self, files: &mut Files) -> Result<Destination, Failure> {
        let Some(path) = &self.xlsx else {
            return Ok(Destination(None));
        };
        let output = files.output(path, "xlsx");
        if path.extension().is_some() && !has_ending(path, &["xlsx"]) && !is_taken(&output) {
            return Err(Failure::Usage {
                argument: "--xlsx",
                found: path.display().to_string(),
                allowed: "a workbook of Excel, such as forces.xlsx; a table of text is written with --csv"
                    .into(),
            });
        }
        let output = output?;
        if path == Path::new(STDOUT) || output.is_standard_output() {
            return Err(Failure::Usage {
                argument: "--xlsx",
                found: format!("`{}`, standard output", path.display()),
                allowed: "a file: a workbook is no text".into(),
            });
        }
        Ok(Destination(Some(output)))
    }
}

impl Destination {
    /// Writes a run.
    pub fn write(&self, answer: &Answer<'_>, verdicts: &[Verdict], file: &SceneFile) -> Result<(), Failure> {
        let Some(output) = &self.0 else { return Ok(()) };
        let bytes = workbook::of_run(answer.run, verdicts, file, &answer.reader.units);
        let bytes = bytes.map_err(|source| output.failed(source))?;
        Ok(output.write(|out| out.write_all(&bytes))?)
    }
}
