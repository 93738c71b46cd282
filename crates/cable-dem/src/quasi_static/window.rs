//! The windows of a step: where the cable moves, and how that zone grows, travels and shrinks.

use std::ops::Range;

use crate::step::Stretch;

/// Most nodes that a disturbed window grows by at once on each side.
const MAX_GROWTH: usize = 256;

/// Nodes looked at together.
const BLOCK: usize = 64;

/// A window to solve in this step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    pub stretch: Stretch,
    /// Whether it travels with the vehicle.
    pub travels: bool,
}

/// Where windows may lie, and how far beyond a disturbance they reach.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    /// The unknown nodes.
    pub free: Stretch,
    /// Nodes over which a stuck cable's response fades to a hundredth, at most [`MAX_GROWTH`].
    pub margin: usize,
}

impl Room {
    /// On a cable whose sheath has the given `screening` (λ/h)².
    pub fn new(free: Stretch, screening: f64) -> Self {
        Self {
            free,
            margin: fading_nodes(screening).min(MAX_GROWTH),
        }
    }

    /// `stretch` with `nodes` more on either side, as far as there are any.
    pub fn widened(self, stretch: Stretch, nodes: usize) -> Stretch {
        Stretch {
            lo: stretch.lo.saturating_sub(nodes).max(self.free.lo),
            hi: (stretch.hi + nodes).min(self.free.hi),
        }
    }

    /// Whether a window reaches so near to an end that the end feels it.
    pub fn near_an_end(self, stretch: Stretch) -> bool {
        stretch.lo <= self.free.lo + self.margin || stretch.hi + self.margin >= self.free.hi
    }

    /// The part of the cable that may slip under a vehicle over `node` whose adhesion matters over `reach` nodes.
    pub fn under(self, node: i64, reach: usize) -> Stretch {
        let clamp = |node: i64| node.clamp(self.free.lo as i64, self.free.hi as i64) as usize;
        Stretch {
            lo: clamp(node - reach as i64),
            hi: clamp(node + reach as i64),
        }
    }
}

/// Friction that the cable would need all along if it stood still.
pub(super) struct Needed<'a> {
    /// Its parts at every node \[N/m\].
    pub friction: &'a [f64],
    pub adhesion: &'a [f64],
    /// What there is of it \[N/m\].
    pub limit: f64,
}

impl Needed<'_> {
    fn slips(&self, node: usize) -> bool {
        (self.friction[node] + self.adhesion[node]).abs() > self.limit
    }

    /// Whether any of `nodes` slips: without a jump out of the loop, so that several are seen at once.
    fn any_slips(&self, nodes: Range<usize>) -> bool {
        let pairs = self.friction[nodes.clone()].iter().zip(&self.adhesion[nodes]);
        pairs.fold(false, |any, (friction, adhesion)| {
            any | ((friction + adhesion).abs() > self.limit)
        })
    }

    fn first(&self, nodes: Range<usize>) -> Option<usize> {
        let mut blocks = nodes
            .clone()
            .step_by(BLOCK)
            .map(|lo| lo..nodes.end.min(lo + BLOCK));
        blocks
            .find(|block| self.any_slips(block.clone()))?
            .find(|&node| self.slips(node))
    }

    fn last(&self, nodes: Range<usize>) -> Option<usize> {
        let mut blocks = nodes
            .clone()
            .step_by(BLOCK)
            .map(|lo| lo..nodes.end.min(lo + BLOCK))
            .rev();
        blocks
            .find(|block| self.any_slips(block.clone()))?
            .rev()
            .find(|&node| self.slips(node))
    }
}

/// The travelling window: the last one, extended to every node `near` the vehicle that slips.
pub(super) fn travelling(
    room: Room,
    near: Stretch,
    last: Option<Stretch>,
    needed: &Needed<'_>,
) -> Option<Stretch> {
    let end = near.hi + 1;
    let Some(last) = last else {
        let lo = needed.first(near.lo..end)?;
        let hi = needed.last(near.lo..end).unwrap_or(lo);
        return Some(room.widened(Stretch { lo, hi }, room.margin));
    };
    let before = needed.first(near.lo..last.lo.min(end));
    let after = needed.last(last.hi.max(near.lo) + 1..end);
    let slipping = Stretch {
        lo: before.unwrap_or(last.lo),
        hi: after.unwrap_or(last.hi),
    };
    let widened = room.widened(slipping, room.margin);
    Some(Stretch {
        lo: before.map_or(last.lo, |_| widened.lo),
        hi: after.map_or(last.hi, |_| widened.hi),
    })
}

/// Lists a step's windows in `windows`, from left to right; those that touch become one. The travelling window is at least as
/// wide as it was in the last pass, which spares it growing again.
pub(super) fn collect(
    windows: &mut Vec<Window>,
    travelling: Option<Stretch>,
    remembered: Option<Stretch>,
    at_supports: impl Iterator<Item = Stretch>,
) {
    windows.clear();
    let travelling = match (travelling, remembered) {
        (Some(a), Some(b)) if a.lo <= b.hi && b.lo <= a.hi => Some(Stretch {
            lo: a.lo.min(b.lo),
            hi: a.hi.max(b.hi),
        }),
        (travelling, _) => travelling,
    };
    let window = |travels| move |stretch| Window { stretch, travels };
    windows.extend(travelling.map(window(true)));
    windows.extend(at_supports.map(window(false)));
    windows.sort_by_key(|window| window.stretch.lo);
    windows.dedup_by(|next, window| {
        let touches = next.stretch.lo <= window.stretch.hi + 2;
        if touches {
            window.stretch.hi = window.stretch.hi.max(next.stretch.hi);
            window.travels |= next.travels;
        }
        touches
    });
}

/// The window grown by `growth` nodes beyond each edge whose outer neighbour is `disturbed`, and the growth to try next.
pub(super) fn grow(
    room: Room,
    stretch: Stretch,
    growth: usize,
    disturbed: impl Fn(usize) -> bool,
) -> (Stretch, usize) {
    let widened = room.widened(stretch, growth);
    let left = stretch.lo > room.free.lo && disturbed(stretch.lo - 1);
    let right = stretch.hi < room.free.hi && disturbed(stretch.hi + 1);
    let grown = Stretch {
        lo: if left { widened.lo } else { stretch.lo },
        hi: if right { widened.hi } else { stretch.hi },
    };
    (grown, (2 * growth).min(MAX_GROWTH))
}

/// The part of a solved window that still moves; `None` if nothing does. `quiet` is asked of an edge and the node inside it.
pub(super) fn shrink(solved: Stretch, quiet: impl Fn(usize, usize) -> bool) -> Option<Stretch> {
    let Stretch { mut lo, mut hi } = solved;
    while lo < hi && quiet(lo, lo + 1) {
        lo += 1;
    }
    while hi > lo && quiet(hi, hi - 1) {
        hi -= 1;
    }
    (lo < hi).then_some(Stretch { lo, hi })
}

/// Nodes over which the response of a stuck chain fades to a hundredth; `screening` is (λ/h)².
fn fading_nodes(screening: f64) -> usize {
    if screening <= 0.0 {
        return 2;
    }
    // Decay ratio of the difference equation (1 + 2 s) r_i = s (r_{i−1} + r_{i+1}).
    let half = 0.5 / screening;
    let ratio = 1.0 + half - (half * (half + 2.0)).sqrt();
    ((100.0_f64.ln() / -ratio.ln()).ceil() as usize).max(2)
}
