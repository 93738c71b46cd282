//! What a design answers: force against movement.

use serde::{Deserialize, Serialize};

use super::limits::{Limits, Place};
use crate::{CableEnd, DayExtremes, PassRecord, Run};

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
    /// Force on the clamp after the last pass \[N\], where there is one.
    pub clamp_force_n: Option<f64>,
    /// Estimated relative error of the forces.
    pub error_estimate: f64,
    /// Whether it is within both limits.
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
    /// The stiffnesses within both limits \[N/m\], from and to; no upper one where a fixed end is within them too. `None` where no
    /// stiffness is.
    pub range_n_per_m: Option<(f64, Option<f64>)>,
    /// What to take: within the range, with margins to both limits. `None` where no stiffness stays within them.
    pub answer: Option<TradeOff>,
    /// Everything that was computed, by growing stiffness, from a free end or no clamp on.
    pub curve: Vec<TradeOff>,
}

impl TradeOff {
    /// What `run` gives for a spring of this stiffness at `place`.
    pub(super) fn of(run: &Run, place: Place, stiffness_n_per_m: Option<f64>, limits: Limits) -> Self {
        let largest = |values: &[fn(&PassRecord) -> f64]| {
            let passes = run.passes.iter();
            let all = passes.flat_map(|pass| values.iter().map(move |value| value(pass)));
            all.fold(0.0, |largest: f64, value| largest.max(value.abs()))
        };
        // Heat is hardest between passes.
        let heated = |of: fn(&DayExtremes, CableEnd) -> f64| {
            let days = run.heat.iter().map(|heat| &heat.all_days);
            days.flat_map(|days| CableEnd::ALL.map(|end| of(days, end)))
                .fold(0.0, f64::max)
        };
        let clamped = matches!(place, Place::Clamp(_)) && stiffness_n_per_m != Some(0.0);
        let clamp = run.restraints.last().filter(|_| clamped);
        let mut point = Self {
            stiffness_n_per_m,
            force_n: largest(&[
                |pass| pass.upstream_force_n,
                |pass| pass.downstream_force_n,
                |pass| pass.upstream_peak_n,
                |pass| pass.downstream_peak_n,
            ])
            .max(heated(DayExtremes::largest_force)),
            movement_m: largest(&[
                |pass| pass.upstream_displacement_m,
                |pass| pass.downstream_displacement_m,
            ])
            .max(heated(DayExtremes::movement)),
            clamp_force_n: clamp.map(|clamp| clamp.force_n),
            error_estimate: run.error_estimate.relative,
            within_limits: true,
        };
        point.within_limits = limited(limits).iter().all(|limit| limit.share(&point) <= 1.0);
        point
    }
}

/// A limited quantity of a point: its name, what it is there, and the most that is allowed.
pub(super) struct Limit(pub &'static str, fn(&TradeOff) -> f64, f64);

impl Limit {
    /// What of a point it is beside its limit, at most 1 within the limit.
    pub fn share(&self, point: &TradeOff) -> f64 {
        self.1(point) / self.2
    }
}

pub(super) fn limited(limits: Limits) -> Vec<Limit> {
    let force = Limit("force", |point| point.force_n, limits.force_n);
    let movement = |limit| Limit("movement", |point| point.movement_m, limit);
    std::iter::once(force)
        .chain(limits.movement_m.map(movement))
        .collect()
}
