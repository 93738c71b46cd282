//! A fit on ever finer meshes, until the coarser one would hardly move the parameters.

use calibrate::{CalibrationError, Emulator, Fit};

use super::error::study;
use super::model::SeriesModel;
use super::problem::{FIRST_LEVEL, LAST_LEVEL, Problem};
use crate::Error;

/// Shift of a parameter by the mesh, in standard errors, above which a finer one is taken.
pub const MESH_SHIFT: f64 = 0.8;

pub struct Final {
    pub fit: Fit,
    /// What was learned of the forces on the coarsest mesh.
    pub coarsest: Emulator,
    pub level: u32,
    /// How much more than the coarser mesh the finer one of two says, and how many standard errors that moves
    /// each parameter.
    pub difference: Vec<f64>,
    pub shift: Vec<f64>,
    /// What was added to what the mesh predicts.
    pub correction: Option<Vec<f64>>,
    /// Model runs, all levels together.
    pub evaluations: usize,
}

/// Fits with at most `limit` model runs, with profiles or without: on the coarsest mesh, whose runs cost
/// least, then on the first that may answer. Where the one below it would move a parameter too far, on the
/// finest one, to which is added what the next says more at the optimum.
pub fn fit(problem: &Problem<'_>, limit: usize, profiles: bool) -> Result<Final, Error> {
    let mut fits = Fits {
        problem,
        limit,
        profiles,
        evaluations: 0,
    };
    let meshed = problem.models.iter().any(SeriesModel::is_meshed);
    let first = fits.on(0, None, None)?;
    let coarsest = first.emulator.clone();
    let (mut level, mut fit) = (0, first);
    if !meshed {
        level = FIRST_LEVEL;
        fit = fits.on(level, Some(&fit), None)?;
        let coarser = fits.once(level - 1, &fit.values())?;
        let difference: Vec<f64> = fit.fitted.iter().zip(&coarser).map(|(a, b)| a - b).collect();
        let shift = fit.shift(&difference);
        if shift.iter().all(|shift| shift.abs() <= MESH_SHIFT) {
            return Ok(Final {
                fit,
                coarsest,
                level,
                difference,
                shift,
                correction: None,
                evaluations: fits.evaluations,
            });
        }
        level = LAST_LEVEL;
        fit = fits.on(level, Some(&fit), None)?;
    }
    let finer = fits.once(level + 1, &fit.values())?;
    let difference: Vec<f64> = finer.iter().zip(&fit.fitted).map(|(a, b)| a - b).collect();
    let shift = fit.shift(&difference);
    Ok(Final {
        fit: fits.on(level, Some(&fit), Some(difference.clone()))?,
        coarsest,
        level,
        shift,
        correction: Some(difference.clone()),
        difference,
        evaluations: fits.evaluations,
    })
}

struct Fits<'a> {
    problem: &'a Problem<'a>,
    limit: usize,
    profiles: bool,
    evaluations: usize,
}

impl Fits<'_> {
    /// A fit on a level of meshes, which begins with what a fit on a coarser one learned.
    fn on(&mut self, level: u32, coarse: Option<&Fit>, correction: Option<Vec<f64>>) -> Result<Fit, Error> {
        let model = self.problem.model(level, correction);
        let left = self.limit.saturating_sub(self.evaluations);
        let mut calibration = self.problem.calibration(&model, self.profiles, left)?;
        if let Some(coarse) = coarse {
            calibration = calibration.with_coarse(coarse.emulator.clone());
        }
        let fit = calibration.fit().map_err(|error| match error {
            // Of all levels together.
            CalibrationError::EvaluationLimit { .. } => {
                study(CalibrationError::EvaluationLimit { limit: self.limit })
            }
            other => study(other),
        })?;
        self.evaluations += fit.evaluations;
        Ok(fit)
    }

    /// What a level predicts with these values of all parameters.
    fn once(&mut self, level: u32, values: &[f64]) -> Result<Vec<f64>, Error> {
        self.evaluations += 1;
        self.problem.predict(level, 1.0, values)
    }
}
