//! A point of the curve of force against movement.

use serde::{Deserialize, Serialize};

use super::limits::{Limits, Place};
use crate::{PassRecord, Run};

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

impl TradeOff {
    /// What `run` gives for a spring of this stiffness at `place`.
    pub(super) fn of(run: &Run, place: Place, stiffness_n_per_m: Option<f64>, limits: Limits) -> Self {
        let largest = |values: &[fn(&PassRecord) -> f64]| {
            let all = run
                .passes
                .iter()
                .flat_map(|pass| values.iter().map(move |value| value(pass)));
            all.fold(0.0, |largest: f64, value| largest.max(value.abs()))
        };
        let clamped = matches!(place, Place::Clamp(_)) && stiffness_n_per_m != Some(0.0);
        let mut point = Self {
            stiffness_n_per_m,
            force_n: largest(&[
                |pass| pass.upstream_force_n,
                |pass| pass.downstream_force_n,
                |pass| pass.upstream_peak_n,
                |pass| pass.downstream_peak_n,
            ]),
            movement_m: largest(&[
                |pass| pass.upstream_displacement_m,
                |pass| pass.downstream_displacement_m,
            ]),
            clamp_force_n: run
                .restraints
                .last()
                .filter(|_| clamped)
                .map(|clamp| clamp.force_n),
            error_estimate: run.error_estimate.relative,
            within_limits: true,
        };
        point.within_limits = shares(limits).iter().all(|(_, share)| share(&point) <= 1.0);
        point
    }
}

/// A limited quantity: its name, and what of a point it is beside its limit, at most 1 within the limit.
pub(super) type Share = (&'static str, Box<dyn Fn(&TradeOff) -> f64 + Sync>);

pub(super) fn shares(limits: Limits) -> Vec<Share> {
    let mut shares: Vec<Share> = vec![("force", Box::new(move |point| point.force_n / limits.force_n))];
    if let Some(limit) = limits.movement_m {
        shares.push(("movement", Box::new(move |point| point.movement_m / limit)));
    }
    shares
}
