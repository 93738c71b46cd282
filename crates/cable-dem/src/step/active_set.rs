//! Active-set iteration for one step: guess the contact states, solve, correct, until they hold.
//!
//! This is the semismooth Newton method on r = anchor − γ clamp(g, lower, upper) (M. Hintermüller, K. Ito, K. Kunisch,
//! SIAM J. Optim. 13 (2002) 865), with each row scaled so that γ → 0 is Coulomb's law and nothing special. From the
//! contact states that the previous vehicle positions predict it needs one or two linear solves; it may cycle, and then
//! [`super::exact`] takes over.

use super::chain::{Chain, Contact, Load, Stretch, Trial};
use super::elimination::Rows;
use super::tolerance::Tolerance;

/// Linear solves after which the iteration counts as cycling.
const MAX_SWEEPS: usize = 24;

/// Iterates from the trial's contact states; on success the trial is the step's one answer. Else the largest violation as a share of the
/// friction limit is returned, and in any case the number of linear solves.
pub(crate) fn iterate(
    chain: &Chain,
    load: &Load<'_>,
    stretch: Stretch,
    tolerance: Tolerance,
    trial: &mut Trial,
) -> (Result<(), f64>, usize) {
    let rows = Rows::new(chain, load, stretch, &trial.r);
    let eliminated = &mut trial.eliminated;
    let r = &mut trial.r[stretch.nodes()];
    let g = &mut trial.g[stretch.nodes()];
    let contact = &mut trial.contact[stretch.nodes()];
    let mut changed = (0, r.len() - 1);
    let mut worst = f64::INFINITY;
    for sweep in 1..=MAX_SWEEPS {
        if !rows.solve(contact, changed, eliminated, r) {
            return (Err(f64::INFINITY), sweep);
        }
        (worst, changed) = correct(&rows, tolerance, r, g, contact);
        if worst == 0.0 {
            return (Ok(()), sweep);
        }
        if changed.0 > changed.1 {
            // Rounding alone: the same rows give the same answer.
            return (Err(worst / chain.limit), sweep);
        }
    }
    (Err(worst / chain.limit), MAX_SWEEPS)
}

/// Sets g from the solved r and corrects contact states that do not hold. Returned: the largest violation \[N/m\], and the first
/// and last node whose states were corrected.
fn correct(
    rows: &Rows<'_>,
    tolerance: Tolerance,
    r: &[f64],
    g: &mut [f64],
    contact: &mut [Contact],
) -> (f64, (usize, usize)) {
    let chain = rows.chain;
    let count = r.len();
    // Of one length, so that no access is checked in the loop.
    let (diagonal, per_tributary) = (&rows.diagonal[..count], &rows.per_tributary[..count]);
    let (adhesion, support, anchor) = (
        &rows.adhesion[..count],
        &rows.support[..count],
        &rows.anchor[..count],
    );
    let (g, contact) = (&mut g[..count], &mut contact[..count]);
    let mut worst = 0.0_f64;
    let (mut first, mut last) = (count - 1, 0);
    let (mut left, mut here) = (rows.held.0, r[0]);
    for k in 0..count {
        let right = if k + 1 < count { r[k + 1] } else { rows.held.1 };
        let force = chain.stiffness * (diagonal[k] * here - left - right) - support[k];
        let balancing = force * per_tributary[k];
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
                    (first, last) = (first.min(k), k);
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
            }
            let slip = anchor[k] - here - chain.compliance * bound;
            let along = if state == Contact::Forward { slip } else { -slip };
            let slips_along = along >= -tolerance.slip;
            if !slips_along {
                contact[k] = Contact::Stuck;
                worst = worst.max(chain.limit.max(f64::MIN_POSITIVE));
                (first, last) = (first.min(k), k);
            }
        }
        (left, here) = (here, right);
    }
    (worst, (first, last))
}

fn nan_is_infinite(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value }
}
