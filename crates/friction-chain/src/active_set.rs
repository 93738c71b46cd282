//! Solving a step by its active set: guess the contact states, solve, correct those that do not hold, until all do.
//!
//! This is the semismooth Newton method on r = anchor − γ clamp(g, lower, upper) (M. Hintermüller, K. Ito, K. Kunisch,
//! SIAM J. Optim. 13 (2002) 865), with each row scaled so that γ → 0 is Coulomb's law and nothing special. From a good guess it needs one
//! or two linear solves. It may cycle between both directions of slip; then the [bisection] finds the contact states.

use crate::bisection;
use crate::chain::Chain;
use crate::error::ChainError;
use crate::problem::{Contact, Load, Trial};
use crate::stretch::Stretch;
use crate::tolerance::Tolerance;
use crate::tridiagonal;
use crate::tuning::{MAX_ITERATIONS, NODES_OF_BISECTION};

/// Violation, as a share of the friction limit, that is taken for rounding if nothing more can be corrected.
const ROUNDED: f64 = 1e-7;

/// Implicit steps on one chain.
#[derive(Debug, Clone)]
pub struct ImplicitStep {
    /// The chain.
    pub chain: Chain,
    /// The answer of the last step; its contact states are the first guess for the next.
    pub trial: Trial,
    /// What the steps since [`Self::begin`] cost.
    pub work: Work,
    pub(crate) tolerance: Tolerance,
    /// Storage of the linear solve.
    factors: Vec<f64>,
    /// Nodes whose contact states were corrected last, ascending.
    corrected: Vec<usize>,
}

/// Counts of work that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Linear solves.
    pub solves: usize,
    /// Nodes eliminated in these, with what bisections cost.
    pub node_updates: usize,
    /// Steps in which the active set cycled, so that the contact states were found by bisection.
    pub cycles: usize,
}

impl ImplicitStep {
    /// Steps on `chain`, which is at rest and sticks.
    pub fn new(chain: Chain) -> Self {
        let nodes = chain.nodes.len();
        Self {
            trial: Trial::new(nodes),
            work: Work::default(),
            tolerance: Tolerance::new(&chain, 0.0),
            factors: vec![0.0; nodes],
            corrected: Vec::new(),
            chain,
        }
    }

    /// Begins where all nodes stick and are displaced by `r` \[m\]; the steps from there will displace them by up to `peak` \[m\].
    ///
    /// # Panics
    ///
    /// Unless `r` has a value for every node.
    pub fn begin(&mut self, r: &[f64], peak: f64) {
        self.trial.r.copy_from_slice(r);
        self.trial.contact.fill(Contact::Stuck);
        self.work = Work::default();
        let largest = r.iter().fold(peak, |largest, r| largest.max(r.abs()));
        self.tolerance = Tolerance::new(&self.chain, largest);
    }

    /// Solves the nodes of `stretch`, which are free, from the trial's contact states; the other ones are held.
    ///
    /// # Errors
    ///
    /// [`ChainError::NoEquilibrium`] if none is found, or a value of the load is not a number.
    ///
    /// # Panics
    ///
    /// Unless the load has a value for every node, and `stretch` lies on the chain.
    pub fn solve(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), ChainError> {
        let solved = self.iterate(load, stretch).or_else(|_| {
            self.work.cycles += 1;
            self.solve_exactly(load, stretch)
        });
        solved.map_err(|violation| ChainError::NoEquilibrium { violation })
    }

    /// Solves `stretch` from the contact states that the bisection finds.
    pub(crate) fn solve_exactly(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), f64> {
        bisection::set_contacts(&self.chain, load, stretch, &mut self.trial);
        self.work.node_updates += stretch.count() * stretch.count() / NODES_OF_BISECTION;
        self.iterate(load, stretch)
    }

    /// Corrects contact states until they hold. On failure, the largest violation as a share of the friction limit.
    fn iterate(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), f64> {
        let mut worst = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            self.stop(load, stretch)?;
            self.displace(load, stretch);
            worst = self.correct(load, stretch);
            if self.corrected.is_empty() {
                break;
            }
            self.advance(load, stretch);
        }
        if worst <= ROUNDED { Ok(()) } else { Err(worst) }
    }

    /// One linear solve with the trial's contact states.
    fn displace(&mut self, load: &Load<'_>, stretch: Stretch) {
        let (per_stiffness, Trial { r, contact, .. }) = (self.chain.per_stiffness, &mut self.trial);
        let held = stretch.neighbours(r).map(Option::unwrap_or_default);
        let (nodes, contact) = (stretch.of(&self.chain.nodes), stretch.of(contact));
        let load = load.on(stretch);
        let row = |i: usize| {
            let load = [load.support[i] * per_stiffness, load.adhesion[i], load.anchor[i]];
            nodes[i].row(contact[i], load, per_stiffness)
        };
        tridiagonal::solve(held, row, &mut self.factors, stretch.of_mut(r));
        self.work.solves += 1;
        self.work.node_updates += stretch.count();
    }

    /// If nothing but friction holds the chain and all of it may slip, it moves as a whole until the first node sticks. Fails where
    /// none would.
    fn stop(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), f64> {
        let (chain, Trial { r, contact, .. }) = (&self.chain, &mut self.trial);
        if stretch != chain.free || contact.contains(&Contact::Stuck) || chain.is_held() {
            return Ok(());
        }
        let nodes = stretch.nodes();
        let friction = |i: usize| chain.nodes[i].bound(contact[i], load.adhesion[i]);
        let force = |i: usize| chain.nodes[i].tributary * friction(i) + load.support[i];
        let force: f64 = nodes.clone().map(force).sum();
        let length: f64 = nodes.clone().map(|i| chain.nodes[i].tributary).sum();
        let balanced = force.abs() <= self.tolerance.friction * length;
        let moves = if force > 0.0 {
            Contact::Forward
        } else {
            Contact::Backward
        };
        let slip = |i: usize| (load.anchor[i] - r[i] - chain.compliance * friction(i)).abs();
        let slipping = nodes.filter(|&i| balanced || contact[i] == moves);
        let first = slipping.min_by(|&a, &b| slip(a).total_cmp(&slip(b)));
        contact[first.ok_or(f64::INFINITY)?] = Contact::Stuck;
        Ok(())
    }

    /// Sets the friction of the solved displacements and corrects contact states that do not hold. Returned: the largest violation, as a
    /// share of the friction limit.
    fn correct(&mut self, load: &Load<'_>, stretch: Stretch) -> f64 {
        let (chain, tolerance, load) = (&self.chain, self.tolerance, load.on(stretch));
        let Trial { r, g, contact } = &mut self.trial;
        let [mut left, after] = stretch.neighbours(r).map(Option::unwrap_or_default);
        let (nodes, r, g) = (stretch.of(&chain.nodes), stretch.of(r), stretch.of_mut(g));
        let contact = stretch.of_mut(contact);
        self.corrected.clear();
        let mut worst = 0.0_f64;
        // What is not a number is a violation too.
        let mut violate = |share: f64| worst = worst.max(if share.is_nan() { f64::INFINITY } else { share });
        for i in 0..stretch.count() {
            let (node, here, adhesion) = (&nodes[i], r[i], load.adhesion[i]);
            let right = r.get(i + 1).copied().unwrap_or(after);
            let force = chain.stiffness * (node.diagonal * here - left - right) - load.support[i];
            let balancing = force * node.per_tributary;
            left = here;
            // Comparisons that NaN fails: it counts as a violation.
            if contact[i] == Contact::Stuck {
                let total = balancing + adhesion;
                let excess = total.abs() - node.limit;
                g[i] = balancing;
                if excess <= 0.0 {
                    continue;
                }
                if excess <= tolerance.friction {
                    g[i] = node.limit.copysign(total) - adhesion;
                    continue;
                }
                violate(excess / node.limit);
                self.corrected.push(stretch.lo + i);
                contact[i] = if total < 0.0 {
                    Contact::Backward
                } else {
                    Contact::Forward
                };
            } else {
                g[i] = node.bound(contact[i], adhesion);
                let residual = (balancing - g[i]).abs();
                let is_balanced = residual <= tolerance.friction;
                if !is_balanced {
                    violate(residual / node.limit);
                }
                let slip = load.anchor[i] - here - chain.compliance * g[i];
                let along = if contact[i] == Contact::Forward {
                    slip
                } else {
                    -slip
                };
                let slips_along = along >= -tolerance.slip;
                if !slips_along {
                    violate(1.0);
                    self.corrected.push(stretch.lo + i);
                    contact[i] = Contact::Stuck;
                }
            }
        }
        worst
    }

    /// Lets nodes beside those that slip slip too, as many as it takes to bear the force on the first of them. A stuck node shields those
    /// behind it, so that without this a stretch that slips, as in a cable that warms, grows by one node a solve.
    fn advance(&mut self, load: &Load<'_>, stretch: Stretch) {
        let (nodes, accuracy) = (&self.chain.nodes, self.tolerance.friction);
        let Trial { g, contact, .. } = &mut self.trial;
        let total = |k: usize| g[k] + load.adhesion[k];
        // The friction of a node that was solved for as slipping is at the limit.
        let excess = |k: usize| total(k).abs() - nodes[k].limit;
        let slipped = |contact: &[Contact], k: usize| contact[k] != Contact::Stuck && excess(k) <= accuracy;
        for &k in &self.corrected {
            let state = contact[k];
            if state == Contact::Stuck || excess(k) <= accuracy {
                continue;
            }
            let direction = total(k).signum();
            let mut force = excess(k) * nodes[k].tributary;
            let mut yields = |contact: &mut [Contact], k: usize| {
                force -= (nodes[k].limit - direction * total(k)) * nodes[k].tributary;
                let yields = force >= 0.0 && contact[k] == Contact::Stuck;
                if yields {
                    contact[k] = state;
                }
                yields
            };
            if k < stretch.hi && slipped(contact, k + 1) {
                let _ = (stretch.lo..k).rev().all(|k| yields(contact, k));
            } else if k > stretch.lo && slipped(contact, k - 1) {
                let _ = (k + 1..=stretch.hi).all(|k| yields(contact, k));
            }
        }
    }
}
