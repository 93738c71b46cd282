//! What a design answers: force against movement.

use serde::{Deserialize, Serialize};

use super::limits::Place;
use crate::{CableEnd, DayExtremes, Limited, Limits, PassRecord, Run};

/// A scene's answer with one stiffness.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TradeOff {
    /// Stiffness \[N/m\]; `None` where the end is fixed.
    pub stiffness_n_per_m: Option<f64>,
    /// Largest force on either end \[N\].
    pub force_n: f64,
    /// Largest displacement of either end \[m\].
    pub movement_m: f64,
    /// Largest force on the upstream end \[N\].
    pub upstream_force_n: f64,
    /// Largest force on the downstream end \[N\].
    pub downstream_force_n: f64,
    /// Largest displacement of the upstream end \[m\].
    pub upstream_movement_m: f64,
    /// Largest displacement of the downstream end \[m\].
    pub downstream_movement_m: f64,
    /// Force on the clamp after the last pass \[N\], where there is one.
    pub clamp_force_n: Option<f64>,
    /// Estimated relative error of the forces.
    pub error_estimate: f64,
    /// Whether it is within all limits.
    pub within_limits: bool,
}

/// What holds the cable best.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Design {
    /// The scene's title.
    pub title: String,
    /// What was varied.
    pub place: Place,
    /// Number of passes.
    pub passes: u64,
    /// The limits.
    pub limits: Limits,
    /// The stiffnesses within all limits \[N/m\], from and to; no upper one where a fixed end is within them too. `None` where only a fixed end or no
    /// stiffness is.
    pub range_n_per_m: Option<(f64, Option<f64>)>,
    /// What to take: within the range, with margins to the limits. `None` where no stiffness stays within them.
    pub answer: Option<TradeOff>,
    /// Where no stiffness stays within the limits, the one that comes nearest to them.
    pub nearest: Option<TradeOff>,
    /// Everything that was computed, by growing stiffness, from a free end or no clamp on.
    pub curve: Vec<TradeOff>,
}

impl TradeOff {
    /// What `run` gives for a spring of this stiffness at `place`.
    pub(crate) fn of(run: &Run, place: Place, stiffness_n_per_m: Option<f64>, limits: &Limits) -> Self {
        let largest = |value: fn(CableEnd, &PassRecord) -> f64, end: CableEnd| {
            run.passes.iter().map(|pass| value(end, pass)).fold(0.0, f64::max)
        };
        // Heat is hardest between passes.
        let heated = |of: fn(&DayExtremes, CableEnd) -> f64, end: CableEnd| {
            let days = run.heat.iter().map(|heat| of(&heat.all_days, end));
            days.fold(0.0, f64::max)
        };
        let forces = CableEnd::ALL.map(|end| {
            let heated = heated(DayExtremes::largest_force, end);
            largest(CableEnd::largest_force, end).max(heated)
        });
        let movements = CableEnd::ALL.map(|end| {
            let heated = heated(DayExtremes::movement, end);
            largest(CableEnd::movement, end).max(heated)
        });
        let clamped = matches!(place, Place::Clamp(_)) && stiffness_n_per_m != Some(0.0);
        let clamp = run.restraints.last().filter(|_| clamped);
        let mut point = Self {
            stiffness_n_per_m,
            force_n: forces[0].max(forces[1]),
            movement_m: movements[0].max(movements[1]),
            upstream_force_n: forces[0],
            downstream_force_n: forces[1],
            upstream_movement_m: movements[0],
            downstream_movement_m: movements[1],
            clamp_force_n: clamp.map(|clamp| clamp.force_n),
            error_estimate: run.error_estimate.relative,
            within_limits: true,
        };
        point.within_limits = point.excess(limits) <= 1.0;
        point
    }

    /// The largest of what is limited, as a share of its limit.
    pub(super) fn excess(&self, limits: &Limits) -> f64 {
        let shares = limited(limits).into_iter().map(|limit| limit.share(self));
        shares.fold(0.0, f64::max)
    }

    /// What is limited, as this point has it \[N or m\].
    pub fn value(&self, end: CableEnd, quantity: Limited) -> f64 {
        match (quantity, end) {
            (Limited::Force, CableEnd::Upstream) => self.upstream_force_n,
            (Limited::Force, CableEnd::Downstream) => self.downstream_force_n,
            (Limited::Movement, CableEnd::Upstream) => self.upstream_movement_m,
            (Limited::Movement, CableEnd::Downstream) => self.downstream_movement_m,
        }
    }
}

/// One limit.
pub(super) struct Limit(CableEnd, Limited, f64);

impl Limit {
    /// What of a point it is beside its limit, at most 1 within the limit.
    pub fn share(&self, point: &TradeOff) -> f64 {
        point.value(self.0, self.1) / self.2
    }

    pub fn name(&self) -> String {
        self.1.at(self.0)
    }
}

pub(super) fn limited(limits: &Limits) -> Vec<Limit> {
    let limit = |(end, quantity, limit)| Limit(end, quantity, limit);
    limits.all().map(limit).collect()
}
