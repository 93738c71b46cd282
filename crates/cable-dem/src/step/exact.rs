//! The contact states of one step without iteration, by dynamic programming along the chain.
//!
//! Passing from left to right, the part of the chain left of a spring demands a force p(u) that grows with the
//! displacement u at its end: a monotone, piecewise linear graph. Two rules carry it along:
//!
//! - a spring k shears the graph, (u, p) → (u + p/k, p);
//! - a node adds its support's load and its friction: two new corners, between them the slope w/γ (a step for γ = 0).
//!
//! At the right end the graph meets what holds the chain, and the corners passed on the way back tell which contact
//! states hold. The method is direct: it cannot cycle. Each node touches the corners between its own slip limits and the
//! last node's only ([`super::graph`]), except where supports are; the way there and back still costs as much as a few
//! linear solves, so that [`super::active_set`] goes first. Graphs of this kind are known from total-variation filtering
//! (N. A. Johnson, J. Comput. Graph. Stat. 22 (2013) 246).

use std::cmp::Ordering;

use super::chain::{Chain, Contact, Load, Stretch, Trial};
use super::graph::{Graph, NodeFriction};

/// Sets the trial's contact states on `stretch` to those of the step's one answer. Returns how many corners it touched.
///
/// With nothing but friction to hold the chain and all of it slipping, the displacement nearest to the anchor is taken. There a
/// node is about to stick; it counts as stuck, so that the chain has a place, and balance puts its friction at the limit.
pub(crate) fn set_contacts(chain: &Chain, load: &Load<'_>, stretch: Stretch, trial: &mut Trial) -> usize {
    let Stretch { lo, hi } = stretch;
    let (r, contact) = (&trial.r, &mut trial.contact);
    let k = chain.stiffness;
    let mut graph = if lo > 0 {
        let mut held = Graph::new(k, r[lo - 1], f64::INFINITY, stretch.len());
        held.add_spring();
        held
    } else {
        Graph::new(k, load.anchor[lo], 0.0, stretch.len())
    };
    for i in lo..=hi {
        let neighbours = usize::from(i > 0) + usize::from(i + 1 < r.len());
        let support = k * (chain.nodes[i].diagonal - neighbours as f64);
        // Without a spring the load acts as one more constant part of the friction, which touches two corners alone.
        let (sprung, constant) = if support == 0.0 {
            (0.0, load.support[i])
        } else {
            (load.support[i], 0.0)
        };
        graph.add_node((support, sprung), friction(chain, load, i).and(constant));
        if i < hi {
            graph.add_spring();
        }
    }

    let mut u = if hi + 1 < r.len() {
        graph.displacement_before_spring(r[hi + 1])
    } else {
        graph.rest_displacement(load.anchor[hi])
    };
    let held = lo > 0
        || hi + 1 < r.len()
        || (lo..=hi)
            .any(|i| chain.nodes[i].diagonal > (usize::from(i > 0) + usize::from(i + 1 < r.len())) as f64);
    let mut least = (f64::INFINITY, hi);
    for i in (lo..=hi).rev() {
        if i < hi {
            graph.remove_spring();
            u = graph.displacement_before_spring(u);
        }
        let NodeFriction {
            forward, backward, ..
        } = friction(chain, load, i);
        let slip = (forward - u).max(u - backward).max(0.0);
        if slip < least.0 {
            least = (slip, i);
        }
        contact[i] = match graph.side_of_last(u) {
            Ordering::Less => Contact::Forward,
            Ordering::Greater => Contact::Backward,
            Ordering::Equal => {
                u = u.max(forward).min(backward);
                Contact::Stuck
            }
        };
        graph.remove_node();
    }
    if !held && !contact[lo..=hi].contains(&Contact::Stuck) {
        contact[least.1] = Contact::Stuck;
    }
    graph.touched
}

/// Friction of node i: +w q above, −w q below the displacements beyond which it slips, both shifted by the adhesion.
fn friction(chain: &Chain, load: &Load<'_>, i: usize) -> NodeFriction {
    let bound = |contact| chain.bound(contact, load.adhesion[i]);
    let at = |contact| load.anchor[i] - chain.compliance * bound(contact);
    NodeFriction {
        forward: at(Contact::Forward),
        backward: at(Contact::Backward),
        upper: chain.nodes[i].tributary * bound(Contact::Forward),
        lower: chain.nodes[i].tributary * bound(Contact::Backward),
    }
}

#[cfg(test)]
mod tests {
    //! Every one of the 3ⁿ combinations of contact states, solved densely and checked against the contact law: those that
    //! hold give one and the same displacement, and both ways of solving a step must find it.

    use super::super::active_set::iterate;
    use super::super::chain::Node;
    use super::super::tolerance::Tolerance;
    use super::*;
    use proptest::prelude::*;

    const STATES: [Contact; 3] = [Contact::Stuck, Contact::Forward, Contact::Backward];
    const TOLERANCE: Tolerance = Tolerance {
        friction: 1e-9,
        slip: 1e-9,
        // Supports are up to a million times as stiff as the chain.
        negligible: 1e-17,
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
        fn chain(&self) -> Chain {
            let n = self.nodes.len();
            let end = |i: usize| i == 0 || i + 1 == n;
            let tributary: Vec<f64> = (0..n).map(|i| if end(i) { 0.5 } else { 1.0 }).collect();
            let diagonal: Vec<f64> = (0..n)
                .map(|i| self.nodes[i].2 + if end(i) { 1.0 } else { 2.0 })
                .collect();
            Chain {
                stiffness: 1.0,
                nodes: Node::of(&diagonal, &tributary, 1.0, self.compliance),
                compliance: self.compliance,
                limit: 1.0,
                free: self.stretch(),
                rounding: 0.0,
            }
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
        (1..=7_usize).prop_flat_map(move |n| {
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

    /// Corners touched per node on a chain of `nodes` nodes under Coulomb friction, at rest with `waves` waves of
    /// displacement along it, whose duct shifts the friction bounds so far that many nodes slip.
    fn corners_per_node(nodes: usize, waves: f64) -> f64 {
        let phase = |i: usize| std::f64::consts::TAU * waves * i as f64 / nodes as f64;
        let smooth = Step {
            compliance: 0.0,
            nodes: (0..nodes)
                .map(|i| (1e3 * phase(i).sin(), 1.5 * (3.0 * phase(i)).cos(), 0.0, 0.0))
                .collect(),
            held: (false, true),
            guess: vec![0; nodes],
        };
        let (adhesion, support, anchor) = (
            smooth.column(|node| node.1),
            smooth.column(|node| node.3),
            smooth.column(|node| node.0),
        );
        let load = Load {
            adhesion: &adhesion,
            support: &support,
            anchor: &anchor,
        };
        let mut trial = smooth.trial(&smooth.guess);
        let touched = set_contacts(&smooth.chain(), &load, smooth.stretch(), &mut trial);
        let slipping = trial.contact.iter().filter(|c| **c != Contact::Stuck).count();
        assert!(slipping > nodes / 10, "{slipping} of {nodes} nodes slip");
        touched as f64 / nodes as f64
    }

    /// Two corners of its own, on the way there and on the way back, and those that the gap passes. On smooth displacements
    /// that is each corner a few times in all, however long the chain: three times the least is the bound.
    #[test]
    fn the_work_grows_as_the_chain_does() {
        for waves in [1.0, 3.0, 10.0] {
            for nodes in [500, 2_000, 8_000, 32_000] {
                let found = corners_per_node(nodes, waves);
                println!("{waves} {nodes}: {found}");
                assert!(
                    found < 4.0 + 2.0 * waves,
                    "{nodes} nodes, {waves} waves: {found} corners a node"
                );
            }
        }
    }

    fn near(one: &[f64], other: &[f64]) -> bool {
        one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-7)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1500))]

        #[test]
        fn both_ways_find_the_one_answer(step in step()) {
            // A chain of one node has no spring; the solver never meets it.
            prop_assume!(step.nodes.len() > 1);
            let chain = step.chain();
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

            let mut trial = step.trial(&step.guess);
            set_contacts(&chain, &load, stretch, &mut trial);
            let outcome = iterate(&chain, &load, stretch, TOLERANCE, &mut trial).outcome;
            if step.is_held() {
                prop_assert!(outcome.is_ok(), "{outcome:?}");
            }
            if outcome.is_ok() {
                prop_assert!(right(&trial.r), "exact: {:?}, {answers:?}", trial.r);
            }

            // From any guess the iteration finds the answer or says that it did not.
            let mut trial = step.trial(&step.guess);
            let iterated = iterate(&chain, &load, stretch, TOLERANCE, &mut trial);
            if let Ok(slipped) = iterated.outcome {
                prop_assert!(right(&trial.r), "iteration: {:?}, {answers:?}", trial.r);
                // What was added up on the way is the slip of all nodes: r + γ g has moved from the anchor.
                let slip = |i: usize| {
                    let moved = anchor[i] - trial.r[i] - chain.compliance * trial.g[i];
                    chain.nodes[i].tributary * moved.abs()
                };
                let all: f64 = stretch.nodes().map(slip).sum();
                prop_assert!((slipped - all).abs() < 1e-7, "{slipped} of {all}");
            }
        }
    }
}
