//! A descent by Levenberg–Marquardt, as a solver that argmin's executor drives: argmin has none of its own.
//!
//! Model runs are expensive, so J follows by Broyden's update (K. Madsen, H. B. Nielsen, O. Tingleff, Methods for Non-Linear Least
//! Squares Problems, 2004, section 3.4) and is computed anew where a step fails.

use argmin::core::{
    Error, Executor, IterState, KV, Problem, Solver, State, TerminationReason, TerminationStatus,
};
use nalgebra::{DMatrix, DVector};

use crate::CalibrationError;
use crate::deviance::Deviance;
use crate::evaluator::Evaluator;
use crate::point::Point;
use crate::step::{Damping, Quadratic};

/// Next step in standard errors at which a descent may stop where no step lowers the deviance: noise of the model hides the rest.
pub(crate) const NOISY: f64 = 0.5;
/// Share of the usual steps of derivatives where no step lowers the deviance: they were too long for a model that bends, in direction of a
/// parameter that the data hardly know. Of 200 direct fits of a steep law 39 failed without it (tests/calibration_coverage.rs).
const SHORTER: f64 = 0.25;

/// How to descend.
#[derive(Clone)]
pub(crate) struct Descent<'a> {
    pub evaluator: &'a Evaluator<'a>,
    pub deviance: Deviance,
    /// A parameter that stays where it is.
    pub held: Option<usize>,
    /// J as it is near the start, if it is known.
    pub jacobian: Option<DMatrix<f64>>,
    /// Whether J must be computed anew before convergence is declared.
    pub verified: bool,
    /// Length of the next step, in standard errors, at which the descent has converged.
    pub tolerance: f64,
    pub iterations: u64,
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

impl Descent<'_> {
    /// Descends from `start`, whether or not that converges.
    pub fn run(self, start: Point) -> Result<Optimum, CalibrationError> {
        let (deviance, iterations) = (self.deviance, self.iterations);
        let solver = LevenbergMarquardt {
            cost: deviance.total(&start.residuals),
            trust: if self.jacobian.is_some() {
                Trust::Updated
            } else {
                Trust::Lost
            },
            jacobian: self.jacobian.clone(),
            point: start,
            damping: Damping::FIRST,
            steps: 1.0,
            offset: f64::INFINITY,
            descent: self,
        };
        // Ctrl-C is the caller's.
        let executor = Executor::new((), solver)
            .ctrlc(false)
            .configure(|state| state.max_iters(iterations));
        let found = executor.run().map_err(own)?;
        let status = found.state.get_termination_status();
        let converged = *status == TerminationStatus::Terminated(TerminationReason::SolverConverged);
        let iterations = found.state.get_iter();
        let LevenbergMarquardt {
            point,
            jacobian,
            offset,
            ..
        } = found.solver;
        let jacobian = jacobian.ok_or(CalibrationError::NotConverged { iterations, offset })?;
        Ok(Optimum {
            point,
            jacobian,
            deviance,
            iterations,
            offset,
            converged,
        })
    }
}

/// An error that has passed through argmin comes out as it went in.
fn own(error: Error) -> CalibrationError {
    error
        .downcast::<CalibrationError>()
        .unwrap_or_else(|source| CalibrationError::Optimiser {
            source: source.into(),
        })
}

/// What is known of J where the descent stands.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Trust {
    /// It was computed there.
    Exact,
    /// It was computed nearby, or has followed by Broyden's update.
    Updated,
    /// It must be computed anew.
    Lost,
}

struct LevenbergMarquardt<'a> {
    descent: Descent<'a>,
    point: Point,
    cost: f64,
    jacobian: Option<DMatrix<f64>>,
    trust: Trust,
    damping: Damping,
    /// Share of the usual steps of derivatives.
    steps: f64,
    offset: f64,
}

impl LevenbergMarquardt<'_> {
    /// The deviance around the present point; J is computed first where it must be.
    fn quadratic(&mut self, weights: &DVector<f64>) -> Result<(Quadratic, DMatrix<f64>), CalibrationError> {
        let held = self.descent.held;
        let jacobian = match self.jacobian.take() {
            Some(jacobian) if self.trust != Trust::Lost => jacobian,
            near => {
                self.trust = Trust::Exact;
                let steps = self.descent.evaluator.steps(weights, near.as_ref(), self.steps);
                self.descent.evaluator.jacobian(&self.point.free, &steps, held)?
            }
        };
        let quadratic = Quadratic::new(&self.point, weights, &jacobian, held);
        self.offset = quadratic.offset();
        Ok((quadratic, jacobian))
    }

    /// One trial step; the answer says why it was the last, if it was.
    fn advance(&mut self) -> Result<Option<TerminationReason>, CalibrationError> {
        let descent = &self.descent;
        let (deviance, tolerance, verified) = (descent.deviance, descent.tolerance, descent.verified);
        let weights = deviance.weights(&self.point.residuals);
        let (mut here, mut jacobian) = self.quadratic(&weights)?;
        let spent = self.damping.is_spent();
        let doubtful = if self.trust == Trust::Updated {
            spent || (verified && self.offset < tolerance)
        } else {
            spent && self.offset >= NOISY && self.steps > SHORTER
        };
        if doubtful {
            if self.trust == Trust::Exact {
                self.steps = SHORTER;
            }
            self.trust = Trust::Lost;
            self.jacobian = Some(jacobian);
            self.damping = Damping::FIRST;
            (here, jacobian) = self.quadratic(&weights)?;
        }
        let reason = if self.offset < tolerance {
            Some(TerminationReason::SolverConverged)
        } else if self.damping.is_spent() {
            Some(TerminationReason::SolverExit(
                "no step lowers the deviance".into(),
            ))
        } else {
            None
        };
        if reason.is_some() {
            self.jacobian = Some(jacobian);
            return Ok(reason);
        }
        if let Some(step) = here.step(self.damping.value()) {
            let free = &self.point.free + &step.change;
            let residuals = self.descent.evaluator.residuals(&free)?;
            let cost = deviance.total(&residuals);
            let share = (self.cost - cost) / step.gain.max(f64::MIN_POSITIVE);
            let poor = self.damping.judge(share);
            let was = self.trust;
            if cost < self.cost {
                // Broyden's update: exact along the step, unchanged across it.
                let missed = &residuals - &self.point.residuals - &jacobian * &step.change;
                jacobian += missed / step.change.norm_squared() * step.change.transpose();
                self.point = Point { free, residuals };
                self.cost = cost;
                self.trust = Trust::Updated;
            }
            // A J that was not computed here is the first suspect; with one that was, the step was too long.
            if poor && was == Trust::Updated {
                self.trust = Trust::Lost;
            }
        } else {
            self.damping.judge(f64::NAN);
        }
        self.jacobian = Some(jacobian);
        Ok(None)
    }
}

/// The iteration as argmin keeps it: point and deviance.
type Iteration = IterState<DVector<f64>, (), (), (), (), f64>;

impl Solver<(), Iteration> for LevenbergMarquardt<'_> {
    fn name(&self) -> &'static str {
        "Levenberg-Marquardt"
    }

    fn next_iter(&mut self, _: &mut Problem<()>, state: Iteration) -> Result<(Iteration, Option<KV>), Error> {
        let reason = self.advance()?;
        let state = state.param(self.point.free.clone()).cost(self.cost);
        Ok(match reason {
            Some(reason) => (state.terminate_with(reason), None),
            None => (state, None),
        })
    }
}
