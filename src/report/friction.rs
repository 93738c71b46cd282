//! Friction on the cable with the vehicle over the middle of the duct.

use std::sync::Arc;

use crate::ground::Ground;
use crate::run::run_over;
use crate::{FrictionProfile, Run, RunOptions, Scene};

/// Friction in the first and the last pass; of a cable that is heated every day in the first alone, by a run of its own.
#[derive(Debug)]
pub struct Friction {
    /// The passes shown.
    pub passes: Vec<(u64, FrictionProfile)>,
    /// Why there are not more.
    pub remark: Option<String>,
}

impl Friction {
    pub fn new(scene: &Scene, ground: &Arc<Ground>, run: &Run) -> Self {
        let with = |passes, remark| Self { passes, remark };
        if scene.friction_limit() == 0.0 {
            let remark = "There is no friction here, so nothing drags the cable along.";
            return with(Vec::new(), Some(remark.into()));
        }
        let mut passes = shown(run);
        if passes.len() > 2 {
            passes.drain(1..passes.len() - 1);
        }
        if !passes.is_empty() {
            return with(passes, None);
        }
        let mut scene = scene.clone();
        scene.traffic.passes = 1;
        scene.heat = None;
        let options = RunOptions {
            stages: &[1],
            ..RunOptions::default()
        };
        match run_over(&scene, Arc::clone(ground), &options) {
            Ok(first) => with(
                shown(&first),
                Some("Friction is that of the first pass, without heat.".into()),
            ),
            Err(error) => with(
                Vec::new(),
                Some(format!("Friction could not be computed: {error}.")),
            ),
        }
    }
}

/// The passes of which the run shows friction.
fn shown(run: &Run) -> Vec<(u64, FrictionProfile)> {
    let stages = run.stages.iter();
    stages
        .filter_map(|stage| Some((stage.pass, stage.friction.clone()?)))
        .collect()
}

/// ∫ of the positive part of `values` over `places`, by the trapezoidal rule.
pub fn positive_area(places: &[f64], values: impl Iterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.map(|value| value.max(0.0)).collect();
    let widths = places.windows(2).map(|x| x[1] - x[0]);
    let means = values.windows(2).map(|v| 0.5 * (v[0] + v[1]));
    widths.zip(means).map(|(width, mean)| width * mean).sum()
}
