//! One implicit step of the whole cable, for laws with memory.
//!
//! Unknown are the increments r = u_new − u of all nodes but fixed ones. With a mass term c_i ≥ 0 [N/m] and loads p_i,
//!
//! (K + S + c) r = p + w f_new,  f_new from the slip ΔD − r by the friction law:
//!
//! the quasi-static step's convex problem (see `quasi_static::chain`) with more on the diagonal. It is solved by the
//! same active set; where that cycles it is led to the answer from that of a softer sheath, and last of all the dynamic
//! programming takes over.

use crate::Statistics;
use crate::quasi_static::{Chain, Contact, Elimination, Load, Outcome, Stretch, Tolerance, Trial, contacts};
use crate::transient::Lumped;

/// Accuracy of friction and equilibrium, as a share of the friction limit.
const FRICTION_ACCURACY: f64 = 1e-9;
/// Accuracy of slip, as a share of the largest displacement. What a slipping node may slip the wrong way adds up over
/// thousands of steps: it has to be far below the slip of one step.
const SLIP_ACCURACY: f64 = 1e-12;
/// Softnesses γ k/h through which a step is led that does not converge from its first guess.
const SOFTNESSES: [f64; 9] = [100.0, 10.0, 1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// Solver of implicit steps over the whole cable, for laws with memory and a given mass term.
#[derive(Debug, Clone)]
pub(crate) struct StepSolver {
    chain: Chain,
    /// The same chain with a softer sheath.
    softened: Chain,
    soft_anchor: Vec<f64>,
    free: Stretch,
    elimination: Elimination,
    trial: Trial,
    anchor: Vec<f64>,
    adhesion: Vec<f64>,
    /// Loads p \[N\], to be set before [`Self::solve`].
    pub load: Vec<f64>,
}

/// How exactly a step of `lumped` must hold when displacements reach `largest` \[m\].
pub(crate) fn tolerance(lumped: &Lumped, largest: f64) -> Tolerance {
    let friction = lumped.cable.friction();
    let accuracy = (FRICTION_ACCURACY * friction.limit()).max(16.0 * lumped.rounding(largest));
    Tolerance {
        friction: accuracy,
        slip: SLIP_ACCURACY * largest + friction.compliance() * accuracy,
    }
}

impl StepSolver {
    /// A solver with the mass term `inertia` · m_i on the diagonal; `inertia` in 1/s².
    pub fn new(lumped: &Lumped, inertia: f64) -> Self {
        let nodes = lumped.mesh.nodes();
        let last = nodes - 1;
        let k = lumped.stiffness;
        let mut diagonal = vec![2.0; nodes];
        (diagonal[0], diagonal[last]) = (1.0, 1.0);
        for (i, diagonal) in diagonal.iter_mut().enumerate() {
            *diagonal += inertia * lumped.mass(i) / k;
        }
        for &(node, spring) in &lumped.springs {
            diagonal[node] += spring / k;
        }
        let compliance = lumped.cable.friction().compliance();
        let tributary: Vec<f64> = (0..nodes).map(|i| lumped.mesh.tributary_length(i)).collect();
        let chain = Chain {
            stiffness: k,
            diagonal,
            softness: tributary.iter().map(|w| compliance * k / w).collect(),
            tributary,
            compliance,
            limit: lumped.cable.friction().limit(),
        };
        Self {
            softened: chain.clone(),
            soft_anchor: vec![0.0; nodes],
            chain,
            free: Stretch {
                lo: usize::from(lumped.fixed[0]),
                hi: last - usize::from(lumped.fixed[1]),
            },
            elimination: Elimination::new(nodes),
            trial: Trial {
                r: vec![0.0; nodes],
                g: vec![0.0; nodes],
                contact: vec![Contact::Stuck; nodes],
            },
            anchor: vec![0.0; nodes],
            adhesion: vec![0.0; nodes],
            load: vec![0.0; nodes],
        }
    }

    /// Solves one step: from friction `f`, with duct increments `duct` and the loads set before. `f` becomes the new
    /// friction, [`Self::increments`] the answer. On failure, the largest violation as a share of the friction limit.
    pub fn solve(
        &mut self,
        lumped: &Lumped,
        tolerance: Tolerance,
        duct: &[f64],
        f: &mut [f64],
        statistics: &mut Statistics,
    ) -> Result<(), f64> {
        anchor(&mut self.anchor, duct, f, self.chain.compliance);
        let mut outcome = self.attempt(tolerance, statistics);
        if outcome != Outcome::Solved {
            self.soften(lumped, tolerance, duct, f, statistics);
            outcome = self.attempt(tolerance, statistics);
        }
        if outcome != Outcome::Solved {
            let load = Load {
                adhesion: &self.adhesion,
                support: &self.load,
                anchor: &self.anchor,
            };
            statistics.corners += contacts(&self.chain, &load, self.free, &mut self.trial);
            statistics.exact_steps += 1;
            outcome = self.attempt(tolerance, statistics);
        }
        if let Outcome::Violated(violation) = outcome {
            self.trial.contact.fill(Contact::Stuck);
            return Err(violation);
        }
        f[self.free.lo..=self.free.hi].copy_from_slice(&self.trial.g[self.free.lo..=self.free.hi]);
        for (end, node) in [0, f.len() - 1].into_iter().enumerate() {
            if lumped.fixed[end] {
                f[node] = lumped.held.after_slip(f[node], duct[node]);
            }
        }
        Ok(())
    }

    /// Runs the active set from the trial's contact states.
    fn attempt(&mut self, tolerance: Tolerance, statistics: &mut Statistics) -> Outcome {
        let load = Load {
            adhesion: &self.adhesion,
            support: &self.load,
            anchor: &self.anchor,
        };
        let (outcome, sweeps) =
            self.elimination
                .iterate(&self.chain, &load, self.free, tolerance, &mut self.trial);
        statistics.sweeps += sweeps;
        statistics.node_updates += sweeps * (self.free.hi + 1 - self.free.lo);
        outcome
    }

    /// Leads the contact states from those of a softer sheath, whose energy is smoother, to those of the real one.
    fn soften(
        &mut self,
        lumped: &Lumped,
        tolerance: Tolerance,
        duct: &[f64],
        f: &[f64],
        statistics: &mut Statistics,
    ) {
        self.trial.contact.fill(Contact::Stuck);
        let scale = lumped.mesh.spacing() / lumped.stiffness;
        for softness in SOFTNESSES {
            let compliance = softness * scale;
            if compliance <= self.chain.compliance {
                break;
            }
            self.softened.soften(compliance);
            anchor(&mut self.soft_anchor, duct, f, compliance);
            // The real chain's place is lent to the softer one for the attempt.
            std::mem::swap(&mut self.chain, &mut self.softened);
            std::mem::swap(&mut self.anchor, &mut self.soft_anchor);
            self.attempt(tolerance, statistics);
            std::mem::swap(&mut self.chain, &mut self.softened);
            std::mem::swap(&mut self.anchor, &mut self.soft_anchor);
        }
    }

    /// Increments r of the last step \[m\].
    pub fn increments(&self) -> &[f64] {
        &self.trial.r
    }

    /// Contact states: those of the last step, or a prediction of the next.
    pub fn contacts(&mut self) -> &mut [Contact] {
        &mut self.trial.contact
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
}

/// Where the duct holds the sheath after its increment, ΔD + γ f, measured from u.
fn anchor(anchor: &mut [f64], duct: &[f64], f: &[f64], compliance: f64) {
    for (anchor, (duct, f)) in anchor.iter_mut().zip(duct.iter().zip(f)) {
        // Without shear the friction does not count, whatever it is.
        *anchor = duct + if compliance > 0.0 { compliance * f } else { 0.0 };
    }
}
