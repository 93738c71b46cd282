//! Several ways to hold a cable beside each other, each by a run of the scene.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::limits::{DesignError, check_place};
use super::runs::OneMesh;
use super::trade_off::{Spring, TradeOff};
use crate::ground::{Ground, road};
use crate::{Error, Limits, Place, Progress, Scene};

/// One way to hold the cable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// Where the spring is.
    pub place: Place,
    /// Its stiffness \[N/m\]: 0 is a free end or no clamp, infinity a fixed end.
    pub stiffness: f64,
}

/// Runs `scene` once with each of `measures`, all on one mesh, on all cores. A run that fails is an error in its own
/// place; `progress` is called after each run.
///
/// # Errors
///
/// [`DesignError`] where the run that chooses the mesh fails, or `progress` stops the runs.
pub fn compare(
    scene: &Scene,
    measures: &[Measure],
    progress: Progress<'_>,
) -> Result<Vec<Result<TradeOff, DesignError>>, DesignError> {
    scene.validate().map_err(Error::from)?;
    compare_over(
        scene,
        &Arc::new(Ground::new(scene, None, road::reach(scene))?),
        measures,
        progress,
    )
}

/// The same over a `ground` that is known to be that of a valid `scene`.
pub(crate) fn compare_over(
    scene: &Scene,
    ground: &Arc<Ground>,
    measures: &[Measure],
    progress: Progress<'_>,
) -> Result<Vec<Result<TradeOff, DesignError>>, DesignError> {
    let mut places = measures.iter().map(|measure| measure.place);
    let end = places.find(|place| !matches!(place, Place::Clamp(_)));
    let mesh = OneMesh::new(scene, ground, end.as_slice(), progress)?;
    let done = AtomicUsize::new(0);
    let answer = |measure: &Measure| {
        measure.check(scene)?;
        let springs = [Spring::new(measure.place, measure.stiffness)];
        Ok(mesh.run(&springs, &Limits::default(), false)?)
    };
    measures
        .par_iter()
        .map(|measure| {
            let answer = answer(measure);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.report(done as f64 / measures.len() as f64)?;
            Ok(answer)
        })
        .collect()
}

impl Measure {
    fn check(&self, scene: &Scene) -> Result<(), DesignError> {
        check_place(self.place, scene)?;
        let rigid_clamp = matches!(self.place, Place::Clamp(_)) && self.stiffness.is_infinite();
        if self.stiffness >= 0.0 && !rigid_clamp {
            return Ok(());
        }
        Err(DesignError::Invalid {
            name: "stiffness",
            found: self.stiffness,
            allowed: "at least 0, and finite for a clamp",
        })
    }
}
