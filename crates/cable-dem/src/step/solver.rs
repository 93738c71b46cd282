//! Solving a step: guess the contact states, solve, correct those that do not hold, until all do.
//!
//! This is the semismooth Newton method on r = anchor − γ clamp(g, lower, upper) (M. Hintermüller, K. Ito, K. Kunisch,
//! SIAM J. Optim. 13 (2002) 865), with each row scaled so that γ → 0 is Coulomb's law and nothing special. From the
//! contact states that the previous vehicle positions predict it needs one or two linear solves. It may cycle between both
//! directions of slip; then [`super::bisection`] finds the contact states.

use super::bisection;
use super::problem::{Chain, Contact, Load, Stretch, Trial};
use super::tolerance::Tolerance;
use crate::Statistics;
use crate::tridiagonal;
use crate::tuning::{MAX_ITERATIONS, NODES_OF_BISECTION, UNBALANCED_SHARE};

/// Violation, as a share of the friction limit, that is taken for rounding if nothing more can be
/// corrected.
const ROUNDED: f64 = 1e-4 * UNBALANCED_SHARE;

/// Solver of implicit steps on one chain.
#[derive(Debug, Clone)]
pub(crate) struct StepSolver {
    pub chain: Chain,
    /// The answer of the last step; its contact states are the first guess for the next.
    pub trial: Trial,
    /// What the steps since [`Self::start`] cost.
    pub statistics: Statistics,
    pub(super) tolerance: Tolerance,
    /// Storage of the linear solve.
    factors: Vec<f64>,
}

/// What does not hold after a linear solve.
#[derive(Debug, Clone, Copy, Default)]
struct Violations {
    /// The largest, as a share of the friction limit.
    worst: f64,
    /// Contact states that were corrected.
    corrected: usize,
}

impl StepSolver {
    pub fn new(chain: Chain) -> Self {
        let nodes = chain.nodes.len();
        Self {
            trial: Trial::new(nodes),
            statistics: Statistics::default(),
            tolerance: Tolerance::new(&chain, 0.0),
            factors: vec![0.0; nodes],
            chain,
        }
    }

    /// Forgets the last pass's contact states. Displacements will reach `largest` \[m\].
    pub fn start(&mut self, largest: f64) {
        self.trial.contact.fill(Contact::Stuck);
        self.statistics = Statistics::default();
        self.tolerance = Tolerance::new(&self.chain, largest);
    }

    /// Solves `stretch` from the trial's contact states. On failure, the largest violation as a share of the friction limit.
    pub fn solve(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), f64> {
        if self.iterate(load, stretch).is_ok() {
            return Ok(());
        }
        self.statistics.cycles += 1;
        self.solve_exactly(load, stretch)
    }

    /// Solves `stretch` from the contact states that the bisection finds.
    pub(super) fn solve_exactly(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), f64> {
        bisection::set_contacts(&self.chain, load, stretch, &mut self.trial);
        self.statistics.node_updates += stretch.len() * stretch.len() / NODES_OF_BISECTION;
        self.iterate(load, stretch)
    }

    /// Corrects contact states until they hold.
    fn iterate(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), f64> {
        let mut found = Violations::default();
        for _ in 0..MAX_ITERATIONS {
            self.displace(load, stretch)?;
            found = self.correct(load, stretch);
            if found.corrected == 0 {
                break;
            }
            self.advance(load, stretch);
        }
        if found.worst <= ROUNDED {
            Ok(())
        } else {
            Err(found.worst)
        }
    }

    /// One linear solve with the trial's contact states.
    fn displace(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), f64> {
        self.hold(load, stretch)?;
        let (chain, Trial { r, contact, .. }) = (&self.chain, &mut self.trial);
        let nodes = stretch.nodes();
        let held = stretch.neighbours(r).map(Option::unwrap_or_default);
        let n = stretch.len();
        // Slices of one length, so that no access is checked in the loop: both take 1.2 times as long without.
        let (of_nodes, contact) = (&chain.nodes[nodes.clone()][..n], &contact[nodes.clone()][..n]);
        let Load {
            adhesion,
            support,
            anchor,
        } = load.on(stretch);
        let (adhesion, support, anchor) = (&adhesion[..n], &support[..n], &anchor[..n]);
        let row = |i: usize| {
            let support = support[i] * chain.per_stiffness;
            of_nodes[i].row(contact[i], support, adhesion[i], anchor[i], chain.per_stiffness)
        };
        tridiagonal::solve(held, row, &mut self.factors[nodes.clone()], &mut r[nodes]);
        self.statistics.sweeps += 1;
        self.statistics.node_updates += stretch.len();
        Ok(())
    }

    /// Nothing but friction may hold the cable, and all of it may slip: then it moves as a whole until the first node sticks. Fails
    /// where none would.
    fn hold(&mut self, load: &Load<'_>, stretch: Stretch) -> Result<(), f64> {
        let (chain, Trial { r, contact, .. }) = (&self.chain, &mut self.trial);
        if chain.is_held || stretch != chain.free || contact.contains(&Contact::Stuck) {
            return Ok(());
        }
        let bound = |i: usize| chain.nodes[i].bound(contact[i], load.adhesion[i]);
        let force: f64 = stretch
            .nodes()
            .map(|i| chain.nodes[i].tributary * bound(i) + load.support[i])
            .sum();
        let moves = if force > 0.0 {
            Contact::Forward
        } else {
            Contact::Backward
        };
        let slip = |i: usize| (load.anchor[i] - r[i] - chain.compliance * bound(i)).abs();
        let balanced = force.abs()
            <= self.tolerance.friction * stretch.nodes().map(|i| chain.nodes[i].tributary).sum::<f64>();
        let slipping = stretch.nodes().filter(|&i| balanced || contact[i] == moves);
        let first = slipping.min_by(|&a, &b| slip(a).total_cmp(&slip(b)));
        contact[first.ok_or(f64::INFINITY)?] = Contact::Stuck;
        Ok(())
    }

    /// Sets the friction of the solved displacements and corrects contact states that do not hold.
    fn correct(&mut self, load: &Load<'_>, stretch: Stretch) -> Violations {
        let (chain, tolerance, range) = (&self.chain, self.tolerance, stretch.nodes());
        let Trial { r, g, contact } = &mut self.trial;
        let [mut left, after] = stretch.neighbours(r).map(Option::unwrap_or_default);
        let n = stretch.len();
        // Slices of one length, so that no access is checked in the loop: both take 1.2 times as long without.
        let nodes = &chain.nodes[range.clone()][..n];
        let Load {
            adhesion,
            support,
            anchor,
        } = load.on(stretch);
        let (adhesion, support, anchor) = (&adhesion[..n], &support[..n], &anchor[..n]);
        let (r, g) = (&r[range.clone()][..n], &mut g[range.clone()][..n]);
        let contact = &mut contact[range][..n];
        let mut found = Violations::default();
        for i in 0..n {
            let (node, state, here) = (&nodes[i], contact[i], r[i]);
            let right = if i + 1 < n { r[i + 1] } else { after };
            let force = chain.stiffness * (node.diagonal * here - left - right) - support[i];
            let balancing = force * node.per_tributary;
            left = here;
            if state == Contact::Stuck {
                let total = balancing + adhesion[i];
                let excess = total.abs() - node.limit;
                g[i] = balancing;
                // Comparisons that NaN fails: it counts as a violation.
                if excess <= 0.0 {
                    continue;
                }
                if excess <= tolerance.friction {
                    g[i] = node.limit.copysign(total) - adhesion[i];
                    continue;
                }
                found.violate(excess / node.limit);
                found.corrected += 1;
                contact[i] = if total < 0.0 {
                    Contact::Backward
                } else {
                    Contact::Forward
                };
            } else {
                g[i] = node.bound(state, adhesion[i]);
                let residual = (balancing - g[i]).abs();
                let balanced = residual <= tolerance.friction;
                if !balanced {
                    found.violate(residual / node.limit);
                }
                let slip = anchor[i] - here - chain.compliance * g[i];
                let along = if state == Contact::Forward { slip } else { -slip };
                let slips_along = along >= -tolerance.slip;
                if !slips_along {
                    found.violate(1.0);
                    contact[i] = Contact::Stuck;
                    found.corrected += 1;
                }
            }
        }
        found
    }

    /// Lets nodes beside those that slip slip too, as many as it takes to bear the force on the first of them. A stuck node shields those
    /// behind it, so that without this a stretch that slips, as in a cable that warms, grows by one node a solve.
    fn advance(&mut self, load: &Load<'_>, stretch: Stretch) {
        let (chain, accuracy) = (&self.chain, self.tolerance.friction);
        let Trial { g, contact, .. } = &mut self.trial;
        let total = |k: usize| g[k] + load.adhesion[k];
        // The friction of a node that was solved for as slipping is at the limit.
        let excess = |k: usize| total(k).abs() - chain.nodes[k].limit;
        for k in stretch.nodes() {
            let state = contact[k];
            if state == Contact::Stuck || excess(k) <= accuracy {
                continue;
            }
            let direction = total(k).signum();
            let mut force = excess(k) * chain.nodes[k].tributary;
            let mut yields = |contact: &mut [Contact], k: usize| {
                let node = &chain.nodes[k];
                force -= (node.limit - direction * total(k)) * node.tributary;
                let yields = force >= 0.0 && contact[k] == Contact::Stuck;
                if yields {
                    contact[k] = state;
                }
                yields
            };
            let slipped =
                |contact: &[Contact], k: usize| contact[k] != Contact::Stuck && excess(k) <= accuracy;
            if k < stretch.hi && slipped(contact, k + 1) {
                (stretch.lo..k)
                    .rev()
                    .take_while(|&k| yields(contact, k))
                    .for_each(drop);
            } else if k > stretch.lo && slipped(contact, k - 1) {
                (k + 1..=stretch.hi)
                    .take_while(|&k| yields(contact, k))
                    .for_each(drop);
            }
        }
    }
}

impl Violations {
    fn violate(&mut self, share: f64) {
        // What is not a number is a violation too.
        let share = if share.is_nan() { f64::INFINITY } else { share };
        self.worst = self.worst.max(share);
    }
}
