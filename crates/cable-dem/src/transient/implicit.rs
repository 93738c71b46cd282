//! One implicit step of the whole cable.
//!
//! Unknown are the increments r = u_new − u of all nodes but fixed ones. With a mass term c_i ≥ 0 [N/m] and loads p_i,
//!
//! (K + S + c) r = p + w f_new,  f_new from the slip ΔD − r by the friction law.
//!
//! For laws with memory that is the convex problem of [`crate::step`]. The sigmoid's is smooth and Newton's method solves it
//! ([`super::sigmoid`]).

use super::lumped::Lumped;
use super::sigmoid::Newton;
use crate::Statistics;
use crate::step::{Chain, Contact, Load, StepSolver};

/// Newton steps from the last increment, and from the clamped law's answer.
const NEWTON_STEPS: [usize; 2] = [15, 200];

/// Solver of implicit steps over the whole cable, for any law and a given mass term.
#[derive(Debug, Clone)]
pub(crate) struct Implicit {
    /// Steps by the law f ← clamp(f + slip/γ, −q, q).
    clamped: StepSolver,
    sigmoid: Option<Newton>,
    anchor: Vec<f64>,
    adhesion: Vec<f64>,
    /// Loads p \[N\], to be set before [`Self::solve`].
    pub load: Vec<f64>,
}

impl Implicit {
    /// A solver with the mass term `inertia` · m_i on the diagonal; `inertia` in 1/s².
    pub fn new(lumped: &Lumped, inertia: f64) -> Self {
        let zeros = || vec![0.0; lumped.mesh.nodes()];
        let chain = Chain::new(&lumped.cable, &lumped.mesh, inertia * lumped.mass_per_metre);
        let has_memory = lumped.cable.friction().law().has_memory();
        Self {
            sigmoid: (!has_memory).then(|| Newton::new(lumped, &chain)),
            clamped: StepSolver::new(chain),
            anchor: zeros(),
            adhesion: zeros(),
            load: zeros(),
        }
    }

    /// Forgets earlier passes; displacements will reach `largest` \[m\].
    pub fn start(&mut self, largest: f64) {
        self.clamped.start(largest);
        if let Some(newton) = &mut self.sigmoid {
            newton.r.fill(0.0);
        }
    }

    /// What the steps since the start cost.
    pub fn statistics(&self) -> Statistics {
        self.clamped.statistics
    }

    /// Contact states of a law with memory: those of the last step, or a prediction of the next.
    pub fn contacts(&mut self) -> Option<&mut [Contact]> {
        let has_memory = self.sigmoid.is_none();
        has_memory.then_some(&mut *self.clamped.trial.contact)
    }

    /// Sets the loads to the body force and the elastic forces that displacements `u` put on the nodes, w p − (K + S) u \[N\].
    pub fn load_elastic(&mut self, lumped: &Lumped, u: &[f64]) {
        let k = lumped.stiffness;
        let mut left = 0.0;
        for i in 0..u.len() {
            let right = u.get(i + 1).map_or(0.0, |next| k * (next - u[i]));
            self.load[i] = right - left + lumped.body[i];
            left = right;
        }
        for &(node, spring) in &lumped.springs {
            self.load[node] -= spring * u[node];
        }
    }

    /// Solves one step: from friction `f`, with duct increments `duct` and the loads set before. `f` becomes the new friction; the
    /// increments r \[m\] are returned, or the largest violation as a share of the friction limit.
    pub fn solve(&mut self, lumped: &Lumped, duct: &[f64], f: &mut [f64]) -> Result<&[f64], f64> {
        let Some(mut newton) = self.sigmoid.take() else {
            self.solve_clamped(lumped, duct, f)?;
            return Ok(&self.clamped.trial.r);
        };
        let accuracy = self.clamped.accuracy();
        let [first, last] = NEWTON_STEPS;
        let statistics = &mut self.clamped.statistics;
        let mut solved = newton.solve(&self.load, accuracy, duct, first, statistics);
        if solved.is_err() {
            f.fill(0.0);
            if self.solve_clamped(lumped, duct, f).is_ok() {
                newton.r.copy_from_slice(&self.clamped.trial.r);
            }
            let statistics = &mut self.clamped.statistics;
            solved = newton.solve(&self.load, accuracy, duct, last, statistics);
        }
        let newton = self.sigmoid.insert(newton);
        solved.map(|()| newton.answer(duct, f))
    }

    fn solve_clamped(&mut self, lumped: &Lumped, duct: &[f64], f: &mut [f64]) -> Result<(), f64> {
        let (compliance, free) = (self.clamped.chain.compliance, self.clamped.chain.free);
        // Where the duct holds the sheath after its increment, measured from u.
        for (anchor, (duct, f)) in self.anchor.iter_mut().zip(duct.iter().zip(&*f)) {
            *anchor = duct + compliance * f;
        }
        let load = Load {
            adhesion: &self.adhesion,
            support: &self.load,
            anchor: &self.anchor,
            friction: f,
        };
        self.clamped.solve(&load, free)?;
        f[free.nodes()].copy_from_slice(&self.clamped.trial.g[free.nodes()]);
        for node in [0, f.len() - 1] {
            if lumped.holds(node) {
                f[node] = lumped.held.after_slip(f[node], duct[node]);
            }
        }
        Ok(())
    }
}
