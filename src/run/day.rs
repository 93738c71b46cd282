//! A day of a plan: how many vehicles, in which periods, how warm the cable.

use cycle_jump::days::{DailyHeat, Day};

use crate::plan::Plan;
use crate::scene::{Heat, Scene, Warming};

/// Up to so many passes a day all are simulated on a day with real ones.
const FEW: u64 = 100;
const SECONDS_A_DAY: f64 = 86_400.0;

/// A day of `plan` with `knots` real periods, or with all.
pub fn of(plan: &Plan<'_>, heat: &Heat, knots: u64, every_pass: bool) -> Day {
    let scene = plan.scene;
    let passes = passes(scene);
    let per_kelvin = scene.cable.axial_stiffness * heat.expansion;
    let force = |kelvin: f64| per_kelvin * (heat.offset + kelvin);
    let few = passes <= FEW || every_pass;
    Day {
        passes,
        period: if few { 1 } else { plan.period.len() },
        heat: match &heat.warming {
            Warming::Swing(swing) => DailyHeat::Cosine {
                lowest: force(0.0),
                highest: force(*swing),
            },
            Warming::Profile(points) => DailyHeat::Profile(
                points
                    .iter()
                    .map(|(seconds, kelvin)| (seconds / SECONDS_A_DAY, force(*kelvin)))
                    .collect(),
            ),
        },
        knots: if few { passes } else { knots },
    }
}

/// A warning where a day is no whole number of the traffic's periods: days that follow from each other all begin with the same vehicle.
pub fn broken_sequence(plan: &Plan<'_>) -> Option<String> {
    let (passes, period) = (passes(plan.scene), plan.period.len() as u64);
    let whole = passes / period * period;
    let is_broken = whole < passes && !plan.period.reordered && plan.scene.traffic.passes > passes;
    is_broken.then(|| {
        format!(
            "{passes} vehicles a day are no whole number of times the {period} of the sequence: each day is computed as if it began \
             the sequence anew, and around midnight forces may be others than with the sequence unbroken; a `traffic.per_day` of {} \
             has none of that",
            if whole == 0 { period } else { whole }
        )
    })
}

/// Whole passes of a day.
fn passes(scene: &Scene) -> u64 {
    scene
        .traffic
        .per_day
        .map_or(1, |per_day| per_day.round().max(1.0) as u64)
}
