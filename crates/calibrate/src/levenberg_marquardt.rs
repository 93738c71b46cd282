//! Levenberg–Marquardt as a solver of argmin, which has none.
//!
//! A step solves (H + λ diag H) Δz = −g with g = Jᵀ(w ∘ r), H = Jᵀ diag(w) J; λ falls when the deviance falls as predicted and
//! rises when it does not (J. J. Moré, "The Levenberg–Marquardt algorithm", 1978; K. Madsen, H. B. Nielsen, O. Tingleff, Methods for
//! Non-Linear Least Squares Problems, 2004, section 3.2). Model runs are dear, so J follows by Broyden's update (section 3.4
//! there) and is computed anew where it fails, and always before convergence is declared.
//!
//! Converged means that the full step would lower the deviance by less than a tolerance: √(gᵀH⁻¹g) is its length in standard
//! errors (D. M. Bates, D. G. Watts, "A relative offset orthogonality convergence criterion", Technometrics 23, 1981).

use argmin::core::{Error, IterState, KV, Operator, Problem, Solver, State, TerminationReason};
use nalgebra::{DMatrix, DVector};

use crate::deviance::{Deviance, information};
use crate::evaluator::Evaluator;
use crate::parameter::FARTHEST;

/// First damping, largest before a fit counts as stuck, and what it is divided and multiplied by.
const FIRST_DAMPING: f64 = 1e-3;
const LARGEST_DAMPING: f64 = 1e4;
/// Damping that changes a step: less of it after a failure would only repeat that.
const FELT_DAMPING: f64 = 0.03;
const LEAST_DAMPING: f64 = 1e-9;
const RELIEF: f64 = 10.0;
const INCREASE: f64 = 8.0;
/// Share of the predicted gain that must come for damping to fall, and below which it rises.
const GOOD_GAIN: f64 = 0.5;
const POOR_GAIN: f64 = 0.1;
/// Added to the diagonal of H: as much as knowing a free variable to ±4, so that one of which the data know nothing, whose
/// slopes are noise, stays about where it is. Beside the information in data that determine a parameter it is nothing.
const RIDGE: f64 = 1.0 / 16.0;
/// Offset, in standard errors, at which a fit has converged where so many steps have failed: ripple of the model hides the rest.
const ROUGH: f64 = 0.25;
const MAX_FAILURES: usize = 2;
/// Longest step of a free variable.
const LONGEST_STEP: f64 = 2.0;

/// State of the iteration as argmin keeps it.
pub(crate) type FitState = IterState<DVector<f64>, (), DMatrix<f64>, (), DVector<f64>, f64>;

/// The least-squares problem as argmin sees it.
pub(crate) struct FitProblem<'a> {
    pub evaluator: &'a Evaluator<'a>,
    pub fixed: &'a [bool],
}

impl Operator for FitProblem<'_> {
    type Param = DVector<f64>;
    type Output = DVector<f64>;

    fn apply(&self, free: &DVector<f64>) -> Result<DVector<f64>, Error> {
        Ok(self.evaluator.residuals(free)?)
    }
}

impl FitProblem<'_> {
    /// J by differences, their steps by the slopes of a Jacobian from nearby.
    fn jacobian(
        &self,
        free: &DVector<f64>,
        weights: &DVector<f64>,
        near: Option<&DMatrix<f64>>,
    ) -> Result<DMatrix<f64>, Error> {
        let slopes = near.map(|near| -> Vec<f64> {
            let square = |column: usize| -> f64 {
                let column = near.column(column);
                column
                    .iter()
                    .zip(weights.iter())
                    .map(|(slope, weight)| weight * slope * slope)
                    .sum()
            };
            (0..near.ncols()).map(|column| square(column).sqrt()).collect()
        });
        let steps = self.evaluator.steps(weights, slopes.as_deref());
        Ok(self.evaluator.jacobian(free, &steps, self.fixed)?)
    }
}

/// The solver.
pub(crate) struct LevenbergMarquardt {
    deviance: Deviance,
    /// Variables that stay where they are.
    fixed: Vec<bool>,
    /// Offset, in standard errors, at which the fit has converged.
    tolerance: f64,
    /// Whether J must be new when convergence is declared.
    verified: bool,
    damping: f64,
    /// J, and whether it was computed by differences where the iteration stands.
    jacobian: Option<DMatrix<f64>>,
    fresh: bool,
    /// Steps in a row that did not lower the deviance.
    failures: usize,
    /// J from nearby, by which the steps of the next one are chosen.
    slopes_from: Option<DMatrix<f64>>,
    /// Length of the full step in standard errors when last computed.
    pub offset: f64,
}

impl LevenbergMarquardt {
    pub fn new(deviance: Deviance, fixed: Vec<bool>, tolerance: f64) -> Self {
        Self {
            deviance,
            fixed,
            tolerance,
            verified: true,
            damping: FIRST_DAMPING,
            jacobian: None,
            fresh: false,
            failures: 0,
            slopes_from: None,
            offset: f64::INFINITY,
        }
    }

    /// Starts from a Jacobian from nearby, or, `fresh`, from the one at the start itself.
    pub fn with_jacobian(mut self, jacobian: Option<DMatrix<f64>>, fresh: bool) -> Self {
        self.fresh = fresh && jacobian.is_some();
        self.jacobian = jacobian;
        self
    }

    /// Chooses the steps of its first Jacobian by one from nearby.
    pub fn with_slopes(mut self, near: DMatrix<f64>) -> Self {
        self.slopes_from = Some(near);
        self
    }

    /// Trusts an updated Jacobian when convergence is declared.
    pub fn unverified(mut self) -> Self {
        self.verified = false;
        self
    }

    /// Variables that a step may move: not fixed, and not pressed against a bound.
    fn moving(&self, free: &DVector<f64>, gradient: &DVector<f64>) -> Vec<usize> {
        (0..free.len())
            .filter(|&k| !self.fixed[k])
            .filter(|&k| {
                let outward = -gradient[k] * free[k] > 0.0;
                !(outward && free[k].abs() >= FARTHEST)
            })
            .collect()
    }

    /// Δz at damping λ, and by how much it should lower the deviance.
    fn step(&self, here: &Quadratic, damping: f64) -> Option<(DVector<f64>, f64)> {
        let moving = self.moving(&here.free, &here.gradient);
        let mut step = DVector::zeros(here.free.len());
        if moving.is_empty() {
            return Some((step, 0.0));
        }
        let mut matrix = DMatrix::from_fn(moving.len(), moving.len(), |i, j| {
            here.information[(moving[i], moving[j])]
        });
        for i in 0..moving.len() {
            matrix[(i, i)] += damping * matrix[(i, i)] + RIDGE;
        }
        let gradient = DVector::from_fn(moving.len(), |i, _| -here.gradient[moving[i]]);
        let solved = matrix.cholesky()?.solve(&gradient);
        for (i, &k) in moving.iter().enumerate() {
            let moved =
                (here.free[k] + solved[i].clamp(-LONGEST_STEP, LONGEST_STEP)).clamp(-FARTHEST, FARTHEST);
            step[k] = moved - here.free[k];
        }
        let gain = -2.0 * here.gradient.dot(&step) - step.dot(&(&here.information * &step));
        Some((step, gain))
    }
}

/// Deviance to second order around a point.
struct Quadratic {
    free: DVector<f64>,
    gradient: DVector<f64>,
    information: DMatrix<f64>,
}

type Outcome = Result<(FitState, Option<KV>), Error>;

impl Solver<FitProblem<'_>, FitState> for LevenbergMarquardt {
    fn name(&self) -> &'static str {
        "Levenberg-Marquardt"
    }

    fn init(&mut self, problem: &mut Problem<FitProblem<'_>>, mut state: FitState) -> Outcome {
        let free = state.take_param().unwrap_or_default();
        let residuals = match state.take_residuals() {
            Some(residuals) => residuals,
            None => problem.problem("operator_count", |problem| problem.apply(&free))?,
        };
        let cost = self.deviance.total(&residuals);
        Ok((state.param(free).residuals(residuals).cost(cost), None))
    }

    /// One trial step, and a new Jacobian first where one is needed.
    fn next_iter(&mut self, problem: &mut Problem<FitProblem<'_>>, mut state: FitState) -> Outcome {
        let cost = state.get_cost();
        let (Some(free), Some(residuals)) = (state.take_param(), state.take_residuals()) else {
            return Ok((
                state.terminate_with(TerminationReason::SolverExit("no start".into())),
                None,
            ));
        };
        let weights = self.deviance.weights(&residuals);
        let mut differentiate = |solver: &mut Self, near: Option<&DMatrix<f64>>| {
            solver.fresh = true;
            problem.problem("jacobian_count", |problem| {
                problem.jacobian(&free, &weights, near)
            })
        };
        let mut jacobian = match self.jacobian.take() {
            Some(jacobian) => jacobian,
            None => differentiate(self, self.slopes_from.clone().as_ref())?,
        };
        let quadratic = |jacobian: &DMatrix<f64>| Quadratic {
            free: free.clone(),
            gradient: jacobian.transpose() * weights.component_mul(&residuals),
            information: information(jacobian, &weights),
        };
        let mut here = quadratic(&jacobian);
        let mut full = self
            .step(&here, LEAST_DAMPING)
            .map_or(f64::INFINITY, |full| full.1);
        let stuck = self.damping > LARGEST_DAMPING;
        if !self.fresh && (stuck || (self.verified && full.max(0.0).sqrt() < self.tolerance)) {
            jacobian = differentiate(self, Some(&jacobian))?;
            self.damping = self.damping.min(FIRST_DAMPING);
            here = quadratic(&jacobian);
            full = self
                .step(&here, LEAST_DAMPING)
                .map_or(f64::INFINITY, |full| full.1);
        }
        self.offset = full.max(0.0).sqrt();
        let rough = self.failures >= MAX_FAILURES && self.fresh && self.offset < ROUGH;
        let done = if self.offset < self.tolerance || rough {
            Some(TerminationReason::SolverConverged)
        } else if self.damping > LARGEST_DAMPING {
            Some(TerminationReason::SolverExit(
                "no step lowers the deviance".into(),
            ))
        } else {
            None
        };
        if let Some(reason) = done {
            let state = state
                .param(free)
                .residuals(residuals)
                .jacobian(jacobian)
                .cost(cost);
            return Ok((state.terminate_with(reason), None));
        }

        let Some((step, predicted)) = self.step(&here, self.damping) else {
            self.damping *= INCREASE;
            self.jacobian = Some(jacobian.clone());
            let state = state.jacobian(jacobian);
            return Ok((state.param(free).residuals(residuals).cost(cost), None));
        };
        let trial = &free + &step;
        let found = problem.problem("operator_count", |problem| problem.apply(&trial))?;
        let found_cost = self.deviance.total(&found);
        let gain = (cost - found_cost) / predicted.max(f64::MIN_POSITIVE);
        let accepted = found_cost < cost;
        self.failures = if accepted { 0 } else { self.failures + 1 };
        if gain > GOOD_GAIN {
            self.damping = (self.damping / RELIEF).max(LEAST_DAMPING);
        } else if gain < POOR_GAIN {
            self.damping = (INCREASE * self.damping).max(FELT_DAMPING);
        }
        if accepted {
            // Broyden's update: exact along the step, unchanged across it.
            let missed = (&found - &residuals - &jacobian * &step) / step.dot(&step);
            jacobian += missed * step.transpose();
        }
        // An old Jacobian is the first suspect; a rejected step from a new one means that the step was too long.
        let renew = gain < POOR_GAIN && !self.fresh;
        if renew {
            self.slopes_from = Some(jacobian.clone());
        } else {
            self.jacobian = Some(jacobian.clone());
        }
        let state = state.jacobian(jacobian);
        self.fresh = self.fresh && !accepted;
        let state = if accepted {
            state.param(trial).residuals(found).cost(found_cost)
        } else {
            state.param(free).residuals(residuals).cost(cost)
        };
        Ok((state, None))
    }
}
