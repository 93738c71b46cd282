//! What `creepage design` says of clamps.

use std::io::Write;

use crate::design::{Design, Place, TradeOff};
use crate::{Limited, Units};

/// What each clamp comes to, whether it is limited or not.
pub fn clamps(out: &mut impl Write, design: &Design, units: &Units) -> std::io::Result<()> {
    let clamps = design.found().map_or(&[][..], |found| &found.clamps);
    for clamp in clamps {
        let force = Limited::Force.shown_in(units, clamp.force_n);
        let movement = Limited::Movement.shown_in(units, clamp.movement_m);
        let place = Place::Clamp(clamp.position_m);
        let slipped = clamp.slipped_m.filter(|slipped| *slipped != 0.0);
        let slipped = slipped.map(|slipped| {
            format!(
                ", and it has slipped by {}",
                Limited::Movement.shown_in(units, slipped)
            )
        });
        let slipped = slipped.unwrap_or_default();
        writeln!(
            out,
            "{place}: force at most {force}, movement at most {movement}{slipped}"
        )?;
    }
    if !clamps.is_empty() && design.limits.clamps.is_empty() {
        writeln!(
            out,
            "clamps are not limited; --limit-force clamp=FORCE limits their force, --limit-movement clamp=LENGTH their movement"
        )?;
    }
    Ok(())
}

/// Force and movement of the clamps that were designed, if there are any.
pub fn on_clamp(design: &Design, found: &TradeOff, units: &Units) -> String {
    let shown = |place: &Place, quantity: Limited| quantity.shown_in(units, found.value(*place, quantity));
    let designed = design.places.iter().filter(|place| has(found, **place));
    let of_one = |place| {
        format!(
            "{}, {}",
            shown(place, Limited::Force),
            shown(place, Limited::Movement)
        )
    };
    let all: Vec<String> = designed.map(of_one).collect();
    if all.is_empty() {
        "–".to_owned()
    } else {
        all.join(" and ")
    }
}

/// Whether there is a clamp at `place`.
pub fn has(point: &TradeOff, place: Place) -> bool {
    point
        .clamps
        .iter()
        .any(|clamp| place.is_clamp_at(clamp.position_m))
}
