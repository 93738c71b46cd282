//! The loop of a fit: what the likelihood on the emulator says, the model confirms, or the emulator learns.
//!
//! The model runs all over the range first, or where the answer of a coarser model rests. Then it runs
//! at the optimum, and once that holds, at the ends of the intervals, the bounds that they leave out, and
//! low places of the profiles, wherever the emulator's own doubt could change the answer, until there is
//! none (after D. R. Jones, M. Schonlau, W. J. Welch, "Efficient Global Optimization of Expensive
//! Black-Box Functions", Journal of Global Optimization 13, 1998).

use nalgebra::DVector;
use rayon::prelude::*;

use crate::likelihood::Likelihood;
use crate::problem::Problem;
use crate::search::all_over;
use crate::solution::{Solution, solve};
use crate::tuning::FIRST_RUNS;
use crate::{CalibrationError, Emulator, ModelError};

/// Rounds after which the emulator is taken not to learn any more: five parameters of two series with the
/// ripple of a mesh take thirty.
const ROUNDS: usize = 80;

/// An emulator that has seen the model run at its first places.
///
/// # Errors
///
/// Those of the model's parts, [`CalibrationError::EvaluationLimit`], and
/// [`CalibrationError::NoAnswer`] if the model has none at any of these places.
pub(crate) fn begin(problem: &Problem<'_>) -> Result<Emulator, CalibrationError> {
    let parameters: Vec<_> = problem
        .of_model()
        .into_iter()
        .map(|k| problem.parameters[k].clone())
        .collect();
    let (dimensions, noise) = (parameters.len(), problem.options.relative_noise);
    let mut emulator = Emulator::new(parameters, problem.parts()?, noise, problem.coarse.clone())?;
    let places = match &problem.coarse {
        Some(coarse) => coarse.optimum.iter().cloned().collect(),
        None => all_over(dimensions, FIRST_RUNS * (1 + dimensions)),
    };
    match run(problem, &mut emulator, places)? {
        Some(source) if emulator.runs() == 0 => {
            let places = emulator.evaluations();
            Err(CalibrationError::NoAnswer { places, source })
        }
        _ => Ok(emulator),
    }
}

/// A solution that rests on runs of the model wherever the emulator could be wrong about it.
///
/// # Errors
///
/// [`CalibrationError::NotConverged`], [`CalibrationError::EvaluationLimit`], and
/// [`CalibrationError::PredictionLength`].
pub(crate) fn converge(problem: &Problem<'_>, emulator: &mut Emulator) -> Result<Solution, CalibrationError> {
    let mut last: Option<DVector<f64>> = None;
    for _ in 0..ROUNDS {
        let likelihood = Likelihood::new(problem, emulator);
        let mut solution = solve(&likelihood, last.as_ref())?;
        let free = solution.optimum.point.free.clone();
        let optimum = likelihood.place(&free);
        let mut places = doubtful(&likelihood, &solution);
        places.insert(0, optimum.clone());
        places.retain(|place| !emulator.knows(place));
        if let Some(predicted) = emulator.known(&optimum)
            && places.is_empty()
            && solution.is_complete
        {
            solution.optimum.point.residuals = likelihood.residuals(&free, &predicted);
            emulator.optimum = Some(optimum);
            return Ok(solution);
        }
        run(problem, emulator, places)?;
        last = Some(free);
    }
    Err(CalibrationError::NotConverged)
}

/// Runs the model at places where it has not run yet, and learns what it says; why it had no answer, if
/// it had none at one of them.
fn run(
    problem: &Problem<'_>,
    emulator: &mut Emulator,
    places: Vec<DVector<f64>>,
) -> Result<Option<ModelError>, CalibrationError> {
    let limit = problem.options.max_evaluations;
    if emulator.evaluations() + places.len() > limit {
        return Err(CalibrationError::EvaluationLimit { limit });
    }
    let expected = problem.observations.len();
    let run = |place: DVector<f64>| {
        let predicted = problem.model.predict(&emulator.values(&place));
        let predicted = match predicted {
            Ok(values) if values.len() != expected => {
                let found = values.len();
                return Err(CalibrationError::PredictionLength { expected, found });
            }
            Ok(values) if values.iter().all(|value| value.is_finite()) => Ok(values),
            Ok(_) => Err("a prediction is not a finite number".into()),
            failed => failed,
        };
        Ok((place, predicted))
    };
    let runs = places.into_par_iter().map(run).collect::<Result<Vec<_>, _>>()?;
    let mut failure = None;
    let mut answers = Vec::new();
    for (place, predicted) in runs {
        answers.push((place, predicted.map_err(|reason| failure = Some(reason)).ok()));
    }
    emulator.learn(answers);
    Ok(failure)
}

/// Places on which a solution rests and where the emulator's own error could change it, once the model has
/// run at the optimum.
fn doubtful(likelihood: &Likelihood<'_>, solution: &Solution) -> Vec<DVector<f64>> {
    let optimum = &solution.optimum;
    let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
    let sigmas = likelihood.problem.sigmas.iter();
    let weights: Vec<f64> = curvatures
        .iter()
        .zip(sigmas)
        .map(|(c, sigma)| c / (sigma * sigma))
        .collect();
    let mut doubt = likelihood.emulator.doubt(&weights);
    doubt.learn(&likelihood.place(&optimum.point.free));
    doubt.asked(solution.supports.clone())
}
