//! A descent of the deviance on an emulator: argmin's trust region with Steihaug's steps, and the
//! Gauss–Newton approximation Jᵀ diag(w) J of the Hessian (J. Nocedal, S. J. Wright, Numerical
//! Optimization, 2006, algorithms 4.1 and 7.2, section 10.3).

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Gradient, Hessian, IterState, Problem, Solver, State};
use argmin::solver::trustregion::{Steihaug, TrustRegion};
use nalgebra::{DMatrix, DVector};

use crate::CalibrationError;
use crate::deviance::{Deviance, information};
use crate::likelihood::{Likelihood, Point};
use crate::parameter::FARTHEST;
use crate::tuning::LONGEST_STEP;

/// Length of the next step, in standard errors, at which a descent has converged.
const CONVERGED: f64 = 1e-2;
/// Iterations of a descent: far more than one takes that gets anywhere.
const MAX_ITERATIONS: usize = 100;
/// Added to the diagonal of the Hessian: as much as knowing a free variable to ±4, so that one of which the
/// data know nothing stays about where it is. Relative to the information in data that determine a
/// parameter it is nothing.
const RIDGE: f64 = 1.0 / 16.0;

/// Where a descent ended.
#[derive(Debug, Clone)]
pub(crate) struct Optimum {
    pub point: Point,
    pub jacobian: DMatrix<f64>,
    pub deviance: Deviance,
}

impl Optimum {
    pub fn at(likelihood: &Likelihood<'_>, point: Point, deviance: Deviance) -> Self {
        Self {
            jacobian: likelihood.jacobian(&point.free),
            point,
            deviance,
        }
    }

    pub fn value(&self) -> f64 {
        self.deviance.total(&self.point.residuals)
    }
}

type Iteration = IterState<DVector<f64>, DVector<f64>, (), DMatrix<f64>, (), f64>;

/// Descends from free variables at which the emulator has an answer; one that is `held` stays.
pub(crate) fn descend(
    likelihood: &Likelihood<'_>,
    deviance: Deviance,
    start: DVector<f64>,
    held: Option<usize>,
) -> Result<Point, CalibrationError> {
    let first = likelihood.point(start);
    if !deviance.total(&first.residuals).is_finite() {
        return Ok(first);
    }
    let surface = Surface {
        likelihood,
        deviance,
        held,
        hessian: RefCell::default(),
    };
    let found = minimise(surface, first.free).map_err(|_| CalibrationError::NotConverged)?;
    Ok(likelihood.point(found.map(|z| z.clamp(-FARTHEST, FARTHEST))))
}

fn minimise(surface: Surface<'_>, start: DVector<f64>) -> Result<DVector<f64>, Error> {
    // Conjugate gradients end after as many steps as there are variables, but for rounding.
    let steps = Steihaug::new().with_max_iters(2 * start.len() as u64);
    let mut region = TrustRegion::new(steps).with_max_radius(LONGEST_STEP)?;
    let mut problem = Problem::new(surface);
    let first = Iteration::new().param(start.clone());
    let mut state = region.init(&mut problem, first)?.0;
    for _ in 0..MAX_ITERATIONS {
        if has_converged(&state) {
            break;
        }
        state = region.next_iter(&mut problem, state)?.0;
    }
    Ok(state.take_param().unwrap_or(start))
}

/// The deviance over the free variables.
struct Surface<'a> {
    likelihood: &'a Likelihood<'a>,
    deviance: Deviance,
    /// A variable that stays: its slope is 0.
    held: Option<usize>,
    /// At the variables of the last gradient.
    hessian: RefCell<DMatrix<f64>>,
}

/// By the length of the undamped step in standard errors, √(½ gᵀH⁻¹g) (D. M. Bates, D. G. Watts, "A
/// relative offset orthogonality convergence criterion", Technometrics 23, 1981).
fn has_converged(state: &Iteration) -> bool {
    let factor = state.get_hessian().and_then(|hessian| hessian.clone().cholesky());
    let local = state.get_gradient().zip(factor);
    local
        .is_some_and(|(gradient, factor)| 0.5 * gradient.dot(&factor.solve(gradient)) < CONVERGED * CONVERGED)
}

/// How far beyond its bound a variable is, if nothing changes any more and a spring draws it back.
fn overshoot(z: f64) -> f64 {
    z - z.clamp(-FARTHEST, FARTHEST)
}

impl CostFunction for Surface<'_> {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, free: &DVector<f64>) -> Result<f64, Error> {
        let springs: f64 = free.iter().map(|&z| overshoot(z).powi(2)).sum();
        let residuals = self.likelihood.point(free.clone()).residuals;
        Ok(self.deviance.total(&residuals) + springs)
    }
}

impl Gradient for Surface<'_> {
    type Param = DVector<f64>;
    type Gradient = DVector<f64>;

    fn gradient(&self, free: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let residuals = self.likelihood.point(free.clone()).residuals;
        let mut jacobian = self.likelihood.jacobian(free);
        if let Some(held) = self.held {
            jacobian.column_mut(held).fill(0.0);
        }
        let weights = self.deviance.weights(&residuals);
        let springs = free.map(|z| 2.0 * overshoot(z));
        let mut hessian = 2.0 * information(&jacobian, &weights);
        for (k, &spring) in springs.iter().enumerate() {
            hessian[(k, k)] += 2.0 * if spring == 0.0 { RIDGE } else { 1.0 };
        }
        let gradient = 2.0 * jacobian.tr_mul(&weights.component_mul(&residuals)) + springs;
        // Steihaug's steps panic where a number is none.
        let mut entries = gradient.iter().chain(&hessian);
        if !entries.all(|entry| entry.abs() < 1e60) {
            return Err(CalibrationError::NotConverged.into());
        }
        *self.hessian.borrow_mut() = hessian;
        Ok(gradient)
    }
}

impl Hessian for Surface<'_> {
    type Param = DVector<f64>;
    type Hessian = DMatrix<f64>;

    /// At the variables of the last gradient, which the trust region always asks for first.
    fn hessian(&self, _: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
        Ok(self.hessian.borrow().clone())
    }
}
