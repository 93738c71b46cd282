#![doc = include_str!("../README.md")]

mod alternatives;
mod answer;
mod cell;
mod diagnosis;
mod discrepancy;
mod error;
mod ground;
mod meshes;
mod mistakes;
mod model;
mod noise;
mod options;
mod overload;
mod problem;
pub mod readings;
mod result;
mod row;
mod terms;
mod unknown;
mod watch;

use calibrate::Options;

pub use calibrate::{CalibrationError, Loss};
pub use cell::{force_ends, held_end};
pub use diagnosis::LackOfFit;
pub use discrepancy::SHARES;
pub use mistakes::of_forces;
pub use options::{CalibrateOptions, Deflection, Series};
pub use overload::within_reach;
pub use result::{
    Calibrated, FitMethod, FittedParameter, FittedReading, ModelErrorEstimate, ProfilePoint, ResidualSize,
};
pub use unknown::{Quantity, Unknown};

use crate::readings::Readings;
use creepage_run::Error;
use creepage_scene::Scene;
use model::SeriesModel;
use problem::Problem;
use watch::Watch;

/// Calibrates one scene.
///
/// # Errors
///
/// [`Error`] when scene, readings and options do not fit together, there are too few readings, a run fails, or the fit does
/// not converge.
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
    let kept: Vec<(Readings, Option<String>)> = series.iter().map(overload::within_reach).collect();
    let pairs = series.iter().zip(&kept);
    let within: Vec<Series<'_>> = pairs
        .map(|(one, (readings, _))| Series { readings, ..*one })
        .collect();
    let mut answer = fit(&within, options)?;
    answer
        .warnings
        .splice(..0, kept.into_iter().filter_map(|(_, words)| words));
    Ok(answer)
}

fn fit(series: &[Series<'_>], options: &CalibrateOptions<'_>) -> Result<Calibrated, Error> {
    let unknowns = problem::unknowns(series, options)?;
    let models = series
        .iter()
        .map(SeriesModel::new)
        .collect::<Result<Vec<_>, _>>()?;
    let rows = row::rows(series, &models);
    let limit = match options.max_evaluations {
        0 => Options::default().max_evaluations,
        limit => limit,
    };
    let (terms, unknowns): (Vec<Unknown>, Vec<Unknown>) = unknowns
        .into_iter()
        .partition(|unknown| unknown.quantity.is_of_cell());
    let watch = Watch::new(options.progress, limit);
    let problem = Problem {
        series,
        models: &models,
        rows: &rows,
        unknowns: &unknowns,
        terms: &terms::terms(series.len(), &rows, &terms, options)?,
        options,
        limit,
        watch: &watch,
    };
    let answer = || {
        let mistakes = mistakes::mistakes(&problem)?;
        // What follows from a wrong sign or unit is not worth intervals.
        match meshes::fit(&problem, mistakes.is_empty()) {
            Err(Error::Study { .. }) if !mistakes.is_empty() => {
                error::unfit("data", "readings without any fit", mistakes.join("; "))
            }
            found => answer::answer(&problem, &found?, mistakes),
        }
    };
    let answer = answer();
    if watch.is_stopped() {
        Err(Error::Stopped)
    } else {
        answer
    }
}
