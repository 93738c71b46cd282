//! The loop of a fit: what the likelihood on the emulator says, the model confirms, or the emulator learns.
//!
//! The model runs all over the range first, or where the answer of a coarser model rests. Then it runs
//! at the optimum, at the ends of the intervals and the bounds that they leave out wherever the
//! emulator's own doubt could change the answer, and, once they agree, at low places of the profiles of
//! which too little is known, until both agree at all of them (after D. R. Jones, M. Schonlau, W. J.
//! Welch, "Efficient Global Optimization of Expensive Black-Box Functions", Journal of Global
//! Optimization 13, 1998).

use nalgebra::DVector;
use rayon::prelude::*;

use crate::emulator::Doubt;
use crate::likelihood::{Likelihood, Point};
use crate::problem::Problem;
use crate::search::{MAX_ROUNDS, all_over};
use crate::solution::{CheckPoint, Solution, solve};
use crate::tuning::{ACCURACY, APART, FIRST_RUNS, HIDDEN, HIGH, NEAR, NUGGETS, SETTLED, SURE};
use crate::whitening::Whitening;
use crate::{CalibrationError, Emulator, ModelError, Profiles};

/// Change of the deviance by which a prediction may be off at an optimum: a third of a standard error.
const TOLD: f64 = 0.1;
/// Root of the rise up to which another minimum would be as good a fit, and standard errors of the emulator
/// by which the model might be better than it says.
const AS_GOOD: f64 = 2.0;
const DOUBTS: f64 = 2.0;

/// Distance of optima in free variables, after as many rounds as there may be, at which they are one.
const LOST: f64 = 1e-4;

/// A place, and what the model said there.
type Run = (DVector<f64>, Result<Vec<f64>, ModelError>);

/// What the model said in a round.
struct Seen {
    runs: Vec<Run>,
    /// Residuals at the optimum, if it has an answer there.
    here: Option<DVector<f64>>,
    /// Whether it agrees with the emulator at all places.
    agrees: bool,
}

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
            let (what, allowed) = (
                "number of parameters beside a coarse emulator",
                "those parameters and observations that it has learned",
            );
            return Err(CalibrationError::invalid(what, parameters.len() as f64, allowed));
        }
        let places = match &coarse {
            Some(coarse) => coarse.optimum.iter().cloned().collect(),
            None => all_over(parameters.len(), FIRST_RUNS * (1 + parameters.len())),
        };
        let mut learner = Self {
            problem,
            emulator: Emulator::new(
                parameters,
                parts,
                coarse,
                problem.options.relative_noise.powi(2).clamp(NUGGETS.0, NUGGETS.1),
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
        let wanted = problem.options.profiles;
        // Intervals are worth a look around an optimum that holds, or that a coarser model gave.
        let mut kind = if problem.coarse.is_some() {
            wanted
        } else {
            Profiles::None
        };
        let mut last: Option<DVector<f64>> = None;
        for round in 1..=MAX_ROUNDS {
            let mut likelihood = Likelihood::new(problem, &self.emulator);
            let mut solution = solve(&mut likelihood, last.clone(), kind)?;
            let (mut doubt, asked) = doubtful(&likelihood, &solution);
            let mut seen = self.ask(&likelihood, &solution, &asked)?;
            let free = solution.optimum.point.free.clone();
            // Where readings have no noise, it is lost in rounding.
            let lost = |last: &DVector<f64>| round == MAX_ROUNDS && (last - &free).amax() < LOST;
            let spent = seen.runs.is_empty() || last.as_ref().is_some_and(lost);
            let mut hidden_places = Vec::new();
            if kind == wanted {
                if seen.agrees {
                    hidden_places = hidden(&likelihood, &solution, doubt.as_mut());
                }
                if spent || (seen.agrees && hidden_places.is_empty()) {
                    let optimum = likelihood.place(&free);
                    solution.optimum.point.residuals = seen.here.ok_or(CalibrationError::NotConverged)?;
                    let whitening = likelihood.whitening;
                    self.learn(seen.runs);
                    self.emulator.optimum = Some(optimum);
                    return Ok((solution, whitening));
                }
            }
            let is_near = |here: &DVector<f64>| solution.shift(here) < NEAR;
            if spent || seen.agrees || seen.here.as_ref().is_some_and(is_near) {
                kind = wanted;
            }
            seen.runs.extend(self.run(hidden_places)?);
            last = Some(free);
            self.learn(seen.runs);
        }
        Err(CalibrationError::NotConverged)
    }

    /// What the model says at the optimum and at these places.
    fn ask(
        &self,
        likelihood: &Likelihood<'_>,
        solution: &Solution,
        asked: &[&CheckPoint],
    ) -> Result<Seen, CalibrationError> {
        let points = asked.iter().map(|check| &check.point);
        let points = [&solution.optimum.point].into_iter().chain(points);
        let runs = self.run(points.map(|point| likelihood.place(&point.free)).collect())?;
        let residuals = |point: &Point| {
            let place = likelihood.place(&point.free);
            let said = match runs.iter().find(|(other, _)| *other == place) {
                Some((_, said)) => said.as_ref().ok().cloned(),
                None => self.emulator.known(&place),
            };
            Some(likelihood.residuals(&point.free, &said?))
        };
        let here = residuals(&solution.optimum.point);
        let holds = |here: &DVector<f64>, check: &CheckPoint| {
            let seen = residuals(&check.point);
            seen.is_some_and(|seen| agrees(likelihood, solution, here, check, &seen))
        };
        let agrees = here.as_ref().is_some_and(|here| {
            is_settled(likelihood, solution, here) && asked.iter().all(|check| holds(here, check))
        });
        Ok(Seen { runs, here, agrees })
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
        return (None, apart(solution));
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
    let noise = readings.map(|(value, sigma)| problem.relative_noise() * value / sigma);
    noise
        .zip(weights.iter())
        .map(|(noise, weight)| weight * noise * noise)
        .sum::<f64>()
        .sqrt()
}

/// Whether the optimum would hardly move if the emulator knew what the model said there, and it predicts
/// the deviance: where readings are out of reach, the sensitivities that tell a move vanish.
fn is_settled(likelihood: &Likelihood<'_>, solution: &Solution, seen: &DVector<f64>) -> bool {
    let optimum = &solution.optimum;
    let change = (optimum.deviance.total(seen) - optimum.value()).abs();
    let noise = noise(likelihood, solution);
    // Of the ripple between runs, the parameters follow their share.
    let share = (seen.len() as f64 / optimum.point.free.len() as f64)
        .sqrt()
        .recip();
    solution.shift(seen) <= SETTLED.max(share * noise) && change <= TOLD.max(noise)
}

/// Whether the model's residuals at a place mean what the emulator's did, where `here` are those at the
/// optimum.
fn agrees(
    likelihood: &Likelihood<'_>,
    solution: &Solution,
    here: &DVector<f64>,
    check: &CheckPoint,
    seen: &DVector<f64>,
) -> bool {
    let deviance = &solution.optimum.deviance;
    let root = (deviance.total(seen) - deviance.total(here)).max(0.0).sqrt();
    // Half of what would make it another answer.
    let margin = 0.5 * (check.root - check.threshold).abs();
    let accuracy = (ACCURACY * check.threshold).max(noise(likelihood, solution));
    (root - check.root).abs() <= margin.max(accuracy)
}

/// The ends of the intervals, each at some distance from the optimum and from those before it.
fn apart(solution: &Solution) -> Vec<&CheckPoint> {
    let optimum = &solution.optimum;
    let weights = optimum.deviance.weights(&optimum.point.residuals);
    let mut kept: Vec<&CheckPoint> = Vec::new();
    for check in solution.checks.iter().filter(|check| check.is_end) {
        let others = kept.iter().map(|other| &other.point).chain([&optimum.point]);
        let distance = |other: &Point| {
            let off = &other.residuals - &check.point.residuals;
            off.component_mul(&off).dot(&weights).sqrt()
        };
        if others.map(distance).fold(f64::INFINITY, f64::min) >= APART {
            kept.push(check);
        }
    }
    kept
}
