//! `creepage calibrate`: parameters from readings.

use std::io::Write;

use super::arguments::{CalibrateArguments, OutputArguments, SceneArguments};
use super::input::Input;
use super::progress::{MODEL_RUNS, with_bar};
use super::{Failure, terminal, write};
use crate::calibration::{
    BootstrapOptions, CalibrateOptions, Calibrated, Deflection, FittedParameter, Loss, Readings, Unknown,
};
use crate::output::Kind;
use crate::scene::FrictionLaw;

/// Rows of the table of readings on a terminal.
const ROWS: usize = 16;

pub fn execute(
    scene: &SceneArguments,
    arguments: &CalibrateArguments,
    output: &OutputArguments,
) -> Result<(), Failure> {
    let input = Input::read(scene)?;
    let readings = Readings::from_file(&arguments.data).map_err(crate::Error::from)?;
    let table = write::table(output, Kind::Fit, [&*scene.scene, &arguments.data])?;
    let scene = &input.scene;
    let options = CalibrateOptions {
        unknowns: arguments.fit.iter().copied().map(Unknown::shared).collect(),
        deflection: arguments
            .deflection
            .zip(arguments.deflection_sigma)
            .map(|(value, sigma)| Deflection { value, sigma }),
        loss: if arguments.robust {
            Loss::TUKEY
        } else {
            Loss::Squares
        },
        bootstrap: arguments.bootstrap.map(|replicates| BootstrapOptions {
            replicates,
            seed: arguments.seed,
        }),
        max_evaluations: arguments.max_evaluations,
        ..CalibrateOptions::default()
    };
    let answer = with_bar(MODEL_RUNS, arguments.max_evaluations, |progress| {
        crate::calibrate(scene, &readings, &CalibrateOptions { progress, ..options })
    });
    let mut answer = input.judged(answer)?;
    for warning in &answer.warnings {
        terminal::warn(warning);
    }
    answer.warnings.splice(0..0, input.warnings);
    if let Some(table) = table {
        table.write(&answer.fit)?;
    }
    if output.json {
        write::json(&answer)
    } else if output.is_on_stdout() {
        Ok(())
    } else {
        print(&answer, scene.friction.law)
    }
}

fn print(answer: &Calibrated, law: FrictionLaw) -> Result<(), Failure> {
    let mut out = terminal::out();
    let titles: Vec<String> = answer.titles.iter().map(|title| terminal::line(title)).collect();
    writeln!(out, "{}, law {}", titles.join("; "), law.name())?;
    writeln!(out)?;
    writeln!(
        out,
        "{:<22} {:>13} {:>15}  {:<30} identifiable",
        "parameter", "value", "standard error", "95 % interval"
    )?;
    for parameter in &answer.parameters {
        let error = parameter
            .standard_error
            .map_or_else(|| "unknown".into(), significant);
        writeln!(
            out,
            "{:<22} {:>13} {:>15}  {:<30} {}",
            label(parameter),
            significant(parameter.value),
            error,
            interval(parameter.interval_95),
            if parameter.identifiable { "yes" } else { "NO" }
        )?;
    }
    if let Some(bootstrap) = &answer.bootstrap {
        writeln!(out)?;
        writeln!(
            out,
            "bootstrap: {} replicates, seed {}, {} failed",
            bootstrap.replicates, bootstrap.seed, bootstrap.failed
        )?;
        for (k, parameter) in answer.parameters.iter().enumerate() {
            writeln!(
                out,
                "{:<22} {:>13} {:>15}  {}",
                label(parameter),
                "",
                significant(bootstrap.standard_errors[k]),
                interval(bootstrap.interval_95[k])
            )?;
        }
    }
    for i in 1..answer.parameters.len() {
        for j in 0..i {
            if let Some(correlation) = answer.correlation[i][j] {
                let (one, other) = (&answer.parameters[j].name, &answer.parameters[i].name);
                writeln!(out, "correlation of {one} and {other}: {correlation:.3}")?;
            }
        }
    }
    writeln!(out)?;
    writeln!(
        out,
        "{:>9} {:>13} {:>11} {:>13}",
        "pass", "measured, N", "fitted, N", "residual, N"
    )?;
    let stride = answer.fit.len().div_ceil(ROWS);
    for row in answer.fit.iter().step_by(stride.max(1)) {
        writeln!(
            out,
            "{:>9} {:>13.1} {:>11.1} {:>13.1}",
            row.pass, row.force_n, row.fitted_n, row.residual_n
        )?;
    }
    if stride > 1 {
        writeln!(
            out,
            "(every {stride} of {} readings; --csv writes all)",
            answer.fit.len()
        )?;
    }
    writeln!(out)?;
    let explained = answer
        .r_squared
        .map_or_else(String::new, |r| format!(", R² {r:.5}"));
    writeln!(
        out,
        "residuals: {:.2} N rms{explained}, {:.1} degrees of freedom",
        answer.residual_rms_n, answer.degrees_of_freedom
    )?;
    writeln!(
        out,
        "error of the mesh: {:.2} % of the force, at most {:.2} standard errors of a parameter",
        100.0 * answer.model_error.relative,
        answer
            .model_error
            .standard_errors
            .iter()
            .fold(0.0_f64, |most, &error| most.max(error))
    )?;
    writeln!(
        out,
        "method: cable {}, load cell {}, node spacing {:.3} m, {} model runs; {}",
        answer.method.cable,
        answer.method.load_cell[0],
        answer.method.node_spacing_m[0],
        answer.evaluations,
        answer.method.intervals
    )?;
    Ok(())
}

fn label(parameter: &FittedParameter) -> String {
    match parameter.unit {
        "1" => parameter.name.clone(),
        unit => format!("{}, {unit}", parameter.name),
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
