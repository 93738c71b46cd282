//! `creepage run`: the force after every pass.

use std::io::Write;

use serde::Serialize;

use super::days;
use super::failure::Failure;
use super::progress::{PER_MILLE, PERCENT, with_bar};
use super::shared::{Input, OutputArguments, TrafficArguments};
use super::terminal;
use crate::answer::{after, table_rows};
use crate::output::Kind;
use crate::scene::{Dimension, Traffic};
use crate::shown::{percent, rounded};
use crate::{PassRecord, Run, RunOptions};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  creepage run my-duct.toml
  creepage run my-duct.toml --set friction.dynamic_coefficient=0.3 --set vehicles.0.load=15tf
  creepage run my-duct.toml --json > answer.json
  creepage run my-duct.toml --csv forces.csv --verify")]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    /// Measure the error by a second run on a mesh twice as fine
    #[arg(long)]
    verify: bool,
    /// Force on an end whose first pass is told
    #[arg(long, value_name = "FORCE", value_parser = |text: &str| Dimension::Force.parse_argument(text))]
    limit_force: Option<f64>,
    #[command(flatten)]
    output: OutputArguments,
}

/// The run, and when a force on an end first exceeds the limit.
#[derive(Serialize)]
struct Limited<'a> {
    #[serde(flatten)]
    run: &'a Run,
    #[serde(skip_serializing_if = "Reached::is_not_asked")]
    limit_reached_after: Reached,
}

/// When a limit is reached.
#[derive(Serialize, Clone, Copy, PartialEq)]
#[serde(untagged)]
enum Reached {
    After { pass: u64 },
    Never,
    NotAsked,
}

impl Reached {
    fn is_not_asked(&self) -> bool {
        *self == Self::NotAsked
    }
}

impl<'a> Limited<'a> {
    fn new(run: &'a Run, limit: Option<f64>) -> Self {
        let exceeds = |record: &&PassRecord, limit: f64| {
            let forces = [
                record.upstream_force_n,
                record.upstream_peak_n,
                record.downstream_force_n,
                record.downstream_peak_n,
            ];
            forces.into_iter().any(|force| force.abs() > limit)
        };
        let first = |limit| {
            let record = run.passes.iter().find(|record| exceeds(record, limit));
            record.map_or(Reached::Never, |record| Reached::After { pass: record.pass })
        };
        Self {
            run,
            limit_reached_after: limit.map_or(Reached::NotAsked, first),
        }
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::of(arguments.scene.read()?)?;
    let destination = arguments
        .output
        .destination(Kind::Passes, [&*arguments.scene.file.scene])?;
    let answer = with_bar(PERCENT, PER_MILLE, |progress| {
        let options = RunOptions {
            verify: arguments.verify,
            progress,
            ..RunOptions::default()
        };
        crate::run_with(&input.scene, &options)
    });
    let mut answer = input.located(answer)?;
    let traffic = input.scene.traffic.clone();
    input.warn(&mut answer.warnings);
    let limited = Limited::new(&answer, arguments.limit_force);
    // A column that only some rows have is none of a table.
    let rows = answer.passes.iter().map(|record| PassRecord {
        interpolated: false,
        ..*record
    });
    destination.write(&limited, rows, || {
        print(&answer, &traffic)?;
        let (mut out, limit) = (terminal::out(), arguments.limit_force.unwrap_or_default());
        match limited.limit_reached_after {
            Reached::After { pass } => writeln!(out, "more than {limit} N on an end: from pass {pass} on")?,
            Reached::Never => writeln!(out, "more than {limit} N on an end: not within these passes")?,
            Reached::NotAsked => {}
        }
        Ok(())
    })
}

/// The time of a pass behind its number, where it is known.
fn in_time(traffic: &Traffic, pass: u64) -> String {
    let years = traffic.years_after(pass);
    years.map_or_else(String::new, |years| format!(", {}", after(years)))
}

/// Forces that differ by a smaller share are the same to a reader.
const NOTICEABLE: f64 = 0.01;

fn print(run: &Run, traffic: &Traffic) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(out, "{}", terminal::line(&run.title))?;
    writeln!(
        out,
        "duct motion: {:.2} µm along, {:.1} µm down",
        1e6 * run.duct_motion.peak_longitudinal_m,
        1e6 * run.duct_motion.peak_vertical_m
    )?;
    table(&mut out, run, traffic)?;
    if let Some(heat) = &run.heat {
        days::print(&mut out, &run.days, heat)?;
    }
    match &run.saturation {
        _ if run.heat.is_some() => {}
        Some(saturation) => writeln!(
            out,
            "saturation: {:.1} N, 95 % of it after {} passes{}",
            saturation.force_n,
            saturation.passes_to_95_percent,
            in_time(traffic, saturation.passes_to_95_percent)
        )?,
        None if run.range.is_some() => writeln!(out, "saturation: none, the force was larger before")?,
        None => writeln!(out, "saturation: not reached within these passes")?,
    }
    if let Some(range) = run.range {
        for (end, least, most) in [
            ("upstream", range.upstream_min_n, range.upstream_max_n),
            ("downstream", range.downstream_min_n, range.downstream_max_n),
        ] {
            // Vehicles that differ leave different forces by turns.
            if most - least > NOTICEABLE * most.abs().max(least.abs()) {
                writeln!(
                    out,
                    "in the end the {end} end shows {least:.1} to {most:.1} N by turns"
                )?;
            }
        }
    }
    for restraint in &run.restraints {
        writeln!(
            out,
            "clamp at {} m: {:.1} N, moved {:.4} mm",
            restraint.position_m,
            restraint.force_n,
            1e3 * restraint.force_n / restraint.stiffness_n_per_m
        )?;
    }
    if let Some(slip) = &run.slip_lengths {
        writeln!(
            out,
            "length slipping with the vehicle at mid-duct: {:.2} m forward, {:.2} m backward",
            slip.forward_m, slip.backward_m
        )?;
    }
    writeln!(
        out,
        "estimated error: {} ({})",
        percent(run.error_estimate.relative),
        run.error_estimate.method
    )?;
    writeln!(
        out,
        "plan: ground {}, cable {}, node spacing {:.3} m, vehicle step {:.3} m",
        run.plan.ground, run.plan.cable, run.plan.node_spacing_m, run.plan.vehicle_step_m
    )?;
    for reason in &run.plan.reasons {
        writeln!(out, "  {}", terminal::sentence(reason))?;
    }
    Ok(())
}

/// Forces and movements after some passes.
fn table(out: &mut impl Write, run: &Run, traffic: &Traffic) -> std::io::Result<()> {
    // A column of times where they are known.
    let time = |text: &str| {
        traffic
            .per_day
            .map_or_else(String::new, |_| format!(" {text:>10}"))
    };
    writeln!(
        out,
        "\n{:>9}{} {:>23} {:>23} {:>12}",
        "",
        time(""),
        "force after pass, N",
        "end moved, mm",
        "largest"
    )?;
    writeln!(
        out,
        "{:>9}{} {:>11} {:>11} {:>11} {:>11} {:>12}",
        "pass",
        time("after"),
        "upstream",
        "downstream",
        "upstream",
        "downstream",
        "in cable, N"
    )?;
    for record in table_rows(&run.passes, traffic) {
        writeln!(
            out,
            "{:>9}{} {:>11} {:>11} {:>11} {:>11} {:>12}",
            record.pass,
            time(&record.years.map_or_else(String::new, after)),
            rounded(record.upstream_force_n, 1),
            rounded(record.downstream_force_n, 1),
            rounded(1e3 * record.upstream_displacement_m, 4),
            rounded(1e3 * record.downstream_displacement_m, 4),
            rounded(record.max_compression_n, 1)
        )?;
    }
    writeln!(out)
}
