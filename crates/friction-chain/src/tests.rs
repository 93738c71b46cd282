//! The step against every combination of contact states.
//!
//! Every one of the 3ⁿ combinations of contact states, solved densely and checked against the contact law: those that
//! hold give one and the same displacement, and the solver must find it from any guess.

use crate::tolerance::Tolerance;
use crate::{Chain, ChainError, Clamp, Contact, ImplicitStep, Load, Stretch, Trial};
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
            let best = (pivot..n).max_by(|&a, &b| rows[a][pivot].abs().total_cmp(&rows[b][pivot].abs()))?;
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
