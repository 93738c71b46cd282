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
