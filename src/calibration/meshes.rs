//! A fit on ever finer meshes, until a finer one hardly moves the parameters.

use calibrate::{Calibration, CalibrationError, Emulator, Fit, Model, Profiles};

use super::error::FitError;
use super::model::SeriesModel;
use super::problem::{Effort, FIRST_LEVEL, LAST_LEVEL, Problem};

/// Shift of a parameter by the mesh, in standard errors, above which a finer one is taken.
pub const MESH_SHIFT: f64 = 0.8;
/// Distance to the minimum, in standard errors, at which a fit is good enough to look at its mesh, and in the end.
const PILOT_TOLERANCE: f64 = 0.3;
const TOLERANCE: f64 = 0.05;

pub struct Final {
    pub fit: Fit,
    /// What was learned of the forces on its mesh.
    pub emulator: Emulator,
    pub mesh: MeshChoice,
    /// Model runs, all levels together.
    pub evaluations: usize,
}

/// The level of meshes of the final fit.
pub struct MeshChoice {
    pub level: u32,
    /// What the finer mesh of the last two that were compared says more there, and how many standard errors that moves each parameter.
    pub difference: Vec<f64>,
    pub shift: Vec<f64>,
    /// Whether that is still to be added.
    corrected: bool,
    /// Where a fit on this level or the one below led.
    values: Vec<f64>,
    /// What was learned of the forces on the last level that was fitted.
    emulator: Emulator,
}

impl MeshChoice {
    /// What is added to the predictions on its level.
    pub fn correction(&self) -> Option<Vec<f64>> {
        self.corrected.then(|| self.difference.clone())
    }
}

/// Fits with at most `limit` model runs, with intervals of this kind.
pub fn fit(problem: &Problem<'_>, limit: usize, profiles: Profiles) -> Result<Final, FitError> {
    let (mesh, mut evaluations) = find_level(problem, limit, profiles)?;
    let model = problem.model(mesh.level, mesh.correction());
    let effort = Effort {
        profiles,
        tolerance: TOLERANCE,
        runs: limit.saturating_sub(evaluations),
    };
    let calibration = problem.calibration(&model, Some(mesh.values.clone()), &effort)?;
    let (fit, emulator) = emulated(&calibration, Some(&mesh.emulator), limit)?;
    evaluations += fit.evaluations;
    Ok(Final {
        fit,
        emulator,
        mesh,
        evaluations,
    })
}

/// The coarsest level that moves the parameters hardly away from those of the level below, and the model runs that it took.
fn find_level(
    problem: &Problem<'_>,
    limit: usize,
    wanted: Profiles,
) -> Result<(MeshChoice, usize), FitError> {
    let mut evaluations = 0;
    let mut level = 0;
    let mut start = None;
    let mut coarser: Option<Emulator> = None;
    loop {
        let model = problem.model(level, None);
        let effort = Effort {
            // What is learned on coarse meshes costs least: there the intervals are explored too.
            profiles: if level < FIRST_LEVEL {
                wanted
            } else {
                Profiles::None
            },
            tolerance: PILOT_TOLERANCE,
            runs: limit.saturating_sub(evaluations),
        };
        let calibration = problem.calibration(&model, start, &effort)?;
        let (fit, emulator) = emulated(&calibration, coarser.as_ref(), limit)?;
        let values = fit.values();
        let mut finer = problem
            .model(level + 1, None)
            .predict(problem.of_model(&values))
            .map_err(|source| CalibrationError::NoFeasibleStart { starts: 1, source })?;
        problem.add_terms(&mut finer, &values);
        evaluations += fit.evaluations + 1;
        let difference: Vec<f64> = finer.iter().zip(&fit.fitted).map(|(a, b)| a - b).collect();
        let shift = fit.shift(&difference);
        let enough = level + 1 >= FIRST_LEVEL && shift.iter().all(|shift| shift.abs() <= MESH_SHIFT);
        let last = level == LAST_LEVEL || problem.models.iter().any(SeriesModel::is_meshed);
        if enough || last {
            let found = MeshChoice {
                level: if last { level } else { level + 1 },
                corrected: last,
                values,
                difference,
                shift,
                emulator,
            };
            return Ok((found, evaluations));
        }
        start = Some(values);
        coarser = Some(emulator);
        level += 1;
    }
}

/// Fits with what is left of the runs; an error states the `limit` of them all.
fn emulated(
    calibration: &Calibration<'_>,
    coarser: Option<&Emulator>,
    limit: usize,
) -> Result<(Fit, Emulator), FitError> {
    calibration.fit_emulated(coarser).map_err(|error| {
        match error {
            CalibrationError::EvaluationLimit { .. } => CalibrationError::EvaluationLimit { limit },
            other => other,
        }
        .into()
    })
}
