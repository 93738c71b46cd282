//! A point of the curve of force against movement.

use serde::Serialize;

use super::search::shares;
use super::{Limits, Place};
use crate::{PassRecord, Run};

/// A scene's answer with one stiffness.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    /// Whether it keeps both limits.
    pub within_limits: bool,
}

impl TradeOff {
    /// What `run` says of a spring of this stiffness at `place`.
    pub(super) fn of(run: &Run, place: Place, stiffness_n_per_m: Option<f64>, limits: Limits) -> Self {
        let largest = |values: fn(&PassRecord) -> [f64; 4]| {
            run.passes
                .iter()
                .flat_map(values)
                .fold(0.0, |largest: f64, value| largest.max(value.abs()))
        };
        let clamped = matches!(place, Place::Clamp(_)) && stiffness_n_per_m != Some(0.0);
        let mut point = Self {
            stiffness_n_per_m,
            force_n: largest(|pass| {
                let (upstream, downstream) = (pass.upstream_peak_n, pass.downstream_peak_n);
                [
                    pass.upstream_force_n,
                    pass.downstream_force_n,
                    upstream,
                    downstream,
                ]
            }),
            movement_m: largest(|pass| {
                let (upstream, downstream) = (pass.upstream_displacement_m, pass.downstream_displacement_m);
                [upstream, downstream, 0.0, 0.0]
            }),
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
