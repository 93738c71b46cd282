//! The loop of a fit: what the likelihood on the emulator says, the model confirms, or the emulator learns.
//!
//! The model runs all over the range first, or at the optimum of a coarser model. Then it runs at the
//! optimum, and once that holds, at the ends of the intervals, the bounds that they leave out, and low
//! places of the profiles, wherever the emulator's own doubt could change the answer, until there is none
//! (after D. R. Jones, M. Schonlau, W. J. Welch, "Efficient Global Optimization of Expensive Black-Box
//! Functions", Journal of Global Optimization 13, 1998).

use std::iter::zip;

use nalgebra::DVector;
use rayon::prelude::*;

use crate::likelihood::Likelihood;
use crate::search::{all_over, optimum};
use crate::solution::Solution;
use crate::tuning::FIRST_RUNS;
use crate::{Calibration, CalibrationError, Emulator, Estimate, Fit, ModelError, Part};

/// Rounds after which the emulator is taken not to learn any more: five parameters of two series with the
/// ripple of a mesh take thirty.
const ROUNDS: usize = 80;

impl Calibration<'_> {
    /// Fits. The model runs a few times all over the range, then wherever the answer rests on it. What was
    /// learned of it, [`Fit::emulator`], serves other fits.
    ///
    /// # Errors
    ///
    /// [`CalibrationError`] if there are too few observations, the model has no answer anywhere, or the fit
    /// does not converge.
    pub fn fit(&self) -> Result<Fit, CalibrationError> {
        self.check()?;
        let mut emulator = begin(self)?;
        let solution = converge(self, &mut emulator)?;
        let mut estimates = solution.estimates(self);
        if self.discrepancy.is_empty() {
            return Ok(Fit::new(self, emulator, solution, estimates));
        }
        let mut wider = self.clone();
        wider.parameters.extend_from_slice(&self.discrepancy);
        let solution = converge(&wider, &mut emulator)?;
        for (plain, estimate) in zip(&mut estimates, solution.estimates(&wider)) {
            // A model that may be wrong knows no more than one that may not.
            let interval = estimate.interval.with(&plain.interval);
            *plain = Estimate {
                identifiable: interval.is_closed(),
                interval,
                ..estimate
            };
        }
        Ok(Fit::new(&wider, emulator, solution, estimates))
    }
}

/// An emulator that has seen the model run at its first places.
fn begin(problem: &Calibration<'_>) -> Result<Emulator, CalibrationError> {
    let mut emulator = known(problem)?;
    if emulator.evaluations() > 0 {
        return Ok(emulator);
    }
    let dimensions = problem.of_model().len();
    let places = match &emulator.coarse_optimum {
        Some(place) => vec![place.clone()],
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

/// What is known of the model before the fit.
fn known(problem: &Calibration<'_>) -> Result<Emulator, CalibrationError> {
    let of_model = problem.of_model().into_iter();
    let parameters = of_model.map(|k| problem.parameters[k].clone()).collect();
    let fresh = Emulator::new(parameters, parts(problem)?, problem.relative_noise);
    match &problem.emulator {
        None => Ok(fresh),
        Some(known) => known.taken_for(&fresh).ok_or_else(|| {
            let what = "number of parameters of a fit that begins with an earlier one";
            let allowed = "the same parameters and number of observations as there";
            CalibrationError::invalid(what, problem.of_model().len() as f64, allowed)
        }),
    }
}

/// What acts on which predictions: by default every parameter of the model on all.
fn parts(problem: &Calibration<'_>) -> Result<Vec<Part>, CalibrationError> {
    let (observations, count) = (problem.observations.len(), problem.of_model().len());
    let mut parts = problem.model.parts();
    if parts.is_empty() {
        parts.push(Part {
            predictions: observations,
            parameters: (0..count).collect(),
        });
    }
    let predictions = parts.iter().map(|part| part.predictions).sum();
    CalibrationError::check_count("predictions of the model's parts", predictions, observations)?;
    let mut indices = parts.iter().flat_map(|part| &part.parameters);
    match indices.find(|&&index| index >= count) {
        None => Ok(parts),
        Some(&index) => {
            let (what, allowed) = ("index of a parameter of a part", "below the number of parameters");
            Err(CalibrationError::invalid(what, index as f64, allowed))
        }
    }
}

/// A solution that rests on runs of the model wherever the emulator could be wrong about it.
fn converge(problem: &Calibration<'_>, emulator: &mut Emulator) -> Result<Solution, CalibrationError> {
    let mut last: Option<DVector<f64>> = None;
    for _ in 0..ROUNDS {
        let likelihood = Likelihood::new(problem, emulator);
        let (optimum, ends) = optimum(&likelihood, last.as_ref())?;
        let free = optimum.point.free.clone();
        let place = likelihood.place(&free);
        last = Some(free.clone());
        let places = if emulator.has_run(&place) {
            let mut solution = Solution::around(&likelihood, optimum, &ends)?;
            if let Some(lower) = solution.lower(problem) {
                last = Some(lower.clone());
                continue;
            }
            let mut places = emulator.doubtful(
                &weights(problem, &solution),
                &place,
                solution.supports(&likelihood),
            );
            places.retain(|place| !emulator.has_run(place));
            if let Some(predicted) = emulator.known(&place).filter(|_| places.is_empty()) {
                solution.optimum.point.residuals = likelihood.residuals(&free, &predicted);
                emulator.optimum = Some(place);
                return Ok(solution);
            }
            places
        } else {
            vec![place]
        };
        run(problem, emulator, places)?;
    }
    Err(CalibrationError::NotConverged)
}

/// How much the square of an error of each prediction counts, in squared standard errors.
fn weights(problem: &Calibration<'_>, solution: &Solution) -> Vec<f64> {
    let optimum = &solution.optimum;
    let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
    let pairs = curvatures.iter().zip(&problem.sigmas);
    pairs.map(|(c, sigma)| c / (sigma * sigma)).collect()
}

/// Runs the model at places where it has not run yet, and learns what it says; why it had no answer, if
/// it had none at one of them.
fn run(
    problem: &Calibration<'_>,
    emulator: &mut Emulator,
    places: Vec<DVector<f64>>,
) -> Result<Option<ModelError>, CalibrationError> {
    let expected = problem.observations.len();
    let run = |place: DVector<f64>| {
        let predicted = match problem.model.predict(&emulator.values(&place)) {
            Ok(values) => {
                CalibrationError::check_count("predictions", values.len(), expected)?;
                let is_finite = values.iter().all(|value| value.is_finite());
                let reason = || "a prediction is not a finite number".into();
                is_finite.then_some(values).ok_or_else(reason)
            }
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
