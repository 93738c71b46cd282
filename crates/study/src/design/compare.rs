//! Several ways to hold the cable beside each other, each by a run of the scene.

use std::sync::Arc;

use rayon::prelude::*;

use super::error::DesignError;
use super::runs::Runs;
use super::trade_off::{Spring, TradeOff};
use creepage_plan::ground::{Ground, road};
use creepage_run::{Error, Limits, Progress};
use creepage_scene::Scene;

/// Runs `scene` once with each of `springs`, all on one mesh, on all cores. A run that fails is an
/// error in its own place; `progress` is called after each run.
///
/// # Errors
///
/// [`DesignError`] where the run that chooses the mesh fails, or `progress` stops the runs.
pub fn compare(
    scene: &Scene,
    springs: &[Spring],
    progress: Progress<'_>,
) -> Result<Vec<Result<TradeOff, DesignError>>, DesignError> {
    scene.validate().map_err(Error::from)?;
    let ground = Arc::new(Ground::new(scene, None, road::reach(scene))?);
    compare_over(scene, &ground, springs, progress)
}

/// The same over a `ground` that is known to be that of a valid `scene`.
///
/// # Errors
///
/// As for [`compare()`].
pub fn compare_over(
    scene: &Scene,
    ground: &Arc<Ground>,
    springs: &[Spring],
    progress: Progress<'_>,
) -> Result<Vec<Result<TradeOff, DesignError>>, DesignError> {
    let mut places = springs.iter().map(|spring| spring.place);
    let end = places.find(|place| place.end().is_some());
    let limits = Limits::default();
    let runs = Runs::new(scene, ground, end.as_slice(), &limits, progress, springs.len())?;
    let run = |spring: &Spring| match runs.run(&[*spring]) {
        Err(DesignError::Analysis(Error::Stopped)) => Err(Error::Stopped.into()),
        answer => Ok(answer),
    };
    springs.par_iter().map(run).collect()
}
