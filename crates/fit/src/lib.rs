#![doc = include_str!("../README.md")]

mod answer;
mod cell_errors;
mod diagnosis;
mod discrepancy;
mod error;
mod ground;
mod instrument;
mod meshes;
mod mistakes;
mod model;
mod noise;
mod options;
mod overload;
mod parameters;
mod problem;
pub mod readings;
mod result;
mod unknown;

pub use calibrate::{CalibrationError, Loss};
pub use discrepancy::SHARES;
pub use instrument::{held_end, located};
pub use mistakes::of_forces;
pub use options::{CalibrateOptions, Deflection, Series};
pub use overload::within_reach;
pub use problem::MOST_RUNS;
pub use result::{
    Calibrated, FitMethod, FittedParameter, FittedReading, LackOfFit, ModelErrorEstimate, ProfilePoint,
    ResidualSize,
};
pub use unknown::{Quantity, Unknown};

use crate::instrument::Row;
use crate::model::SeriesModel;
use crate::problem::{Problem, Runs};
use crate::readings::Readings;
use creepage_run::Error;
use creepage_scene::Scene;

/// Calibrates one scene.
///
/// # Errors
///
/// [`Error`] when scene, readings and options do not fit together, there are too few readings, a
/// run fails, or the fit does not converge.
pub fn calibrate(
    scene: &Scene,
    readings: &Readings,
    options: &CalibrateOptions<'_>,
) -> Result<Calibrated, Error> {
    calibrate_jointly(&[Series { scene, readings }], options)
}

/// Calibrates several scenes together, which share what an [`Unknown`] says they share.
///
/// # Errors
///
/// As for [`calibrate()`].
pub fn calibrate_jointly(series: &[Series<'_>], options: &CalibrateOptions<'_>) -> Result<Calibrated, Error> {
    let mut unknowns = options.unknowns.iter();
    if unknowns.any(|unknown| unknown.quantity.is_of_cell()) {
        // What a cell reads too much of any force may be as large as it likes.
        return fit(series, options);
    }
    let kept: Vec<(Readings, Option<String>)> = series.iter().map(within_reach).collect();
    let within = series.iter().zip(&kept);
    let within = within.map(|(one, (readings, _))| Series { readings, ..*one });
    let mut answer = fit(&within.collect::<Vec<_>>(), options)?;
    let words = kept.into_iter().filter_map(|(_, words)| words);
    answer.warnings.splice(..0, words);
    Ok(answer)
}

fn fit(series: &[Series<'_>], options: &CalibrateOptions<'_>) -> Result<Calibrated, Error> {
    let models = series.iter().enumerate();
    let models = models.map(|(index, one)| SeriesModel::new(index, one));
    let models = models.collect::<Result<Vec<_>, _>>()?;
    let rows: Vec<Row> = models.iter().flat_map(|model| model.rows.clone()).collect();
    let problem = Problem {
        models: &models,
        rows: &rows,
        fitted: &parameters::parameters(&models, &rows, options)?,
        options,
        runs: &Runs::default(),
    };
    let answer = answer(&problem);
    problem.check_stopped()?;
    answer
}

fn answer(problem: &Problem<'_>) -> Result<Calibrated, Error> {
    let mistakes = mistakes::mistakes(problem)?;
    // What follows from a wrong sign or unit is not worth intervals.
    match meshes::fit(problem, mistakes.is_empty()) {
        Err(Error::Study { .. }) if !mistakes.is_empty() => {
            let found = "readings without any fit";
            Err(Error::unfit("data", found, mistakes.join("; ")))
        }
        found => answer::answer(problem, &found?, mistakes),
    }
}
