//! Solving a step: iterate; where that cycles, take the exact step.

use super::active_set;
use super::chain::{Chain, Contact, Load, Stretch, Trial};
use super::exact;
use super::tolerance::Tolerance;
use crate::Statistics;

/// Violation of the exact step, as a share of the friction limit, that is taken for rounding: a hundred times its usual accuracy, and a
/// ten thousandth of what may be unbalanced outside the windows.
const ROUNDED: f64 = 1e-7;

/// Solver of implicit steps on one chain.
#[derive(Debug, Clone)]
pub(crate) struct StepSolver {
    pub chain: Chain,
    /// The answer of the last step; its contact states are the first guess for the next.
    pub trial: Trial,
    /// What the steps since [`Self::start`] cost.
    pub statistics: Statistics,
    /// Whether the exact step is taken at once.
    pub without_iteration: bool,
    tolerance: Tolerance,
}

impl StepSolver {
    pub fn new(chain: Chain) -> Self {
        let nodes = chain.nodes.len();
        Self {
            trial: Trial::new(nodes),
            statistics: Statistics::default(),
            without_iteration: false,
            tolerance: Tolerance::new(&chain, 0.0),
            chain,
        }
    }

    /// Forgets the last pass's contact states. Displacements will reach `largest` \[m\].
    pub fn start(&mut self, largest: f64) {
        self.trial.contact.fill(Contact::Stuck);
        self.statistics = Statistics::default();
        self.tolerance = Tolerance::new(&self.chain, largest);
    }

    /// How exactly friction has to hold \[N/m\].
    pub fn accuracy(&self) -> f64 {
        self.tolerance.friction
    }

    /// Solves `stretch` from the trial's contact states: the slip beside the anchors, each times its node's length of cable, together \[m²\].
    /// On failure, the largest violation as a share of the friction limit.
    pub fn solve(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<f64, f64> {
        if !self.without_iteration {
            if let Ok(slip) = self.iterate(load, stretch) {
                return Ok(slip);
            }
        }
        self.statistics.corners += exact::set_contacts(&self.chain, load, stretch, &mut self.trial);
        self.statistics.exact_steps += 1;
        match self.iterate(load, stretch) {
            Err(violation) if violation <= ROUNDED => {
                Ok(active_set::slip(&self.chain, load, stretch, &self.trial))
            }
            solved => solved,
        }
    }

    /// Runs the active set from the trial's contact states.
    fn iterate(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<f64, f64> {
        let (chain, trial) = (&self.chain, &mut self.trial);
        let iterated = active_set::iterate(chain, load, stretch, self.tolerance, trial);
        self.statistics.sweeps += iterated.sweeps;
        self.statistics.node_updates += iterated.node_updates;
        iterated.outcome
    }
}
