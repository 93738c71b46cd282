//! The windows of a step: where the cable moves, how far each reaches, and what of it still moves afterwards.
//!
//! A window reaches as far beyond a disturbance as a stuck cable feels it, and grows until the held
//! node beyond either edge stays in balance to [`crate::tuning::UNBALANCED_SHARE`].

use std::ops::Range;

use friction_chain::Stretch;

use crate::tuning::{BLOCK, GAP};

/// Where windows may lie, and how far beyond a disturbance they reach.
#[derive(Debug, Clone, Copy)]
pub(super) struct WindowBounds {
    /// The unknown nodes.
    pub free: Stretch,
    /// Nodes over which a stuck cable's response fades to a hundredth.
    pub margin: usize,
}

impl WindowBounds {
    /// On a cable whose sheath has the given `screening` (λ/h)².
    pub fn new(free: Stretch, screening: f64) -> Self {
        Self {
            free,
            margin: fading_nodes(screening),
        }
    }

    /// `stretch` with `nodes` more on either side, as far as there are any.
    pub fn widened(self, stretch: Stretch, nodes: usize) -> Stretch {
        Stretch {
            lo: stretch.lo.saturating_sub(nodes).max(self.free.lo),
            hi: (stretch.hi + nodes).min(self.free.hi),
        }
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

/// Where a step is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Window {
    pub stretch: Stretch,
    /// Whether it travels with the vehicle; around a support alone none does.
    pub travels: bool,
}

impl Window {
    /// One that travels.
    pub fn travelling(stretch: Stretch) -> Self {
        Self {
            stretch,
            travels: true,
        }
    }

    /// One around a support.
    pub fn resting(stretch: Stretch) -> Self {
        Self {
            stretch,
            travels: false,
        }
    }

    /// Whether no node lies between this one and the `next`.
    pub fn touches(self, next: Self) -> bool {
        next.stretch.lo <= self.stretch.hi + 1
    }
}

/// Windows that touch, or nearly so, become one; they are left in order.
pub(super) fn join(windows: &mut Vec<Window>) {
    windows.sort_unstable_by_key(|window| window.stretch.lo);
    windows.dedup_by(|next, window| {
        let touches = next.stretch.lo <= window.stretch.hi + GAP;
        if touches {
            window.stretch = window.stretch.hull(next.stretch);
            window.travels |= next.travels;
        }
        touches
    });
}

/// The window grown by `growth` nodes beyond each edge whose outer neighbour is `disturbed`.
pub(super) fn grow(
    bounds: WindowBounds,
    stretch: Stretch,
    growth: usize,
    disturbed: impl Fn(usize) -> bool,
) -> Stretch {
    let widened = bounds.widened(stretch, growth);
    let left = stretch.lo > bounds.free.lo && disturbed(stretch.lo - 1);
    let right = stretch.hi < bounds.free.hi && disturbed(stretch.hi + 1);
    Stretch {
        lo: if left { widened.lo } else { stretch.lo },
        hi: if right { widened.hi } else { stretch.hi },
    }
}

/// Appends the parts of a `solved` window that still move to `parts`, with the quiet node beside each edge. At least [`GAP`] quiet
/// nodes lie between two of them.
pub(super) fn moving(solved: Stretch, moves: impl Fn(&usize) -> bool, parts: &mut Vec<Window>) {
    let mut from = solved.lo;
    while let Some(lo) = (from..=solved.hi).find(&moves) {
        let mut hi = lo;
        // From the far end: of so many nodes side by side one at least is looked at.
        while let Some(next) = (hi + 1..=solved.hi.min(hi + GAP)).rev().find(&moves) {
            hi = next;
        }
        from = hi + 1;
        parts.push(Window::travelling(Stretch {
            lo: solved.lo.max(lo.saturating_sub(1)),
            hi: solved.hi.min(hi + 1),
        }));
    }
}

/// Finds the stretches of `nodes` that slip side by side, where a block of nodes `may_slip`.
pub(super) fn slipping(
    nodes: Range<usize>,
    may_slip: impl Fn(Range<usize>) -> bool,
    slips: impl Fn(&usize) -> bool,
    mut found: impl FnMut(Stretch),
) {
    let (mut from, end) = (nodes.start, nodes.end);
    while from < end {
        let mut block = from..(from + BLOCK).min(end);
        from = block.end;
        if may_slip(block.clone()) {
            if let Some(lo) = block.find(&slips) {
                from = (lo..end).find(|node| !slips(node)).unwrap_or(end);
                found(Stretch { lo, hi: from - 1 });
            }
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    const SOLVED: Stretch = Stretch { lo: 10, hi: 209 };

    /// The parts of [`SOLVED`] that move where `stretches` do.
    fn parts(stretches: &[(usize, usize)]) -> Vec<(usize, usize)> {
        let mut parts = Vec::new();
        let moves = |node: &usize| stretches.iter().any(|&(lo, hi)| (lo..=hi).contains(node));
        moving(SOLVED, moves, &mut parts);
        parts
            .into_iter()
            .map(|part| (part.stretch.lo, part.stretch.hi))
            .collect()
    }

    #[test]
    fn parts_that_move_are_told_apart_by_a_gap_between_them() {
        assert_eq!(parts(&[]), []);
        assert_eq!(parts(&[(50, 50)]), [(49, 51)]);
        // No farther than what was solved.
        assert_eq!(parts(&[(10, 209)]), [(10, 209)]);
        assert_eq!(parts(&[(10, 10), (209, 209)]), [(10, 11), (208, 209)]);
        for begin in 12..12 + 2 * GAP {
            let near = [(begin, 60), (60 + GAP, 90)];
            assert_eq!(parts(&near), [(begin - 1, 91)]);
            let apart = [(begin, 60), (61 + GAP, 90), (92, 92), (150, 200)];
            assert_eq!(parts(&apart), [(begin - 1, 61), (60 + GAP, 93), (149, 201)]);
        }
    }

    #[test]
    fn windows_with_less_than_a_gap_between_them_are_one() {
        let window = |lo, hi| Window::travelling(Stretch { lo, hi });
        let mut windows = vec![
            window(100, 120),
            window(20, 40),
            window(30, 35),
            window(40 + GAP, 70),
            window(71 + GAP, 90),
        ];
        join(&mut windows);
        assert_eq!(windows, [window(20, 70), window(71 + GAP, 120)]);
    }
}
