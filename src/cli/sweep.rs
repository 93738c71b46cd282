//! `creepage sweep`: one scene with many values of some keys.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::limits::LimitArguments;
use super::progress::watched;
use super::readings::TableArguments;
use super::shared::{Force, Json, TrafficArguments, warn_of_slips};
use super::terminal;
use crate::shown::{exact_percent, words_if};
use crate::sweep::{Axis, Band, MapValue, Quantiles, SAMPLE_TOLERANCE, Samples};
use crate::sweep::{Sweep, SweepOptions, SweepSummary, ending};
use crate::{Limited, Units};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Rerun the same command to resume an interrupted sweep. A point that fails is a row with its error. Numbers in the table are SI, in a workbook \
in the units that were typed. In CSV an apostrophe \
stands before a text that a spreadsheet would take for a formula.

Examples:
  creepage sweep my-duct.toml --vary friction.dynamic_coefficient=0.2:0.5:0.05 --out friction.csv
  creepage sweep my-duct.toml --vary duct.depth=0.6m:2m:0.2m --vary vehicles.0.load=10tf,15tf,20tf --out grid.xlsx
  creepage sweep my-duct.toml --vary duct.depth=0.6m:2m:0.2m --vary friction.dynamic_coefficient=0.2:0.5:0.05 --out map.csv --map map.svg
  creepage sweep my-duct.toml --rows ducts.csv --limit-force 2kN --limit-movement 10mm --out answers.xlsx
  creepage sweep my-duct.toml --vary \"friction.dynamic_coefficient=normal(0.25, 0.03)\" --samples 500 --out bands.csv"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    /// A key and its values; may be repeated, for every combination:
    /// KEY=A:B:STEP
    /// KEY=V1,V2,…
    /// KEY=normal(MEAN, SD)
    /// KEY=lognormal(MEDIAN, SIGMA), SIGMA of the logarithm
    /// KEY=uniform(LOW, HIGH), KEY=triangular(LOW, MODE, HIGH)
    /// each also between bounds: KEY=normal(MEAN, SD, min=LOW, max=HIGH)
    #[arg(
        long,
        verbatim_doc_comment,
        value_name = "KEY=VALUES",
        required_unless_present = "rows",
        allow_hyphen_values = true
    )]
    vary: Vec<String>,
    /// A table with one row a duct (CSV or Excel), its columns named as keys, with units or in SI; an empty
    /// cell leaves the scene's own value, and a column `id` is carried over. With --samples a cell, or a
    /// value of the scene, may be a distribution as in --vary
    #[arg(long, value_name = "FILE", conflicts_with = "vary")]
    rows: Option<PathBuf>,
    #[command(flatten)]
    limits: LimitArguments,
    #[command(flatten)]
    table: TableArguments,
    /// Table to write, FILE.csv or FILE.xlsx
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Number of samples of the keys that have a distribution
    #[arg(long, value_name = "N")]
    samples: Option<usize>,
    /// Random seed
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Draw a map over two varied keys to this file (SVG)
    #[arg(long, value_name = "FILE.svg", conflicts_with = "rows")]
    map: Option<PathBuf>,
    /// Quantity shown by the map's colour: force or movement, the larger of the two ends
    #[arg(long, value_name = "VALUE", default_value = "force", requires = "map")]
    map_of: MapValue,
    #[command(flatten)]
    json: Json,
    #[command(flatten)]
    force: Force,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let file = arguments.scene.read()?;
    let rows = arguments.rows.as_deref();
    let axes = arguments.vary.iter().map(|text| Axis::parse(text));
    let samples = Samples {
        count: arguments.samples.unwrap_or(0),
        seed: arguments.seed,
    };
    let mut sweep = match rows {
        Some(rows) => Sweep::of_rows(file, rows, &arguments.table.0.table, samples)?,
        None => Sweep::new(file, axes.collect::<Result<_, _>>()?, samples)?,
    };
    let first = sweep.file_at(0)?;
    warn_of_slips(&first);
    if arguments.limits.are_given() {
        arguments.limits.warn_of_slips();
        sweep = sweep.with_limits(arguments.limits.of_points());
    }
    let tables = sweep.files();
    let read = [Some(&*arguments.scene.file.scene), rows].into_iter().flatten();
    let read = read.chain(tables.iter().map(PathBuf::as_path));
    let mut files = arguments.force.files(read);
    files.output(&arguments.out, ending(&arguments.out)?)?;
    if arguments.map.is_some() {
        // Whether there can be one is known before anything is computed.
        let _ = sweep.map(&[], arguments.map_of)?;
    }
    let map = arguments.map.as_ref();
    let map = map.map(|file| files.output(file, "svg")).transpose()?;
    let count = sweep.count();
    let points = |share: f64| format!("{:.0} of {count} points", share * count as f64);
    let out = arguments.out.display();
    let kept = format!("the finished points are kept beside {out}");
    super::signals::leaves(format!("{kept}; the same command goes on from there"));
    let summary = watched(1.0, points, |progress| {
        let options = SweepOptions {
            force: arguments.force.force,
            progress,
            ..SweepOptions::default()
        };
        sweep.run(&arguments.out, &options)
    })?;
    if let Some(error) = &summary.first_error {
        let failed = format!("{} of {count} points failed", summary.failed);
        terminal::warn(format_args!("{failed}, the first with: {error}"));
    }
    if summary.failed == summary.points {
        return Err(Failure::Nothing);
    }
    if let Some(file) = map {
        let svg = sweep.map(&summary.rows, arguments.map_of)?.to_svg()?;
        file.write(svg.as_bytes())?;
    }
    let units = arguments.limits.units(&first);
    let is_coarse = samples.count > 0 && !first.names("solver.tolerance");
    let words = || print(&summary, &arguments.out, is_coarse, &units);
    arguments.json.print(&summary, words)
}

fn print(summary: &SweepSummary, file: &Path, is_coarse: bool, units: &Units) -> Result<(), Failure> {
    let mut out = terminal::out();
    let before = format!(", {} of them done before", summary.resumed);
    let before = words_if(summary.resumed > 0, &before);
    writeln!(out, "{}: {} points{before}", file.display(), summary.points)?;
    if is_coarse {
        let tolerance = exact_percent(SAMPLE_TOLERANCE);
        let other = "solver.tolerance names another tolerance";
        writeln!(out, "samples are computed to {tolerance}; {other}")?;
    }
    let mut all = summary.bands.iter();
    all.try_for_each(|band| bands(&mut out, band, units))
}

fn bands(out: &mut impl Write, band: &Band, units: &Units) -> Result<(), Failure> {
    let at = band.at.iter().map(|(key, value)| format!("{key} = {value}"));
    writeln!(out, "\n{}", at.collect::<Vec<_>>().join(", "))?;
    let force = format!("force, {}", units.force.symbol());
    let names = [
        "mean",
        "standard deviation",
        "5 %",
        "25 %",
        "50 %",
        "75 %",
        "95 %",
    ];
    let names: Vec<String> = [&*force].into_iter().chain(names).map(str::to_owned).collect();
    let forces = [
        ("downstream", band.downstream_force_n),
        ("upstream", band.upstream_force_n),
        ("largest", band.max_compression_n),
    ];
    let row = |(name, quantiles): (&str, Option<Quantiles>)| {
        let q = quantiles?;
        let values = [q.mean, q.standard_deviation, q.p05, q.p25, q.p50, q.p75, q.p95];
        let values = values.map(|force| Limited::Force.number_in(units, force));
        Some([&[name.to_owned()][..], &values].concat())
    };
    let rows: Vec<Vec<String>> = forces.into_iter().filter_map(row).collect();
    terminal::table(out, &names, &rows)?;
    if band.failed > 0 {
        let (failed, all) = (band.failed, band.failed + band.samples);
        writeln!(
            out,
            "{failed} of {all} samples failed; the quantiles leave them out"
        )?;
    }
    Ok(())
}
