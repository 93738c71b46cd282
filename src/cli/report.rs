//! `creepage report`: a scene's answer as one page of HTML.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use chrono::{DateTime, Utc};

use super::failure::Failure;
use super::limits::{CheckArgument, LimitArguments};
use super::outputs::{Force, output};
use super::progress::watched;
use super::readings::ReadArguments;
use super::shared::{Input, TrafficArguments, UncertainArguments};
use super::state::StartArgument;
use super::terminal;
use crate::Scene;
use crate::measures::Study;
use crate::report::{Report, ReportOptions, Source};

/// Share of the progress that measures have where they are compared.
const MEASURES_SHARE: f64 = 0.9;
/// Names the time of a page in place of the clock.
const EPOCH: &str = "SOURCE_DATE_EPOCH";

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The page holds scene, numbers, figures and, given limits, the measures that keep them; it needs no network and no other file. It names the files it was made from with their SHA-256, and the date: that of SOURCE_DATE_EPOCH (seconds since 1970) where the environment has it. It is in the units that were typed in limits and scene, where they suit.

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
    #[arg(long, value_name = "FILE", conflicts_with = "from_state")]
    data: Option<PathBuf>,
    #[command(flatten)]
    start: StartArgument,
    #[command(flatten)]
    limits: LimitArguments,
    #[command(flatten)]
    uncertain: UncertainArguments,
    #[command(flatten)]
    check: CheckArgument,
    #[command(flatten)]
    force: Force,
    #[command(flatten)]
    reading: ReadArguments,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::of(arguments.uncertain.on(&arguments.scene.read()?)?)?;
    let limits = arguments.limits.limits(&input.scene)?;
    let readings = arguments.data.as_deref().map(|file| arguments.reading.read(file));
    let readings = readings.transpose()?;
    for note in readings.iter().flat_map(|readings| &readings.notes) {
        terminal::warn(note);
    }
    let table = input.table();
    let read = [
        Some(&*arguments.scene.file.scene),
        arguments.data.as_deref(),
        table.as_deref(),
        arguments.start.read(),
    ];
    let sources = sources(&input, &read)?;
    let overrides = arguments.scene.overrides();
    let date = date()?;
    let mut files = arguments.force.files(read.into_iter().flatten());
    let allowed = "a page of HTML, such as my-duct.html, which a browser also prints to PDF";
    let page = output(&mut files, "--output", &arguments.output, "html", allowed)?;
    let start = arguments.start.start()?;
    // Days of heat take long: what nobody asked for is not assumed there.
    let is_asked = input.scene.heat.is_none() || !input.scene.uncertain.is_empty();
    let study = arguments.limits.are_given() && start.is_none() && is_asked;
    let study = study.then(|| Study::new(input.file())).transpose()?;
    let words = |_| "the scene's run, and measures where limits are given".to_owned();
    let report = watched(1.0, words, |progress| {
        let limits_of = |scene: &Scene| arguments.limits.wherever_they_are(scene);
        let compare = |study: &Study| study.compare(&limits_of, progress.part(0.0, MEASURES_SHARE));
        let compared = study.as_ref().map(compare).transpose()?;
        let begin = compared.as_ref().map_or(0.0, |_| MEASURES_SHARE);
        let options = ReportOptions {
            readings: readings.as_ref(),
            warnings: &input.warnings,
            limits,
            units: arguments.limits.units(input.file()),
            start: start.as_ref(),
            sources: &sources,
            overrides: &overrides,
            date: Some(&date),
            compared: compared.as_ref(),
            progress: progress.part(begin, 1.0),
        };
        Report::new(&input.scene, &options)
    });
    let report = input.located(report)?;
    input.warn_all(&report.run().warnings);
    terminal::warn_all(report.mistakes());
    page.write(report.to_html().as_bytes())?;
    arguments.check.judge(report.verdicts())
}

/// The files that are read, the scene's first.
fn sources(input: &Input, read: &[Option<&Path>]) -> Result<Vec<Source>, Failure> {
    let mut sources = Vec::new();
    for (index, path) in read.iter().flatten().enumerate() {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        // What was computed; a pipe can be read only once.
        if index == 0 {
            sources.push(Source::new(name, input.file().text().as_bytes()));
        } else if path.is_file() {
            sources.push(Source::new(name, &std::fs::read(path)?));
        }
    }
    Ok(sources)
}

/// The time of this page: now, or that of `SOURCE_DATE_EPOCH` \[s since 1970\] for a page that can be made again to the last byte
/// (reproducible-builds.org/specs/source-date-epoch).
pub fn date() -> Result<String, Failure> {
    let time = match std::env::var(EPOCH) {
        Err(_) => DateTime::<Utc>::from(SystemTime::now()),
        Ok(text) => {
            let seconds = text.trim().parse().ok();
            let time = seconds.and_then(|seconds| DateTime::from_timestamp(seconds, 0));
            time.ok_or_else(|| {
                let found = format!("`{text}` in the environment");
                Failure::usage(EPOCH, found, "seconds since 1970, such as 1700000000")
            })?
        }
    };
    Ok(time.format("%Y-%m-%d %H:%M UTC").to_string())
}
