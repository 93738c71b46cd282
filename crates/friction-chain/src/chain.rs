//! The chain: equal springs between nodes that rub, and what holds it.

use crate::clamp::Clamp;
use crate::error::ChainError;
use crate::node::{Node, rounding};
use crate::problem::Contact;
use crate::stretch::Stretch;
use crate::tridiagonal::{self, Row};

/// Nodes at equal distances h on springs of stiffness k = EA/h. Each end is fixed, or hangs on a spring to the ground.
#[derive(Debug, Clone)]
pub struct Chain {
    pub(crate) stiffness: f64,
    pub(crate) per_stiffness: f64,
    /// γ \[m²/N\].
    pub(crate) compliance: f64,
    pub(crate) nodes: Vec<Node>,
    /// Springs to the ground on both ends \[N/m\].
    ends: [f64; 2],
    /// Their springs are among the nodes' while they stick.
    clamps: Vec<Clamp>,
    pub(crate) free: Stretch,
    /// The smallest friction limit that a node had at first \[N/m\].
    pub(crate) least_limit: f64,
    /// Rounding error of a node's force per metre \[N/m\], for each metre of displacement.
    pub(crate) rounding: f64,
}

impl Chain {
    /// A chain of `axial_stiffness` EA \[N\] with nodes `spacing` h \[m\] apart, one for each of the friction `limits` q \[N/m\]. A length h
    /// of cable belongs to each, and h/2 to the ends. The contact shears by its `compliance` γ \[m²/N\] for each N/m of friction; 0 is
    /// Coulomb's law. `ends` are springs to the ground \[N/m\], or `None` if an end is fixed.
    ///
    /// # Errors
    ///
    /// [`ChainError::InvalidParameter`] unless stiffness and spacing are positive, limits, compliance, springs and what clamps hold not
    /// negative, clamps on nodes of the chain, and there are two nodes or more, and one that is not fixed.
    pub fn new(
        axial_stiffness: f64,
        spacing: f64,
        compliance: f64,
        limits: &[f64],
        ends: [Option<f64>; 2],
        clamps: Vec<Clamp>,
    ) -> Result<Self, ChainError> {
        let (stiffness, count) = (axial_stiffness / spacing, limits.len());
        let fixed = ends.map(|end| usize::from(end.is_none()));
        let ends = ends.map(Option::unwrap_or_default);
        let enough = count >= 2 && count > fixed[0] + fixed[1];
        checked("nodes", count as f64, "two or more, and one of them free", enough)?;
        for (name, value) in [("axial stiffness", axial_stiffness), ("spacing", spacing)] {
            checked(name, value, "positive", value > 0.0)?;
        }
        let name = "spring, holding force, limit or compliance";
        let of_clamps = clamps.iter().flat_map(|clamp| [clamp.stiffness, clamp.holds]);
        let of_ends = ends.into_iter().chain([compliance]);
        for value in limits.iter().copied().chain(of_ends).chain(of_clamps) {
            checked(name, value, "not negative", value >= 0.0)?;
        }
        for node in clamps.iter().map(|clamp| clamp.node) {
            checked("node of a clamp", node as f64, "one of the chain", node < count)?;
        }
        let node = |&limit: &f64| Node::new(2.0, spacing, limit, stiffness, compliance);
        let mut chain = Self {
            stiffness,
            per_stiffness: 1.0 / stiffness,
            compliance,
            nodes: limits.iter().map(node).collect(),
            ends,
            clamps,
            free: Stretch {
                lo: fixed[0],
                hi: count - 1 - fixed[1],
            },
            least_limit: limits.iter().copied().fold(f64::INFINITY, f64::min),
            rounding: 0.0,
        };
        for end in [0, count - 1] {
            chain.nodes[end].tributary = 0.5 * spacing;
            chain.hang(end);
        }
        (0..chain.clamps.len()).for_each(|index| chain.hang(chain.clamps[index].node));
        let of_spring = |i: usize| rounding(chain.spring(i), chain.nodes[i].tributary);
        let of_springs = chain.free.nodes().map(of_spring).fold(0.0, f64::max);
        chain.rounding = rounding(stiffness, spacing) + of_springs;
        Ok(chain)
    }

    /// k = EA/h \[N/m\].
    #[inline]
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// All nodes.
    #[inline]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// All clamps.
    pub fn clamps(&self) -> &[Clamp] {
        &self.clamps
    }

    /// The nodes that are not fixed.
    #[inline]
    pub fn free(&self) -> Stretch {
        self.free
    }

    /// Neighbours of node `i`: one at an end, else two.
    pub fn neighbours(&self, i: usize) -> f64 {
        if i == 0 || i + 1 == self.nodes.len() {
            1.0
        } else {
            2.0
        }
    }

    /// Spring to the ground on node `i` \[N/m\], clamps that stick with it.
    pub fn spring(&self, i: usize) -> f64 {
        self.stiffness * (self.nodes[i].diagonal - self.neighbours(i))
    }

    /// Whether a fixed end, a spring or a clamp that sticks holds the chain; a spring that rounding loses holds nothing.
    pub fn is_held(&self) -> bool {
        let last = self.nodes.len() - 1;
        let clamped = self.clamps.iter().map(|clamp| clamp.node);
        self.free.count() <= last || [0, last].into_iter().chain(clamped).any(|i| self.spring(i) > 0.0)
    }

    /// Friction per metre \[N/m\] that balances node `i` where all are displaced by `r` \[m\] under the `load` p \[N\]: (K r + S r − p)/w,
    /// with K the stiffness of the chain and S that of the springs to the ground.
    #[inline]
    pub fn balancing_friction(&self, r: &[f64], load: &[f64], i: usize) -> f64 {
        let left = if i > 0 { r[i - 1] } else { 0.0 };
        let right = r.get(i + 1).copied().unwrap_or(0.0);
        let node = &self.nodes[i];
        (self.stiffness * (node.diagonal * r[i] - left - right) - load[i]) * node.per_tributary
    }

    /// Unknowns of all nodes that solve the `row` of each that is free; zero at fixed ends.
    pub fn solve(&self, row: impl Fn(usize) -> Row) -> Vec<f64> {
        let mut x = vec![0.0; self.nodes.len()];
        let (mut factors, lo) = (x.clone(), self.free.lo);
        let unknown = self.free.of_mut(&mut x);
        tridiagonal::solve([0.0; 2], |k| row(lo + k), &mut factors, unknown);
        x
    }

    /// How a stretch that sticks answers a force of 1 N on its `node` while the nodes beside it are held: displacement \[m\] and friction
    /// \[N/m\] of each of its nodes.
    pub fn stuck_response(&self, stretch: Stretch, node: usize) -> [Vec<f64>; 2] {
        let zeros = vec![0.0; self.nodes.len()];
        let (mut r, mut factors, mut load) = (zeros.clone(), zeros.clone(), zeros);
        load[node] = 1.0;
        let of = |i: usize| [load[i] * self.per_stiffness, 0.0, 0.0];
        let row = |i: usize| self.nodes[i].row(Contact::Stuck, of(i), self.per_stiffness);
        let unknown = stretch.of_mut(&mut r);
        tridiagonal::solve([0.0; 2], |k| row(stretch.lo + k), &mut factors, unknown);
        let friction = |i: usize| self.balancing_friction(&r, &load, i);
        [stretch.of(&r).to_vec(), stretch.nodes().map(friction).collect()]
    }

    /// Gives node `i` another friction limit q \[N/m\].
    #[inline]
    pub fn set_limit(&mut self, i: usize, limit: f64) {
        self.nodes[i].limit = limit;
    }

    /// Puts these `clamps` in the place of the former ones, on the same nodes.
    pub fn set_clamps(&mut self, clamps: &[Clamp]) {
        for (index, clamp) in clamps.iter().enumerate().take(self.clamps.len()) {
            let node = self.clamps[index].node;
            self.clamps[index] = *clamp;
            self.clamps[index].node = node;
            self.hang(node);
        }
    }

    /// Lets the clamps on `stretch` stick or slide as displacements `u` \[m\] demand. Returned: whether one of them does so otherwise
    /// than was assumed.
    pub fn correct_clamps(&mut self, stretch: Stretch, u: impl Fn(usize) -> f64) -> bool {
        let mut corrected = false;
        for index in 0..self.clamps.len() {
            let clamp = &mut self.clamps[index];
            let node = clamp.node;
            if stretch.nodes().contains(&node) && clamp.correct(u(node)) {
                self.hang(node);
                corrected = true;
            }
        }
        corrected
    }

    /// Ends a step that moved the nodes of `stretch` to `u` \[m\]: clamps that slide have slipped. Adds the heat of it to `heat` \[J\].
    pub fn settle_clamps(&mut self, stretch: Stretch, u: impl Fn(usize) -> f64, heat: &mut f64) {
        for clamp in &mut self.clamps {
            if stretch.nodes().contains(&clamp.node) {
                *heat += clamp.settle(u(clamp.node));
            }
        }
    }

    /// Adds what clamps do apart from their springs to the `load` of every node \[N\], in a frame that has moved by `frame` \[m\] there.
    pub fn add_clamp_loads(&self, load: &mut [f64], frame: impl Fn(usize) -> f64) {
        for clamp in &self.clamps {
            load[clamp.node] += clamp.load(frame(clamp.node));
        }
    }

    /// Hangs node `i` on the spring of its end, and on those of its clamps that stick.
    fn hang(&mut self, i: usize) {
        let end = if i == 0 {
            self.ends[0]
        } else if i + 1 == self.nodes.len() {
            self.ends[1]
        } else {
            0.0
        };
        let sticks = |clamp: &&Clamp| clamp.node == i && clamp.is_stuck();
        let sticking = self.clamps.iter().filter(sticks);
        let clamped: f64 = sticking.map(|clamp| clamp.stiffness).sum();
        let diagonal = self.neighbours(i) + end / self.stiffness + clamped / self.stiffness;
        let Node { tributary, limit, .. } = self.nodes[i];
        self.nodes[i] = Node::new(diagonal, tributary, limit, self.stiffness, self.compliance);
    }
}

fn checked(name: &'static str, value: f64, allowed: &'static str, holds: bool) -> Result<(), ChainError> {
    if holds {
        Ok(())
    } else {
        Err(ChainError::InvalidParameter { name, value, allowed })
    }
}
