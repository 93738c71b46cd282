//! What is right for the sigmoid law: implicit steps of the same time, without inertia.
//!
//! A step minimises ½ rᵀK r − pᵀr + Σ w (2q/b) ln cosh(b (ΔD − r)/2) over the increments r; its gradient is
//!
//! R(r) = K r − p − w q tanh(b (ΔD − r)/2),  p = −K u,
//!
//! and Newton's method with a line search finds its zero, from the answer for a tenth of b where it does not from rest.

use cable_dem::CableError;
use ground_field::DuctMotion;

/// A cable on equal elements, free at x = 0 and fixed at its other end.
#[derive(Debug, Clone, Copy)]
pub struct Chain {
    pub elements: usize,
    pub spacing: f64,
    pub axial_stiffness: f64,
    /// q \[N/m\].
    pub limit: f64,
    pub shape_factor: f64,
}

/// Newton steps of one law.
const NEWTON_STEPS: usize = 100;
/// Largest residual, as a share of q.
const ACCURACY: f64 = 1e-9;

impl Chain {
    /// Force on the fixed end as the vehicle of `motion` leaves, having driven from `approach` before the duct to as far past it in steps of
    /// `time_step`, after one from rest.
    pub fn force(&self, motion: &DuctMotion, approach: f64, time_step: f64) -> Result<f64, CableError> {
        let length = self.spacing * self.elements as f64;
        let speed = motion.velocity();
        let steps = ((length + 2.0 * approach) / speed / time_step).round() as usize;
        let nodes = 0..=self.elements;
        let duct = |x: f64| -> Vec<f64> {
            nodes
                .clone()
                .map(|i| motion.longitudinal(self.spacing * i as f64 - x))
                .collect()
        };
        let (mut u, mut before) = (vec![0.0; self.elements], vec![0.0; self.elements + 1]);
        let mut at_end = 0.0;
        for step in 0..=steps {
            let x = speed * time_step * step as f64 - approach;
            let now = duct(x);
            let increment: Vec<f64> = now
                .iter()
                .zip(&before)
                .map(|(now, before)| now - before)
                .collect();
            let moved = self
                .step(&u, &increment)
                .map_err(|violation| CableError::NoConvergence {
                    vehicle_position: x,
                    violation,
                })?;
            for (u, r) in u.iter_mut().zip(&moved) {
                *u += r;
            }
            at_end = self.limit * (0.5 * self.shape_factor * increment[self.elements]).tanh();
            before = now;
        }
        // And the friction on the half element at the fixed end.
        Ok(self.axial_stiffness / self.spacing * u[self.elements - 1] + 0.5 * self.spacing * at_end)
    }

    /// The increments of one step.
    fn step(&self, u: &[f64], duct: &[f64]) -> Result<Vec<f64>, f64> {
        let mut r = vec![0.0; u.len()];
        if self.newton(u, duct, self.shape_factor, &mut r).is_ok() {
            return Ok(r);
        }
        r.fill(0.0);
        let mut reached = Ok(());
        for exponent in (0..=8).rev() {
            reached = self.newton(u, duct, self.shape_factor * 0.1_f64.powi(exponent), &mut r);
        }
        reached.map(|()| r)
    }

    fn newton(&self, u: &[f64], duct: &[f64], shape_factor: f64, r: &mut Vec<f64>) -> Result<(), f64> {
        let mut worst = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            let (residual, slope) = self.residual(u, duct, shape_factor, r);
            let largest = residual.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            worst = largest / (self.spacing * self.limit);
            if worst <= ACCURACY {
                return Ok(());
            }
            let direction = self.direction(&residual, &slope);
            let along =
                |residual: &[f64]| -> f64 { residual.iter().zip(&direction).map(|(a, b)| a * b).sum() };
            let descent = along(&residual);
            let mut share = 1.0;
            let mut next: Vec<f64>;
            loop {
                next = r.iter().zip(&direction).map(|(r, d)| r + share * d).collect();
                let (residual, _) = self.residual(u, duct, shape_factor, &next);
                if along(&residual) <= 0.5 * descent.abs() || share < 1e-12 {
                    break;
                }
                share *= 0.5;
            }
            *r = next;
        }
        Err(worst)
    }

    /// R and the slope of friction at every node that moves.
    fn residual(&self, u: &[f64], duct: &[f64], shape_factor: f64, r: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let k = self.axial_stiffness / self.spacing;
        let at = |i: usize| if i < u.len() { u[i] + r[i] } else { 0.0 };
        let node = |i: usize| {
            let width = if i == 0 { 0.5 } else { 1.0 } * self.spacing;
            let left = if i == 0 { 0.0 } else { at(i) - at(i - 1) };
            let tanh = (0.5 * shape_factor * (duct[i] - r[i])).tanh();
            let residual = k * (left - (at(i + 1) - at(i))) - width * self.limit * tanh;
            (
                residual,
                width * self.limit * 0.5 * shape_factor * (1.0 - tanh * tanh),
            )
        };
        (0..u.len()).map(node).unzip()
    }

    /// −H⁻¹ R by elimination.
    fn direction(&self, residual: &[f64], slope: &[f64]) -> Vec<f64> {
        let (k, n) = (self.axial_stiffness / self.spacing, residual.len());
        let (mut factor, mut direction) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n {
            let neighbours = if i == 0 { 1.0 } else { 2.0 };
            let (upper, before) = if i == 0 {
                (0.0, 0.0)
            } else {
                (factor[i - 1], direction[i - 1])
            };
            let pivot = k * neighbours + slope[i] - k * upper;
            factor[i] = k / pivot;
            direction[i] = (k * before - residual[i]) / pivot;
        }
        for i in (0..n - 1).rev() {
            direction[i] += factor[i] * direction[i + 1];
        }
        direction
    }
}
