//! `creepage report`: a scene's answer as one page of HTML.

use std::path::{Path, PathBuf};

use super::arguments::SceneArguments;
use super::input::Input;
use super::{Failure, write};
use crate::calibration::Readings;
use crate::report::{Report, ReportOptions};

/// Arguments of `creepage report`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "The page holds scene, numbers, figures and ways to hold the cable; it needs no network and nothing beside it.

Examples:
  creepage report my-duct.toml -o my-duct.html
  creepage report my-duct.toml -o my-duct.html --data load-cell.csv
  creepage report my-duct.toml -o stiffer.html --set ground.vertical_peak=90um"
)]
pub struct Arguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Page to write (HTML); an older one is replaced
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Readings to draw over the force: CSV with the columns pass,force_n[,sigma_n], at the held end (the downstream one if both are)
    #[arg(long, value_name = "FILE")]
    pub data: Option<PathBuf>,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::read(&arguments.scene)?;
    let readings = arguments
        .data
        .as_deref()
        .map(Readings::from_file)
        .transpose()
        .map_err(crate::Error::from)?;
    let sources = [Some(&arguments.scene.scene), arguments.data.as_ref()];
    if sources
        .into_iter()
        .flatten()
        .any(|source| same_file(source, &arguments.output))
    {
        return Err(Failure::Usage {
            argument: "--output".into(),
            found: format!("{}, which is read", arguments.output.display()),
            allowed: "another file".into(),
        });
    }
    let page = write::Replacement::of(&arguments.output)?;
    let report = super::with_progress(|progress| {
        Report::new(
            &input.scene,
            &ReportOptions {
                readings: readings.as_ref(),
                warnings: &input.warnings,
                progress: Some(progress),
                ..ReportOptions::default()
            },
        )
    });
    let report = input.judged(report)?;
    super::warn(&report.run().warnings);
    page.write(&report.to_html())
}

fn same_file(one: &Path, other: &Path) -> bool {
    match (one.canonicalize(), other.canonicalize()) {
        (Ok(one), Ok(other)) => one == other,
        _ => false,
    }
}
