//! What to try where no stiffness keeps the limits.

use super::design_words::none;
use crate::design::{Design, Place};
use crate::shown::percent;
use crate::{Limited, Scene, Units};

/// Which limits nothing keeps, by how much the nearest exceeds them, and what to try.
pub fn advice(design: &Design, scene: &Scene, units: &Units) -> String {
    let Some(nearest) = &design.nearest else {
        return String::new();
    };
    let fails = |(place, quantity, limit): (Place, Limited, f64)| {
        let value = nearest.value(place, quantity);
        (value > limit).then(|| {
            format!(
                "the {} exceeds its limit by {} ({})",
                quantity.at(place),
                quantity.shown_in(units, value - limit),
                percent(value / limit - 1.0)
            )
        })
    };
    let fails: Vec<String> = design.limits.all().filter_map(fails).collect();
    let middle = 0.5 * scene.duct.length;
    let is_clamp = |place: &Place| matches!(place, Place::Clamp(_));
    let try_next = match &design.places[..] {
        [place] if is_clamp(place) => format!(
            "a clamp elsewhere (--at more than once compares), a spring with it (--at \"downstream+{middle} m\")"
        ),
        [_] => format!(
            "springs at both ends (--at upstream+downstream), a clamp (--at \"{middle} m\", or with a spring: --at \"downstream+{middle} m\")"
        ),
        _ => "other places (--at), further clamps in the scene".to_owned(),
    };
    format!(
        "{}: at the nearest, which is on standard output, {}; try {try_next}, a larger limit, or less friction or load on the duct",
        none(design),
        fails.join(" and ")
    )
}
