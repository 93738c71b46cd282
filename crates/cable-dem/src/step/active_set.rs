//! Active-set iteration for one step: guess the contact states, solve, correct, until they hold.
//!
//! This is the semismooth Newton method on r = anchor − γ clamp(g, lower, upper) (M. Hintermüller, K. Ito, K. Kunisch,
//! SIAM J. Optim. 13 (2002) 865), with each row scaled so that γ → 0 is Coulomb's law and nothing special. From the
//! contact states that the previous vehicle positions predict it needs one or two linear solves, most of a few nodes only; it may cycle,
//! and then [`super::exact`] takes over.

use super::chain::{Chain, Contact, Load, Stretch, Trial};
use super::elimination::Rows;
use super::tolerance::Tolerance;

/// Linear solves after which the iteration counts as cycling: nine in ten steps take one, and what takes more than a few costs more than the
/// exact step. Node updates of five scenes under Coulomb's law, beside 24 solves: 3 to 25 % fewer.
const MAX_SWEEPS: usize = 8;

/// What an iteration came to.
pub(super) struct Iterated {
    /// On success the trial is the step's one answer, and this is the slip beside the anchors, each times its node's length of cable, together
    /// \[m²\]; else the largest violation as a share of the friction limit.
    pub outcome: Result<f64, f64>,
    /// Linear solves, and nodes solved for in all of them.
    pub sweeps: usize,
    pub node_updates: usize,
}

/// What does not hold after a solve.
struct Violations {
    /// The largest \[N/m\].
    worst: f64,
    /// The first and last node out of balance, and those whose contact states were corrected; the first lies beyond the last where there are none.
    unbalanced: (usize, usize),
    corrected: (usize, usize),
    /// Slip of the nodes that were looked at, each times its length of cable \[m²\].
    slip: f64,
}

/// Iterates from the trial's contact states. After the first solve only nodes that a corrected contact state moves are solved for again.
pub(super) fn iterate(
    chain: &Chain,
    load: &Load<'_>,
    stretch: Stretch,
    tolerance: Tolerance,
    trial: &mut Trial,
) -> Iterated {
    let rows = Rows::new(chain, load, stretch, &trial.r);
    let eliminated = &mut trial.eliminated;
    let r = &mut trial.r[stretch.nodes()];
    let g = &mut trial.g[stretch.nodes()];
    let contact = &mut trial.contact[stretch.nodes()];
    let last = r.len() - 1;
    let mut found = Violations {
        worst: f64::INFINITY,
        unbalanced: (0, last),
        corrected: (0, last),
        slip: 0.0,
    };
    let mut node_updates = 0;
    let ended = |outcome, sweeps, node_updates| Iterated {
        outcome,
        sweeps,
        node_updates,
    };
    for sweep in 1..=MAX_SWEEPS {
        let Some(moved) = rows.solve(contact, found.corrected, tolerance.negligible, eliminated, r) else {
            return ended(Err(f64::INFINITY), sweep, node_updates + r.len());
        };
        let nodes = (
            moved.0.saturating_sub(1).min(found.unbalanced.0),
            (moved.1 + 1).min(last).max(found.unbalanced.1),
        );
        node_updates += nodes.1 + 1 - nodes.0;
        found = correct(&rows, tolerance, nodes, r, g, contact);
        if found.worst == 0.0 {
            let slip = if nodes == (0, last) {
                found.slip
            } else {
                slip(chain, load, stretch, trial)
            };
            return ended(Ok(slip), sweep, node_updates);
        }
        if found.corrected.0 > found.corrected.1 {
            // Rounding alone: the same rows give the same answer.
            return ended(Err(found.worst / chain.limit), sweep, node_updates);
        }
        found.corrected = advance(&rows, tolerance, found.corrected, g, contact);
    }
    ended(Err(found.worst / chain.limit), MAX_SWEEPS, node_updates)
}

/// Sets g of `nodes`, the first and the last, from the solved r and corrects contact states that do not hold.
fn correct(
    rows: &Rows<'_>,
    tolerance: Tolerance,
    nodes: (usize, usize),
    r: &[f64],
    g: &mut [f64],
    contact: &mut [Contact],
) -> Violations {
    let chain = rows.chain;
    let (first, end) = (nodes.0, nodes.1 + 1);
    let (mut left, mut here) = (first.checked_sub(1).map_or(rows.held.0, |k| r[k]), r[first]);
    let beyond = r.get(end).copied().unwrap_or(rows.held.1);
    // Of one length, so that no access is checked in the loop.
    let count = end - first;
    let (nodes, adhesion) = (&rows.nodes[first..end], &rows.adhesion[first..end]);
    let (support, anchor) = (&rows.support[first..end], &rows.anchor[first..end]);
    let r = &r[first..end];
    let (g, contact) = (&mut g[first..end], &mut contact[first..end]);
    let (mut worst, mut all_slip) = (0.0_f64, 0.0);
    let none = (usize::MAX, 0);
    let (mut unbalanced, mut corrected) = (none, none);
    let with = |(low, high): (usize, usize), k: usize| (low.min(first + k), high.max(first + k));
    for k in 0..count {
        let right = if k + 1 < count { r[k + 1] } else { beyond };
        let force = chain.stiffness * (nodes[k].diagonal * here - left - right) - support[k];
        let balancing = force * nodes[k].per_tributary;
        let state = contact[k];
        if state == Contact::Stuck {
            let total = balancing + adhesion[k];
            let excess = total.abs() - chain.limit;
            g[k] = balancing;
            // A comparison that NaN fails: it counts as a violation.
            let within = excess <= 0.0;
            if !within {
                if excess <= tolerance.friction {
                    g[k] = chain.limit.copysign(total) - adhesion[k];
                } else {
                    worst = worst.max(nan_is_infinite(excess));
                    contact[k] = if total > 0.0 {
                        Contact::Forward
                    } else {
                        Contact::Backward
                    };
                    corrected = with(corrected, k);
                }
            }
        } else {
            let bound = chain.bound(state, adhesion[k]);
            g[k] = bound;
            // The linear solve itself: equilibrium with the bound.
            let residual = (balancing - bound).abs();
            let balanced = residual <= tolerance.friction;
            if !balanced {
                worst = worst.max(nan_is_infinite(residual));
                unbalanced = with(unbalanced, k);
            }
            let slip = anchor[k] - here - chain.compliance * bound;
            all_slip += nodes[k].tributary * slip.abs();
            let along = if state == Contact::Forward { slip } else { -slip };
            let slips_along = along >= -tolerance.slip;
            if !slips_along {
                contact[k] = Contact::Stuck;
                worst = worst.max(chain.limit.max(f64::MIN_POSITIVE));
                corrected = with(corrected, k);
            }
        }
        (left, here) = (here, right);
    }
    Violations {
        worst,
        unbalanced,
        corrected,
        slip: all_slip,
    }
}

/// Slip of the nodes in `stretch` beside their anchors, each times its length of cable, together \[m²\].
pub(super) fn slip(chain: &Chain, load: &Load<'_>, stretch: Stretch, trial: &Trial) -> f64 {
    let nodes = stretch.nodes();
    let state = trial.r[nodes.clone()].iter().zip(&trial.g[nodes.clone()]);
    let slips = trial.contact[nodes.clone()]
        .iter()
        .zip(&load.anchor[nodes.clone()])
        .zip(state)
        .zip(&chain.nodes[nodes])
        .map(|(((contact, anchor), (r, g)), node)| {
            let slip = node.tributary * (anchor - r - chain.compliance * g).abs();
            if *contact == Contact::Stuck { 0.0 } else { slip }
        });
    slips.sum()
}

/// Lets nodes beside those that slip slip too, as many as it takes to bear the force on the first of them; returns the first and last
/// node whose states are `corrected` then. A stuck node of a stiff sheath shields those behind it, so that without this a stretch that
/// slips grows by one node a solve: 1.2 to 1.5 times the work under Coulomb's law on fine meshes.
fn advance(
    rows: &Rows<'_>,
    tolerance: Tolerance,
    corrected: (usize, usize),
    g: &[f64],
    contact: &mut [Contact],
) -> (usize, usize) {
    let limit = rows.chain.limit;
    let (mut first, mut last) = corrected;
    let total = |k: usize| g[k] + rows.adhesion[k];
    // The friction of a node that was solved for as slipping is at the limit.
    let exceeds = |k: usize| total(k).abs() - limit > tolerance.friction;
    for k in corrected.0..=corrected.1 {
        let state = contact[k];
        if state == Contact::Stuck || !exceeds(k) {
            continue;
        }
        let direction = total(k).signum();
        let mut force = (total(k).abs() - limit) * rows.nodes[k].tributary;
        let mut yields = |contact: &mut [Contact], k: usize| {
            force -= (limit - direction * total(k)) * rows.nodes[k].tributary;
            let yields = force >= 0.0 && contact[k] == Contact::Stuck;
            if yields {
                contact[k] = state;
            }
            yields
        };
        let slipped = |k: usize| contact[k] != Contact::Stuck && !exceeds(k);
        if k + 1 < g.len() && slipped(k + 1) {
            let grown = (0..k).rev().take_while(|&k| yields(contact, k)).last();
            first = first.min(grown.unwrap_or(k));
        } else if k > 0 && slipped(k - 1) {
            let grown = (k + 1..g.len()).take_while(|&k| yields(contact, k)).last();
            last = last.max(grown.unwrap_or(k));
        }
    }
    (first, last)
}

fn nan_is_infinite(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value }
}
