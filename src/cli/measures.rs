//! `creepage measures`: what one would fit, and whether it holds whatever is not known.

use std::io::Write;
use std::path::PathBuf;

use super::failure::Failure;
use super::limits::LimitArguments;
use super::outputs::{Force, further_output};
use super::progress::watched;
use super::shared::{Input, Json, TrafficArguments, UncertainArguments};
use super::terminal;
use crate::Scene;
use crate::measures::{Comparison, Study};
use crate::words::Reader;
use crate::words::measures::{failures, measures, recommendation, uncertain};

#[derive(Debug, clap::Args)]
#[command(
    group = clap::ArgGroup::new("limit").args(["limit_force", "limit_movement"]).multiple(true).required(true),
    after_help = "Every measure is run in every combination of the lowest, the middle and the highest value of what is uncertain, friction at five places, and then \
closer around the worst: neither end of an interval is the safe one. Without [uncertain] friction is assumed to be from 0.2 to 0.5, and the ground's deflection \
to be known to a factor of two.

Measures are those of the scene, [[measures]] with name, upstream, downstream, restraints (in place of the scene's), added_restraints and cost, or a list built in. \
The cheapest that holds is recommended; without costs the one with the fewest parts. Where none holds, the exit status is 1.

Examples:
  creepage measures my-duct.toml --limit-force 3kN --limit-movement 15mm
  creepage measures my-duct.toml --limit-force 3kN --uncertain friction.dynamic_coefficient=0.2:0.5 --uncertain ground.vertical_peak=90um:150um
  creepage measures my-duct.toml --limit-force 3kN --limit-force \"99 m=5kN\" --years 20 --trucks-per-day 800 --xlsx measures.xlsx"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    #[command(flatten)]
    uncertain: UncertainArguments,
    #[command(flatten)]
    limits: LimitArguments,
    /// Write an Excel workbook to this file: measures, every combination, scene
    #[arg(long, value_name = "FILE.xlsx")]
    xlsx: Option<PathBuf>,
    #[command(flatten)]
    force: Force,
    #[command(flatten)]
    json: Json,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let file = arguments.uncertain.on(&arguments.scene.read()?)?;
    let input = Input::of(file)?;
    arguments.limits.warn_of_slips();
    let table = input.table();
    let read = [Some(&*arguments.scene.file.scene), table.as_deref()];
    let mut files = arguments.force.files(read.into_iter().flatten());
    let (xlsx, allowed) = (&arguments.xlsx, "a workbook of Excel, such as measures.xlsx");
    let workbook = further_output(&mut files, "--xlsx", xlsx.as_deref(), "xlsx", allowed)?;
    let study = Study::new(input.file())?;
    // A limit of a clamp that no measure has would say nothing.
    arguments.limits.limits_with(&input.scene, &study.clamps())?;
    let comparison = input.located(compared(&study, &arguments.limits))?;
    let reader = Reader::new(arguments.limits.units(input.file()), &input.scene);
    if let Some(output) = &workbook {
        let bytes = crate::workbook::of_measures(&comparison, &reader, input.file());
        let bytes = bytes.map_err(|source| output.failed(source))?;
        output.write(&bytes)?;
    }
    let words = || print(&comparison, &reader);
    arguments.json.print(&comparison, words)?;
    if comparison.recommended.is_some() {
        return Ok(());
    }
    let none = "no measure holds in every combination: what comes nearest is on standard output";
    Err(Failure::NotKept(none.to_owned()))
}

/// Makes the runs, and says how many there may be.
pub fn compared(study: &Study, limits: &LimitArguments) -> Result<Comparison, crate::Error> {
    let [combinations, count, most] = study.size();
    let words = |_| format!("{count} measures in {combinations} combinations, at most {most} runs");
    watched(1.0, words, |progress| {
        study.compare(&|scene: &Scene| limits.wherever_they_are(scene), progress)
    })
}

fn print(comparison: &Comparison, reader: &Reader) -> Result<(), Failure> {
    let mut out = terminal::out();
    let (title, passes) = (terminal::line(&comparison.title), comparison.passes);
    writeln!(
        out,
        "{title}: measures, {passes} passes\nuncertain: {}\n",
        uncertain(comparison)
    )?;
    let table = measures(comparison, reader);
    terminal::table(&mut out, &table.head, &table.rows)?;
    writeln!(out)?;
    for failure in failures(comparison) {
        writeln!(out, "{}", terminal::sentence(&failure))?;
    }
    Ok(writeln!(out, "{}", recommendation(comparison, reader))?)
}
