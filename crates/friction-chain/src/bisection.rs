//! The contact states of one step by bisection of the chain, where the active set cycles.
//!
//! The displacement of the node in the middle is where the [`Response`]s of both halves of the chain and its own friction balance. Then it
//! holds the halves, and each is solved in the same way. So no guess is needed, and nothing can cycle. The work grows with the square of
//! the number of nodes n: it is that of about n/6 linear solves.

use crate::chain::Chain;
use crate::problem::{Contact, Load, Trial};
use crate::response::{Grounding, Response, rest};
use crate::stretch::Stretch;

/// A step on the whole chain; neighbours of the stretch that is solved are held at their displacements.
struct Step<'a> {
    chain: &'a Chain,
    load: &'a Load<'a>,
    trial: &'a mut Trial,
}

/// Sets the trial's displacements and contact states on `stretch` to those of the step's one answer; the displacements are less exact
/// than those of a linear solve. If nothing but friction holds the chain and all of it slips, they are any that suit.
pub(crate) fn set_contacts(chain: &Chain, load: &Load<'_>, stretch: Stretch, trial: &mut Trial) {
    let [before, after] = stretch.neighbours(&trial.r);
    Step { chain, load, trial }.solve(stretch.lo, stretch.hi + 1, before, after);
}

impl Step<'_> {
    /// Solves the nodes from `lo` up to `end`, whose neighbours stand at `before` and `after` if there are any.
    fn solve(&mut self, lo: usize, end: usize, before: Option<f64>, after: Option<f64>) {
        if lo == end {
            return;
        }
        let middle = usize::midpoint(lo, end - 1);
        let left = self.response(lo..middle, before);
        let right = self.response((middle + 1..end).rev(), after);
        let ground = self.ground(middle);
        let needed = |u: f64| left.force(u) + right.force(u) + ground.support(u);
        let [forward, backward] = ground.slips;
        let [upper, lower] = ground.bounds;
        let (contact, limits) = if needed(forward) > upper {
            (Contact::Forward, [f64::NEG_INFINITY, forward])
        } else if needed(backward) < lower {
            (Contact::Backward, [backward, f64::INFINITY])
        } else {
            (Contact::Stuck, [forward, backward])
        };
        let friction = |u: f64| match contact {
            Contact::Forward => upper,
            Contact::Backward => lower,
            Contact::Stuck => ground.friction(u),
        };
        let u = rest(&left, &right, limits, |u| ground.support(u) - friction(u));
        (self.trial.contact[middle], self.trial.r[middle]) = (contact, u);
        self.solve(lo, middle, before, Some(u));
        self.solve(middle + 1, end, Some(u), after);
    }

    /// What a part of the chain answers at the node beyond its last one.
    fn response(&self, nodes: impl Iterator<Item = usize>, held: Option<f64>) -> Response {
        let mut response = Response::new(held, self.chain.stiffness);
        nodes.for_each(|node| response.add(&self.ground(node), self.chain.stiffness));
        response
    }

    /// How the ground holds node `i`: the friction bounds, shifted by the adhesion, and where it slips.
    fn ground(&self, i: usize) -> Grounding {
        let node = &self.chain.nodes[i];
        let bounds =
            [Contact::Forward, Contact::Backward].map(|slips| node.bound(slips, self.load.adhesion[i]));
        Grounding {
            stiffness: self.chain.spring(i),
            load: self.load.support[i],
            slips: bounds.map(|bound| self.load.anchor[i] - self.chain.compliance * bound),
            bounds: bounds.map(|bound| node.tributary * bound),
        }
    }
}
