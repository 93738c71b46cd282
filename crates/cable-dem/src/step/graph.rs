//! A monotone piecewise linear graph p(u) that remembers how it came about.
//!
//! Its corners stand on two stacks that meet at a gap: below it those of smaller u, above it those of greater u. What
//! happens to all corners of a stack is written to the stack's [`Map`] only, and what happens to a part of the graph
//! first moves the gap to its border. A step of [`super::exact`] so costs the corners that the gap passes, few where the
//! cable's displacement is smooth, and not all there are.
//!
//! Every step can be undone, the last one first: the way back needs no copies of the graphs passed.

use std::cmp::Ordering;

/// Corner of a graph: displacement and force.
#[derive(Debug, Clone, Copy)]
struct Corner {
    u: f64,
    p: f64,
}

/// (u, p) → (u + s p + u₀, p + p₀), s = springs/k.
#[derive(Debug, Clone, Copy, Default)]
struct Map {
    springs: f64,
    u: f64,
    p: f64,
}

#[derive(Debug, Clone, Default)]
struct Stack {
    corners: Vec<Corner>,
    map: Map,
}

/// Friction of one node: +`upper` below the displacement `forward`, `lower` above `backward`, linear between them.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeFriction {
    pub forward: f64,
    pub backward: f64,
    pub upper: f64,
    pub lower: f64,
}

impl NodeFriction {
    /// The same with a constant `load`, which moves both its bounds.
    pub fn and(self, load: f64) -> Self {
        Self {
            upper: self.upper + load,
            lower: self.lower + load,
            ..self
        }
    }
}

/// What one node did to the graph, for undoing it.
#[derive(Debug, Clone)]
struct Added {
    friction: NodeFriction,
    /// Slope outside the corners before and after.
    outer: [f64; 2],
    /// The stacks before a support touched them.
    unsupported: Option<[Stack; 2]>,
    /// Corners that the gap passed, upward positive.
    passed: isize,
    /// Corners on the slope between both limits.
    sloped: usize,
}

/// The graph; beyond its corners it goes on with one slope on either side.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    /// 1/k \[m/N\].
    softness: f64,
    below: Stack,
    above: Stack,
    /// Slope outside the corners; infinite for a held displacement.
    outer: f64,
    added: Vec<Added>,
    /// The corners on all nodes' slopes, as they were before.
    sloped: Vec<Corner>,
    /// Corners touched: the work done.
    pub touched: usize,
}

impl Graph {
    /// A single corner at (u, 0) on a chain of springs of `stiffness` k \[N/m\], with room for so many `nodes`.
    pub fn new(stiffness: f64, u: f64, outer: f64, nodes: usize) -> Self {
        let stack = || Stack {
            corners: Vec::with_capacity(2 * nodes + 1),
            map: Map::default(),
        };
        let mut below = stack();
        below.corners.push(Corner { u, p: 0.0 });
        Self {
            softness: 1.0 / stiffness,
            below,
            above: stack(),
            outer,
            added: Vec::with_capacity(nodes),
            sloped: Vec::new(),
            touched: 0,
        }
    }

    /// The graph behind one more spring.
    pub fn add_spring(&mut self) {
        self.outer = 1.0 / (1.0 / self.outer + self.softness);
        for stack in [&mut self.below, &mut self.above] {
            stack.map.springs += 1.0;
            stack.map.u += stack.map.p * self.softness;
        }
    }

    /// Takes the spring behind the last node off again.
    pub fn remove_spring(&mut self) {
        self.outer = self.added.last().map_or(self.outer, |added| added.outer[1]);
        for stack in [&mut self.below, &mut self.above] {
            stack.map.springs -= 1.0;
            stack.map.u -= stack.map.p * self.softness;
        }
    }

    /// Adds a spring to the ground and its load at the node where the graph stands. This does touch all corners. Returns the stacks as
    /// they were.
    fn add_support(&mut self, stiffness: f64, load: f64) -> Option<[Stack; 2]> {
        if stiffness == 0.0 && load == 0.0 {
            return None;
        }
        let softness = self.softness;
        let before = [self.below.clone(), self.above.clone()];
        for stack in [&mut self.below, &mut self.above] {
            let map = std::mem::take(&mut stack.map);
            for corner in &mut stack.corners {
                *corner = map.forth(*corner, softness);
                corner.p += stiffness * corner.u - load;
            }
            self.touched += stack.corners.len();
        }
        self.outer += stiffness;
        Some(before)
    }

    /// Adds the (stiffness, load) of a node's support, and subtracts its friction: two more corners.
    pub fn add_node(&mut self, (stiffness, load): (f64, f64), friction: NodeFriction) {
        let before = self.outer;
        let unsupported = self.add_support(stiffness, load);
        let NodeFriction {
            forward,
            backward,
            upper,
            lower,
        } = friction;
        let softness = self.softness;
        let mut passed = 0_isize;
        while self.below.top(softness).is_some_and(|corner| corner.u >= forward) {
            self.below.hand_over(&mut self.above, softness);
            passed -= 1;
        }
        while self.above.top(softness).is_some_and(|corner| corner.u < forward) {
            self.above.hand_over(&mut self.below, softness);
            passed += 1;
        }
        let mut left = self.below.top(softness);
        let mut right = self.above.top(softness);
        let start = Corner {
            u: forward,
            p: self.force(left, right, forward) - upper,
        };
        let known = self.sloped.len();
        while let Some(corner) = right.filter(|corner| corner.u <= backward) {
            self.above.corners.pop();
            self.sloped.push(corner);
            (left, right) = (Some(corner), self.above.top(softness));
        }
        let stop = Corner {
            u: backward,
            p: self.force(left, right, backward) - lower,
        };
        self.below.map.p -= upper;
        self.above.map.p -= lower;
        self.below.push(start, softness);
        for &corner in &self.sloped[known..] {
            let share = if backward > forward {
                (corner.u - forward) / (backward - forward)
            } else {
                0.5
            };
            let p = corner.p - upper + share * (upper - lower);
            self.below.push(Corner { p, ..corner }, softness);
        }
        self.above.push(stop, softness);
        let sloped = self.sloped.len() - known;
        self.touched += passed.unsigned_abs() + sloped + 2;
        self.added.push(Added {
            friction,
            outer: [before, self.outer],
            unsupported,
            passed,
            sloped,
        });
    }

    /// Where `u` lies beside the last node's slip limits, by its corners as they stand now: their maps, undone and done
    /// again, leave rounding that a comparison with the limits themselves would take for slip.
    pub fn side_of_last(&self, u: f64) -> Ordering {
        let sloped = self.added.last().map_or(0, |added| added.sloped);
        let stop = self.below.corners.len();
        let limits = (stop - sloped - 1..=stop).map(|index| self.corner(index).u);
        let (least, most) = limits.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), at| {
            (least.min(at), most.max(at))
        });
        if u < least {
            Ordering::Less
        } else if u > most {
            Ordering::Greater
        } else {
            Ordering::Equal
        }
    }

    /// Takes the last node out again.
    pub fn remove_node(&mut self) {
        let Some(Added {
            friction,
            outer: [outer, _],
            unsupported,
            passed,
            sloped,
        }) = self.added.pop()
        else {
            return;
        };
        self.outer = outer;
        self.touched += passed.unsigned_abs() + sloped + 2;
        if let Some(stacks) = unsupported {
            [self.below, self.above] = stacks;
            let left = self.sloped.len().saturating_sub(sloped);
            self.sloped.truncate(left);
            return;
        }
        let softness = self.softness;
        self.above.corners.pop();
        self.below
            .corners
            .truncate(self.below.corners.len().saturating_sub(sloped + 1));
        self.below.map.p += friction.upper;
        self.above.map.p += friction.lower;
        for _ in 0..sloped {
            if let Some(corner) = self.sloped.pop() {
                self.above.push(corner, softness);
            }
        }
        for _ in 0..passed.unsigned_abs() {
            if passed < 0 {
                self.above.hand_over(&mut self.below, softness);
            } else {
                self.below.hand_over(&mut self.above, softness);
            }
        }
    }

    /// The u for which u + p(u)/k is `beyond`, the displacement behind a spring.
    pub fn displacement_before_spring(&self, beyond: f64) -> f64 {
        let softness = self.softness;
        self.crossing(
            |corner| corner.u + corner.p * softness - beyond,
            1.0 + self.outer * softness,
        )
    }

    /// The u for which p(u) = 0; of a whole range, the one nearest to `wanted`.
    pub fn rest_displacement(&self, wanted: f64) -> f64 {
        if self.outer > 0.0 {
            return self.crossing(|corner| corner.p, self.outer);
        }
        let low = self.partition_point(|corner| corner.p < 0.0);
        let high = self.partition_point(|corner| corner.p <= 0.0);
        let last = self.len() - 1;
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
        let (a, b) = (self.corner(left), self.corner(right));
        if b.p > a.p {
            a.u + (b.u - a.u) * (-a.p / (b.p - a.p)).clamp(0.0, 1.0)
        } else {
            a.u
        }
    }

    /// p at `u` between the corners `left` and `right`, or beyond one of them where there is no other.
    fn force(&self, left: Option<Corner>, right: Option<Corner>, u: f64) -> f64 {
        match (left, right) {
            (Some(left), Some(right)) if right.u > left.u => {
                left.p + (right.p - left.p) * (u - left.u) / (right.u - left.u)
            }
            (Some(corner), Some(_)) => corner.p,
            (Some(corner), None) | (None, Some(corner)) => corner.p + self.outer * (u - corner.u),
            (None, None) => 0.0,
        }
    }

    /// Zero of a growing function that is linear between the corners and has slope `outer` in u beyond them.
    fn crossing(&self, value: impl Fn(&Corner) -> f64, outer: f64) -> f64 {
        let index = self.partition_point(|corner| value(corner) < 0.0);
        let last = self.len() - 1;
        if index == 0 || index > last {
            let corner = self.corner(index.min(last));
            return corner.u - value(&corner) / outer;
        }
        let (a, b) = (self.corner(index - 1), self.corner(index));
        let (at, bt) = (value(&a), value(&b));
        a.u + (b.u - a.u) * (-at / (bt - at)).clamp(0.0, 1.0)
    }

    fn len(&self) -> usize {
        self.below.corners.len() + self.above.corners.len()
    }

    /// Corner by its place, from the smallest u on.
    fn corner(&self, index: usize) -> Corner {
        let below = self.below.corners.len();
        let (stack, place) = if index < below {
            (&self.below, index)
        } else {
            (&self.above, self.len() - 1 - index)
        };
        stack.map.forth(stack.corners[place], self.softness)
    }

    /// How many corners come before the first that does not satisfy `holds`. It is looked for from the gap on, in strides that double.
    fn partition_point(&self, holds: impl Fn(&Corner) -> bool) -> usize {
        let (mut low, mut high) = (0, self.len());
        let (mut at, mut stride) = (self.below.corners.len(), 1);
        while low < high {
            at = at.min(high - 1);
            if holds(&self.corner(at)) {
                low = at + 1;
                at = low.saturating_add(stride).min(usize::midpoint(low, high));
            } else {
                high = at;
                at = high
                    .saturating_sub(stride)
                    .saturating_sub(1)
                    .max(usize::midpoint(low, high));
            }
            stride = stride.saturating_mul(2);
        }
        low
    }
}

impl Stack {
    fn top(&self, softness: f64) -> Option<Corner> {
        self.corners
            .last()
            .map(|&corner| self.map.forth(corner, softness))
    }

    fn push(&mut self, corner: Corner, softness: f64) {
        self.corners.push(self.map.back(corner, softness));
    }

    /// Gives its top corner to `other`.
    fn hand_over(&mut self, other: &mut Self, softness: f64) {
        if let Some(corner) = self.corners.pop() {
            other.push(self.map.forth(corner, softness), softness);
        }
    }
}

impl Map {
    fn forth(self, corner: Corner, softness: f64) -> Corner {
        Corner {
            u: corner.u + self.springs * corner.p * softness + self.u,
            p: corner.p + self.p,
        }
    }

    fn back(self, corner: Corner, softness: f64) -> Corner {
        let p = corner.p - self.p;
        Corner {
            u: corner.u - self.springs * p * softness - self.u,
            p,
        }
    }
}
