//! `creepage run`: the force after every pass.

use std::io::{self, Write};
use std::path::PathBuf;

use serde::Serialize;

use super::failure::Failure;
use super::limits::{CheckArgument, LimitArguments};
use super::outputs::{OutputArguments, further_output};
use super::progress::watched;
use super::shared::{Input, TrafficArguments};
use super::state::StartArgument;
use super::terminal;
use crate::words::{Answer, Fact, Reader, solved};
use crate::{Limits, PassRecord, Reached, Run, RunOptions, Verdict};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "What is printed, and a workbook, is in the units that were typed in limits and scene, where they suit; CSV and JSON are SI.

Examples:
  creepage run my-duct.toml
  creepage run my-duct.toml --set friction.dynamic_coefficient=0.3 --set vehicles.0.load=15tf
  creepage run my-duct.toml --json > answer.json
  creepage run my-duct.toml --csv forces.csv --verify
  creepage run my-duct.toml --xlsx forces.xlsx
  creepage run my-duct.toml --years 20 --trucks-per-day 800 --limit-force downstream=2kN --limit-movement 10mm
  creepage run my-duct.toml --years 10 --save-state after-10-years.json
  creepage run my-duct.toml --from-state after-10-years.json --years 5 --trucks-per-day 2000
  creepage run my-duct.toml --limit-force \"20 m=3kN\"   # of the clamp at 20 m; clamp=3kN for all clamps"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    /// Measure the error by a second run on a mesh twice as fine
    #[arg(long)]
    verify: bool,
    #[command(flatten)]
    limits: LimitArguments,
    #[command(flatten)]
    check: CheckArgument,
    #[command(flatten)]
    start: StartArgument,
    /// Write the cable as the last pass leaves it to this file, for --from-state
    #[arg(long, value_name = "FILE.json")]
    save_state: Option<PathBuf>,
    /// Write an Excel workbook to this file: answer, passes, force along the cable, clamps, days of heat, scene
    #[arg(long, value_name = "FILE.xlsx")]
    xlsx: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArguments,
}

/// The run, and what it makes of the limits, if there are any.
#[derive(Serialize)]
pub struct Judged<'a> {
    #[serde(flatten)]
    pub run: &'a Run,
    #[serde(flatten)]
    pub judgement: Option<Judgement>,
}

#[derive(Serialize)]
pub struct Judgement {
    /// Of the limit that is exceeded first; null if all are kept.
    limit_reached_after: Option<Reached>,
    pub limits: Vec<Verdict>,
}

impl Judgement {
    pub fn new(run: &Run, limits: &Limits) -> Self {
        let limits = limits.verdicts(run);
        let reached = limits.iter().filter_map(|verdict| verdict.reached_after);
        Self {
            limit_reached_after: reached.min_by_key(|reached| reached.pass),
            limits,
        }
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::of(arguments.scene.read()?)?;
    let limits = arguments.limits.limits(&input.scene)?;
    let table = input.table();
    let read = [
        Some(&*arguments.scene.file.scene),
        table.as_deref(),
        arguments.start.read(),
    ];
    let mut files = arguments.output.files(read.into_iter().flatten());
    let destination = arguments.output.destination(&mut files)?;
    let start = arguments.start.start()?;
    let (option, path) = ("--save-state", arguments.save_state.as_deref());
    let saved = further_output(&mut files, option, path, "json", "a file for --from-state")?;
    let (path, allowed) = (
        arguments.xlsx.as_deref(),
        "a workbook of Excel, such as forces.xlsx; a table of text is written with --csv",
    );
    let workbook = further_output(&mut files, "--xlsx", path, "xlsx", allowed)?;
    let reader = Reader::new(arguments.limits.units(input.file()), &input.scene);
    let words = |_| "passes on finer and finer meshes".to_owned();
    let run = watched(1.0, words, |progress| {
        let options = RunOptions {
            verify: arguments.verify,
            start: start.as_ref(),
            progress,
            ..RunOptions::default()
        };
        crate::run_with(&input.scene, &options)
    });
    let mut run = input.located(run)?;
    input.warn(&mut run.warnings);
    if let Some(saved) = &saved {
        let text = serde_json::to_vec(&run.state).map_err(io::Error::from)?;
        saved.write(&text)?;
    }
    let are_given = arguments.limits.are_given();
    let judged = Judged {
        run: &run,
        judgement: are_given.then(|| Judgement::new(&run, &limits)),
    };
    let judgement = judged.judgement.as_ref();
    let verdicts = judgement.map_or(&[][..], |judgement| &judgement.limits);
    let (scene, run) = (&input.scene, &run);
    let answer = Answer { scene, run, reader };
    if let Some(output) = &workbook {
        let bytes = crate::workbook::of_run(run, verdicts, input.file(), &reader.units);
        let bytes = bytes.map_err(|source| output.failed(source))?;
        output.write(&bytes)?;
    }
    destination.write(&judged, rows(&run.passes), || print(&answer, verdicts))?;
    arguments.check.judge(verdicts)
}

/// The last column of the table, 1 or 0 in every row, or in none: JSON leaves it out wherever it is false.
#[derive(Serialize)]
struct LastColumn {
    #[serde(skip_serializing_if = "Option::is_none")]
    interpolated: Option<u8>,
}

/// The rows of a table.
fn rows(passes: &[PassRecord]) -> impl Iterator<Item = (PassRecord, LastColumn)> {
    let any = passes.iter().any(|record| record.interpolated);
    passes.iter().map(move |record| {
        let last = LastColumn {
            interpolated: any.then_some(record.interpolated.into()),
        };
        let others = PassRecord {
            interpolated: false,
            ..*record
        };
        (others, last)
    })
}

fn print(answer: &Answer<'_>, verdicts: &[Verdict]) -> Result<(), Failure> {
    let mut out = terminal::out();
    let Answer { run, reader, .. } = answer;
    writeln!(out, "{}", terminal::line(&run.title))?;
    if let Some(start) = &run.start {
        writeln!(out, "begins with the cable after {} passes", start.passes)?;
    }
    let tables = [Some(answer.passes(true)), answer.days(), answer.clamps()];
    for table in tables.into_iter().flatten() {
        writeln!(out)?;
        terminal::table(&mut out, &table.head, &table.rows)?;
    }
    writeln!(out)?;
    for Fact { name, value, note } in answer.facts() {
        let (initial, rest) = name.split_at(1);
        writeln!(out, "{}{rest}: {value}, {note}", initial.to_lowercase())?;
    }
    let more = [answer.by_turns(), answer.heat().unwrap_or_default()];
    for sentence in more.iter().filter(|sentence| !sentence.is_empty()) {
        writeln!(out, "{}", sentence.trim_start())?;
    }
    if let Some(slip) = &run.slip_lengths {
        let [forward, backward] = [slip.forward, slip.backward].map(|length| reader.length(length));
        let what = "length of cable that slides under a vehicle at mid-duct";
        writeln!(out, "{what}: {forward} forward, {backward} backward")?;
    }
    writeln!(out, "{}", solved(&run.plan, reader))?;
    for reason in [&run.error_estimate.method].into_iter().chain(&run.plan.reasons) {
        writeln!(out, "  {}", terminal::sentence(reason))?;
    }
    for verdict in verdicts {
        writeln!(out, "{}", answer.verdict(verdict))?;
    }
    if verdicts.len() > 1 {
        writeln!(out, "{}", Verdict::summary(verdicts))?;
    }
    Ok(())
}
