//! What the second backward difference remembers.
//!
//! With increments δ_n = u_n − u_{n−1} the formulas of the parent module read
//!
//! v_n = (3 δ_n − δ_{n−1})/(2Δt),  a_n = 9/(4Δt²) δ_n − b_n,  b_n = (3 δ_{n−1}/(2Δt) + 4 v_{n−1} − v_{n−2})/(2Δt),
//!
//! in which no displacement appears: small increments are not blurred by the creep of many passes. A pass starts from
//! rest, with a history of zeros, which is exact.

use crate::transient::Lumped;

/// Displacement, and two steps of motion.
#[derive(Debug, Clone)]
pub(super) struct History {
    /// u \[m\].
    pub displacement: Vec<f64>,
    /// δ of the last step \[m\].
    pub increment: Vec<f64>,
    /// v \[m/s\].
    pub velocity: Vec<f64>,
    /// v one step before.
    earlier: Vec<f64>,
}

impl History {
    /// With displacement `u` \[m\].
    pub fn at_rest(u: &[f64]) -> Self {
        let zeros = || vec![0.0; u.len()];
        Self {
            displacement: u.to_vec(),
            increment: zeros(),
            velocity: zeros(),
            earlier: zeros(),
        }
    }

    /// Adds the known part of the inertia force, m b, to `load` \[N\].
    pub fn load_inertia(&self, lumped: &Lumped, time_step: f64, load: &mut [f64]) {
        let half = 0.5 / time_step;
        for (i, load) in load.iter_mut().enumerate() {
            let known = 3.0 * half * self.increment[i] + 4.0 * self.velocity[i] - self.earlier[i];
            *load += lumped.mass(i) * half * known;
        }
    }

    /// Takes the step with increments `r`.
    pub fn advance(&mut self, r: &[f64], time_step: f64) {
        let half = 0.5 / time_step;
        for (i, r) in r.iter().enumerate() {
            self.earlier[i] = self.velocity[i];
            self.velocity[i] = half * (3.0 * r - self.increment[i]);
            self.increment[i] = *r;
            self.displacement[i] += r;
        }
    }
}
