//! One implicit step with the sigmoid law: a smooth convex problem by Newton's method with a line search.
//!
//! The step minimises Π(r) = ½ rᵀ(K + S + c) r − pᵀr + Σ w (2q/b) ln cosh(b (ΔD − r)/2), whose gradient is
//!
//! R(r) = (K + S + c) r − p − w q tanh(b (ΔD − r)/2),
//!
//! and whose Hessian adds w (q b/2) sech² to the diagonal. Along Newton's direction d the derivative R·d grows from below
//! zero; a full step that passes the minimum is cut back until |R·d| has fallen to half. For a large b the tanh is
//! nearly a step and Newton starts far from its basin: where it does not arrive from the last increment, it starts again from
//! the answer for clamp(b Δs/2, −1, 1), which the active set finds ([`StepSolver`]).

use super::{Lumped, StepSolver};
use crate::quasi_static::{Contact, Tolerance};
use crate::{FrictionLaw, Statistics};

/// Newton steps from the last increment, and from the clamped law's answer.
const NEWTON_STEPS: [usize; 2] = [15, 200];
/// Halvings of one line search.
const HALVINGS: usize = 40;

/// Solver of implicit steps over the whole cable for the sigmoid law.
#[derive(Debug, Clone)]
pub(crate) struct SigmoidSolver {
    /// The clamped law's solver, and the loads.
    pub inner: StepSolver,
    half_shape: f64,
    limit: f64,
    /// K + S + c on the diagonal \[N/m\].
    diagonal: Vec<f64>,
    r: Vec<f64>,
    tried: Vec<f64>,
    direction: Vec<f64>,
    residual: Vec<f64>,
    slope: Vec<f64>,
    upper: Vec<f64>,
    clamped: Vec<f64>,
}

impl SigmoidSolver {
    pub fn new(lumped: &Lumped, inertia: f64) -> Self {
        let nodes = lumped.mesh.nodes();
        let zeros = || vec![0.0; nodes];
        let k = lumped.stiffness;
        let mut diagonal: Vec<f64> = (0..nodes).map(|i| 2.0 * k + inertia * lumped.mass(i)).collect();
        diagonal[0] -= k;
        diagonal[nodes - 1] -= k;
        for &(node, spring) in &lumped.springs {
            diagonal[node] += spring;
        }
        let friction = lumped.cable.friction();
        let half_shape = match friction.law() {
            FrictionLaw::Sigmoid { shape_factor } => 0.5 * shape_factor,
            _ => 0.0,
        };
        Self {
            inner: StepSolver::new(lumped, inertia),
            half_shape,
            limit: friction.limit(),
            diagonal,
            r: zeros(),
            tried: zeros(),
            direction: zeros(),
            residual: zeros(),
            slope: zeros(),
            upper: zeros(),
            clamped: zeros(),
        }
    }

    /// Forgets earlier passes: a pass depends on the state it starts from, to the last digit.
    pub fn start(&mut self) {
        self.r.fill(0.0);
        self.inner.contacts().fill(Contact::Stuck);
    }

    /// Solves one step with duct increments `duct` and the inner solver's loads; `f` becomes the friction. On failure the
    /// largest residual as a share of the friction limit.
    pub fn solve(
        &mut self,
        lumped: &Lumped,
        tolerance: Tolerance,
        duct: &[f64],
        f: &mut [f64],
        statistics: &mut Statistics,
    ) -> Result<&[f64], f64> {
        let mut outcome = self.newton(lumped, tolerance, duct, NEWTON_STEPS[0], statistics);
        if outcome.is_err() {
            self.clamped.fill(0.0);
            let start = self
                .inner
                .solve(lumped, tolerance, duct, &mut self.clamped, statistics);
            if start.is_ok() {
                self.r.copy_from_slice(self.inner.increments());
            }
            outcome = self.newton(lumped, tolerance, duct, NEWTON_STEPS[1], statistics);
        }
        if let Err(violation) = outcome {
            self.r.fill(0.0);
            return Err(violation);
        }
        for i in 0..f.len() {
            f[i] = self.limit * (self.half_shape * (duct[i] - self.r[i])).tanh();
        }
        Ok(&self.r)
    }

    /// Newton's method from `r`.
    fn newton(
        &mut self,
        lumped: &Lumped,
        tolerance: Tolerance,
        duct: &[f64],
        steps: usize,
        statistics: &mut Statistics,
    ) -> Result<(), f64> {
        let nodes = duct.len();
        let mut worst = f64::INFINITY;
        for _ in 0..steps {
            let start = self.evaluate(lumped, duct, 0.0);
            worst = start.worst;
            if worst <= tolerance.friction {
                return Ok(());
            }
            self.solve_direction(lumped);
            statistics.sweeps += 1;
            statistics.node_updates += nodes;
            let descent: f64 = (0..nodes).map(|i| self.residual[i] * self.direction[i]).sum();
            if descent >= 0.0 || descent.is_nan() {
                break;
            }
            let mut share = 1.0;
            for _ in 0..HALVINGS {
                let along = self.evaluate(lumped, duct, share).along;
                if along <= 0.5 * descent.abs() {
                    break;
                }
                share *= 0.5;
            }
            for (r, d) in self.r.iter_mut().zip(&self.direction) {
                *r += share * d;
            }
        }
        // What the last step reached.
        worst = worst.min(self.evaluate(lumped, duct, 0.0).worst);
        if worst <= tolerance.friction {
            Ok(())
        } else {
            Err(if worst.is_nan() {
                f64::INFINITY
            } else {
                worst / self.limit
            })
        }
    }

    /// Residual and slope at r + share · direction.
    fn evaluate(&mut self, lumped: &Lumped, duct: &[f64], share: f64) -> Evaluation {
        let nodes = duct.len();
        let last = nodes - 1;
        let k = lumped.stiffness;
        for i in 0..nodes {
            let d = if share == 0.0 {
                0.0
            } else {
                share * self.direction[i]
            };
            self.tried[i] = self.r[i] + d;
        }
        let mut result = Evaluation {
            worst: 0.0,
            along: 0.0,
        };
        for (i, &moved) in duct.iter().enumerate() {
            if (i == 0 && lumped.fixed[0]) || (i == last && lumped.fixed[1]) {
                self.residual[i] = 0.0;
                self.slope[i] = 0.0;
                continue;
            }
            let r = self.tried[i];
            let left = if i > 0 { self.tried[i - 1] } else { 0.0 };
            let right = if i < last { self.tried[i + 1] } else { 0.0 };
            let w = lumped.mesh.tributary_length(i);
            let tanh = (self.half_shape * (moved - r)).tanh();
            let residual =
                self.diagonal[i] * r - k * (left + right) - self.inner.load[i] - w * self.limit * tanh;
            self.residual[i] = residual;
            self.slope[i] = w * self.limit * self.half_shape * (1.0 - tanh * tanh);
            let violation = residual.abs() / w;
            // What is not a number is a violation too.
            result.worst = result.worst.max(if violation.is_nan() {
                f64::INFINITY
            } else {
                violation
            });
            result.along += residual * self.direction[i];
        }
        result
    }

    /// Newton's direction −H⁻¹ R by elimination; H is diagonally dominant.
    fn solve_direction(&mut self, lumped: &Lumped) {
        let k = lumped.stiffness;
        let last = self.r.len() - 1;
        let (lo, hi) = (usize::from(lumped.fixed[0]), last - usize::from(lumped.fixed[1]));
        self.direction.fill(0.0);
        let (mut upper, mut before) = (0.0, 0.0);
        for i in lo..=hi {
            let inverse = 1.0 / (self.diagonal[i] + self.slope[i] - k * upper);
            upper = k * inverse;
            before = (k * before - self.residual[i]) * inverse;
            self.upper[i] = upper;
            self.direction[i] = before;
        }
        for i in (lo..hi).rev() {
            self.direction[i] += self.upper[i] * self.direction[i + 1];
        }
    }
}

/// How far r is from the answer.
#[derive(Debug, Clone, Copy)]
struct Evaluation {
    /// Largest residual per metre of cable \[N/m\].
    worst: f64,
    /// Derivative of the energy along the direction.
    along: f64,
}
