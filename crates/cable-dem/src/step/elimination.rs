//! The linear system of a stretch whose contact states are given, eliminated from both ends at once.
//!
//! With K the chain's stiffness and supports, a stuck node reads r + γ g = anchor, a slipping one equilibrium with g at its bound. Divided
//! by its diagonal each is a row
//!
//! r_i − a_i (r_{i−1} + r_{i+1}) = b_i,  0 ≤ a_i ≤ ½, or up to 1 for an end without a neighbour,
//!
//! so that elimination needs no pivoting. It comes from both ends and meets in the middle: each row waits for the one before it, and
//! two can wait at once. What is carried from row to row are determinants, d_i = d_{i−1} − a_i a_{i−1} d_{i−2}: two products, where pivots
//! d_i/d_{i−1} would have every row wait for a division. Rounding changes them as if it had changed the rows by a few units in the
//! last place.

use super::chain::{Chain, Contact, Eliminated, Load, Node, Stretch};

/// Rows after which determinants are made of size 1 again: each is at least half the one before.
const RESCALED: usize = 256;
/// A pivot below this is none: rows add up to the supports' share alone; without any, and all slipping, nothing holds the stretch.
const SINGULAR: f64 = 1e-14;

/// The nodes of a stretch, as slices of one length.
pub(super) struct Rows<'a> {
    pub chain: &'a Chain,
    pub nodes: &'a [Node],
    pub adhesion: &'a [f64],
    pub support: &'a [f64],
    pub anchor: &'a [f64],
    /// Neighbours beyond the ends: a held one enters as a known value, a missing one as none at all.
    pub held: (f64, f64),
    per_stiffness: f64,
}

/// r_i − a (r_{i−1} + r_{i+1}) = b.
struct Row {
    a: f64,
    b: f64,
}

/// What the rows on one side leave to the next: the last one's value, d_{i−1}, a_{i−1} d_{i−2}.
#[derive(Clone, Copy)]
struct Side {
    value: f64,
    determinant: f64,
    minor: f64,
}

impl Side {
    /// Beside a row that is eliminated, or a neighbour that is held: only the ratio of determinants counts.
    fn beside(row: Eliminated) -> Self {
        Self {
            value: row.value,
            determinant: 1.0,
            minor: row.factor,
        }
    }

    /// The same with a determinant of 1.
    fn rescaled(self) -> Self {
        Self {
            determinant: 1.0,
            minor: self.minor / self.determinant,
            ..self
        }
    }

    #[allow(clippy::inline_always, reason = "a call a row costs half of the time")]
    #[inline(always)]
    fn eliminate(self, row: &Row) -> (Self, Eliminated) {
        let determinant = self.determinant - row.a * self.minor;
        let inverse = self.determinant / determinant;
        let factor = row.a * inverse;
        let value = row.b * inverse + factor * self.value;
        let next = Self {
            value,
            determinant,
            minor: row.a * self.determinant,
        };
        (next, Eliminated { value, factor })
    }
}

impl Eliminated {
    /// Whether it says the same as `other`, but for `negligible` \[m\] and rounding.
    fn is_near(self, other: Self, negligible: f64) -> bool {
        (self.value - other.value).abs() <= negligible && (self.factor - other.factor).abs() <= f64::EPSILON
    }
}

impl<'a> Rows<'a> {
    pub fn new(chain: &'a Chain, load: &Load<'a>, stretch: Stretch, r: &[f64]) -> Self {
        let nodes = stretch.nodes();
        Self {
            chain,
            nodes: &chain.nodes[nodes.clone()],
            adhesion: &load.adhesion[nodes.clone()],
            support: &load.support[nodes.clone()],
            anchor: &load.anchor[nodes],
            held: (
                stretch.lo.checked_sub(1).map_or(0.0, |i| r[i]),
                r.get(stretch.hi + 1).copied().unwrap_or(0.0),
            ),
            per_stiffness: 1.0 / chain.stiffness,
        }
    }

    #[allow(clippy::inline_always, reason = "a call a row costs half of the time")]
    #[inline(always)]
    fn row(&self, contact: &[Contact], k: usize) -> Row {
        let (node, support) = (&self.nodes[k], self.per_stiffness * self.support[k]);
        match contact[k] {
            Contact::Stuck => {
                let (a, share) = node.stuck;
                Row {
                    a,
                    b: share * self.anchor[k] + a * support,
                }
            }
            slipping => {
                let a = node.per_diagonal;
                let bound = self.chain.bound(slipping, self.adhesion[k]);
                Row {
                    a,
                    b: a * (self.per_stiffness * node.tributary * bound + support),
                }
            }
        }
    }

    /// Solves for `r`; only nodes between the `changed` two are in other contact states than when `r` and `eliminated` were last written.
    /// Returned are the first and last node up to which that moves the cable, by more than `negligible` \[m\]; `None` where the system is
    /// singular.
    pub fn solve(
        &self,
        contact: &[Contact],
        changed: (usize, usize),
        negligible: f64,
        eliminated: &mut [Eliminated],
        r: &mut [f64],
    ) -> Option<(usize, usize)> {
        let count = r.len();
        let (contact, eliminated) = (&contact[..count], &mut eliminated[..count]);
        let middle = count / 2;
        let held = |value| Eliminated { value, factor: 0.0 };
        // Rows that stay as they were eliminated, on both sides.
        let (mut i, mut j) = (changed.0.min(middle), changed.1.max(middle));
        let from = i.checked_sub(1).map_or(held(self.held.0), |i| eliminated[i]);
        let mut below = Side::beside(from);
        let from = eliminated.get(j + 1).copied().unwrap_or(held(self.held.1));
        let mut above = Side::beside(from);
        while i < middle && j > middle {
            let pairs = (middle - i).min(j - middle).min(RESCALED);
            for _ in 0..pairs {
                let (low, high) = (self.row(contact, i), self.row(contact, j));
                (below, eliminated[i]) = below.eliminate(&low);
                (above, eliminated[j]) = above.eliminate(&high);
                i += 1;
                j -= 1;
            }
            (below, above) = (below.rescaled(), above.rescaled());
        }
        while i < middle {
            let end = middle.min(i + RESCALED);
            for i in i..end {
                let row = eliminated[i];
                (below, eliminated[i]) = below.eliminate(&self.row(contact, i));
                if i > changed.1 && eliminated[i].is_near(row, negligible) {
                    return Some((downwards(changed.0, i, negligible, eliminated, r), i));
                }
            }
            (i, below) = (end, below.rescaled());
        }
        while j > middle {
            let end = middle.max(j.saturating_sub(RESCALED));
            for j in (end + 1..=j).rev() {
                let row = eliminated[j];
                (above, eliminated[j]) = above.eliminate(&self.row(contact, j));
                if j < changed.0 && eliminated[j].is_near(row, negligible) {
                    return Some((j, upwards(changed.1, j, negligible, eliminated, r)));
                }
            }
            (j, above) = (end, above.rescaled());
        }
        let met = self.row(contact, middle);
        let pivot = 1.0 - met.a * (below.minor + above.minor);
        let solved = (met.b + met.a * (below.value + above.value)) / pivot;
        // A comparison that NaN fails.
        let is_regular = pivot > SINGULAR && solved.is_finite();
        r[middle] = solved;
        let (mut left, mut right) = (solved, solved);
        let pairs = (middle - changed.0.min(middle)).min(changed.1.max(middle) - middle);
        for k in 1..=pairs {
            let (low, high) = (eliminated[middle - k], eliminated[middle + k]);
            left = low.value + low.factor * left;
            right = high.value + high.factor * right;
            (r[middle - k], r[middle + k]) = (left, right);
        }
        let first = downwards(changed.0, middle - pairs, negligible, eliminated, r);
        let last = upwards(changed.1, middle + pairs, negligible, eliminated, r);
        is_regular.then_some((first, last))
    }
}

/// Solves for the nodes below `from`, at least down to `to`, and on until one moves by no more than `negligible` \[m\]; returns the last one.
fn downwards(to: usize, from: usize, negligible: f64, eliminated: &[Eliminated], r: &mut [f64]) -> usize {
    let mut neighbour = r[from];
    for i in (0..from).rev() {
        let moved = eliminated[i].value + eliminated[i].factor * neighbour;
        if i < to && (moved - r[i]).abs() <= negligible {
            return i + 1;
        }
        r[i] = moved;
        neighbour = moved;
    }
    0
}

/// The same for the nodes above.
fn upwards(to: usize, from: usize, negligible: f64, eliminated: &[Eliminated], r: &mut [f64]) -> usize {
    let mut neighbour = r[from];
    for i in from + 1..r.len() {
        let moved = eliminated[i].value + eliminated[i].factor * neighbour;
        if i > to && (moved - r[i]).abs() <= negligible {
            return i - 1;
        }
        r[i] = moved;
        neighbour = moved;
    }
    r.len() - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DuctedCable, End, Friction, FrictionLaw, Mesh};

    /// Nodes on either side are more than determinants are carried over without being rescaled.
    const NODES: usize = 1302;

    fn chain(law: FrictionLaw) -> Chain {
        let length = 0.1 * (NODES - 1) as f64;
        let friction = Friction::new(law, 30.0).expect("friction");
        let cable = DuctedCable::new(length, 8e6, friction)
            .and_then(|cable| cable.with_ends(End::Free, End::Spring(2e6)))
            .expect("a cable");
        Chain::new(&cable, &Mesh::new(length, 0.1, 0.05).expect("a mesh"))
    }

    #[test]
    fn every_row_holds_and_rows_that_stay_need_not_be_eliminated_again() {
        let sheath = FrictionLaw::ElasticPlastic { shape_factor: 3e6 };
        for law in [FrictionLaw::Coulomb, sheath] {
            let chain = chain(law);
            // Any numbers.
            let noise = |i: usize| ((i * 7919 + 13) % 1009) as f64 / 1009.0 - 0.5;
            let [adhesion, support, anchor] =
                [3.0, 50.0, 1e-4].map(|size| (0..NODES).map(|i| size * noise(i)).collect::<Vec<_>>());
            let load = Load {
                adhesion: &adhesion,
                support: &support,
                anchor: &anchor,
            };
            let stretch = Stretch { lo: 0, hi: NODES - 1 };
            let state = |i: usize| match (i / 40) % 3 {
                0 => Contact::Stuck,
                1 => Contact::Forward,
                _ => Contact::Backward,
            };
            let mut contact: Vec<Contact> = (0..NODES).map(state).collect();
            let rows = Rows::new(&chain, &load, stretch, &[0.0; NODES]);
            let mut eliminated = vec![Eliminated::default(); NODES];
            let mut r = vec![0.0; NODES];
            assert!(
                rows.solve(&contact, (0, NODES - 1), 0.0, &mut eliminated, &mut r)
                    .is_some()
            );
            for changed in [(30, 35), (900, 1290), (640, 660), (0, 0), (NODES - 1, NODES - 1)] {
                for state in &mut contact[changed.0..=changed.1] {
                    *state = match state {
                        Contact::Stuck => Contact::Forward,
                        _ => Contact::Stuck,
                    };
                }
                let old = r.clone();
                let moved = rows.solve(&contact, changed, 0.0, &mut eliminated, &mut r);
                let (first, last) = moved.expect("a regular system");
                if law == FrictionLaw::Coulomb {
                    // A stuck node holds fast and shields what lies beyond it: there are 40 in a row, each 120.
                    assert!(
                        first + 120 > changed.0 && last < changed.1 + 120,
                        "{first} to {last}"
                    );
                }
                assert!((0..first).chain(last + 1..NODES).all(|i| old[i] == r[i]));
                let size = r.iter().fold(0.0_f64, |most, r| most.max(r.abs()));
                for i in 0..NODES {
                    let Row { a, b } = rows.row(&contact, i);
                    let left = if i > 0 { r[i - 1] } else { 0.0 };
                    let right = r.get(i + 1).copied().unwrap_or(0.0);
                    let missed = r[i] - a * (left + right) - b;
                    assert!(missed.abs() < 1e-13 * size, "row {i}: {missed:e} of {size:e}");
                }
            }
        }
    }

    #[test]
    fn what_nothing_holds_is_refused() {
        let friction = Friction::new(FrictionLaw::Coulomb, 30.0).expect("friction");
        let cable = DuctedCable::new(2.0, 8e6, friction).expect("a cable");
        let chain = Chain::new(&cable, &Mesh::new(2.0, 0.1, 0.05).expect("a mesh"));
        let zeros = [0.0; 21];
        let load = Load {
            adhesion: &zeros,
            support: &zeros,
            anchor: &zeros,
        };
        let rows = Rows::new(&chain, &load, Stretch { lo: 0, hi: 20 }, &zeros);
        let mut eliminated = [Eliminated::default(); 21];
        let mut contact = [Contact::Forward; 21];
        assert!(
            rows.solve(&contact, (0, 20), 0.0, &mut eliminated, &mut [0.0; 21])
                .is_none()
        );
        contact[3] = Contact::Stuck;
        assert!(
            rows.solve(&contact, (3, 3), 0.0, &mut eliminated, &mut [0.0; 21])
                .is_some()
        );
    }
}
