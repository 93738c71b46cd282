//! `creepage calibrate`: parameters from readings.

use std::io::Write;
use std::ops::RangeInclusive;
use std::path::PathBuf;

use super::failure::Failure;
use super::progress::watched;
use super::readings::ReadArguments;
use super::shared::{Input, OutputArguments, SceneArguments, Threads};
use super::terminal;
use crate::calibration::{
    CalibrateOptions, Calibrated, Deflection, FittedParameter, FittedReading, Loss, MAX_RUNS, ResidualSize,
    SHARES, Series, Unknown,
};
use crate::scene::{Dimension, FrictionLaw, four_digits};
use crate::shown::{ROWS, percent};
use crate::words::Table;
use crate::{Error, Readings};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  creepage calibrate my-duct.toml --data forces.csv
  creepage calibrate my-duct.toml --data cell.csv --unit kN --fit dynamic_coefficient,shape_factor,drift --json
  creepage calibrate --scene-data upper.toml=upper.csv --scene-data lower.toml=lower.csv \\
    --fit dynamic_coefficient_1,dynamic_coefficient_2,ground_stiffness")]
pub struct Arguments {
    /// Scene file (TOML)
    #[arg(required_unless_present = "scene_data", requires = "data")]
    scene: Option<PathBuf>,
    /// Override a key of every scene, such as friction.dynamic_coefficient=0.3; a number without a unit is SI; may be repeated
    #[arg(long, value_name = "KEY=VALUE", allow_hyphen_values = true)]
    set: Vec<String>,
    /// Readings after passes: a table (text or .xlsx) with columns such as pass,force_n[,sigma_n] or `Pass;Force [kN]`. Forces are those on
    /// the held end (the downstream one if both are), unless a column says its end
    #[arg(long, value_name = "FILE", requires = "scene")]
    data: Option<PathBuf>,
    /// A scene and its readings, fitted jointly with the others; may be repeated
    #[arg(long, value_name = "SCENE=FILE", value_parser = scene_and_data)]
    scene_data: Vec<(PathBuf, PathBuf)>,
    /// What to fit: dynamic_coefficient, route.1.dynamic_coefficient (of the second section of a route), shape_factor,
    /// ground_stiffness (how many times stiffer than in the scene); of every load cell
    /// zero_offset, drift. Scenes share what has no number: shape_factor_2 is that of the second. Default:
    /// dynamic_coefficient,shape_factor (only the first with Coulomb's law)
    #[arg(long, value_delimiter = ',', value_name = "NAMES", value_parser = |text: &str| text.trim().parse::<Unknown>())]
    fit: Vec<Unknown>,
    /// Standard deviation of a load cell's zero, if it is fitted. Default: a quarter of the largest force
    #[arg(long, value_name = "FORCE", value_parser = quantity(Dimension::Force, POSITIVE, "a positive force such as \"20 N\""))]
    zero_offset_sigma: Option<f64>,
    /// Standard deviation of its drift per pass, if it is fitted. Default: a quarter of the largest force over all passes
    #[arg(long, value_name = "FORCE", value_parser = quantity(Dimension::Force, POSITIVE, "a positive force such as \"20 N\""))]
    drift_sigma: Option<f64>,
    /// Measured deflection under the first vehicle, "115 um"; also fits ground_stiffness
    #[arg(long, value_name = "LENGTH", requires = "deflection_sigma",
        value_parser = quantity(Dimension::Length, POSITIVE, "a positive length such as \"115 um\""))]
    deflection: Option<f64>,
    /// Standard deviation of the measured deflection, "15 um"
    #[arg(long, value_name = "LENGTH", requires = "deflection",
        value_parser = quantity(Dimension::Length, POSITIVE, "a positive length such as \"115 um\""))]
    deflection_sigma: Option<f64>,
    /// Let the model be wrong by a smooth function of the passes, with a standard deviation of SHARE of the
    /// largest reading (0.01 % to 1000 %): intervals then hold where the model is off by as much
    #[arg(long, value_name = "SHARE", num_args = 0..=1, require_equals = true, default_missing_value = "3 %",
        conflicts_with = "robust",
        value_parser = quantity(Dimension::Ratio, SHARES, "0.01 % to 1000 % of the largest reading"))]
    discrepancy: Option<f64>,
    /// Ignore outliers (Tukey's loss)
    #[arg(long)]
    robust: bool,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    reading: ReadArguments,
}

const POSITIVE: RangeInclusive<f64> = f64::MIN_POSITIVE..=f64::MAX;

/// Reads a quantity within a range.
fn quantity(
    dimension: Dimension,
    range: RangeInclusive<f64>,
    allowed: &'static str,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync {
    move |text| match dimension.parse_argument(text) {
        Ok(value) if range.contains(&value) => Ok(value),
        Ok(_) => Err(format!("found \"{text}\"; allowed: {allowed}")),
        Err(error) => Err(format!("found \"{text}\": {error}; allowed: {allowed}")),
    }
}

fn scene_and_data(text: &str) -> Result<(PathBuf, PathBuf), String> {
    match text.split_once('=') {
        Some((scene, data)) if !scene.is_empty() && !data.is_empty() => Ok((scene.into(), data.into())),
        _ => Err(format!(
            "found `{text}`; allowed: SCENE=FILE, such as upper.toml=upper.csv"
        )),
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let first = arguments.scene.clone().zip(arguments.data.clone());
    let files: Vec<(PathBuf, PathBuf)> = first.into_iter().chain(arguments.scene_data.clone()).collect();
    let input = |(scene, _): &(PathBuf, PathBuf)| {
        let (scene, set) = (scene.clone(), arguments.set.clone());
        Input::read(&SceneArguments { scene, set })
    };
    let inputs = files.iter().map(input).collect::<Result<Vec<_>, _>>()?;
    let readings = files.iter().map(|(_, data)| arguments.reading.read(data));
    let readings = readings.collect::<Result<Vec<_>, _>>()?;
    let read = files.iter().flat_map(|(scene, data)| [&**scene, &**data]);
    let mut files = arguments.output.files(read);
    let destination = arguments.output.destination(&mut files)?;
    let answer = calibrate(arguments, &inputs, &readings);
    let mut answer = match &inputs[..] {
        [only] => only.located(answer)?,
        // Which of the files is at fault is not known.
        _ => answer?,
    };
    let law = inputs[0].scene.friction.law();
    terminal::warn_all(&answer.warnings);
    let slips: Vec<String> = inputs.into_iter().flat_map(|input| input.warnings).collect();
    answer.warnings.splice(0..0, slips);
    destination.write(&answer, &answer.fit, || print(&answer, law))?;
    match answer.misses_by() {
        None => Ok(()),
        Some(times) => Err(Failure::NotKept(format!(
            "the model misses these readings by {times:.0} times their spread: see whether units, ends, ground and traffic are those of the scene"
        ))),
    }
}

fn calibrate(arguments: &Arguments, inputs: &[Input], readings: &[Readings]) -> Result<Calibrated, Error> {
    let deflection = arguments.deflection.zip(arguments.deflection_sigma);
    let options = CalibrateOptions {
        unknowns: arguments.fit.clone(),
        zero_offset_sigma: arguments.zero_offset_sigma,
        drift_sigma: arguments.drift_sigma,
        discrepancy: arguments.discrepancy,
        deflection: deflection.map(|(value, sigma)| Deflection { value, sigma }),
        loss: if arguments.robust {
            Loss::Tukey
        } else {
            Loss::Squares
        },
        ..CalibrateOptions::default()
    };
    let scenes = inputs.iter().map(|input| &input.scene);
    let series = scenes
        .zip(readings)
        .map(|(scene, readings)| Series { scene, readings });
    let series: Vec<Series<'_>> = series.collect();
    let most = MAX_RUNS as f64;
    // Measured on one to four parameters; two are fitted where none is named.
    let fitted = Some(arguments.fit.len()).filter(|count| *count > 0);
    let usual = 16 + 25 * fitted.unwrap_or(2);
    let words = |share: f64| format!("{:.0} of about {usual} model runs", share * most);
    watched(usual as f64 / most, words, |progress| {
        crate::calibrate_jointly(&series, &CalibrateOptions { progress, ..options })
    })
}

fn print(answer: &Calibrated, law: FrictionLaw) -> Result<(), Failure> {
    let mut out = terminal::out();
    let titles: Vec<String> = answer.titles.iter().map(|title| terminal::line(title)).collect();
    writeln!(out, "{}, law {}\n", titles.join("; "), law.name())?;
    let row = |parameter: &FittedParameter| {
        let error = parameter.standard_error.map(significant);
        vec![
            label(&parameter.name, parameter.unit),
            significant(parameter.value),
            error.unwrap_or_else(|| "unknown".into()),
            interval(parameter.interval_95),
            if parameter.identifiable { "yes" } else { "NO" }.to_owned(),
        ]
    };
    let head = [
        "parameter",
        "value",
        "standard error",
        "95 % interval",
        "identifiable",
    ];
    let parameters = Table::new(head, answer.parameters.iter().map(row).collect(), 1);
    terminal::table(&mut out, &parameters.head, &parameters.rows)?;
    for i in 1..answer.parameters.len() {
        for j in 0..i {
            if let Some(correlation) = answer.correlation[i][j] {
                let (one, other) = (&answer.parameters[j].name, &answer.parameters[i].name);
                writeln!(out, "correlation of {one} and {other}: {correlation:.3}")?;
            }
        }
    }
    writeln!(out)?;
    print_readings(&mut out, answer)?;
    writeln!(out)?;
    print_quality(&mut out, answer)
}

/// How well the model follows the readings, and what the answer rests on.
fn print_quality(out: &mut impl Write, answer: &Calibrated) -> Result<(), Failure> {
    let explained = answer.r_squared.map(|r| format!(", R² {r:.5}"));
    let explained = explained.unwrap_or_default();
    let residuals: Vec<String> = answer.residuals.iter().map(ToString::to_string).collect();
    let (residuals, freedom) = (residuals.join(", "), four_digits(answer.degrees_of_freedom));
    writeln!(
        out,
        "residuals: {residuals}{explained}, {freedom} degrees of freedom"
    )?;
    let lack = &answer.lack_of_fit;
    let tests = [
        ("their signs", Some(lack.p_runs)),
        ("a drift", lack.p_trend),
        ("a zero offset", lack.p_offset),
        ("their size", lack.p_noise),
        ("the sigmas", lack.p_sigma),
    ];
    let words = |(what, chance): (&str, Option<f64>)| Some(format!("{what} {:.2}", chance?));
    let tests = tests.into_iter().filter_map(words).collect::<Vec<_>>().join(", ");
    let verdict = if lack.suspicious { "SUSPICIOUS" } else { "yes" };
    writeln!(
        out,
        "whether they are noise: {verdict}; the chance that noise shows {tests}"
    )?;
    for assumption in &answer.assumptions {
        writeln!(out, "assumed: {assumption}")?;
    }
    let error = percent(answer.model_error.relative);
    let of = only(answer).map_or("largest reading", |kind| kind.measured);
    let shifts = answer.model_error.standard_errors.iter();
    let shift = shifts.fold(0.0_f64, |most, &error| most.max(error));
    writeln!(
        out,
        "error of the mesh: {error} of the {of}, at most {shift:.2} standard errors of a parameter"
    )?;
    let (method, runs) = (&answer.method, answer.evaluations);
    let first = match answer.fit[0].measured {
        "force" => "load cell",
        other => other,
    };
    let (cable, cell, spacing) = (&method.cable, &method.load_cell[0], method.node_spacing_m[0]);
    let how = format!("cable {cable}, {first} {cell}, node spacing {spacing:.3} m, {runs} model runs");
    Ok(writeln!(out, "method: {how}; {}", method.intervals)?)
}

/// The kind of all readings, where they are of one.
fn only(answer: &Calibrated) -> Option<&ResidualSize> {
    answer.residuals.first().filter(|_| answer.residuals.len() == 1)
}

fn print_readings(out: &mut impl Write, answer: &Calibrated) -> Result<(), Failure> {
    let unit = only(answer).map_or("1", |kind| kind.unit);
    let [measured, fitted, residual] = ["measured", "fitted", "residual"].map(|name| label(name, unit));
    let names = ["pass".to_owned(), measured, fitted, residual, String::new()];
    let stride = answer.fit.len().div_ceil(ROWS).max(1);
    let row = |row: &FittedReading| {
        let shown = |value: f64| match row.unit {
            "N" => format!("{value:.1}"),
            _ => format!("{value:.3e}"),
        };
        let [measured, fitted, residual] = [row.value, row.fitted, row.residual].map(shown);
        let is_other = only(answer).is_none() || row.measured != "force";
        let of = [
            is_other.then(|| format!("{}, {}", row.measured, row.unit)),
            (answer.titles.len() > 1).then(|| format!("scene {}", row.series)),
            (!row.run.is_empty()).then(|| format!("run {}", terminal::line(&row.run))),
        ];
        let of: Vec<String> = of.into_iter().flatten().collect();
        vec![row.pass.to_string(), measured, fitted, residual, of.join("  ")]
    };
    let rows: Vec<Vec<String>> = answer.fit.iter().step_by(stride).map(row).collect();
    terminal::table(out, &names, &rows)?;
    if stride > 1 {
        let count = answer.fit.len();
        writeln!(out, "(every {stride} of {count} readings; --csv writes all)")?;
    }
    Ok(())
}

/// A name with its unit.
fn label(name: &str, unit: &str) -> String {
    match unit {
        "1" => name.to_owned(),
        unit => format!("{name}, {unit}"),
    }
}

fn significant(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        format!("{value:.3e}")
    } else {
        format!("{value:.5}")
    }
}

fn interval([lower, upper]: [Option<f64>; 2]) -> String {
    match (lower, upper) {
        (Some(lower), Some(upper)) => format!("{} to {}", significant(lower), significant(upper)),
        (Some(lower), None) => format!("above {}", significant(lower)),
        (None, Some(upper)) => format!("below {}", significant(upper)),
        (None, None) => "open".into(),
    }
}
