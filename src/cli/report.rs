//! `creepage report`: a scene's answer as one page of HTML.

use std::ffi::OsStr;
use std::path::PathBuf;

use super::failure::Failure;
use super::limits::LimitArguments;
use super::progress::{HowFar, stopped, watched};
use super::readings::ReadArguments;
use super::shared::{Force, Input, TrafficArguments};
use super::terminal;
use crate::output::Kind;
use crate::report::{Report, ReportOptions};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The page holds scene, numbers, figures and ways to hold the cable; it needs no network and nothing beside it.

Examples:
  creepage report my-duct.toml -o my-duct.html
  creepage report my-duct.toml -o my-duct.html --data load-cell.csv
  creepage report my-duct.toml -o my-duct.html --years 20 --trucks-per-day 800 --limit-force 2kN --limit-movement downstream=10mm
  creepage report my-duct.toml -o stiffer.html --set ground.vertical_peak=90um"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    /// Page to write (HTML); an older page is replaced
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Readings to draw over the force: a table (text or .xlsx) with columns such as pass,force_n[,sigma_n] or `Pass;Force [kN]`, at the
    /// held end (the downstream one if both are)
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,
    #[command(flatten)]
    limits: LimitArguments,
    #[command(flatten)]
    force: Force,
    #[command(flatten)]
    reading: ReadArguments,
}

/// Formats that somebody may expect by the name's ending, and none of which this is.
const OTHER_FORMATS: [&str; 7] = ["csv", "docx", "json", "pdf", "png", "svg", "xlsx"];

impl Arguments {
    /// Refuses a page by the name of another format, which no program would open.
    fn page_is_html(&self) -> Result<(), Failure> {
        let ending = self.output.extension().map(OsStr::to_ascii_lowercase);
        if OTHER_FORMATS
            .iter()
            .any(|other| ending.as_deref() == Some(other.as_ref()))
        {
            return Err(Failure::Usage {
                argument: "--output",
                found: self.output.display().to_string(),
                allowed: "a page of HTML, such as my-duct.html, which a browser also prints to PDF".into(),
            });
        }
        Ok(())
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::of(arguments.scene.read()?)?;
    let limits = arguments.limits.limits(input.scene.ends)?;
    let readings = arguments
        .data
        .as_deref()
        .map(|file| arguments.reading.read(file))
        .transpose()?;
    for note in readings.iter().flat_map(crate::Readings::notes) {
        terminal::warn(note);
    }
    let table = input.table();
    let read = [
        Some(&*arguments.scene.file.scene),
        arguments.data.as_deref(),
        table.as_deref(),
    ];
    let mut files = arguments.force.files(read.into_iter().flatten());
    let page = files.output(&arguments.output, Kind::Page)?;
    arguments.page_is_html()?;
    let how_far = |now| HowFar::new(now, "the scene's run, then ways to hold the cable");
    let keep = |_| stopped("no page is written");
    let report = watched(how_far, keep, |progress| {
        Report::new(
            &input.scene,
            &ReportOptions {
                readings: readings.as_ref(),
                warnings: &input.warnings,
                limits,
                progress,
                ..ReportOptions::default()
            },
        )
    });
    let report = input.located(report)?;
    input.warn_all(&report.run().warnings);
    Ok(page.write(|out| out.write_all(report.to_html().as_bytes()))?)
}
