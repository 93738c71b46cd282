//! `creepage plan`: which models would be used, and why.

use std::io::Write;

use super::failure::Failure;
use super::outputs::Json;
use super::progress::watched;
use super::shared::{Input, TrafficArguments};
use super::terminal;
use crate::PlanReport;
use crate::occurrence::Occurrence;
use crate::scene::four_digits;
use crate::shown::{percent, spacing, time, words_if};
use crate::words::candidates;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  creepage plan my-duct.toml
  creepage plan my-duct.toml --set solver.tolerance=0.05 --json")]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    #[command(flatten)]
    json: Json,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::of(arguments.scene.read()?)?;
    let words = |_| "choosing ground, method and mesh".to_owned();
    let plan = watched(1.0, words, |_| {
        crate::plan(&input.scene).map(|plan| plan.report())
    });
    let mut plan = input.located(plan)?;
    input.warn(&mut plan.warnings);
    arguments.json.print(&plan, || print(&plan))
}

/// What is chosen, and every candidate.
fn print(plan: &PlanReport) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(out, "{}", terminal::line(&plan.title))?;
    let error = plan
        .estimated_error
        .map(|error| format!("about {}", percent(error)));
    let error = error.unwrap_or("not known before the run".into());
    let [node, step] = [plan.node_spacing_m, plan.vehicle_step_m].map(spacing);
    let (ground, cable, time) = (&plan.ground, &plan.cable, time(plan.estimated_seconds));
    writeln!(
        out,
        "ground {ground}, cable {cable}, node spacing {node} m, vehicle step {step} m; error {error}, time about {time}"
    )?;
    if let Some(occurrence) = &plan.occurrence {
        print_occurrence(&mut out, occurrence)?;
    }
    writeln!(out)?;
    let table = candidates(&plan.candidates);
    Ok(terminal::table(&mut out, &table.head, &table.rows)?)
}

/// A go or no-go before anything is run.
fn print_occurrence(out: &mut impl Write, occurrence: &Occurrence) -> Result<(), Failure> {
    write!(out, "Q = q z²/(EA max|D_l|) = {:.2}: ", occurrence.q_number)?;
    if occurrence.creeps() {
        write!(
            out,
            "{:.0} % of the friction stays locked in at saturation; at most about {} N in this duct, whatever the friction",
            100.0 * occurrence.locked_share,
            four_digits(occurrence.ceiling_n)
        )?;
    } else {
        write!(out, "nothing creeps")?;
    }
    let rough = words_if(
        occurrence.rough,
        " (rough: the numbers are those of one concentrated load on a half-space)",
    );
    Ok(writeln!(out, "{rough}")?)
}
