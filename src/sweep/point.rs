//! The answer of one point.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::{Error, Limits, Run, Scene, Verdict};

/// What one point of a sweep answers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Answer {
    /// Force on the downstream end after the last pass \[N\].
    pub downstream_force_n: f64,
    /// Force on the upstream end after the last pass \[N\].
    pub upstream_force_n: f64,
    /// Largest compression along the cable after the last pass \[N\].
    pub max_compression_n: f64,
    /// Where the force levels off \[N\], if it does.
    pub saturation_force_n: Option<f64>,
    /// Passes to 95 % of that.
    pub passes_to_95_percent: Option<u64>,
    /// Displacement of the upstream end after the last pass \[m\].
    pub upstream_displacement_m: f64,
    /// Displacement of the downstream end after the last pass \[m\].
    pub downstream_displacement_m: f64,
    /// Estimated relative error of the forces.
    pub error_estimate: f64,
    /// Whether any limit is exceeded, if there are limits.
    #[serde(default)]
    pub limit_exceeded: Option<bool>,
    /// When the first of them is \[years\], if the vehicles a day are known.
    #[serde(default)]
    pub limit_reached_after_years: Option<f64>,
    /// What heat adds, over all days.
    #[serde(flatten, default)]
    pub heat: Option<HeatAnswer>,
}

/// What a cable that is heated every day shows over all days.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeatAnswer {
    /// Largest force on the downstream end \[N\].
    pub downstream_max_n: f64,
    /// Least force on the downstream end \[N\].
    pub downstream_min_n: f64,
    /// Largest force on the upstream end \[N\].
    pub upstream_max_n: f64,
    /// Least force on the upstream end \[N\].
    pub upstream_min_n: f64,
    /// Movement of the cable from day to day in the end \[m\], where days repeat but for that.
    pub drift_per_day_m: Option<f64>,
}

/// The limits of every point, which may name clamps that not every point has.
#[derive(Clone)]
pub struct PointLimits {
    /// What distinguishes them from others.
    name: String,
    of: Arc<Resolve>,
}

/// The limits of a scene, or why it has none.
type Resolve = dyn Fn(&Scene) -> Result<Limits, String> + Send + Sync;

impl PointLimits {
    /// Limits by a `name`, under which a sweep is resumed, and what they are in a scene.
    pub fn new(
        name: impl Into<String>,
        of: impl Fn(&Scene) -> Result<Limits, String> + Send + Sync + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            of: Arc::new(of),
        }
    }
}

impl std::fmt::Debug for PointLimits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.name)
    }
}

/// A point that is done.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// Number of the point in the grid, from 0.
    pub index: usize,
    /// The answer, or why there is none, in one line.
    pub outcome: Result<Answer, String>,
}

impl Answer {
    /// The last pass of a run; `None` for a run without passes.
    pub fn of(run: &Run) -> Option<Self> {
        let last = run.passes.last()?;
        Some(Self {
            downstream_force_n: last.downstream_force_n,
            upstream_force_n: last.upstream_force_n,
            max_compression_n: last.max_compression_n,
            saturation_force_n: run.saturation.map(|saturation| saturation.force_n),
            passes_to_95_percent: run.saturation.map(|saturation| saturation.passes_to_95_percent),
            upstream_displacement_m: last.upstream_displacement_m,
            downstream_displacement_m: last.downstream_displacement_m,
            error_estimate: run.error_estimate.relative,
            limit_exceeded: None,
            limit_reached_after_years: None,
            heat: run.heat.as_ref().map(|heat| HeatAnswer {
                downstream_max_n: heat.all_days.downstream_max_n,
                downstream_min_n: heat.all_days.downstream_min_n,
                upstream_max_n: heat.all_days.upstream_max_n,
                upstream_min_n: heat.all_days.upstream_min_n,
                drift_per_day_m: heat.drift_per_day_m,
            }),
        })
    }

    /// The same with what the `run` of `scene` makes of the limits.
    pub(super) fn judged(mut self, run: &Run, scene: &Scene, limits: &PointLimits) -> Result<Self, Error> {
        let unfit = |reason: String| Error::unfit("restraints", "a limit of a clamp", reason);
        let verdicts = (limits.of)(scene).map_err(unfit)?.verdicts(run);
        let reached = verdicts.iter().filter_map(|verdict| verdict.reached_after?.years);
        self.limit_exceeded = Some(verdicts.iter().any(Verdict::is_exceeded));
        self.limit_reached_after_years = reached.min_by(f64::total_cmp);
        Ok(self)
    }
}
