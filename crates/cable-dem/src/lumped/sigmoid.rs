//! One implicit step with the sigmoid law: a smooth convex problem by Newton's method with a line search.
//!
//! The step minimises Π(r) = ½ rᵀ(K + S) r − pᵀr + Σ w (2q/b) ln cosh(b (ΔD − r)/2), whose gradient is
//!
//! R(r) = (K + S) r − p − w q tanh(b (ΔD − r)/2),
//!
//! and whose Hessian adds w (q b/2) sech² to the diagonal. Along Newton's direction d the derivative R·d grows from below
//! zero; a full step that passes the minimum is cut back until |R·d| has fallen to half. For a large b the tanh is
//! nearly a step and Newton starts far from its basin: where it does not arrive from no motion, it starts again from
//! the answer for clamp(b Δs/2, −1, 1), which the active set finds ([`super::step`]).

use super::Lumped;
use crate::step::{Chain, Stretch};
use crate::tridiagonal::{self, Row};
use crate::{FrictionLaw, Statistics};

/// Halvings of one line search.
const HALVINGS: usize = 40;

/// Newton's method on implicit steps over the whole cable with the sigmoid law.
#[derive(Debug, Clone)]
pub(super) struct Newton {
    half_shape: f64,
    /// Friction limit \[N/m\].
    limit: f64,
    /// K + S.
    chain: Chain,
    /// Increments \[m\]: where the next step starts from, and its answer.
    pub r: Vec<f64>,
    direction: Vec<f64>,
    residual: Vec<f64>,
    slope: Vec<f64>,
    factors: Vec<f64>,
}

impl Newton {
    pub fn new(lumped: &Lumped, chain: &Chain) -> Self {
        let zeros = || vec![0.0; lumped.mesh.nodes()];
        let half_shape = match lumped.cable.friction().law() {
            FrictionLaw::Sigmoid { shape_factor } => 0.5 * shape_factor,
            _ => 0.0,
        };
        Self {
            half_shape,
            limit: lumped.cable.friction().limit(),
            chain: chain.clone(),
            r: zeros(),
            direction: zeros(),
            residual: zeros(),
            slope: zeros(),
            factors: zeros(),
        }
    }

    /// Writes the friction of the increments found to `f` \[N/m\].
    pub fn set_friction(&self, duct: &[f64], f: &mut [f64]) {
        for (f, (duct, r)) in f.iter_mut().zip(duct.iter().zip(&self.r)) {
            *f = self.limit * (self.half_shape * (duct - r)).tanh();
        }
    }

    /// At most `steps` Newton steps from `r` to a residual of `accuracy` \[N/m\]; on failure the largest residual as a share of the friction limit.
    pub fn solve(
        &mut self,
        load: &[f64],
        accuracy: f64,
        duct: &[f64],
        steps: usize,
        statistics: &mut Statistics,
    ) -> Result<(), f64> {
        let mut worst = f64::INFINITY;
        for step in 0..=steps {
            worst = worst.min(self.evaluate(load, duct, 0.0).0);
            if worst <= accuracy {
                return Ok(());
            }
            if step == steps {
                break;
            }
            self.solve_direction();
            statistics.sweeps += 1;
            statistics.node_updates += duct.len();
            let slopes = self.residual.iter().zip(&self.direction);
            let descent: f64 = slopes.map(|(residual, direction)| residual * direction).sum();
            if descent >= 0.0 || descent.is_nan() {
                break;
            }
            let mut share = 1.0;
            for _ in 0..HALVINGS {
                if self.evaluate(load, duct, share).1 <= 0.5 * descent.abs() {
                    break;
                }
                share *= 0.5;
            }
            for (r, d) in self.r.iter_mut().zip(&self.direction) {
                *r += share * d;
            }
        }
        self.r.fill(0.0);
        Err(worst / self.limit)
    }

    /// Sets residual and slope at r + share · direction. Returns the largest residual per metre of cable \[N/m\] and the derivative of
    /// the energy along the direction.
    fn evaluate(&mut self, load: &[f64], duct: &[f64], share: f64) -> (f64, f64) {
        let (mut worst, mut along) = (0.0_f64, 0.0);
        let (last, k, q) = (duct.len() - 1, self.chain.stiffness, self.limit);
        let at = |i: usize| {
            self.r[i]
                + if share == 0.0 {
                    0.0
                } else {
                    share * self.direction[i]
                }
        };
        let (mut r, mut right) = (0.0, at(0));
        for i in 0..=last {
            let left = r;
            (r, right) = (right, if i < last { at(i + 1) } else { 0.0 });
            if !self.chain.free.nodes().contains(&i) {
                continue;
            }
            let w = self.chain.nodes[i].tributary;
            let tanh = (self.half_shape * (duct[i] - r)).tanh();
            let residual = k * self.chain.nodes[i].diagonal * r - k * (left + right) - load[i] - w * q * tanh;
            self.residual[i] = residual;
            self.slope[i] = w * q * self.half_shape * (1.0 - tanh * tanh);
            let violation = residual.abs() / w;
            // What is not a number is a violation too.
            worst = if violation.is_nan() {
                f64::INFINITY
            } else {
                worst.max(violation)
            };
            along += residual * self.direction[i];
        }
        (worst, along)
    }

    /// Newton's direction −H⁻¹ R by elimination; H is diagonally dominant.
    fn solve_direction(&mut self) {
        let (k, Stretch { lo, hi }) = (self.chain.stiffness, self.chain.free);
        self.direction.fill(0.0);
        let row = |i: usize| {
            let per_pivot = 1.0 / (k * self.chain.nodes[lo + i].diagonal + self.slope[lo + i]);
            Row {
                share: k * per_pivot,
                value: -self.residual[lo + i] * per_pivot,
            }
        };
        tridiagonal::solve([0.0, 0.0], row, &mut self.factors, &mut self.direction[lo..=hi]);
    }
}
