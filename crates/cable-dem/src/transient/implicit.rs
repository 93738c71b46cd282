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
use crate::step::{Chain, Contact, Load, StepSolver, Tolerance, Trial};

/// Newton steps from the last increment, and from the clamped law's answer.
const NEWTON_STEPS: [usize; 2] = [15, 200];

/// Solver of implicit steps over the whole cable, for any law and a given mass term.
#[derive(Debug, Clone)]
pub(crate) struct Implicit {
    clamped: Clamped,
    sigmoid: Option<Newton>,
    /// Loads p \[N\], to be set before [`Self::solve`].
    pub load: Vec<f64>,
}

/// Steps by the law f ← clamp(f + slip/γ, −q, q).
#[derive(Debug, Clone)]
struct Clamped {
    solver: StepSolver,
    trial: Trial,
    anchor: Vec<f64>,
    adhesion: Vec<f64>,
}

impl Implicit {
    /// A solver with the mass term `inertia` · m_i on the diagonal; `inertia` in 1/s².
    pub fn new(lumped: &Lumped, inertia: f64) -> Self {
        let nodes = lumped.mesh.nodes();
        let chain = Chain::new(&lumped.cable, &lumped.mesh, inertia * lumped.mass_per_metre);
        let has_memory = lumped.cable.friction().law().has_memory();
        Self {
            sigmoid: (!has_memory).then(|| Newton::new(lumped, &chain)),
            clamped: Clamped {
                solver: StepSolver::new(chain),
                trial: Trial::new(nodes),
                anchor: vec![0.0; nodes],
                adhesion: vec![0.0; nodes],
            },
            load: vec![0.0; nodes],
        }
    }

    /// Forgets earlier passes: a pass depends on the state it starts from, to the last digit.
    pub fn start(&mut self) {
        self.clamped.trial.contact.fill(Contact::Stuck);
        if let Some(newton) = &mut self.sigmoid {
            newton.start();
        }
    }

    /// How exactly steps must hold when displacements reach `largest` \[m\].
    pub fn tolerance(&self, largest: f64) -> Tolerance {
        Tolerance::new(&self.clamped.solver.chain, largest)
    }

    /// Contact states of a law with memory: those of the last step, or a prediction of the next.
    pub fn contacts(&mut self) -> Option<&mut [Contact]> {
        self.sigmoid.is_none().then_some(&mut *self.clamped.trial.contact)
    }

    /// Sets the loads to the elastic forces that displacements `u` put on the nodes, −(K + S) u \[N\].
    pub fn load_elastic(&mut self, lumped: &Lumped, u: &[f64]) {
        let k = lumped.stiffness;
        let mut left = 0.0;
        for i in 0..u.len() {
            let right = u.get(i + 1).map_or(0.0, |next| k * (next - u[i]));
            self.load[i] = right - left;
            left = right;
        }
        for &(node, spring) in &lumped.springs {
            self.load[node] -= spring * u[node];
        }
    }

    /// Solves one step: from friction `f`, with duct increments `duct` and the loads set before. `f` becomes the new friction; the
    /// increments r \[m\] are returned, or the largest violation as a share of the friction limit.
    pub fn solve(
        &mut self,
        lumped: &Lumped,
        tolerance: Tolerance,
        duct: &[f64],
        f: &mut [f64],
        statistics: &mut Statistics,
    ) -> Result<&[f64], f64> {
        let Some(newton) = &mut self.sigmoid else {
            self.clamped
                .solve(lumped, &self.load, tolerance, duct, f, statistics)?;
            return Ok(&self.clamped.trial.r);
        };
        let [first, last] = NEWTON_STEPS;
        if newton
            .solve(&self.load, tolerance, duct, first, statistics)
            .is_err()
        {
            f.fill(0.0);
            let start = self
                .clamped
                .solve(lumped, &self.load, tolerance, duct, f, statistics);
            if start.is_ok() {
                newton.restart(&self.clamped.trial.r);
            }
            newton.solve(&self.load, tolerance, duct, last, statistics)?;
        }
        Ok(newton.answer(duct, f))
    }
}

impl Clamped {
    fn solve(
        &mut self,
        lumped: &Lumped,
        load: &[f64],
        tolerance: Tolerance,
        duct: &[f64],
        f: &mut [f64],
        statistics: &mut Statistics,
    ) -> Result<(), f64> {
        let (compliance, free) = (self.solver.chain.compliance, self.solver.chain.free);
        // Where the duct holds the sheath after its increment, measured from u.
        for (anchor, (duct, f)) in self.anchor.iter_mut().zip(duct.iter().zip(&*f)) {
            *anchor = duct + compliance * f;
        }
        let load = Load {
            adhesion: &self.adhesion,
            support: load,
            anchor: &self.anchor,
        };
        let solved = self
            .solver
            .solve(&load, f, free, tolerance, &mut self.trial, statistics);
        if solved.is_err() {
            self.trial.contact.fill(Contact::Stuck);
            return solved;
        }
        f[free.nodes()].copy_from_slice(&self.trial.g[free.nodes()]);
        for node in [0, f.len() - 1] {
            if lumped.holds(node) {
                f[node] = lumped.held.after_slip(f[node], duct[node]);
            }
        }
        Ok(())
    }
}
