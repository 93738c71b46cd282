//! One step of the whole cable without inertia, for any friction law: how a cable is laid, and how a pass with inertia begins and ends.
//!
//! Unknown are the increments r = u_new − u of all nodes but fixed ones,
//!
//! (K + S) r = w p − (K + S) u + w f_new,  f_new from the slip ΔD − r by the friction law.
//!
//! For laws with memory that is the convex problem of [`crate::step`]. The sigmoid's is smooth and Newton's method solves it
//! ([`super::sigmoid`]).

use super::Lumped;
use super::sigmoid::Newton;
use crate::step::{Chain, Load, StepSolver};
use crate::{CableState, Statistics};

/// Newton steps from no motion, and from the clamped law's answer.
const NEWTON_STEPS: [usize; 2] = [15, 200];

/// Solver of such steps.
pub(crate) struct WholeStep<'a> {
    lumped: &'a Lumped,
    /// Steps by the law f ← clamp(f + slip/γ, −q, q).
    clamped: StepSolver,
    sigmoid: Option<Newton>,
}

impl<'a> WholeStep<'a> {
    pub fn new(lumped: &'a Lumped) -> Self {
        let chain = Chain::new(&lumped.cable, &lumped.mesh);
        let has_memory = lumped.cable.friction().law().has_memory();
        Self {
            lumped,
            sigmoid: (!has_memory).then(|| Newton::new(lumped, &chain)),
            clamped: StepSolver::new(chain),
        }
    }

    /// Carries `state` on where the duct at every node moves by `increment` \[m\]; displacements will reach `largest` \[m\]. Returns the heat
    /// of the slip \[J\]; on failure the largest violation as a share of the friction limit.
    pub fn follow(
        &mut self,
        increment: &[f64],
        largest: f64,
        state: &mut CableState,
        statistics: &mut Statistics,
    ) -> Result<f64, f64> {
        let lumped = self.lumped;
        self.clamped.start(largest);
        let load = lumped.loads(&state.displacement);
        let mut friction = state.friction.clone();
        match self.sigmoid.take() {
            Some(mut newton) => {
                let solved = self.solve_sigmoid(&mut newton, &load, increment, &mut friction);
                self.sigmoid = Some(newton);
                solved
            }
            None => self.solve_clamped(&load, increment, &mut friction),
        }?;
        let moved = self
            .sigmoid
            .as_ref()
            .map_or(&self.clamped.trial.r, |newton| &newton.r);
        let compliance = lumped.elastic_compliance();
        let heat = lumped.weighted(|i| {
            friction[i] * (increment[i] - moved[i] - compliance * (friction[i] - state.friction[i]))
        });
        for (u, r) in state.displacement.iter_mut().zip(moved) {
            *u += r;
        }
        state.friction = friction;
        *statistics += self.clamped.statistics;
        Ok(heat)
    }

    /// Sets `f` to the friction after duct increments `duct`, by a law with memory.
    fn solve_clamped(&mut self, load: &[f64], duct: &[f64], f: &mut [f64]) -> Result<(), f64> {
        let (compliance, free) = (self.clamped.chain.compliance, self.clamped.chain.free);
        // Where the duct holds the sheath after its increment, measured from u.
        let anchor: Vec<f64> = duct
            .iter()
            .zip(&*f)
            .map(|(duct, f)| duct + compliance * f)
            .collect();
        let load = Load {
            adhesion: &vec![0.0; f.len()],
            support: load,
            anchor: &anchor,
        };
        self.clamped.solve(&load, free)?;
        f[free.nodes()].copy_from_slice(&self.clamped.trial.g[free.nodes()]);
        for node in [0, f.len() - 1] {
            if self.lumped.holds(node) {
                f[node] = self.lumped.held.after_slip(f[node], duct[node]);
            }
        }
        Ok(())
    }

    /// The same by the sigmoid, from no motion or else from the answer of the clamped law.
    fn solve_sigmoid(
        &mut self,
        newton: &mut Newton,
        load: &[f64],
        duct: &[f64],
        f: &mut [f64],
    ) -> Result<(), f64> {
        let accuracy = self.clamped.accuracy();
        let [first, last] = NEWTON_STEPS;
        newton.r.fill(0.0);
        let mut solved = newton.solve(load, accuracy, duct, first, &mut self.clamped.statistics);
        if solved.is_err() {
            f.fill(0.0);
            if self.solve_clamped(load, duct, f).is_ok() {
                newton.r.copy_from_slice(&self.clamped.trial.r);
            }
            solved = newton.solve(load, accuracy, duct, last, &mut self.clamped.statistics);
        }
        newton.set_friction(duct, f);
        solved
    }
}
