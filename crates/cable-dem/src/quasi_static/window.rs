//! The windows of a step: where the cable moves, and how that zone grows, travels and shrinks.

use super::chain::Stretch;
use super::passage::Snapshot;
use super::sweeper::Sweeper;

/// Share of the friction limit by which friction and equilibrium may be off outside the windows while the vehicle passes.
/// Measured against whole-cable solves this moves the force by less than 1e-4 of q L (in 1400 random scenes, but for one cable
/// held by nothing: 5e-4).
pub(crate) const NEGLIGIBLE: f64 = 1e-3;
/// A window's edge is quiet when the force its last move put on the next node is below this share of [`NEGLIGIBLE`].
const QUIET: f64 = 0.25;

/// A window to solve in this step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    pub(super) stretch: Stretch,
    /// Whether it travels with the vehicle.
    pub(super) travels: bool,
}

impl Sweeper {
    /// The travelling window of this step: the last one, extended to every node near the vehicle that must slip.
    pub(super) fn disturbed(
        &self,
        snapshot: &Snapshot<'_>,
        reach: usize,
        travelling: Option<Stretch>,
    ) -> Option<Stretch> {
        let node = snapshot.node;
        let clamp = |node: i64| node.clamp(self.free.lo as i64, self.free.hi as i64) as usize;
        let (from, to) = (clamp(node - reach as i64), clamp(node + reach as i64));
        let limit = self.chain.limit * (1.0 + NEGLIGIBLE);
        let slips = |i: &usize| (self.g[*i] + snapshot.adhesion[i + 1]).abs() > limit;
        let inside = travelling.unwrap_or(Stretch { lo: to + 1, hi: to });
        let first = (from..inside.lo.min(to + 1)).find(slips);
        let last = (inside
            .hi
            .max(from)
            .saturating_add(usize::from(travelling.is_some()))..=to)
            .rev()
            .find(slips);
        let widened = |stretch: Stretch| Stretch {
            lo: first.map_or(stretch.lo, |i| i.saturating_sub(self.margin).max(self.free.lo)),
            hi: last.map_or(stretch.hi, |i| (i + self.margin).min(self.free.hi)),
        };
        match (travelling, first, last) {
            (Some(stretch), _, _) => Some(widened(stretch)),
            (None, Some(first), last) => Some(widened(Stretch {
                lo: first,
                hi: last.unwrap_or(first),
            })),
            (None, None, _) => None,
        }
    }

    /// Lists this step's windows, from left to right; those that touch become one. The travelling window is at least as
    /// wide as it was in the last pass, which spares it growing again.
    pub(super) fn collect_windows(&mut self, travelling: Option<Stretch>, remembered: Option<Stretch>) {
        self.windows.clear();
        let travelling = match (travelling, remembered) {
            (Some(a), Some(b)) if a.lo <= b.hi && b.lo <= a.hi => Some(Stretch {
                lo: a.lo.min(b.lo),
                hi: a.hi.max(b.hi),
            }),
            (travelling, _) => travelling,
        };
        self.windows.extend(travelling.map(|stretch| Window {
            stretch,
            travels: true,
        }));
        self.windows.extend(
            self.supports
                .iter()
                .filter(|support| support.due)
                .map(|support| Window {
                    stretch: support.stretch,
                    travels: false,
                }),
        );
        self.windows.sort_by_key(|window| window.stretch.lo);
        let mut merged = 0;
        for index in 1..self.windows.len() {
            let next = self.windows[index];
            let window = &mut self.windows[merged];
            if next.stretch.lo <= window.stretch.hi + 2 {
                window.stretch.hi = window.stretch.hi.max(next.stretch.hi);
                window.travels |= next.travels;
            } else {
                merged += 1;
                self.windows[merged] = next;
            }
        }
        self.windows.truncate(merged + 1);
    }

    /// The part of a solved window that still moves; `None` if nothing does.
    pub(super) fn shrink(&self, solved: Stretch) -> Option<Stretch> {
        let Stretch { mut lo, mut hi } = solved;
        let quiet = |edge: usize, inner: usize| {
            let moved = (self.trial.r[inner] - self.r[inner]).abs();
            self.chain.stiffness * moved <= QUIET * NEGLIGIBLE * self.chain.limit * self.chain.tributary[edge]
        };
        while lo < hi && quiet(lo, lo + 1) {
            lo += 1;
        }
        while hi > lo && quiet(hi, hi - 1) {
            hi -= 1;
        }
        (lo < hi).then_some(Stretch { lo, hi })
    }

    /// Whether this step may have changed the force on an end.
    pub(super) fn ends_touched(&self) -> bool {
        self.supports.iter().any(|support| support.due)
            || self.windows.iter().any(|window| {
                window.stretch.lo <= self.free.lo + self.margin
                    || window.stretch.hi + self.margin >= self.free.hi
            })
    }
}
