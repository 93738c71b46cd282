//! The contact states of one step without iteration, by dynamic programming along the chain.
//!
//! Passing from left to right, the part of the chain left of a spring demands a force p(u) that grows with the
//! displacement u at its end: a monotone, piecewise linear graph. Two rules carry it along:
//!
//! - a spring k shears the graph, (u, p) → (u + p/k, p);
//! - a node adds its support's load and its friction: two new corners, between them the slope w/γ (a step for γ = 0).
//!
//! At the right end the graph meets what holds the chain, and the corners passed on the way back tell which contact
//! states hold. The method is direct: it cannot cycle. Its cost grows with the square of the stretch's length, so that
//! [`super::active_set`] goes first. Graphs of this kind are known from total-variation filtering (N. A. Johnson,
//! J. Comput. Graph. Stat. 22 (2013) 246).

use super::chain::{Chain, Contact, Load, Stretch, Trial};

/// Corner of a graph: displacement and force.
#[derive(Debug, Clone, Copy)]
struct Corner {
    u: f64,
    p: f64,
}

/// A monotone piecewise linear graph p(u); beyond its corners it goes on with one slope on either side.
#[derive(Debug, Clone)]
struct Graph {
    corners: Vec<Corner>,
    /// Slope outside the corners; infinite for a held displacement.
    outer: f64,
}

/// Sets the trial's contact states on `stretch` to those of the step's one answer.
///
/// With nothing but friction to hold the chain and all of it slipping, the displacement nearest to the anchor is taken.
pub(crate) fn contacts(chain: &Chain, load: &Load<'_>, stretch: Stretch, trial: &mut Trial) {
    let Stretch { lo, hi } = stretch;
    let (r, contact) = (&trial.r, &mut trial.contact);
    let k = chain.stiffness;
    let count = hi - lo + 1;
    // Graph right of each node, friction included: what the way back reads.
    let mut passed: Vec<Graph> = Vec::with_capacity(count);
    let mut graph = if lo > 0 {
        Graph {
            corners: vec![Corner { u: r[lo - 1], p: 0.0 }],
            outer: f64::INFINITY,
        }
        .after_spring(k)
    } else {
        Graph {
            corners: vec![Corner {
                u: load.anchor[lo],
                p: 0.0,
            }],
            outer: 0.0,
        }
    };
    for i in lo..=hi {
        let neighbours = usize::from(i > 0) + usize::from(i + 1 < r.len());
        let support = k * (chain.diagonal[i] - neighbours as f64);
        graph.add_support(support, load.support[i]);
        graph.add_friction(chain, load, i);
        if i < hi {
            let next = graph.after_spring(k);
            passed.push(std::mem::replace(&mut graph, next));
        } else {
            passed.push(graph.clone());
        }
    }

    let mut u = if hi + 1 < r.len() {
        passed[count - 1].displacement_before_spring(k, r[hi + 1])
    } else {
        passed[count - 1].rest_displacement(load.anchor[hi])
    };
    for i in (lo..=hi).rev() {
        if i < hi {
            u = passed[i - lo].displacement_before_spring(k, u);
        }
        let (forward, backward) = slip_limits(chain, load, i);
        contact[i] = if u < forward {
            Contact::Forward
        } else if u > backward {
            Contact::Backward
        } else {
            Contact::Stuck
        };
    }
}

/// Displacements below and above which node i slips.
fn slip_limits(chain: &Chain, load: &Load<'_>, i: usize) -> (f64, f64) {
    let at = |contact| load.anchor[i] - chain.compliance * chain.bound(contact, load.adhesion[i]);
    (at(Contact::Forward), at(Contact::Backward))
}

impl Graph {
    fn after_spring(&self, k: f64) -> Self {
        Self {
            corners: self
                .corners
                .iter()
                .map(|corner| Corner {
                    u: corner.u + corner.p / k,
                    p: corner.p,
                })
                .collect(),
            outer: 1.0 / (1.0 / self.outer + 1.0 / k),
        }
    }

    fn add_support(&mut self, stiffness: f64, load: f64) {
        for corner in &mut self.corners {
            corner.p += stiffness * corner.u - load;
        }
        self.outer += stiffness;
    }

    /// Adds −w g(u): +w q above the node's slip limits, −w q below them, both shifted by the adhesion.
    fn add_friction(&mut self, chain: &Chain, load: &Load<'_>, i: usize) {
        let (forward, backward) = slip_limits(chain, load, i);
        let upper = chain.tributary[i] * chain.bound(Contact::Forward, load.adhesion[i]);
        let lower = chain.tributary[i] * chain.bound(Contact::Backward, load.adhesion[i]);
        let start = Corner {
            u: forward,
            p: self.force(forward) - upper,
        };
        let stop = Corner {
            u: backward,
            p: self.force(backward) - lower,
        };
        let below = self.corners.partition_point(|corner| corner.u < forward);
        let above = self.corners.partition_point(|corner| corner.u <= backward);
        let mut corners = Vec::with_capacity(self.corners.len() + 2);
        corners.extend(self.corners[..below].iter().map(|corner| Corner {
            p: corner.p - upper,
            ..*corner
        }));
        corners.push(start);
        for corner in &self.corners[below..above.max(below)] {
            let share = if backward > forward {
                (corner.u - forward) / (backward - forward)
            } else {
                0.5
            };
            corners.push(Corner {
                p: corner.p - upper + share * (upper - lower),
                ..*corner
            });
        }
        corners.push(stop);
        corners.extend(self.corners[above.max(below)..].iter().map(|corner| Corner {
            p: corner.p - lower,
            ..*corner
        }));
        self.corners = corners;
    }

    /// p at `u`.
    fn force(&self, u: f64) -> f64 {
        let index = self.corners.partition_point(|corner| corner.u < u);
        match (
            index.checked_sub(1).map(|i| self.corners[i]),
            self.corners.get(index),
        ) {
            (Some(left), Some(right)) if right.u > left.u => {
                left.p + (right.p - left.p) * (u - left.u) / (right.u - left.u)
            }
            (_, Some(right)) if right.u == u => right.p,
            (_, Some(right)) if index == 0 => right.p + self.outer * (u - right.u),
            (Some(left), _) => left.p + self.outer * (u - left.u),
            _ => 0.0,
        }
    }

    /// The u for which u + p(u)/k is `beyond`, the displacement behind the spring.
    fn displacement_before_spring(&self, k: f64, beyond: f64) -> f64 {
        self.crossing(|corner| corner.u + corner.p / k - beyond, 1.0 + self.outer / k)
    }

    /// The u for which p(u) = 0; of a whole range, the one nearest to `wanted`.
    fn rest_displacement(&self, wanted: f64) -> f64 {
        if self.outer > 0.0 {
            return self.crossing(|corner| corner.p, self.outer);
        }
        let low = self.corners.partition_point(|corner| corner.p < 0.0);
        let high = self.corners.partition_point(|corner| corner.p <= 0.0);
        let last = self.corners.len() - 1;
        let from = if low == 0 {
            f64::NEG_INFINITY
        } else {
            self.zero_between(low - 1, low.min(last))
        };
        let to = if high > last {
            f64::INFINITY
        } else {
            self.zero_between(high.max(1) - 1, high)
        };
        wanted.max(from).min(to)
    }

    fn zero_between(&self, left: usize, right: usize) -> f64 {
        let (a, b) = (self.corners[left], self.corners[right]);
        if b.p > a.p {
            a.u + (b.u - a.u) * (-a.p / (b.p - a.p)).clamp(0.0, 1.0)
        } else {
            a.u
        }
    }

    /// Zero of a growing function that is linear between the corners and has slope `outer` in u beyond them.
    fn crossing(&self, value: impl Fn(&Corner) -> f64, outer: f64) -> f64 {
        let index = self.corners.partition_point(|corner| value(corner) < 0.0);
        let last = self.corners.len() - 1;
        if index == 0 {
            return self.corners[0].u - value(&self.corners[0]) / outer;
        }
        if index > last {
            return self.corners[last].u - value(&self.corners[last]) / outer;
        }
        let (a, b) = (self.corners[index - 1], self.corners[index]);
        let (at, bt) = (value(&a), value(&b));
        a.u + (b.u - a.u) * (-at / (bt - at)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    //! Every one of the 3ⁿ combinations of contact states, solved densely and checked against the contact law: those that
    //! hold give one and the same displacement, and both ways of solving a step must find it.

    use super::super::active_set::{Elimination, Outcome};
    use super::super::chain::{Tolerance, Trial};
    use super::*;
    use proptest::prelude::*;

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
        fn chain(&self) -> Chain {
            let n = self.nodes.len();
            let end = |i: usize| i == 0 || i + 1 == n;
            let tributary: Vec<f64> = (0..n).map(|i| if end(i) { 0.5 } else { 1.0 }).collect();
            Chain {
                stiffness: 1.0,
                diagonal: (0..n)
                    .map(|i| self.nodes[i].2 + if end(i) { 1.0 } else { 2.0 })
                    .collect(),
                softness: tributary.iter().map(|w| self.compliance / w).collect(),
                tributary,
                compliance: self.compliance,
                limit: 1.0,
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
                g: vec![0.0; self.nodes.len()],
                contact: guess.iter().map(|&state| STATES[state]).collect(),
            }
        }

        /// Displacements of one combination of contact states, by dense elimination with pivoting; `None` if singular.
        fn displacements(&self, chain: &Chain, contact: &[Contact]) -> Option<Vec<f64>> {
            let Stretch { lo, hi } = self.stretch();
            let n = hi - lo + 1;
            let mut rows = vec![vec![0.0; n + 1]; n];
            for (row, i) in rows.iter_mut().zip(lo..=hi) {
                let (anchor, adhesion, _, load) = self.nodes[i];
                let w = chain.tributary[i];
                // Equilibrium K r − p = w g; stuck, with γ g = anchor − r.
                let (scale, own, right) = match contact[i] {
                    Contact::Stuck => (self.compliance, w, w * anchor),
                    Contact::Forward => (1.0, 0.0, w * (1.0 - adhesion)),
                    Contact::Backward => (1.0, 0.0, w * (-1.0 - adhesion)),
                };
                row[i - lo] = scale * chain.diagonal[i] + own;
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
                let g = force / chain.tributary[i];
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
                .prop_map(move |(compliance, mut nodes, held, guess)| {
                    for node in &mut nodes {
                        // Loads act where supports are.
                        if node.2 == 0.0 {
                            node.3 = 0.0;
                        }
                    }
                    Step {
                        compliance,
                        held: if n < 3 { (false, false) } else { held },
                        nodes,
                        guess,
                    }
                })
        })
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

            let mut elimination = Elimination::new(step.nodes.len());
            let mut trial = step.trial(&step.guess);
            contacts(&chain, &load, stretch, &mut trial);
            let (outcome, _) = elimination.iterate(&chain, &load, stretch, TOLERANCE, &mut trial);
            if step.is_held() {
                prop_assert_eq!(outcome, Outcome::Solved);
            }
            if outcome == Outcome::Solved {
                prop_assert!(right(&trial.r), "exact: {:?}, {answers:?}", trial.r);
            }

            // From any guess the iteration finds the answer or says that it did not.
            let mut trial = step.trial(&step.guess);
            if elimination.iterate(&chain, &load, stretch, TOLERANCE, &mut trial).0 == Outcome::Solved {
                prop_assert!(right(&trial.r), "iteration: {:?}, {answers:?}", trial.r);
            }
        }
    }
}
