//! A descent of the deviance on an emulator: argmin's trust region with Steihaug's steps, and the
//! Gauss–Newton approximation Jᵀ diag(w) J of the Hessian (J. Nocedal, S. J. Wright, Numerical
//! Optimization, 2006, algorithms 4.1 and 7.2, section 10.3).

use std::cell::RefCell;

use argmin::core::{
    CostFunction, Error, Executor, Gradient, Hessian, IterState, KV, Problem, Solver, TerminationReason,
    TerminationStatus,
};
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
const MAX_ITERATIONS: u64 = 100;
/// Added to the diagonal of the Hessian: as much as knowing a free variable to ±4, so that one of which the
/// data know nothing stays about where it is. Beside the information in data that determine a parameter it
/// is nothing.
const RIDGE: f64 = 1.0 / 16.0;

/// Where a descent ended.
#[derive(Debug, Clone)]
pub(crate) struct Optimum {
    pub point: Point,
    pub jacobian: DMatrix<f64>,
    pub deviance: Deviance,
}

impl Optimum {
    pub fn value(&self) -> f64 {
        self.deviance.total(&self.point.residuals)
    }
}

/// Descends from free variables at which the emulator has an answer; one that is `held` stays.
///
/// # Errors
///
/// [`CalibrationError::NotConverged`] where numbers are too large to go on.
pub(crate) fn descend(
    likelihood: &Likelihood<'_>,
    deviance: Deviance,
    start: DVector<f64>,
    held: Option<usize>,
) -> Result<Point, CalibrationError> {
    let moving: Vec<usize> = (0..start.len()).filter(|&k| Some(k) != held).collect();
    let first = likelihood.point(start);
    if moving.is_empty() || !deviance.total(&first.residuals).is_finite() {
        return Ok(first);
    }
    let surface = Surface {
        likelihood,
        deviance,
        start: &first.free,
        moving: &moving,
        last: RefCell::default(),
        hessian: RefCell::default(),
    };
    let failed = |_: Error| CalibrationError::NotConverged;
    // Conjugate gradients end after as many steps as there are variables, but for rounding.
    let steps = Steihaug::new().with_max_iters(2 * moving.len() as u64);
    let region = TrustRegion::new(steps)
        .with_max_radius(LONGEST_STEP)
        .map_err(failed)?;
    let variables = DVector::from_fn(moving.len(), |k, _| first.free[moving[k]]);
    let executor = Executor::new(surface, Converging(region));
    // Ctrl-C is the caller's.
    let executor = executor
        .ctrlc(false)
        .configure(|state| state.param(variables).max_iters(MAX_ITERATIONS));
    let mut found = executor.run().map_err(failed)?;
    let mut free = first.free.clone();
    for (&k, &z) in moving.iter().zip(found.state.take_param().iter().flatten()) {
        free[k] = z.clamp(-FARTHEST, FARTHEST);
    }
    Ok(likelihood.point(free))
}

/// The deviance over the variables that move.
struct Surface<'a> {
    likelihood: &'a Likelihood<'a>,
    deviance: Deviance,
    start: &'a DVector<f64>,
    moving: &'a [usize],
    /// Where the deviance was last asked for, and the Hessian that was found along with the last gradient.
    last: RefCell<Option<(DVector<f64>, Point)>>,
    hessian: RefCell<DMatrix<f64>>,
}

impl Surface<'_> {
    fn point(&self, variables: &DVector<f64>) -> Point {
        let mut free = self.start.clone();
        for (&k, &z) in self.moving.iter().zip(variables.iter()) {
            free[k] = z;
        }
        self.likelihood.point(free)
    }
}

/// How far beyond its bound a variable is, where nothing changes any more and a spring draws it back.
fn beyond(z: f64) -> f64 {
    z - z.clamp(-FARTHEST, FARTHEST)
}

impl CostFunction for Surface<'_> {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, variables: &DVector<f64>) -> Result<f64, Error> {
        let springs: f64 = variables.iter().map(|&z| beyond(z).powi(2)).sum();
        let point = self.point(variables);
        let deviance = self.deviance.total(&point.residuals);
        *self.last.borrow_mut() = Some((variables.clone(), point));
        Ok(deviance + springs)
    }
}

impl Gradient for Surface<'_> {
    type Param = DVector<f64>;
    type Gradient = DVector<f64>;

    fn gradient(&self, variables: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let last = self.last.take().filter(|(last, _)| last == variables);
        let point = last.map_or_else(|| self.point(variables), |(_, point)| point);
        let jacobian = self.likelihood.jacobian(&point.free).select_columns(self.moving);
        let weights = self.deviance.weights(&point.residuals);
        let mut gradient = 2.0 * jacobian.tr_mul(&weights.component_mul(&point.residuals));
        let mut hessian = 2.0 * information(&jacobian, &weights);
        for (k, &z) in variables.iter().enumerate() {
            hessian[(k, k)] += 2.0 * RIDGE;
            if beyond(z) != 0.0 {
                gradient[k] = 2.0 * beyond(z);
                hessian.fill_row(k, 0.0);
                hessian.fill_column(k, 0.0);
                hessian[(k, k)] = 2.0;
            }
        }
        // Steihaug's steps panic where a number is none.
        if !gradient
            .iter()
            .chain(hessian.iter())
            .all(|entry| entry.abs() < 1e60)
        {
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

/// argmin's trust region, which of itself never ends.
struct Converging(TrustRegion<Steihaug<DVector<f64>, f64>, f64>);

type Iteration = IterState<DVector<f64>, DVector<f64>, (), DMatrix<f64>, (), f64>;

impl<'a> Solver<Surface<'a>, Iteration> for Converging {
    fn name(&self) -> &'static str {
        "Trust region until it has converged"
    }

    fn init(
        &mut self,
        problem: &mut Problem<Surface<'a>>,
        state: Iteration,
    ) -> Result<(Iteration, Option<KV>), Error> {
        self.0.init(problem, state)
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Surface<'a>>,
        state: Iteration,
    ) -> Result<(Iteration, Option<KV>), Error> {
        self.0.next_iter(problem, state)
    }

    /// Ends by the length of the undamped step in standard errors, √(½ gᵀH⁻¹g) (D. M. Bates, D. G.
    /// Watts, "A relative offset orthogonality convergence criterion", Technometrics 23, 1981).
    fn terminate(&mut self, state: &Iteration) -> TerminationStatus {
        let (gradient, hessian) = (state.get_gradient(), state.get_hessian());
        let factor = hessian.and_then(|hessian| hessian.clone().cholesky());
        match gradient.zip(factor) {
            Some((gradient, factor))
                if 0.5 * gradient.dot(&factor.solve(gradient)) < CONVERGED * CONVERGED =>
            {
                TerminationStatus::Terminated(TerminationReason::SolverConverged)
            }
            _ => TerminationStatus::NotTerminated,
        }
    }
}
