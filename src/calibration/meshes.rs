//! The fit on the mesh that the plan takes, and what a finer one says more.

use calibrate::{CalibrationError, Fit};

use super::model::MeshOf;
use super::problem::{Problem, Way};
use crate::Error;

pub struct Final {
    pub fit: Fit,
    /// How much more a mesh twice as fine says at the optimum, which was added to what the mesh predicts, and how many standard errors
    /// that moved each parameter.
    pub difference: Vec<f64>,
    pub shift: Vec<f64>,
    /// Model runs, all meshes together.
    pub evaluations: usize,
}

/// Fits with at most `limit` model runs, with profiles or without: on the coarsest mesh, whose runs cost least, then on that of the plan, then on
/// the same with what a mesh twice as fine says more at the optimum.
pub fn fit(problem: &Problem<'_>, limit: usize, profiles: bool) -> Result<Final, Error> {
    let limited = |error: CalibrationError| match error {
        // Of all meshes together.
        CalibrationError::EvaluationLimit { .. } => CalibrationError::EvaluationLimit { limit },
        other => other,
    };
    let none = vec![0.0; problem.rows.len()];
    let way = Way {
        mesh: MeshOf::Answer,
        difference: &none,
        profiles,
        runs: limit,
    };
    let (first, mut evaluations) = if problem.models.iter().any(|model| model.levels.named) {
        let alone = Way {
            profiles: false,
            ..way
        };
        (problem.fit(alone, |calibration| calibration, limited)?, 0)
    } else {
        let guess = Way {
            mesh: MeshOf::Guess,
            ..way
        };
        let guess = problem.fit(guess, |calibration| calibration, limited)?;
        let runs = limit.saturating_sub(guess.evaluations);
        let answer = Way {
            profiles: false,
            runs,
            ..way
        };
        let coarse = guess.emulator;
        let first = problem.fit(answer, |calibration| calibration.with_coarse(coarse), limited)?;
        (first, guess.evaluations)
    };
    let finer = problem.predict(MeshOf::Check, 1.0, &first.values())?;
    evaluations += 1;
    let difference: Vec<f64> = finer.iter().zip(&first.fitted).map(|(a, b)| a - b).collect();
    let (shift, _) = first.shift(&difference);
    let last = Way {
        difference: &difference,
        runs: limit.saturating_sub(evaluations),
        ..way
    };
    let known = first.emulator;
    let fit = problem.fit(last, |calibration| calibration.with_emulator(known), limited)?;
    Ok(Final {
        evaluations: evaluations + fit.evaluations,
        fit,
        difference,
        shift,
    })
}
