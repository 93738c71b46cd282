//! `creepage run`: the force after every pass.

use std::io::Write;

use serde::Serialize;

use super::days;
use super::failure::Failure;
use super::limits::{CheckArgument, LimitArguments};
use super::progress::watched;
use super::shared::{Input, OutputArguments, TrafficArguments};
use super::state::{self, SaveArgument, StartArgument};
use super::terminal;
#[cfg(feature = "xlsx")]
use super::workbook::WorkbookArguments;
use crate::answer::{Place, after, in_rows, table_rows};
use crate::scene::Traffic;
use crate::shown::{exact, percent, spacing, words_if};
use crate::{
    CableEnd, DuctMotionSummary, Limited, Limits, PassRecord, Reached, Run, RunOptions, Scene, Units, Verdict,
};

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
    #[command(flatten)]
    save: SaveArgument,
    #[cfg(feature = "xlsx")]
    #[command(flatten)]
    workbook: WorkbookArguments,
    #[command(flatten)]
    output: OutputArguments,
}

/// The run, and what it makes of the limits, if there are any.
#[derive(Serialize)]
struct Judged<'a> {
    #[serde(flatten)]
    run: &'a Run,
    #[serde(flatten)]
    judgement: Option<Judgement>,
}

#[derive(Serialize)]
struct Judgement {
    /// Of the limit that is exceeded first; null where all are kept.
    limit_reached_after: Option<Reached>,
    limits: Vec<Verdict>,
}

impl Judgement {
    fn new(run: &Run, limits: &Limits) -> Self {
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
    arguments.check.needs(&arguments.limits)?;
    let table = input.table();
    let read = [
        Some(&*arguments.scene.file.scene),
        table.as_deref(),
        arguments.start.read(),
    ];
    let mut files = arguments.output.files(read.into_iter().flatten());
    let destination = arguments.output.destination(&mut files)?;
    let (start, saved) = (arguments.start.start()?, arguments.save.destination(&mut files)?);
    #[cfg(feature = "xlsx")]
    let workbook = arguments.workbook.destination(&mut files)?;
    let units = arguments.limits.units(input.file());
    let words = |_| "passes on finer and finer meshes".to_owned();
    let answer = watched(1.0, words, |progress| {
        let options = RunOptions {
            verify: arguments.verify,
            start: start.as_ref(),
            progress,
            ..RunOptions::default()
        };
        crate::run_with(&input.scene, &options)
    });
    let mut answer = input.located(answer)?;
    let scene = input.scene.clone();
    #[cfg(feature = "xlsx")]
    let file = input.file().clone();
    input.warn(&mut answer.warnings);
    if let Some(saved) = &saved {
        state::write(saved, &answer)?;
    }
    let judgement = arguments
        .limits
        .are_given()
        .then(|| Judgement::new(&answer, &limits));
    let judged = Judged {
        run: &answer,
        judgement,
    };
    let verdicts = judged
        .judgement
        .as_ref()
        .map_or(&[][..], |judgement| &judgement.limits);
    #[cfg(feature = "xlsx")]
    workbook.write(&answer, verdicts, &file, &units)?;
    destination.write(&judged, rows(&answer.passes), || {
        print(&answer, &scene, &units)?;
        let mut out = terminal::out();
        for verdict in verdicts {
            writeln!(out, "{}", verdict.shown(&units))?;
        }
        if verdicts.len() > 1 {
            writeln!(out, "{}", Verdict::summary(verdicts))?;
        }
        Ok(())
    })?;
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

/// The time of a pass behind its number, where it is known.
fn in_time(traffic: &Traffic, pass: u64) -> String {
    let years = traffic.years_after(pass);
    years.map_or_else(String::new, |years| format!(", {}", after(years)))
}

fn heading(out: &mut impl Write, title: &str, motion: &DuctMotionSummary) -> std::io::Result<()> {
    writeln!(out, "{}", terminal::line(title))?;
    writeln!(
        out,
        "duct motion: {:.2} µm along, {:.1} µm down",
        1e6 * motion.peak_longitudinal_m,
        1e6 * motion.peak_vertical_m
    )
}

fn print(run: &Run, scene: &Scene, units: &Units) -> Result<(), Failure> {
    let mut out = terminal::out();
    let (force, metres) = (|value| units.force(value), units.length.symbol());
    let length = |value| units.length.of_si(value);
    heading(&mut out, &run.title, &run.duct_motion)?;
    if let Some(start) = &run.start {
        writeln!(out, "begins with the cable after {} passes", start.passes)?;
    }
    let a_day = run.heat.as_ref().map(|heat| heat.passes_per_day);
    table(&mut out, &run.passes, scene, (a_day, run.random.is_some()), units)?;
    if let Some(heat) = &run.heat {
        days::print(&mut out, &run.days, heat, scene.traffic.passes, units)?;
    }
    for end in CableEnd::ALL {
        let largest = run.largest(end, Limited::Force);
        if run.heat.is_none() && largest > 0.0 {
            let unit = units.force.symbol();
            writeln!(
                out,
                "largest on the {} end: {} {unit}, during a pass",
                end.name(),
                force(largest)
            )?;
        }
    }
    match &run.saturation {
        _ if run.heat.is_some() => {}
        Some(saturation) => writeln!(
            out,
            "saturation: {} {}{}, 95 % of {} after {} passes{}",
            force(saturation.force_n),
            units.force.symbol(),
            words_if(saturation.is_beyond(&run.passes), " beyond these passes"),
            if run.random.is_some() { "the mean" } else { "it" },
            saturation.passes_to_95_percent,
            in_time(&scene.traffic, saturation.passes_to_95_percent)
        )?,
        None if run.range.is_some() => writeln!(out, "saturation: none, the force was larger before")?,
        None => writeln!(out, "saturation: not reached within these passes")?,
    }
    for (end, least, most) in run.by_turns() {
        let how = if run.random.is_some() {
            "in nine passes of ten"
        } else {
            "by turns"
        };
        writeln!(
            out,
            "in the end the {} end shows {} to {} {} {how}",
            end.name(),
            force(least),
            force(most),
            units.force.symbol()
        )?;
    }
    for restraint in &run.restraints {
        let largest = |quantity| run.largest(Place::Clamp(restraint.position_m), quantity);
        writeln!(
            out,
            "clamp at {} {metres}: {} {} after the last pass; at most {} {}, moved {} {}",
            exact(length(restraint.position_m)),
            force(restraint.force_n),
            units.force.symbol(),
            force(largest(Limited::Force)),
            units.force.symbol(),
            units.movement(largest(Limited::Movement)),
            units.movement.symbol()
        )?;
        if let Some(slipped) = restraint.slipped_m {
            let (slipped, symbol) = (units.movement(slipped), units.movement.symbol());
            writeln!(out, "    it has slipped by {slipped} {symbol}")?;
        }
    }
    if let Some(slip) = &run.slip_lengths {
        writeln!(
            out,
            "length slipping with the vehicle at mid-duct: {:.2} {metres} forward, {:.2} {metres} backward",
            length(slip.forward_m),
            length(slip.backward_m)
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
        "plan: ground {}, cable {}, node spacing {} {metres}, vehicle step {} {metres}",
        run.plan.ground,
        run.plan.cable,
        spacing(length(run.plan.node_spacing_m)),
        spacing(length(run.plan.vehicle_step_m))
    )?;
    for reason in &run.plan.reasons {
        writeln!(out, "  {}", terminal::sentence(reason))?;
    }
    Ok(())
}

/// Forces and movements after some passes, of which there are so many `a_day` of heat, or which are means over many vehicles.
fn table(
    out: &mut impl Write,
    passes: &[PassRecord],
    scene: &Scene,
    (a_day, are_means): (Option<u64>, bool),
    units: &Units,
) -> std::io::Result<()> {
    let traffic = &scene.traffic;
    let rows = table_rows(passes, traffic);
    let (kind, kinds) = in_rows(&rows, scene, a_day, are_means).unwrap_or_default();
    let mut kinds = kinds.iter();
    let [force, movement] = [units.force, units.movement].map(|unit| unit.symbol());
    let mut names = vec!["pass".to_owned()];
    // Times, and what distinguishes rows, have columns where there are any.
    names.extend(traffic.per_day.map(|_| "after".to_owned()));
    names.extend(["upstream", "downstream"].map(|end| format!("{end} force, {force}")));
    names.extend(["upstream", "downstream"].map(|end| format!("{end} moved, {movement}")));
    names.push(format!("most in cable, {force}"));
    names.extend(Some(kind.to_owned()).filter(|kind| !kind.is_empty()));
    let row = |record: &PassRecord| {
        let mut row = vec![record.pass.to_string()];
        row.extend(
            traffic
                .per_day
                .map(|_| record.years.map_or_else(String::new, after)),
        );
        row.extend([record.upstream_force_n, record.downstream_force_n].map(|force| units.force(force)));
        let moved = [record.upstream_displacement_m, record.downstream_displacement_m];
        row.extend(moved.map(|movement| units.movement(movement)));
        row.push(units.force(record.max_compression_n));
        let kind = kinds.next().map_or_else(String::new, |kind| terminal::line(kind));
        row.extend((row.len() < names.len()).then_some(kind));
        row
    };
    let rows: Vec<Vec<String>> = rows.into_iter().map(row).collect();
    writeln!(out)?;
    terminal::table(out, &names, &rows)?;
    writeln!(out)
}
