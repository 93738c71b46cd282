//! The slow problem: (1 + ℓ ∂/∂x) ∂u/∂n = G(f̄) in the pass number n, with f̄ = −EA ∂²u/∂x².
//!
//! In space, finite volumes: forces F = −EA u′ on the pieces between points, and at every point the friction that balances
//! them over its share w of the cable. At an end
//!
//! w f̄ + S(f̄) = F_inside − F_end,  F_end = ∓ s (u + v),
//!
//! with S and v of the end's layer ([`crate::layer`]) and s the spring there; a fixed end takes u = −v instead of its
//! equation. Where S falls with f̄, the slow problem ends that much before the cable's end, as far as S and w f̄ together
//! rise.

use crate::layer::Layer;
use crate::tridiagonal::Tridiagonal;
use crate::{LawError, MixedLaw};

/// Newton's method gives up after this many iterations.
const MOST_ITERATIONS: usize = 30;

/// One end of the slow problem.
#[derive(Debug, Clone)]
pub(crate) struct SlowEnd {
    pub layer: Layer,
    /// Spring to the ground \[N/m\]; `None` holds the end.
    pub stiffness: Option<f64>,
    /// Cable beyond the last point \[m\].
    pub inset: f64,
}

/// The problem on its points.
#[derive(Debug, Clone)]
pub(crate) struct SlowProblem {
    pub law: MixedLaw,
    pub axial_stiffness: f64,
    pub points: Vec<f64>,
    pub weights: Vec<f64>,
    /// Clamps' stiffness at every point \[N/m\].
    pub springs: Vec<f64>,
    pub upstream: SlowEnd,
    pub downstream: SlowEnd,
}

/// Locked friction at one point, with its derivatives by the displacements to the left, here and to the right.
#[derive(Debug, Clone, Copy)]
struct Local {
    friction: f64,
    by: [f64; 3],
}

impl SlowEnd {
    /// Force on what holds the end \[N\], measured as pull back on the cable, per displacement: spring and the inset piece in
    /// series.
    fn grip(&self, axial_stiffness: f64) -> f64 {
        match self.stiffness {
            Some(stiffness) if stiffness > 0.0 => 1.0 / (1.0 / stiffness + self.inset / axial_stiffness),
            _ => 0.0,
        }
    }

    /// Friction f̄ with w f̄ + S(f̄) + inset · f̄ = `force`, and its derivative by `force`.
    fn friction(&self, weight: f64, force: f64, limit: f64) -> (f64, f64) {
        let width = weight + self.inset;
        let balance = |f: f64| {
            let (s, slope) = self.layer.force.at(f);
            (width * f + s - force, (width + slope).max(0.1 * width))
        };
        let (mut low, mut high) = (-4.0 * limit, 4.0 * limit);
        let mut f = (force / width).clamp(low, high);
        for _ in 0..60 {
            let (value, slope) = balance(f);
            if value > 0.0 {
                high = f;
            } else {
                low = f;
            }
            let newton = f - value / slope;
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            if (next - f).abs() <= 1e-12 * limit {
                f = next;
                break;
            }
            f = next;
        }
        (f, 1.0 / balance(f).1)
    }
}

impl SlowProblem {
    fn last(&self) -> usize {
        self.points.len() - 1
    }

    fn stiffness(&self, piece: usize) -> f64 {
        self.axial_stiffness / (self.points[piece + 1] - self.points[piece])
    }

    /// Force in the piece after point `piece` \[N\], compression positive.
    pub fn force(&self, u: &[f64], piece: usize) -> f64 {
        self.stiffness(piece) * (u[piece] - u[piece + 1])
    }

    /// Displacement −v of an end's point while what holds the end is at rest.
    pub fn held(&self, end: &SlowEnd) -> f64 {
        -end.layer.displacement.at(self.law.saturation()).0
    }

    /// Locked friction at every point \[N/m\].
    pub fn friction(&self, u: &[f64]) -> Vec<f64> {
        (0..u.len()).map(|i| self.local(u, i).friction).collect()
    }

    fn local(&self, u: &[f64], i: usize) -> Local {
        let limit = self.law.friction_limit();
        let (weight, last) = (self.weights[i], self.last());
        if i == 0 {
            let (end, k) = (&self.upstream, self.stiffness(0));
            if end.stiffness.is_none() {
                return self.at_rest();
            }
            let grip = end.grip(self.axial_stiffness);
            let spring = grip * (u[0] - self.held(end)) + self.springs[0] * u[0];
            let (friction, by) = end.friction(weight, self.force(u, 0) + spring, limit);
            return Local {
                friction,
                by: [0.0, by * (k + grip + self.springs[0]), -by * k],
            };
        }
        if i == last {
            let (end, k) = (&self.downstream, self.stiffness(last - 1));
            if end.stiffness.is_none() {
                return self.at_rest();
            }
            let grip = end.grip(self.axial_stiffness);
            let spring = grip * (u[last] - self.held(end)) + self.springs[last] * u[last];
            let (friction, by) = end.friction(weight, spring - self.force(u, last - 1), limit);
            return Local {
                friction,
                by: [-by * k, by * (k + grip + self.springs[last]), 0.0],
            };
        }
        let (left, right, spring) = (self.stiffness(i - 1), self.stiffness(i), self.springs[i]);
        Local {
            friction: (self.force(u, i) - self.force(u, i - 1) + spring * u[i]) / weight,
            by: [-left / weight, (left + right + spring) / weight, -right / weight],
        }
    }

    /// A point that does not move carries the friction that stops it.
    fn at_rest(&self) -> Local {
        Local {
            friction: self.law.saturation(),
            by: [0.0; 3],
        }
    }

    /// Weights of the advance at a point's left neighbour, itself and its right neighbour in a + ℓ ∂a/∂x, for the friction of
    /// `u`. Where vehicles enter there is nothing before to remember.
    pub fn memory(&self, u: &[f64]) -> Vec<[f64; 3]> {
        let (last, x) = (self.last(), &self.points);
        let friction = self.friction(u);
        (0..=last)
            .map(|i| {
                let lag = self.law.lag(friction[i]);
                if (i == 0 && lag > 0.0) || (i == last && lag < 0.0) {
                    return [0.0, 1.0, 0.0];
                }
                let (left, right) = (i.saturating_sub(1), (i + 1).min(last));
                let share = lag / (x[right] - x[left]);
                let mut weights = [-share, 1.0, share];
                if i == 0 {
                    weights = [0.0, 1.0 - share, share];
                } else if i == last {
                    weights = [-share, 1.0 + share, 0.0];
                }
                weights
            })
            .collect()
    }

    /// Solves (1 + ℓ ∂/∂x)(u − base) = step · G(f̄(u)) by Newton's method from the guess in `u`; returns the iterations.
    pub fn implicit(
        &self,
        memory: &[[f64; 3]],
        base: &[f64],
        step: f64,
        accuracy: f64,
        u: &mut [f64],
        system: &mut Tridiagonal,
    ) -> Result<usize, LawError> {
        let last = self.last();
        for iteration in 1..=MOST_ITERATIONS {
            for i in 0..=last {
                let held = match i {
                    0 => self.upstream.stiffness.is_none().then_some(&self.upstream),
                    i if i == last => self.downstream.stiffness.is_none().then_some(&self.downstream),
                    _ => None,
                };
                if let Some(end) = held {
                    system.rows[i] = [0.0, 1.0, 0.0];
                    system.right[i] = self.held(end) - u[i];
                    continue;
                }
                let local = self.local(u, i);
                let (advance, slope) = self.law.advance(local.friction);
                let mut right = step * advance;
                for k in 0..3 {
                    system.rows[i][k] = memory[i][k] - step * slope * local.by[k];
                    if memory[i][k] != 0.0 {
                        right -= memory[i][k] * (u[i + k - 1] - base[i + k - 1]);
                    }
                }
                system.right[i] = right;
            }
            system.solve();
            let change = greatest(system.right.iter().map(|d| d.abs()));
            for (value, change) in u.iter_mut().zip(&system.right) {
                *value += change;
            }
            if !change.is_finite() {
                break;
            }
            if change <= accuracy {
                return Ok(iteration);
            }
        }
        Err(LawError::NoConvergence { pass: 0.0, step })
    }
}

/// The largest of `values`, NaN if any of them is: `f64::max` would drop it.
pub(crate) fn greatest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most: f64, value| {
        if value > most || value.is_nan() || most.is_nan() {
            if most.is_nan() { most } else { value }
        } else {
            most
        }
    })
}

#[cfg(test)]
mod tests {
    use super::greatest;

    #[test]
    fn nothing_hides_what_is_not_a_number() {
        assert_eq!(greatest([1.0, 3.0, 2.0].into_iter()), 3.0);
        assert!(greatest([f64::NAN, 3.0].into_iter()).is_nan());
        assert!(greatest([3.0, f64::NAN].into_iter()).is_nan());
    }
}
