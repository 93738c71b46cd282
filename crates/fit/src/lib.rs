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
pub use problem::MAX_RUNS;
pub use result::{
    Calibrated, FitMethod, FittedParameter, FittedReading, LackOfFit, ModelErrorEstimate, ProfilePoint,
    ResidualSize,
};
pub use unknown::{Quantity, Unknown};

use crate::model::SeriesModel;
use crate::problem::{Problem, Runs};
use crate::readings::{Reading, Readings};
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
    // What a cell reads too much of any force may be as large as it likes.
    let is_bounded = !options
        .unknowns
        .iter()
        .any(|unknown| unknown.quantity.is_of_cell());
    let kept = |one| {
        if is_bounded {
            within_reach(one)
        } else {
            (one.readings.clone(), None)
        }
    };
    let kept: Vec<(Readings, Option<String>)> = series.iter().map(kept).collect();
    let models = series.iter().zip(&kept).enumerate();
    let models = models.map(|(index, (one, (readings, _)))| SeriesModel::new(index, one.scene, readings));
    let models = models.collect::<Result<Vec<_>, _>>()?;
    let rows: Vec<Reading> = models.iter().flat_map(|model| model.rows.clone()).collect();
    let problem = Problem {
        models: &models,
        rows: &rows,
        fitted: &parameters::parameters(&models, &rows, options)?,
        options,
        runs: &Runs::default(),
    };
    let answer = answer(&problem);
    problem.check_stopped()?;
    let mut answer = answer?;
    let words = kept.into_iter().filter_map(|(_, words)| words);
    answer.warnings.splice(..0, words);
    Ok(answer)
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
