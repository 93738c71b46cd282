//! How far a run is: passes on the present mesh, and the share of the work till it is done.

use super::progress::{HowFar, Now};
use crate::Underway;
use crate::shown::spacing;

/// How far the run `underway` is.
pub fn how_far(underway: &Underway, now: Now) -> HowFar {
    let Some(reached) = underway.reached() else {
        return HowFar::unknown("choosing ground, method and mesh", now.elapsed);
    };
    let finer = if reached.is_refined {
        ", finer than before"
    } else {
        ""
    };
    let words = format!(
        "pass {} of {} on nodes {} m apart{finer}",
        reached.pass,
        reached.passes,
        spacing(reached.node_spacing_m)
    );
    HowFar::new(now, &words)
}
