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
/// dominant, so that elimination needs no pivoting. It comes from both ends and meets in the middle: a row waits for the
/// division of the row before, and two rows can wait at once.
fn solve(chain: &Chain, load: &Load<'_>, stretch: Stretch, trial: &mut Trial) -> bool {
    let Stretch { lo, hi } = stretch;
    let Trial {
        r, contact, factors, ..
    } = trial;
    let per_stiffness = 1.0 / chain.stiffness;
    let row = |i: usize| Row::new(chain, load, contact[i], per_stiffness, i);
    // A held neighbour enters as a known value, a missing one not at all.
    let held = |value: Option<&f64>| Eliminated {
        value: value.copied().unwrap_or(0.0),
        factor: 0.0,
    };
    let mut below = held(lo.checked_sub(1).map(|i| &r[i]));
    let mut above = held(r.get(hi + 1));
    let middle = lo + stretch.len() / 2;
    let pairs = hi - middle;
    for k in 0..pairs {
        let (i, j) = (lo + k, hi - k);
        let (Some(from_below), Some(from_above)) = (row(i).eliminate(below), row(j).eliminate(above)) else {
            return false;
        };
        (below, above) = (from_below, from_above);
        (r[i], factors[i]) = (below.value, below.factor);
        (r[j], factors[j]) = (above.value, above.factor);
    }
    if lo + pairs < middle {
        let Some(last) = row(middle - 1).eliminate(below) else {
            return false;
        };
        below = last;
        (r[middle - 1], factors[middle - 1]) = (below.value, below.factor);
    }
    let Some(met) = row(middle).between(below, above) else {
        return false;
    };
    r[middle] = met;
    let (mut right, mut left) = (met, met);
    for k in 1..=pairs {
        let (i, j) = (middle - k, middle + k);
        left = r[i] + factors[i] * left;
        right = r[j] + factors[j] * right;
        (r[i], r[j]) = (left, right);
    }
    if lo + pairs < middle {
        r[lo] += factors[lo] * left;
    }
    true
}

/// One row: diagonal · r_i − off · (r_{i−1} + r_{i+1}) = right.
struct Row {
    diagonal: f64,
    off: f64,
    right: f64,
}

/// A row without one of its neighbours: r_i = value + factor · r of the other one.
#[derive(Clone, Copy)]
struct Eliminated {
    value: f64,
    factor: f64,
}

#[allow(clippy::inline_always, reason = "a call a row costs a tenth of the time")]
impl Row {
    #[inline(always)]
    fn new(chain: &Chain, load: &Load<'_>, contact: Contact, per_stiffness: f64, i: usize) -> Self {
        match contact {
            Contact::Stuck => {
                let soft = chain.softness[i];
                Self {
                    diagonal: 1.0 + soft * chain.diagonal[i],
                    off: soft,
                    right: load.anchor[i] + soft * per_stiffness * load.support[i],
                }
            }
            slipping => Self {
                diagonal: chain.diagonal[i],
                off: 1.0,
                right: per_stiffness
                    * (chain.tributary[i] * chain.bound(slipping, load.adhesion[i]) + load.support[i]),
            },
        }
    }

    /// Puts the eliminated neighbour in; none where nothing is left to hold the node.
    #[inline(always)]
    fn eliminate(&self, neighbour: Eliminated) -> Option<Eliminated> {
        let inverse = self.inverse(neighbour.factor)?;
        Some(Eliminated {
            value: (self.right + self.off * neighbour.value) * inverse,
            factor: self.off * inverse,
        })
    }

    /// The answer where both neighbours are eliminated.
    fn between(&self, below: Eliminated, above: Eliminated) -> Option<f64> {
        let inverse = self.inverse(below.factor + above.factor)?;
        Some((self.right + self.off * (below.value + above.value)) * inverse)
    }

    /// 1/pivot. Rows add up to the supports' share alone: without any, and all slipping, nothing holds the stretch.
    #[inline(always)]
    fn inverse(&self, factor: f64) -> Option<f64> {
        let pivot = self.diagonal - self.off * factor;
        (pivot > 1e-14 * self.diagonal).then(|| 1.0 / pivot)
    }
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
