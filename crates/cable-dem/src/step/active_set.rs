//! Active-set iteration for one step: guess the contact states, solve, correct, until they hold.
//!
//! This is the semismooth Newton method on r = anchor − γ clamp(g, lower, upper) (M. Hintermüller, K. Ito, K. Kunisch,
//! SIAM J. Optim. 13 (2002) 865), with each row scaled so that γ → 0 is Coulomb's law and nothing special. From the
//! contact states that the previous vehicle positions predict it needs one or two linear solves; it may cycle, and then
//! [`super::exact`] takes over.

use super::chain::{Chain, Contact, Load, Stretch, Trial};
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
    let mut outcome = Err(f64::INFINITY);
    for sweep in 1..=MAX_SWEEPS {
        if !solve(chain, load, stretch, trial) {
            return (Err(f64::INFINITY), sweep);
        }
        outcome = correct(chain, load, stretch, tolerance, trial);
        if outcome.is_ok() {
            return (outcome, sweep);
        }
    }
    (outcome, MAX_SWEEPS)
}

/// Solves the linear system of the given contact states; false if it is singular.
///
/// A stuck row reads r + γ g = anchor, a slipping one k⁻¹ times equilibrium with g at its bound. Both are diagonally
/// dominant, so that elimination needs no pivoting.
fn solve(chain: &Chain, load: &Load<'_>, stretch: Stretch, trial: &mut Trial) -> bool {
    let Stretch { lo, hi } = stretch;
    let Trial {
        r, contact, factors, ..
    } = trial;
    let per_stiffness = 1.0 / chain.stiffness;
    let last = r.len() - 1;
    // A held neighbour enters as a known value, a missing one not at all.
    let mut factor = 0.0;
    let mut before = if lo > 0 { r[lo - 1] } else { 0.0 };
    let after = if hi < last { r[hi + 1] } else { 0.0 };
    for i in lo..=hi {
        let (diagonal, off, right) = match contact[i] {
            Contact::Stuck => {
                let soft = chain.softness[i];
                (
                    1.0 + soft * chain.diagonal[i],
                    soft,
                    load.anchor[i] + soft * per_stiffness * load.support[i],
                )
            }
            slipping => (
                chain.diagonal[i],
                1.0,
                per_stiffness
                    * (chain.tributary[i] * chain.bound(slipping, load.adhesion[i]) + load.support[i]),
            ),
        };
        let held = if i == hi { off * after } else { 0.0 };
        let pivot = diagonal - off * factor;
        // Rows add up to the supports' share alone: without any, and all slipping, nothing holds the stretch.
        if pivot <= 1e-14 * diagonal {
            return false;
        }
        let inverse = 1.0 / pivot;
        factor = off * inverse;
        before = (right + off * before + held) * inverse;
        factors[i] = factor;
        r[i] = before;
    }
    let mut next = r[hi];
    for i in (lo..hi).rev() {
        next = r[i] + factors[i] * next;
        r[i] = next;
    }
    true
}

/// Sets g from the solved r and corrects contact states that do not hold.
fn correct(
    chain: &Chain,
    load: &Load<'_>,
    stretch: Stretch,
    tolerance: Tolerance,
    trial: &mut Trial,
) -> Result<(), f64> {
    let Trial { r, g, contact, .. } = trial;
    let mut worst = 0.0_f64;
    for i in stretch.lo..=stretch.hi {
        let balancing = chain.balancing_friction(r, load.support, i);
        match contact[i] {
            Contact::Stuck => {
                let total = balancing + load.adhesion[i];
                let excess = total.abs() - chain.limit;
                g[i] = balancing;
                // A comparison that NaN fails: it counts as a violation.
                let within = excess <= tolerance.friction;
                if !within {
                    worst = worst.max(nan_is_infinite(excess));
                    contact[i] = if total > 0.0 {
                        Contact::Forward
                    } else {
                        Contact::Backward
                    };
                } else if excess > 0.0 {
                    g[i] = chain.limit.copysign(total) - load.adhesion[i];
                }
            }
            slipping => {
                let bound = chain.bound(slipping, load.adhesion[i]);
                g[i] = bound;
                let slip = load.anchor[i] - r[i] - chain.compliance * bound;
                let along = if slipping == Contact::Forward { slip } else { -slip };
                // The linear solve itself: equilibrium with the bound.
                let residual = (balancing - bound).abs();
                let balanced = residual <= tolerance.friction;
                if !balanced {
                    worst = worst.max(nan_is_infinite(residual));
                }
                let slips_along = along >= -tolerance.slip;
                if !slips_along {
                    contact[i] = Contact::Stuck;
                    worst = worst.max(chain.limit.max(f64::MIN_POSITIVE));
                }
            }
        }
    }
    if worst == 0.0 {
        Ok(())
    } else {
        Err(worst / chain.limit)
    }
}

fn nan_is_infinite(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value }
}
