//! The loop of a fit: what the likelihood on the emulator says, the model confirms, or the emulator learns.
//!
//! The model runs all over the range first, or where the answer of a coarser model rests. Then it runs at the
//! optimum, at the ends of the intervals and the bounds that they leave out wherever the emulator's own doubt
//! could change the answer, and, once they agree, at low places of the profiles of which too little is known,
//! until both agree at all of them (after D. R. Jones, M. Schonlau, W. J. Welch, "Efficient Global
//! Optimization of Expensive Black-Box Functions", Journal of Global Optimization 13, 1998).

use nalgebra::DVector;
use rayon::prelude::*;

use crate::emulator::Doubt;
use crate::likelihood::Likelihood;
use crate::problem::Problem;
use crate::search::{MAX_ROUNDS, all_over};
use crate::solution::{CheckPoint, Solution, solve};
use crate::tuning::{ACCURACY, APART, FIRST_RUNS, HIDDEN, HIGH, SETTLED, SURE};
use crate::whitening::Whitening;
use crate::{CalibrationError, Emulator, ModelError};

/// Change of the deviance by which a prediction may be off at an optimum: a third of a standard error.
const TOLD: f64 = 0.1;
/// Root of the rise up to which another minimum would be as good a fit, and standard errors of the emulator
/// by which the model might be better than it says.
const AS_GOOD: f64 = 2.0;
const DOUBTS: f64 = 2.0;

/// A place, and what the model said there.
type Run = (DVector<f64>, Result<Vec<f64>, ModelError>);

/// An emulator and the model that it learns from.
pub(crate) struct Learner<'a> {
    pub problem: &'a Problem<'a>,
    pub emulator: Emulator,
    /// Model runs so far.
    pub evaluations: usize,
}

impl<'a> Learner<'a> {
    /// One that has seen the model run at its first places.
    ///
    /// # Errors
    ///
    /// Those of the model's parts, [`CalibrationError::EvaluationLimit`], and
    /// [`CalibrationError::NoAnswer`] where the model has none at any of these places.
    pub fn new(problem: &'a Problem<'a>) -> Result<Self, CalibrationError> {
        let (parameters, parts) = (problem.model_parameters(), problem.parts()?);
        let coarse = problem.coarse.clone();
        if coarse
            .as_ref()
            .is_some_and(|coarse| !coarse.is_of(&parameters, &parts))
        {
            return Err(CalibrationError::InvalidOption {
                name: "coarse emulator's parameters",
                value: parameters.len() as f64,
                allowed: "those of this calibration, and its observations",
            });
        }
        let mut places: Vec<DVector<f64>> = start(problem).into_iter().collect();
        if let Some(coarse) = &coarse {
            places.clone_from(&coarse.pillars);
        } else {
            let count = parameters.len();
            let first = problem.options.first_runs.unwrap_or(FIRST_RUNS * (1 + count));
            places.extend(all_over(count, first));
        }
        let mut learner = Self {
            problem,
            emulator: Emulator::new(
                parameters,
                parts,
                coarse,
                problem.options.relative_noise.powi(2).clamp(1e-12, 1e-8),
            ),
            evaluations: 0,
        };
        let mut runs = learner.run(places)?;
        if runs.iter().all(|(_, predicted)| predicted.is_err()) {
            let reason = runs.pop().and_then(|(_, predicted)| predicted.err());
            return Err(CalibrationError::NoAnswer {
                places: runs.len() + 1,
                source: reason.unwrap_or_else(|| "there are none".into()),
            });
        }
        learner.learn(runs);
        Ok(learner)
    }

    /// A solution at whose places the model agrees, and what whitened its residuals.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::NotConverged`], [`CalibrationError::EvaluationLimit`], and
    /// [`CalibrationError::PredictionLength`].
    pub fn converge(&mut self) -> Result<(Solution, Option<Whitening>), CalibrationError> {
        let problem = self.problem;
        let mut last: Option<DVector<f64>> = None;
        for _ in 0..MAX_ROUNDS {
            let mut likelihood = Likelihood::new(problem, &self.emulator);
            let first = last.or_else(|| Some(likelihood.free(&start(problem)?)));
            let mut solution = solve(&mut likelihood, first, problem.options.profiles)?;
            let (mut doubt, asked) = doubtful(&likelihood, &solution);
            let optimum = likelihood.place(&solution.optimum.point.free);
            let mut places = vec![optimum.clone()];
            places.extend(asked.iter().map(|check| likelihood.place(&check.point.free)));
            let mut runs = self.run(places)?;
            let spent = runs.is_empty();
            if std::env::var_os("DBG").is_some() {
                eprintln!(
                    "round: runs {} optimum {:?} value {:.4e} new {} asked {:?}",
                    self.emulator.runs(),
                    optimum.as_slice(),
                    solution.optimum.value(),
                    runs.len(),
                    asked
                        .iter()
                        .map(|c| (c.root, c.threshold, c.is_end))
                        .collect::<Vec<_>>()
                );
            }
            let seen = |place: &DVector<f64>| -> Option<&[f64]> {
                let run = runs.iter().find(|(other, _)| other == place);
                run.map_or_else(|| self.emulator.known(place), |(_, said)| said.as_deref().ok())
            };
            let residuals =
                seen(&optimum).map(|said| likelihood.residuals(&solution.optimum.point.free, said));
            let agreed = residuals.as_ref().is_some_and(|here| {
                is_settled(&likelihood, &solution, here)
                    && asked.iter().all(|check| {
                        let said = seen(&likelihood.place(&check.point.free));
                        said.is_some_and(|said| agrees(&likelihood, &solution, here, check, said))
                    })
            });
            if std::env::var_os("DBG").is_some() {
                if let Some(here) = &residuals {
                    eprintln!(
                        "   shift {:.3e} deviance {:.4e}",
                        solution.shift(here),
                        solution.optimum.deviance.total(here)
                    );
                }
            }
            let hidden = if agreed {
                hidden(&likelihood, &solution, doubt.as_mut())
            } else {
                Vec::new()
            };
            if (agreed && hidden.is_empty()) || spent {
                let pillars = pillars(&likelihood, &solution);
                solution.optimum.point.residuals = residuals.ok_or(CalibrationError::NotConverged)?;
                let whitening = likelihood.whitening;
                self.learn(runs);
                self.emulator.pillars = pillars;
                return Ok((solution, whitening));
            }
            runs.extend(self.run(hidden)?);
            last = Some(solution.optimum.point.free);
            self.learn(runs);
        }
        Err(CalibrationError::NotConverged)
    }

    /// Runs the model where it has not run yet.
    fn run(&self, places: Vec<DVector<f64>>) -> Result<Vec<Run>, CalibrationError> {
        let mut new: Vec<DVector<f64>> = Vec::new();
        for place in places {
            if !self.emulator.knows(&place) && !new.contains(&place) {
                new.push(place);
            }
        }
        let limit = self.problem.options.max_evaluations;
        if self.evaluations + new.len() > limit {
            return Err(CalibrationError::EvaluationLimit { limit });
        }
        let expected = self.problem.observations.len();
        let run = |place: DVector<f64>| {
            let predicted = self.problem.model.predict(&self.emulator.values(&place));
            let predicted = match predicted {
                Ok(values) if values.len() != expected => {
                    let found = values.len();
                    return Err(CalibrationError::PredictionLength { expected, found });
                }
                Ok(values) => match values.iter().position(|value| !value.is_finite()) {
                    Some(index) => Err(format!("prediction {index} is not a finite number").into()),
                    None => Ok(values),
                },
                failed => failed,
            };
            Ok((place, predicted))
        };
        new.into_par_iter().map(run).collect()
    }

    fn learn(&mut self, runs: Vec<Run>) {
        self.evaluations += runs.len();
        let answers = runs.into_iter().map(|(place, predicted)| (place, predicted.ok()));
        self.emulator.learn(answers.collect());
    }
}

/// Where the model's parameters have the values that are to be tried first.
fn start(problem: &Problem<'_>) -> Option<DVector<f64>> {
    let start = problem.options.start.as_ref()?;
    let own = problem.of_model();
    let share = |k: usize, _| problem.parameters[own[k]].share_of(start[own[k]]);
    Some(DVector::from_fn(own.len(), share))
}

/// The ends and bounds where the emulator's error could change the answer, once the model has run at the
/// optimum, and the doubt that runs at them leave.
fn doubtful<'s>(likelihood: &Likelihood<'_>, solution: &'s Solution) -> (Option<Doubt>, Vec<&'s CheckPoint>) {
    let optimum = &solution.optimum;
    let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
    let sigmas = likelihood.problem.sigmas.iter();
    let weights: Vec<f64> = curvatures
        .iter()
        .zip(sigmas)
        .map(|(c, sigma)| c / (sigma * sigma))
        .collect();
    let Some(mut doubt) = likelihood.emulator.doubt(&weights) else {
        return (None, solution.checks.iter().collect());
    };
    doubt.learn(&likelihood.place(&optimum.point.free));
    let candidate = |check: &CheckPoint| {
        // Half of what would make it another answer, for two standard errors.
        let allowed = SURE.max(0.25 * (check.root - check.threshold).abs());
        (likelihood.place(&check.point.free), allowed)
    };
    let asked = doubt.asked(&solution.checks.iter().map(candidate).collect::<Vec<_>>());
    let checks = asked.into_iter().map(|index| &solution.checks[index]).collect();
    (Some(doubt), checks)
}

/// Low places of the profiles at which the model might fit as well for all that the emulator knows. A finer
/// model rests on what a coarser one was asked.
fn hidden(likelihood: &Likelihood<'_>, solution: &Solution, doubt: Option<&mut Doubt>) -> Vec<DVector<f64>> {
    let Some(doubt) = doubt.filter(|_| likelihood.problem.coarse.is_none()) else {
        return Vec::new();
    };
    let least = HIDDEN.max(noise(likelihood, solution));
    let low = solution.scan.iter().filter(|(_, root)| *root < HIGH);
    let low: Vec<(DVector<f64>, f64)> = low
        .map(|(free, root)| (likelihood.place(free), least.max((root - AS_GOOD) / DOUBTS)))
        .collect();
    let asked = doubt.asked(&low);
    asked.into_iter().map(|index| low[index].0.clone()).collect()
}

/// The model's own noise, in standard errors of all readings together.
fn noise(likelihood: &Likelihood<'_>, solution: &Solution) -> f64 {
    let (problem, optimum) = (likelihood.problem, &solution.optimum);
    let weights = optimum.deviance.weights(&optimum.point.residuals);
    let readings = problem.observations.iter().zip(&problem.sigmas);
    let noise = readings.map(|(value, sigma)| problem.options.relative_noise * value / sigma);
    noise
        .zip(weights.iter())
        .map(|(noise, weight)| weight * noise * noise)
        .sum::<f64>()
        .sqrt()
}

/// Whether the optimum would hardly move if the emulator knew what the model said there, and it predicts the
/// deviance: where readings are out of reach, the sensitivities that tell a move vanish.
fn is_settled(likelihood: &Likelihood<'_>, solution: &Solution, seen: &DVector<f64>) -> bool {
    let optimum = &solution.optimum;
    let change = (optimum.deviance.total(seen) - optimum.value()).abs();
    let noise = noise(likelihood, solution);
    solution.shift(seen) <= SETTLED.max(noise) && change <= TOLD.max(noise)
}

/// Whether what the model said at a place means what the emulator did, where `here` are its residuals at the
/// optimum.
fn agrees(
    likelihood: &Likelihood<'_>,
    solution: &Solution,
    here: &DVector<f64>,
    check: &CheckPoint,
    said: &[f64],
) -> bool {
    let deviance = &solution.optimum.deviance;
    let residuals = likelihood.residuals(&check.point.free, said);
    let root = (deviance.total(&residuals) - deviance.total(here))
        .max(0.0)
        .sqrt();
    // Half of what would make it another answer.
    let margin = 0.5 * (check.root - check.threshold).abs();
    let accuracy = (ACCURACY * check.threshold).max(noise(likelihood, solution));
    (root - check.root).abs() <= margin.max(accuracy)
}

/// The optimum and the ends of the intervals, each at some distance from those before it.
fn pillars(likelihood: &Likelihood<'_>, solution: &Solution) -> Vec<DVector<f64>> {
    let optimum = &solution.optimum;
    let mut kept = vec![&optimum.point];
    for check in &solution.checks {
        let distance = |other: &&crate::likelihood::Point| {
            let off = &other.residuals - &check.point.residuals;
            let weights = optimum.deviance.weights(&optimum.point.residuals);
            off.component_mul(&off).dot(&weights).sqrt()
        };
        if check.is_end && kept.iter().map(distance).fold(f64::INFINITY, f64::min) >= APART {
            kept.push(&check.point);
        }
    }
    kept.into_iter()
        .map(|point| likelihood.place(&point.free))
        .collect()
}
