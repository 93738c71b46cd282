//! Where the cable begins to slip outside the windows. A block of nodes is looked at again only when the vehicle has come so far that it
//! can slip: with 9600 nodes on a stiff cable a run takes two thirds of the time that it takes with a look at every node in every step.

use std::ops::Range;

use super::passage::Snapshot;
use crate::step::Stretch;

/// Nodes side by side, or lattice points, that are looked at together.
const BLOCK: usize = 32;

/// Up to which vehicle position no node slips, block by block.
#[derive(Debug, Clone)]
pub(super) struct Watch {
    quiet_until: Vec<i64>,
}

impl Watch {
    /// Over a cable of so many `nodes`.
    pub fn new(nodes: usize) -> Self {
        Self {
            quiet_until: vec![i64::MIN; nodes.div_ceil(BLOCK)],
        }
    }

    /// Forgets what it knows of `stretch`, whose friction has changed.
    pub fn forget(&mut self, stretch: Stretch) {
        self.quiet_until[stretch.lo / BLOCK..=stretch.hi / BLOCK].fill(i64::MIN);
    }

    /// The nodes of all blocks that `stretch` touches, as far as they are among the `free` ones: a block is watched as a whole.
    pub fn around(stretch: Stretch, free: Stretch) -> Range<usize> {
        let (lo, end) = (stretch.lo / BLOCK * BLOCK, (stretch.hi / BLOCK + 1) * BLOCK);
        lo.max(free.lo)..end.min(free.hi + 1)
    }

    /// Finds, block by block, what slips among `nodes`: where `friction` and adhesion together are beyond `limit` \[N/m\].
    pub fn slipping(
        &mut self,
        nodes: Range<usize>,
        snapshot: &Snapshot<'_>,
        friction: &[f64],
        limit: f64,
        mut found: impl FnMut(Stretch),
    ) {
        if nodes.is_empty() {
            return;
        }
        let (rates, first) = snapshot.rates;
        for block in nodes.start / BLOCK..nodes.end.div_ceil(BLOCK) {
            if snapshot.position <= self.quiet_until[block] {
                continue;
            }
            let begin = block * BLOCK;
            let watched = nodes.start.max(begin)..nodes.end.min(begin + BLOCK);
            let needed = |node: usize| (friction[node] + snapshot.adhesion[node]).abs();
            let pairs = friction[watched.clone()]
                .iter()
                .zip(&snapshot.adhesion[watched.clone()]);
            // Without the care for NaN of the library's maximum, several nodes are looked at at once.
            let most = pairs.map(|(friction, adhesion)| (friction + adhesion).abs());
            let most = most.fold(0.0, |most, needed| if needed > most { needed } else { most });
            if most <= limit {
                self.quiet_until[block] = snapshot.position + rates.lasts(first + begin, limit - most);
                continue;
            }
            let slips = |&node: &usize| needed(node) > limit;
            let (lo, hi) = (watched.clone().find(slips), watched.rev().find(slips));
            if let (Some(lo), Some(hi)) = (lo, hi) {
                found(Stretch { lo, hi });
            }
        }
    }
}

/// How fast the adhesion of a node changes as the vehicle drives.
#[derive(Debug, Clone)]
pub(super) struct Rates {
    /// Of a block of lattice points and both beside it: the largest change from a point of the lattice to the next \[N/m\].
    around: Vec<f64>,
    phases: usize,
}

impl Rates {
    /// Of the adhesion \[N/m\] on a lattice, phase by phase.
    pub fn new(adhesion: &[&[f64]]) -> Self {
        let phases = adhesion.len();
        let mut largest = vec![0.0_f64; adhesion[0].len().div_ceil(BLOCK) + 2];
        for (k, phase) in adhesion.iter().enumerate() {
            // The last phase is followed by the next point of the first one.
            let next = &adhesion[(k + 1) % phases][usize::from(k + 1 == phases)..];
            for (point, (a, b)) in phase.iter().zip(next).enumerate() {
                let largest = &mut largest[point / BLOCK + 1];
                *largest = largest.max((b - a).abs());
            }
        }
        let around = largest.windows(3);
        Self {
            around: around.map(|rates| rates[0].max(rates[1]).max(rates[2])).collect(),
            phases,
        }
    }

    /// How many lattice units the vehicle can drive before the adhesion of any node of a block, the first of which stands at lattice point
    /// `first`, changes by more than `slack` \[N/m\]; at most a block's length, over which the block does not leave the points around.
    fn lasts(&self, first: usize, slack: f64) -> i64 {
        let most = (BLOCK * self.phases) as f64;
        (slack / self.around[first / BLOCK]).min(most) as i64
    }
}

#[cfg(test)]
mod tests {
    use ground_field::Direction;

    use super::*;
    use crate::quasi_static::passage::Passage;
    use crate::quasi_static::window::Room;
    use crate::{DuctedCable, Friction, FrictionLaw, Mesh};

    /// Adhesion of two wheels over a duct of 60 m, and friction that is different at every node.
    fn scene(spacing: f64, vehicle_step: f64) -> (Passage, Vec<f64>, f64) {
        let limit = 40.0;
        let friction = Friction::new(FrictionLaw::Coulomb, limit).expect("valid friction");
        let cable = DuctedCable::new(60.0, 1e7, friction).expect("a valid cable");
        let mesh = Mesh::new(60.0, spacing, vehicle_step).expect("a valid mesh");
        let wheel = |xi: f64| 2e-5 * xi / (1.0 + xi * xi).powi(2);
        let shape = |xi: f64| wheel(xi) + 0.7 * wheel(xi + 4.0);
        let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, 30.0).expect("a passage");
        let friction = (0..mesh.nodes())
            .map(|node| 39.0 * (0.37 * node as f64).sin())
            .collect();
        (passage, friction, limit)
    }

    const STEPS: [(f64, f64); 4] = [(0.1, 0.05), (0.1, 0.1), (0.07, 0.02), (0.05, 0.15)];

    #[test]
    fn nothing_that_slips_is_missed() {
        for (spacing, vehicle_step) in STEPS {
            let (passage, mut friction, limit) = scene(spacing, vehicle_step);
            let nodes = friction.len();
            let free = Stretch { lo: 0, hi: nodes - 1 };
            let room = Room::new(free, 0.0);
            let mut watch = Watch::new(nodes);
            let mut slips = 0;
            for &position in &passage.positions {
                let snapshot = passage.snapshot(position);
                let near = Watch::around(room.under(snapshot.node, passage.reach), free);
                let mut found = vec![false; nodes];
                watch.slipping(near, &snapshot, &friction, limit, |slips| {
                    found[slips.nodes()].fill(true);
                });
                for node in 0..nodes {
                    let needed = friction[node] + snapshot.adhesion[node];
                    if needed.abs() > limit {
                        assert!(found[node], "node {node} with the vehicle at {position}");
                        // It slips until its friction is just below the limit.
                        friction[node] = (0.998 * limit).copysign(needed) - snapshot.adhesion[node];
                        watch.forget(Stretch { lo: node, hi: node });
                        slips += 1;
                    }
                }
            }
            assert!(slips > nodes, "{slips} slips of {nodes} nodes");
        }
    }

    #[test]
    fn where_nothing_can_slip_a_block_is_looked_at_once_a_block_s_length() {
        for (spacing, vehicle_step) in STEPS {
            let (passage, friction, limit) = scene(spacing, vehicle_step);
            let mut watch = Watch::new(friction.len());
            let mut looks = 0;
            for &position in &passage.positions {
                looks += watch
                    .quiet_until
                    .iter()
                    .filter(|&&until| position > until)
                    .count();
                let snapshot = passage.snapshot(position);
                watch.slipping(0..friction.len(), &snapshot, &friction, 100.0 * limit, |_| {
                    panic!("nothing slips");
                });
            }
            let blocks = watch.quiet_until.len() * passage.steps();
            // Far away the vehicle makes longer steps.
            let most = 2.0 * vehicle_step / (BLOCK as f64 * spacing);
            assert!(
                looks as f64 <= most * blocks as f64,
                "{looks} looks at {blocks} blocks"
            );
        }
    }
}
