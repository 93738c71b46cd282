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
    /// [`ChainError::NoEquilibrium`] where none is found, and where a value of the load is not a number.
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
            let corrected;
            (worst, corrected) = self.correct(load, stretch);
            if !corrected {
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

    /// Where nothing but friction holds the chain and all of it may slip, it moves as a whole until the first node sticks. Fails where
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
    /// share of the friction limit, and whether a contact state was corrected.
    fn correct(&mut self, load: &Load<'_>, stretch: Stretch) -> (f64, bool) {
        let (chain, tolerance, load) = (&self.chain, self.tolerance, load.on(stretch));
        let Trial { r, g, contact } = &mut self.trial;
        let [mut left, after] = stretch.neighbours(r).map(Option::unwrap_or_default);
        let (nodes, r, g) = (stretch.of(&chain.nodes), stretch.of(r), stretch.of_mut(g));
        let contact = stretch.of_mut(contact);
        let (mut worst, mut corrected) = (0.0_f64, false);
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
                corrected = true;
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
                    corrected = true;
                    contact[i] = Contact::Stuck;
                }
            }
        }
        (worst, corrected)
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
        for k in stretch.nodes() {
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

#[cfg(test)]
mod tests {
    //! The step against every combination of contact states.
    //!
    //! Every one of the 3ⁿ combinations of contact states, solved densely and checked against the contact law: those that
    //! hold give one and the same displacement, and the solver must find it from any guess.

    use proptest::prelude::*;

    use crate::tolerance::Tolerance;
    use crate::{Chain, ChainError, Clamp, Contact, ImplicitStep, Load, Stretch, Trial};

    const STATES: [Contact; 3] = [Contact::Stuck, Contact::Forward, Contact::Backward];
    const TOLERANCE: Tolerance = Tolerance {
        friction: 1e-9,
        slip: 1e-9,
    };

    /// A step on a chain with k = 1, q = 1 and elements of length 1.
    #[derive(Debug, Clone)]
    struct Step {
        compliance: f64,
        /// Anchor, adhesion, support's stiffness and load of each node.
        nodes: Vec<(f64, f64, f64, f64)>,
        /// Whether the first and last node are held, not solved for.
        held: (bool, bool),
        guess: Vec<usize>,
    }

    impl Step {
        fn chain(&self) -> Result<Chain, ChainError> {
            let limits = vec![1.0; self.nodes.len()];
            let ends = [self.held.0, self.held.1].map(|is_held| (!is_held).then_some(0.0));
            let spring = |(i, node): (usize, &(f64, f64, f64, f64))| Clamp::new(i, node.2, f64::INFINITY);
            let springs = self.nodes.iter().enumerate().map(spring).collect();
            Chain::new(1.0, 1.0, self.compliance, &limits, ends, springs)
        }

        fn stretch(&self) -> Stretch {
            Stretch {
                lo: usize::from(self.held.0),
                hi: self.nodes.len() - 1 - usize::from(self.held.1),
            }
        }

        fn column(&self, value: impl Fn(&(f64, f64, f64, f64)) -> f64) -> Vec<f64> {
            self.nodes.iter().map(value).collect()
        }

        /// Held nodes stand at their anchors.
        fn trial(&self, guess: &[usize]) -> Trial {
            Trial {
                r: self.column(|node| node.0),
                contact: guess.iter().map(|&state| STATES[state]).collect(),
                ..Trial::new(self.nodes.len())
            }
        }

        /// Displacements of one combination of contact states, by dense elimination with pivoting; `None` if singular.
        fn displacements(&self, chain: &Chain, contact: &[Contact]) -> Option<Vec<f64>> {
            let Stretch { lo, hi } = self.stretch();
            let n = hi - lo + 1;
            let mut rows = vec![vec![0.0; n + 1]; n];
            for (row, i) in rows.iter_mut().zip(lo..=hi) {
                let (anchor, adhesion, _, load) = self.nodes[i];
                let w = chain.nodes[i].tributary;
                // Equilibrium K r − p = w g; stuck, with γ g = anchor − r.
                let (scale, own, right) = match contact[i] {
                    Contact::Stuck => (self.compliance, w, w * anchor),
                    Contact::Forward => (1.0, 0.0, w * (1.0 - adhesion)),
                    Contact::Backward => (1.0, 0.0, w * (-1.0 - adhesion)),
                };
                row[i - lo] = scale * chain.nodes[i].diagonal + own;
                row[n] = right + scale * load;
                let neighbours = [i.checked_sub(1), (i + 1 < self.nodes.len()).then_some(i + 1)];
                for j in neighbours.into_iter().flatten() {
                    if (lo..=hi).contains(&j) {
                        row[j - lo] = -scale;
                    } else {
                        row[n] += scale * self.nodes[j].0;
                    }
                }
            }
            for pivot in 0..n {
                let best =
                    (pivot..n).max_by(|&a, &b| rows[a][pivot].abs().total_cmp(&rows[b][pivot].abs()))?;
                rows.swap(pivot, best);
                if rows[pivot][pivot].abs() < 1e-11 {
                    return None;
                }
                let top = rows[pivot].clone();
                for row in rows.iter_mut().skip(pivot + 1) {
                    let factor = row[pivot] / top[pivot];
                    for (value, above) in row.iter_mut().zip(&top) {
                        *value -= factor * above;
                    }
                }
            }
            let mut r = self.column(|node| node.0);
            for i in (0..n).rev() {
                let known: f64 = (i + 1..n).map(|j| rows[i][j] * r[lo + j]).sum();
                r[lo + i] = (rows[i][n] - known) / rows[i][i];
            }
            Some(r)
        }

        /// Whether displacements solve the step: friction balances, keeps its bounds, and slip goes along with it.
        fn holds(&self, chain: &Chain, r: &[f64], tolerance: f64) -> bool {
            let Stretch { lo, hi } = self.stretch();
            (lo..=hi).all(|i| {
                let (anchor, adhesion, support, load) = self.nodes[i];
                let mut force = support * r[i] - load;
                if i > 0 {
                    force += r[i] - r[i - 1];
                }
                if i + 1 < r.len() {
                    force += r[i] - r[i + 1];
                }
                let g = force / chain.nodes[i].tributary;
                let total = g + adhesion;
                let slip = anchor - r[i] - self.compliance * g;
                total.abs() <= 1.0 + tolerance
                    && (slip <= tolerance || total >= 1.0 - tolerance)
                    && (slip >= -tolerance || total <= -1.0 + tolerance)
            })
        }

        /// All displacements that solve the step.
        fn answers(&self, chain: &Chain) -> Vec<Vec<f64>> {
            let n = self.nodes.len();
            (0..3_usize.pow(n as u32))
                .filter_map(|code| {
                    let contact: Vec<Contact> =
                        (0..n).map(|i| STATES[code / 3_usize.pow(i as u32) % 3]).collect();
                    self.displacements(chain, &contact)
                })
                .filter(|r| self.holds(chain, r, 1e-10))
                .collect()
        }

        /// Whether something else than friction holds the chain: then there is one answer only.
        fn is_held(&self) -> bool {
            self.held.0 || self.held.1 || self.nodes.iter().any(|node| node.2 > 0.0)
        }
    }

    fn step() -> impl Strategy<Value = Step> {
        // Whole and half numbers meet at corners of the graphs, where ties are.
        let tied = |low: i32, high: i32| (low..=high).prop_map(|v| f64::from(v) * 0.5);
        let value =
            move |size: i32| prop_oneof![tied(-size, size), -0.5 * f64::from(size)..0.5 * f64::from(size)];
        let support = prop_oneof![3 => Just(0.0), 1 => 0.01..100.0_f64, 1 => Just(1e6)];
        let node = (value(8), value(5), support, prop_oneof![Just(0.0), value(6)]);
        let compliance = prop_oneof![Just(0.0), Just(1.0), 1e-6..10.0_f64];
        (2..=7_usize).prop_flat_map(move |n| {
            (
                compliance.clone(),
                prop::collection::vec(node.clone(), n),
                (any::<bool>(), any::<bool>()),
                prop::collection::vec(0..3_usize, n),
            )
                .prop_map(move |(compliance, nodes, held, guess)| Step {
                    compliance,
                    held: if n < 3 { (false, false) } else { held },
                    nodes,
                    guess,
                })
        })
    }

    fn near(one: &[f64], other: &[f64]) -> bool {
        one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-7)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1500))]

        #[test]
        fn every_guess_leads_to_the_one_answer(step in step()) {
            let chain = step.chain()?;
            let (adhesion, support, anchor) = (
                step.column(|node| node.1),
                step.column(|node| node.3),
                step.column(|node| node.0),
            );
            let load = Load { adhesion: &adhesion, support: &support, anchor: &anchor };
            let stretch = step.stretch();
            let answers = step.answers(&chain);
            if step.is_held() {
                prop_assert!(!answers.is_empty());
                for answer in &answers {
                    prop_assert!(near(answer, &answers[0]), "{answers:?}");
                }
            }
            let right = |r: &[f64]| {
                step.holds(&chain, r, 1e-7) && (!step.is_held() || near(r, &answers[0]))
            };

            // From any guess: by the iteration first, and by the exact contact states alone.
            for exactly in [false, true] {
                let mut solver = ImplicitStep::new(chain.clone());
                solver.tolerance = TOLERANCE;
                solver.trial = step.trial(&step.guess);
                let solved = if exactly {
                        solver.solve_exactly(&load, stretch).map_err(|violation| ChainError::NoEquilibrium { violation })
                    } else {
                        solver.solve(&load, stretch)
                    };
                let trial = &solver.trial;
                prop_assert!(solved.is_ok() || answers.is_empty(), "{solved:?}, {:?}, {answers:?}", trial.r);
                prop_assert!(!exactly || solver.work.solves < 3, "{:?}", solver.work);
                if solved.is_ok() {
                    prop_assert!(right(&trial.r), "{:?}, {answers:?}", trial.r);
                }
            }
        }
    }
}
