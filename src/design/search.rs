//! The search for a design.

use std::sync::Arc;

use super::answer::Design;
use super::error::DesignError;
use super::request::DesignOptions;
use super::{one_spring, two_springs};
use crate::ground::{Ground, road};
use crate::{Error, Scene};

/// Finds the stiffnesses within the limits.
///
/// ```
/// use creepage::Scene;
/// use creepage::design::{DesignOptions, Limits, Place, design};
///
/// let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
/// scene.traffic.passes = 2;
/// let limits = Limits::both(Some(100.0), None);
/// let design = design(&scene, &DesignOptions::new(Place::Downstream, limits))?;
/// assert!(design.answer.is_some_and(|answer| answer.force_n <= 100.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// [`DesignError`] where limits or places have no meaning, a run fails, or the limits of one spring
/// are kept in several ranges of stiffness.
pub fn design(scene: &Scene, options: &DesignOptions<'_>) -> Result<Design, DesignError> {
    options.check(scene)?;
    scene.validate().map_err(Error::from)?;
    let ground = Arc::new(Ground::new(scene, None, road::reach(scene))?);
    let (runs, rough_runs, found) = if options.second.is_some() {
        two_springs::search(scene, &ground, options)?
    } else {
        one_spring::search(scene, &ground, options)?
    };
    let limits = &options.limits;
    let curve = runs.points();
    // Between two stiffnesses that keep a limit every other does; the run has the last word.
    let answer = found.chosen.filter(|answer| answer.within_limits);
    let answer = answer.map(|answer| runs.judged(answer)).transpose()?;
    let by_excess = curve
        .iter()
        .min_by(|a, b| a.excess(limits).total_cmp(&b.excess(limits)));
    let nearest = by_excess.filter(|_| answer.is_none()).cloned();
    let nearest = nearest.map(|nearest| runs.judged(nearest)).transpose()?;
    let binding = match (answer.as_ref().or(nearest.as_ref()), found.range) {
        (Some(answer), Some(_)) if nearest.is_none() => found
            .exceeded
            .into_iter()
            .map(|(limit, side)| answer.binding(limit, Some(side)))
            .collect(),
        (Some(found), _) => found.tightest(limits),
        (None, _) => Vec::new(),
    };
    Ok(Design {
        title: scene.title.clone(),
        place: options.place,
        places: options.places(),
        passes: scene.traffic.passes,
        limits: limits.clone(),
        range_n_per_m: found
            .range
            .filter(|(from, _)| from.is_finite())
            .map(|(from, to)| (from, to.is_finite().then_some(to))),
        answer,
        nearest,
        binding,
        // Those of the mesh and of the answer too.
        runs: rough_runs + curve.len() + 2,
        curve,
    })
}
