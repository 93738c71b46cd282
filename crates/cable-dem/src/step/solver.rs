//! Solving a step: iterate; where that cycles, take the exact step.
//!
//! The exact step's work grows with the nodes, tens of linear solves in all, but with a mass at every node by their square. There the
//! contact states are first led from those of a softer sheath to those of the real one: under Coulomb's law with inertia the work is
//! 1.3 to 2.3 times as much without that, measured on three cables over six passes.

use super::active_set::{Elimination, Outcome};
use super::chain::{Chain, Contact, Load, Stretch, Trial};
use super::exact;
use super::tolerance::Tolerance;
use crate::Statistics;

/// Softnesses γ k/h of the sheath through which a step of the whole chain is led that does not converge from its first guess.
const SOFTNESSES: [f64; 9] = [100.0, 10.0, 1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// Solver of implicit steps on one chain.
#[derive(Debug, Clone)]
pub(crate) struct StepSolver {
    pub chain: Chain,
    elimination: Elimination,
    soft_anchor: Vec<f64>,
    /// Whether the exact step is taken at once.
    pub without_iteration: bool,
}

impl StepSolver {
    pub fn new(chain: Chain) -> Self {
        let nodes = chain.tributary.len();
        Self {
            chain,
            elimination: Elimination::new(nodes),
            soft_anchor: vec![0.0; nodes],
            without_iteration: false,
        }
    }

    /// Solves `stretch` from the trial's contact states; the trial becomes the answer. `friction` \[N/m\] is that before the step. On
    /// failure, the largest violation as a share of the friction limit.
    pub fn solve(
        &mut self,
        load: &Load<'_>,
        friction: &[f64],
        stretch: Stretch,
        tolerance: Tolerance,
        trial: &mut Trial,
        statistics: &mut Statistics,
    ) -> Result<(), f64> {
        if !self.without_iteration {
            if self.iterate(load, stretch, tolerance, trial, statistics) == Outcome::Solved {
                return Ok(());
            }
            if self.chain.has_inertia {
                self.soften(load, friction, stretch, tolerance, trial, statistics);
                if self.iterate(load, stretch, tolerance, trial, statistics) == Outcome::Solved {
                    return Ok(());
                }
            }
        }
        statistics.corners += exact::contacts(&self.chain, load, stretch, trial);
        statistics.exact_steps += 1;
        match self.iterate(load, stretch, tolerance, trial, statistics) {
            Outcome::Solved => Ok(()),
            Outcome::Violated(violation) => Err(violation),
        }
    }

    /// Runs the active set from the trial's contact states.
    fn iterate(
        &mut self,
        load: &Load<'_>,
        stretch: Stretch,
        tolerance: Tolerance,
        trial: &mut Trial,
        statistics: &mut Statistics,
    ) -> Outcome {
        let (outcome, sweeps) = self
            .elimination
            .iterate(&self.chain, load, stretch, tolerance, trial);
        statistics.sweeps += sweeps;
        statistics.node_updates += sweeps * stretch.len();
        outcome
    }

    /// Leads the contact states from those of a softer sheath, whose energy is smoother, to those of the real one.
    fn soften(
        &mut self,
        load: &Load<'_>,
        friction: &[f64],
        stretch: Stretch,
        tolerance: Tolerance,
        trial: &mut Trial,
        statistics: &mut Statistics,
    ) {
        let own = self.chain.compliance;
        let per_softness = self.chain.tributary[1] / self.chain.stiffness;
        trial.contact[stretch.nodes()].fill(Contact::Stuck);
        let mut soft_anchor = std::mem::take(&mut self.soft_anchor);
        for compliance in SOFTNESSES.map(|softness| softness * per_softness) {
            if compliance <= own {
                break;
            }
            self.chain.soften(compliance);
            for i in stretch.nodes() {
                soft_anchor[i] = load.anchor[i] + (compliance - own) * friction[i];
            }
            let softer = Load {
                anchor: &soft_anchor,
                ..*load
            };
            self.iterate(&softer, stretch, tolerance, trial, statistics);
        }
        self.soft_anchor = soft_anchor;
        self.chain.soften(own);
    }
}
