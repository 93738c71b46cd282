//! The way to the optimum: a coarse scan, a descent from its best point, and another descent from elsewhere to compare.

use std::fmt;
use std::sync::Arc;

use argmin::core::observers::{Observe, ObserverMode};
use argmin::core::{Error, Executor, KV, State, TerminationReason, TerminationStatus};
use nalgebra::{DMatrix, DVector};

use crate::compass::settle;
use crate::deviance::Deviance;
use crate::evaluator::{Evaluator, feasible};
use crate::levenberg_marquardt::{FitProblem, FitState, LevenbergMarquardt};
use crate::uncertainty::parameters_from_data;
use crate::{CalibrationError, Loss};

/// Iterations of one descent.
const MAX_ITERATIONS: u64 = 200;
/// Next step in standard errors at which a descent may stop where no step lowers the deviance: noise of the model hides any
/// further descent.
const NOISY_TOLERANCE: f64 = 0.5;
/// The same for a minimum found by trial.
const SETTLED: f64 = 0.1;
/// The same for a descent that is only compared.
const ROUGH_TOLERANCE: f64 = 0.1;
/// Rounds of fit and scale of the noise, and the changes of spread and normalisation at which they end. The latter jumps as a residual
/// crosses the loss's threshold, and only weighs data against priors.
const MAX_ROUNDS: usize = 30;
const SPREAD_TOLERANCE: f64 = 0.005;
const NORMALISATION_TOLERANCE: f64 = 0.1;
/// Rounds after which only half of a change of the spread is made, so that the rounds cannot go in a circle.
const FREE_ROUNDS: usize = 4;
/// Fall of the deviance that makes another optimum the better one.
pub(crate) const BETTER: f64 = 0.05;
/// Rise of the deviance up to which another minimum counts as a rival: two standard errors.
const RIVAL: f64 = 4.0;
/// Distance from an optimum, in free variables, of a start worth a second descent.
const ELSEWHERE: f64 = 0.7;
/// Descents from elsewhere, and their iterations.
const RESTART_ITERATIONS: u64 = 12;
const MAX_RESTARTS: usize = 3;

/// What an observer is told after every iteration.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    /// Iteration of the present descent.
    pub iteration: u64,
    /// Deviance: its falls are in units of squared standard errors.
    pub deviance: f64,
    /// Parameters in their physical units.
    pub parameters: Vec<f64>,
}

/// Hears of every iteration.
#[derive(Clone)]
pub struct Observer(Arc<dyn Fn(&Progress) + Send + Sync>);

impl Observer {
    /// Calls `observe` after every iteration.
    pub fn new(observe: impl Fn(&Progress) + Send + Sync + 'static) -> Self {
        Self(Arc::new(observe))
    }
}

impl fmt::Debug for Observer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Observer(..)")
    }
}

/// A point and its residuals.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub free: DVector<f64>,
    pub residuals: DVector<f64>,
}

/// Where a descent ended.
#[derive(Debug, Clone)]
pub(crate) struct Optimum {
    pub point: Point,
    pub jacobian: DMatrix<f64>,
    pub deviance: Deviance,
    pub iterations: u64,
    /// Length of the next step in standard errors.
    pub offset: f64,
    /// Whether it is within the tolerance.
    pub converged: bool,
}

impl Optimum {
    pub fn value(&self) -> f64 {
        self.deviance.total(&self.point.residuals)
    }
}

/// What a search needs.
pub(crate) struct Search<'a> {
    pub evaluator: &'a Evaluator<'a>,
    pub observer: Option<Observer>,
    /// Whether the observations came with sigmas.
    pub known_noise: bool,
    /// Next step in standard errors at which a descent has converged.
    pub tolerance: f64,
    pub loss: Loss,
    /// Whether a run costs so much that the others of a profile are fitted no better than an interval needs.
    pub dear: bool,
    /// Smallest noise that makes sense, in units of σ.
    pub least_noise: f64,
}

/// Hands argmin's iterations on to the caller.
struct Reporter {
    observer: Observer,
    parameters: Vec<crate::Parameter>,
}

impl Observe<FitState> for Reporter {
    fn observe_iter(&mut self, state: &FitState, _: &KV) -> Result<(), Error> {
        let Some(free) = state.get_param() else {
            return Ok(());
        };
        (self.observer.0)(&Progress {
            iteration: state.get_iter(),
            deviance: state.get_cost(),
            parameters: self
                .parameters
                .iter()
                .zip(free.iter())
                .map(|(parameter, &z)| parameter.value(parameter.bounded(z)))
                .collect(),
        });
        Ok(())
    }
}

impl Search<'_> {
    fn count(&self) -> usize {
        self.evaluator.parameters.len()
    }

    /// Runs `solver` from `start` until it has converged.
    fn descend(
        &self,
        solver: LevenbergMarquardt,
        fixed: &[bool],
        deviance: Deviance,
        start: Point,
    ) -> Result<Optimum, CalibrationError> {
        let optimum = self.attempt(solver, fixed, deviance, start, MAX_ITERATIONS)?;
        if optimum.converged || optimum.offset < NOISY_TOLERANCE {
            return Ok(optimum);
        }
        let (iterations, offset) = (optimum.iterations, optimum.offset);
        match settle(self.evaluator, &deviance, optimum.point, SETTLED)? {
            Some((point, offset)) => Ok(Optimum {
                jacobian: optimum.jacobian,
                deviance,
                iterations,
                offset,
                converged: true,
                point,
            }),
            None => Err(CalibrationError::NotConverged { iterations, offset }),
        }
    }

    /// Runs `solver` from `start`, whether or not it converges.
    pub fn attempt(
        &self,
        solver: LevenbergMarquardt,
        fixed: &[bool],
        deviance: Deviance,
        start: Point,
        max_iterations: u64,
    ) -> Result<Optimum, CalibrationError> {
        let problem = FitProblem {
            evaluator: self.evaluator,
            fixed,
        };
        // Ctrl-C is the caller's.
        let mut executor = Executor::new(problem, solver).ctrlc(false).configure(|state| {
            state
                .param(start.free)
                .residuals(start.residuals)
                .max_iters(max_iterations)
        });
        if let Some(observer) = &self.observer {
            let reporter = Reporter {
                observer: observer.clone(),
                parameters: self.evaluator.parameters.to_vec(),
            };
            executor = executor.add_observer(reporter, ObserverMode::Always);
        }
        let mut result = executor.run()?;
        let converged = matches!(
            result.state.get_termination_status(),
            TerminationStatus::Terminated(TerminationReason::SolverConverged)
        );
        let iterations = result.state.get_iter();
        let offset = result.solver.offset;
        let parts = (
            result.state.take_param(),
            result.state.take_residuals(),
            result.state.take_jacobian(),
        );
        match parts {
            (Some(free), Some(residuals), Some(jacobian)) => Ok(Optimum {
                point: Point { free, residuals },
                jacobian,
                deviance,
                iterations,
                offset,
                converged,
            }),
            _ => Err(CalibrationError::NotConverged { iterations, offset }),
        }
    }

    /// Scale of the noise at a point: known, or from the residuals there.
    fn scaled(&self, deviance: Deviance, residuals: &DVector<f64>, freedom: f64) -> Deviance {
        match (self.loss.is_robust(), self.known_noise) {
            (false, true) => deviance,
            (true, false) => deviance
                .with_median_spread(residuals, freedom, self.least_noise)
                .normalised(residuals, freedom, self.least_noise),
            _ => deviance.normalised(residuals, freedom, self.least_noise),
        }
    }

    /// Descends from `start`, adapting the scale of the noise.
    pub fn refine(&self, start: Point, jacobian: Option<DMatrix<f64>>) -> Result<Optimum, CalibrationError> {
        let stages: &[Loss] = match self.loss {
            Loss::Tukey { .. } => &[Loss::HUBER, self.loss],
            _ => &[self.loss],
        };
        let mut optimum = None;
        let mut start = start;
        let mut jacobian = jacobian;
        for &loss in stages {
            let found = self.refine_with(loss, start, jacobian, optimum.is_some())?;
            start = found.point.clone();
            jacobian = Some(found.jacobian.clone());
            optimum = Some(found);
        }
        optimum.ok_or(CalibrationError::NotConverged {
            iterations: 0,
            offset: f64::INFINITY,
        })
    }

    fn refine_with(
        &self,
        loss: Loss,
        start: Point,
        jacobian: Option<DMatrix<f64>>,
        fresh: bool,
    ) -> Result<Optimum, CalibrationError> {
        let data = self.evaluator.values.len();
        let fixed = vec![false; self.count()];
        let mut freedom = (data as f64 - self.count() as f64).max(1.0);
        let first = Deviance {
            loss,
            data,
            spread: 1.0,
            normalisation: 1.0,
        };
        let mut deviance = self.scaled(first, &start.residuals, freedom);
        let (mut point, mut jacobian, mut fresh) = (start, jacobian, fresh);
        let mut iterations = 0;
        for round in 0..MAX_ROUNDS {
            let solver = LevenbergMarquardt::new(deviance, fixed.clone(), self.tolerance)
                .with_jacobian(jacobian, fresh);
            let mut optimum = self.descend(solver, &fixed, deviance, point)?;
            iterations += optimum.iterations;
            optimum.iterations = iterations;
            let used = parameters_from_data(&optimum.jacobian, &deviance, &optimum.point.residuals);
            freedom = (data as f64 - used).max(0.5);
            let mut next = self.scaled(deviance, &optimum.point.residuals, freedom);
            let change = |new: f64, old: f64| (new / old).ln().abs();
            if change(next.spread, deviance.spread) < SPREAD_TOLERANCE
                && change(next.normalisation, deviance.normalisation) < NORMALISATION_TOLERANCE
            {
                return Ok(Optimum {
                    deviance: next,
                    ..optimum
                });
            }
            if round >= FREE_ROUNDS {
                next.spread = (next.spread * deviance.spread).sqrt();
            }
            deviance = next;
            point = optimum.point;
            jacobian = Some(optimum.jacobian);
            fresh = true;
        }
        Err(CalibrationError::NotConverged {
            iterations,
            offset: f64::INFINITY,
        })
    }

    /// Points all over the range, the best first; before them the start, if there is one.
    pub fn scan(&self, start: Option<DVector<f64>>, count: usize) -> Result<Vec<Point>, CalibrationError> {
        let mut points: Vec<DVector<f64>> = start.into_iter().collect();
        let started = points.len();
        points.extend(all_over(self.count(), count));
        let residuals = self.evaluator.all(&points)?;
        let mut scored: Vec<(f64, Point)> = points
            .into_iter()
            .zip(residuals)
            .enumerate()
            .filter(|(_, (_, residuals))| feasible(residuals))
            .map(|(index, (free, residuals))| {
                // Of several minima that are as good, the one next to the start is wanted.
                let score = if index < started {
                    f64::NEG_INFINITY
                } else {
                    score(&residuals, self.evaluator.values.len(), self.known_noise)
                };
                (score, Point { free, residuals })
            })
            .collect();
        scored.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(scored.into_iter().map(|(_, point)| point).collect())
    }

    /// Descends from the first point of `scan`, and from the best of the others to see whether they lead lower.
    ///
    /// The second answer is a minimum elsewhere that is hardly higher.
    pub fn best(&self, scan: &[Point], restart: bool) -> Result<(Optimum, Option<Point>), CalibrationError> {
        let mut failure = None;
        let mut optimum = None;
        for point in scan.iter().take(1 + MAX_RESTARTS) {
            match self.refine(point.clone(), None) {
                Ok(found) => {
                    optimum = Some(found);
                    break;
                }
                Err(error @ CalibrationError::EvaluationLimit { .. }) => return Err(error),
                Err(error) => failure = failure.or(Some(error)),
            }
        }
        let mut optimum = match (optimum, failure) {
            (Some(optimum), _) => optimum,
            (None, Some(error)) => return Err(error),
            (None, None) => {
                return Err(CalibrationError::NoFeasibleStart {
                    starts: self.evaluator.count(),
                    source: self.evaluator.last_failure(),
                });
            }
        };
        let restarts = if restart { MAX_RESTARTS } else { 0 };
        let mut rival = None;
        for _ in 0..restarts {
            match self.descend_elsewhere(scan, &optimum)? {
                Some(other) if other.value() < optimum.value() - BETTER => {
                    optimum = self.refine(other.point, None)?;
                }
                Some(other) => {
                    rival = Some(other.point);
                    break;
                }
                None => break,
            }
        }
        Ok((optimum, rival))
    }

    /// A minimum elsewhere that is lower than `optimum` or hardly higher, if a descent from the best point far from it leads to one.
    fn descend_elsewhere(
        &self,
        scan: &[Point],
        optimum: &Optimum,
    ) -> Result<Option<Optimum>, CalibrationError> {
        let far = |point: &&Point| (&point.free - &optimum.point.free).amax() > ELSEWHERE;
        let Some(start) = scan.iter().skip(1).find(far) else {
            return Ok(None);
        };
        let fixed = vec![false; self.count()];
        let solver = LevenbergMarquardt::new(optimum.deviance, fixed.clone(), ROUGH_TOLERANCE).unverified();
        match self.attempt(
            solver,
            &fixed,
            optimum.deviance,
            start.clone(),
            RESTART_ITERATIONS,
        ) {
            Ok(other) if other.value() < optimum.value() - BETTER => Ok(Some(other)),
            Ok(other) if other.value() < optimum.value() + RIVAL && far(&&other.point) => Ok(Some(other)),
            Err(error @ CalibrationError::EvaluationLimit { .. }) => Err(error),
            Ok(_) | Err(_) => Ok(None),
        }
    }
}

/// Points all over the range, by the generalised golden ratio (M. Roberts, "The unreasonable effectiveness of quasirandom sequences",
/// 2018).
pub(crate) fn all_over(dimensions: usize, count: usize) -> Vec<DVector<f64>> {
    let mut ratio = 2.0_f64;
    for _ in 0..60 {
        ratio = (1.0 + ratio).powf(1.0 / (dimensions as f64 + 1.0));
    }
    let point = |index: usize| {
        DVector::from_fn(dimensions, |k, _| {
            let share = (0.5 + (index + 1) as f64 * ratio.powi(-(k as i32) - 1)).fract();
            (share / (1.0 - share)).ln().clamp(-5.0, 5.0)
        })
    };
    (0..count).map(point).collect()
}

/// −2 log likelihood under noise with heavy tails, whose scale is known or estimated on the spot. So many residuals are those of `data`, the
/// others those of priors.
pub(crate) fn score(residuals: &DVector<f64>, data: usize, known_noise: bool) -> f64 {
    let sum: f64 = residuals.iter().take(data).map(|r| r.abs()).sum();
    let priors: f64 = residuals.iter().skip(data).map(|r| r * r).sum();
    if known_noise {
        2.0 * sum + priors
    } else {
        2.0 * data as f64 * sum.max(f64::MIN_POSITIVE).ln() + priors
    }
}
