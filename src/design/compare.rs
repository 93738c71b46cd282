//! Several ways to hold the cable beside each other, each by a run of the scene.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::error::DesignError;
use super::runs::OneMesh;
use super::trade_off::{Spring, TradeOff};
use crate::ground::{Ground, road};
use crate::{Error, Limits, Progress, Scene};

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
pub(crate) fn compare_over(
    scene: &Scene,
    ground: &Arc<Ground>,
    springs: &[Spring],
    progress: Progress<'_>,
) -> Result<Vec<Result<TradeOff, DesignError>>, DesignError> {
    let mut places = springs.iter().map(|spring| spring.place);
    let end = places.find(|place| place.end().is_some());
    let mesh = OneMesh::new(scene, ground, end.as_slice(), progress)?;
    let done = AtomicUsize::new(0);
    let run = |spring: &Spring| {
        let checked = spring.check(scene);
        let answer = checked.and_then(|()| Ok(mesh.run(&[*spring], &Limits::default(), false)?));
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.report(done as f64 / springs.len() as f64)?;
        Ok(answer)
    };
    springs.par_iter().map(run).collect()
}
