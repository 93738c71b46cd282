//! How a part of the chain answers: the force that it needs, as a function of the displacement of its last node.
//!
//! It is a growing, piecewise linear function p(u), since friction is one. Two rules carry it along the chain:
//!
//! - a spring k shears it, (u, p) → (u + p/k, p);
//! - a node adds what its support takes and subtracts its friction: two more corners, between them the slope w/γ (a step for γ = 0).
//!
//! Functions of this kind are known from total-variation filtering (N. A. Johnson, J. Comput. Graph. Stat. 22 (2013) 246).

/// How the ground holds one node.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grounding {
    /// Spring \[N/m\] and load \[N\].
    pub stiffness: f64,
    pub load: f64,
    /// Displacements \[m\] below which the duct slips forward past the node, and beyond which backward.
    pub slips: [f64; 2],
    /// Friction there, the largest and the least; linear between them \[N\].
    pub bounds: [f64; 2],
}

impl Grounding {
    /// Friction \[N\] at the displacement `u` \[m\]; on a step, in the middle of it.
    pub fn friction(&self, u: f64) -> f64 {
        let ([forward, backward], [upper, lower]) = (self.slips, self.bounds);
        let width = backward - forward;
        if u < forward {
            upper
        } else if u > backward {
            lower
        } else {
            let share = if width > 0.0 { (u - forward) / width } else { 0.5 };
            upper + share * (lower - upper)
        }
    }

    /// Force \[N\] that its spring needs at the displacement `u` \[m\], less its load.
    pub fn support(&self, u: f64) -> f64 {
        self.stiffness * u - self.load
    }
}

/// The function p(u): straight between its corners, and of one slope beyond them on either side.
#[derive(Debug, Clone)]
pub(crate) struct Response {
    /// (u, p), ascending in both \[m, N\].
    corners: Vec<(f64, f64)>,
    /// Slope beyond the corners \[N/m\].
    outer: f64,
}

impl Response {
    /// A spring of `stiffness` \[N/m\] to a node that is held at some displacement \[m\]; without one nothing, which needs no force.
    pub fn new(held: Option<f64>, stiffness: f64) -> Self {
        Self {
            corners: vec![(held.unwrap_or_default(), 0.0)],
            outer: held.map_or(0.0, |_| stiffness),
        }
    }

    /// With one more node at its end, held by its `ground`, and behind a spring of `stiffness` k \[N/m\] to the next one.
    pub fn add(&mut self, ground: &Grounding, stiffness: f64) {
        let ([forward, backward], [upper, lower]) = (ground.slips, ground.bounds);
        let from = self.corners.partition_point(|(u, _)| *u < forward);
        let to = from + self.corners[from..].partition_point(|(u, _)| *u <= backward);
        let softness = 1.0 / stiffness;
        let behind = |(u, p): (f64, f64), friction: f64| {
            let p = p - friction + ground.stiffness * u - ground.load;
            (u + p * softness, p)
        };
        let first = behind((forward, self.between(from, forward)), upper);
        let last = behind((backward, self.between(to, backward)), lower);
        let count = self.corners.len();
        self.corners.resize(count + 2, last);
        for i in (to..count).rev() {
            self.corners[i + 2] = behind(self.corners[i], lower);
        }
        self.corners[to + 1] = last;
        for i in (from..to).rev() {
            self.corners[i + 1] = behind(self.corners[i], ground.friction(self.corners[i].0));
        }
        self.corners[from] = first;
        for corner in &mut self.corners[..from] {
            *corner = behind(*corner, upper);
        }
        self.outer += ground.stiffness;
        self.outer /= 1.0 + self.outer * softness;
    }

    /// p(u).
    pub fn force(&self, u: f64) -> f64 {
        self.between(self.corners.partition_point(|(at, _)| *at < u), u)
    }

    /// p(u), where u is not beyond the corner `next` nor before the one in front of it.
    fn between(&self, next: usize, u: f64) -> f64 {
        let before = next.checked_sub(1).map(|i| self.corners[i]);
        match (before, self.corners.get(next)) {
            (Some((u0, p0)), Some(&(u1, p1))) => p0 + (p1 - p0) * (u - u0) / (u1 - u0),
            (Some((at, p)), None) | (None, Some(&(at, p))) => p + self.outer * (u - at),
            (None, None) => 0.0,
        }
    }
}

/// Where a node between two parts of the chain is at rest that needs the force `own`(u) itself, growing and straight between the
/// `limits`; if nothing holds it, as near to there as it can be.
pub(crate) fn rest(left: &Response, right: &Response, limits: [f64; 2], own: impl Fn(f64) -> f64) -> f64 {
    let [low, high] = limits;
    let force = |u: f64| left.force(u) + right.force(u) + own(u);
    let corners = left.corners.iter().chain(&right.corners).map(|(u, _)| *u);
    let within = corners.filter(|u| (low..=high).contains(u));
    let mut places: Vec<f64> = within
        .chain(limits.into_iter().filter(|u| u.is_finite()))
        .collect();
    places.sort_unstable_by(f64::total_cmp);
    let next = places.partition_point(|&u| force(u) < 0.0);
    let outer = |u: f64, towards: f64| {
        let slope = (force(u + towards) - force(u)) / towards;
        if slope > 0.0 { u - force(u) / slope } else { u }
    };
    let u = match (next.checked_sub(1).map(|i| places[i]), places.get(next)) {
        (Some(before), Some(&after)) => {
            let (from, to) = (force(before), force(after));
            before + (after - before) * (-from / (to - from)).clamp(0.0, 1.0)
        }
        // Beyond the corners the force is straight.
        (Some(last), None) => outer(last, 1.0),
        (None, Some(&first)) => outer(first, -1.0),
        (None, None) => 0.0,
    };
    u.max(low).min(high)
}

#[cfg(test)]
mod tests {
    use super::{Grounding, Response, rest};

    /// A spring of 2 N/m behind a node that rubs with 1 N, and one of 1 N/m in front of it: up to 1 N only the latter gives way.
    #[test]
    fn beyond_its_friction_a_node_gives_way() {
        let rubbing = Grounding {
            stiffness: 0.0,
            load: 0.0,
            slips: [0.0; 2],
            bounds: [1.0, -1.0],
        };
        let mut left = Response::new(Some(0.0), 2.0);
        left.add(&rubbing, 1.0);
        let free = Response::new(None, 0.0);
        for (pull, moved) in [(0.5, 0.5), (1.0, 1.0), (3.0, 4.0), (-0.5, -0.5), (-3.0, -4.0)] {
            let found = rest(&left, &free, [f64::NEG_INFINITY, f64::INFINITY], |_| -pull);
            assert!((found - moved).abs() < 1e-12, "{pull} N: {found} m");
        }
    }

    #[test]
    fn a_soft_sheath_rubs_the_less_the_farther_it_is_sheared_back() {
        let sheath = Grounding {
            stiffness: 0.0,
            load: 0.0,
            slips: [1.0, 3.0],
            bounds: [5.0, -3.0],
        };
        let found = [0.0, 1.0, 1.5, 2.5, 3.0, 9.0].map(|u| sheath.friction(u));
        assert_eq!(found, [5.0, 5.0, 3.0, -1.0, -3.0, -3.0]);
    }
}
