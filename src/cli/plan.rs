//! `creepage plan`: which models would be used, and why.

use std::io::Write;

use super::failure::Failure;
use super::progress::{HowFar, Now, stopped, watched};
use super::shared::{Input, Json, TrafficArguments};
use super::terminal;
use crate::error::with_causes;
use crate::occurrence::Occurrence;
use crate::shown::{four_digits, percent, spacing, time};
use crate::{Forecast, Part, PlanReport};

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
    let how_far = |now: Now| HowFar::unknown("choosing ground, method and mesh", now.elapsed);
    let keep = |_| stopped("nothing is planned");
    let (mut plan, solver, forecast) = watched(how_far, keep, |_| {
        let plan = input.located(crate::plan(&input.scene))?;
        let forecast = crate::forecast(&plan);
        let solver = plan.choice.method.cable_method().name();
        Ok::<_, Failure>((plan.report(), solver, forecast))
    })?;
    match forecast {
        Ok(forecast) => foresee(&mut plan, &forecast, solver),
        Err(error) => plan.warnings.push(format!(
            "the time is a rough estimate, and the run may fail: the first passes on a coarse mesh do ({})",
            with_causes(&error)
        )),
    }
    input.warn(&mut plan.warnings);
    arguments.json.print(&plan, || print(&plan))
}

/// Times are those of whole runs, not of their first meshes: as many times those of the first as for every pass by the `solver`. The error has
/// what passes leave wrong that are not simulated.
fn foresee(plan: &mut PlanReport, forecast: &Forecast, solver: &str) {
    // They are right within a factor of two: more digits say nothing.
    let told = |seconds: f64| format!("{seconds:.1e}").parse().unwrap_or(seconds);
    plan.estimated_seconds = told(forecast.seconds);
    plan.estimated_error = plan.estimated_error.map(|error| error + forecast.passes_error);
    let on_first_mesh = plan.candidates.iter().find(|method| method.name == solver);
    let on_first_mesh = on_first_mesh.and_then(|method| method.estimated_seconds);
    let meshes = on_first_mesh.map_or(1.0, |seconds| forecast.every_pass_seconds / seconds);
    let methods = plan.candidates.iter_mut();
    for method in methods.filter(|method| method.part == Part::Cable) {
        if method.chosen {
            method.estimated_seconds = Some(plan.estimated_seconds);
            method.estimated_error = method.estimated_error.map(|error| error + forecast.passes_error);
        } else {
            method.estimated_seconds = method.estimated_seconds.map(|seconds| told(meshes * seconds));
        }
    }
}

/// Every candidate, the chosen ones marked.
fn print(plan: &PlanReport) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(out, "{}", terminal::line(&plan.title))?;
    let error = plan.estimated_error.map_or_else(
        || "not known before the run".to_owned(),
        |error| format!("about {}", percent(error)),
    );
    writeln!(
        out,
        "ground {}, cable {}, node spacing {} m, vehicle step {} m; error {error}, time {}",
        plan.ground,
        plan.cable,
        spacing(plan.node_spacing_m),
        spacing(plan.vehicle_step_m),
        time(plan.estimated_seconds)
    )?;
    if let Some(occurrence) = &plan.occurrence {
        print_occurrence(&mut out, occurrence)?;
    }
    for part in [Part::Ground, Part::Cable, Part::Mesh] {
        let candidates: Vec<_> = plan
            .candidates
            .iter()
            .filter(|candidate| candidate.part == part)
            .collect();
        if candidates.is_empty() {
            continue;
        }
        writeln!(
            out,
            "\n{part:<14} {:>10} {:>10}  why, or why not",
            "error", "time"
        )?;
        for candidate in candidates {
            writeln!(
                out,
                "{} {:<12} {:>10} {:>10}  {}",
                if candidate.chosen { '→' } else { ' ' },
                candidate.name,
                candidate.estimated_error.map_or_else(String::new, percent),
                candidate.estimated_seconds.map_or_else(String::new, time),
                terminal::sentence(&candidate.reason)
            )?;
        }
    }
    Ok(())
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
    let rough = if occurrence.rough {
        " (rough: the numbers are those of one concentrated load on a half-space)"
    } else {
        ""
    };
    writeln!(out, "{rough}")?;
    Ok(())
}
