//! The contact states of one step by bisection of the chain, where the iteration cycles.
//!
//! The displacement of the node in the middle is where the [`Response`]s of both halves of the chain
//! and its own friction balance. Then it holds the halves, and each is solved in the same way. So no
//! guess is needed, and nothing can cycle. The work grows with the square of the number of nodes n: it
//! is that of about n/6 linear solves.

use super::problem::{Chain, Contact, Load, Stretch, Trial};
use super::response::{NodeFriction, NodeSupport, Response, rest};

/// A step on the whole chain; neighbours of the stretch that is solved are held at their displacements.
struct Step<'a> {
    chain: &'a Chain,
    load: &'a Load<'a>,
    trial: &'a mut Trial,
}

/// Sets the trial's displacements and contact states on `stretch` to those of the step's one answer; the displacements are less exact
/// than those of a linear solve. If nothing but friction holds the chain and all of it slips, they are any that suit.
pub(super) fn set_contacts(chain: &Chain, load: &Load<'_>, stretch: Stretch, trial: &mut Trial) {
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
        let (friction, support) = (self.friction(middle), self.support(middle));
        let supported = |u: f64| support.stiffness * u - support.load;
        let needed = |u: f64| left.force(u) + right.force(u) + supported(u);
        let NodeFriction {
            forward,
            backward,
            upper,
            lower,
        } = friction;
        let (contact, u) = if needed(forward) > upper {
            let limits = [f64::NEG_INFINITY, forward];
            (
                Contact::Forward,
                rest(&left, &right, limits, |u| supported(u) - upper),
            )
        } else if needed(backward) < lower {
            let limits = [backward, f64::INFINITY];
            (
                Contact::Backward,
                rest(&left, &right, limits, |u| supported(u) - lower),
            )
        } else {
            let own = |u: f64| supported(u) - friction.at(u);
            (Contact::Stuck, rest(&left, &right, [forward, backward], own))
        };
        (self.trial.contact[middle], self.trial.r[middle]) = (contact, u);
        self.solve(lo, middle, before, Some(u));
        self.solve(middle + 1, end, Some(u), after);
    }

    /// What a part of the chain answers at the node beyond its last one.
    fn response(&self, nodes: impl Iterator<Item = usize>, held: Option<f64>) -> Response {
        let stiffness = self.chain.stiffness;
        let mut response = held.map_or_else(Response::of_nothing, |u| Response::of_spring(u, stiffness));
        for node in nodes {
            response.add(self.support(node), &self.friction(node), stiffness);
        }
        response
    }

    fn support(&self, node: usize) -> NodeSupport {
        NodeSupport {
            stiffness: self.chain.spring(node),
            load: self.load.support[node],
        }
    }

    /// The friction bounds, shifted by the adhesion, and the displacements beyond which the node slips.
    fn friction(&self, i: usize) -> NodeFriction {
        let node = &self.chain.nodes[i];
        let bound = |contact| node.bound(contact, self.load.adhesion[i]);
        let at = |contact| self.load.anchor[i] - self.chain.compliance * bound(contact);
        NodeFriction {
            forward: at(Contact::Forward),
            backward: at(Contact::Backward),
            upper: node.tributary * bound(Contact::Forward),
            lower: node.tributary * bound(Contact::Backward),
        }
    }
}
