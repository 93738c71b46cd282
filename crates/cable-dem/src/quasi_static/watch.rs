//! Where the cable begins to slip outside the windows. A block of nodes is looked at again only when the vehicle has come so far that it
//! can slip: with 9600 nodes on a stiff cable a run takes two thirds of the time that it takes with a look at every node in every step.

use std::ops::Range;

use super::passage::Snapshot;
use super::rates::BLOCK;
use crate::step::Stretch;

/// Up to which vehicle position no node slips, block by block.
#[derive(Debug, Clone)]
pub(super) struct Watch {
    /// The nodes that can slip.
    free: Stretch,
    quiet_until: Vec<i64>,
}

impl Watch {
    /// Over the `free` nodes of a cable.
    pub fn new(free: Stretch) -> Self {
        Self {
            quiet_until: vec![i64::MIN; free.hi / BLOCK + 1],
            free,
        }
    }

    /// Forgets what it knows of `stretch`, whose friction has changed.
    pub fn forget(&mut self, stretch: Stretch) {
        self.quiet_until[stretch.lo / BLOCK..=stretch.hi / BLOCK].fill(i64::MIN);
    }

    /// The nodes of all blocks that `stretch` touches.
    pub fn around(&self, stretch: Stretch) -> Range<usize> {
        self.block(stretch.lo / BLOCK).start..self.block(stretch.hi / BLOCK).end
    }

    fn block(&self, block: usize) -> Range<usize> {
        let begin = block * BLOCK;
        begin.max(self.free.lo)..(begin + BLOCK).min(self.free.hi + 1)
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
            let whole = self.block(block);
            let watched = nodes.start.max(whole.start)..nodes.end.min(whole.end);
            let needed = |node: usize| (friction[node] + snapshot.adhesion[node]).abs();
            let pairs = friction[watched.clone()]
                .iter()
                .zip(&snapshot.adhesion[watched.clone()]);
            // Without the care for NaN of the library's maximum, several nodes are looked at at once.
            let most = pairs.map(|(friction, adhesion)| (friction + adhesion).abs());
            let most = most.fold(0.0, |most, needed| if needed > most { needed } else { most });
            if most <= limit {
                // What of it lies in a window or beyond one is not known.
                if watched == whole {
                    let lasts = rates.lasts(first + block * BLOCK, limit - most);
                    self.quiet_until[block] = snapshot.position + lasts;
                }
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
            let free = Stretch { lo: 1, hi: nodes - 1 };
            let room = Room::new(free, 0.0);
            let mut watch = Watch::new(free);
            let mut slips = 0;
            for (step, &position) in passage.positions.iter().enumerate() {
                let snapshot = passage.snapshot(position);
                let near = watch.around(room.under(snapshot.node, passage.reach));
                // A window of a few nodes, which stays for a while: the block around it is looked at on either side.
                let window = Stretch {
                    lo: 100 + step / 50,
                    hi: 104 + step / 50,
                };
                let (before, behind) = (
                    near.start..near.end.min(window.lo),
                    near.start.max(window.hi + 1)..near.end,
                );
                let mut found = vec![false; nodes];
                found[window.nodes()].fill(true);
                for nodes in [before, behind] {
                    watch.slipping(nodes, &snapshot, &friction, limit, |slips| {
                        found[slips.nodes()].fill(true);
                    });
                }
                for node in free.nodes() {
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
            let free = Stretch {
                lo: 0,
                hi: friction.len() - 2,
            };
            let mut watch = Watch::new(free);
            let mut looks = 0;
            for &position in &passage.positions {
                looks += watch
                    .quiet_until
                    .iter()
                    .filter(|&&until| position > until)
                    .count();
                let snapshot = passage.snapshot(position);
                watch.slipping(watch.around(free), &snapshot, &friction, 100.0 * limit, |_| {
                    panic!("nothing slips")
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

    #[test]
    fn what_has_changed_is_looked_at_again() {
        let (passage, mut friction, limit) = scene(0.1, 0.05);
        let mut watch = Watch::new(Stretch {
            lo: 0,
            hi: friction.len() - 1,
        });
        let mut slipping = |position: i64, friction: &[f64], changed: Option<Stretch>| {
            if let Some(changed) = changed {
                watch.forget(changed);
            }
            let mut found = Vec::new();
            let snapshot = passage.snapshot(position);
            watch.slipping(0..friction.len(), &snapshot, friction, 100.0 * limit, |slips| {
                found.push(slips);
            });
            found
        };
        assert_eq!(slipping(0, &friction, None), []);
        let changed = Stretch { lo: 77, hi: 78 };
        friction[changed.nodes()].fill(-200.0 * limit);
        assert_eq!(slipping(1, &friction, Some(changed)), [changed]);
    }
}
