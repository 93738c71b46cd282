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
        writeln!(out, "{place}: force at most {force}, movement at most {movement}")?;
    }
    if !clamps.is_empty() && design.limits.clamps.is_empty() {
        writeln!(
            out,
            "clamps are not limited; --limit-force clamp=FORCE limits their force, --limit-movement clamp=LENGTH their movement"
        )?;
    }
    Ok(())
}

/// Force and movement of the clamps that were designed, where they are.
pub fn on_clamp(design: &Design, found: &TradeOff, units: &Units) -> String {
    let both = |place: &Place| {
        let shown = |quantity: Limited| quantity.shown_in(units, found.value(*place, quantity));
        format!("{}, {}", shown(Limited::Force), shown(Limited::Movement))
    };
    let designed = design.places.iter().filter(|place| has(found, **place));
    let all: Vec<String> = designed.map(both).collect();
    if all.is_empty() {
        "–".to_owned()
    } else {
        all.join(" and ")
    }
}

/// Whether there is a clamp at `place`.
pub fn has(point: &TradeOff, place: Place) -> bool {
    let mut clamps = point.clamps.iter();
    clamps.any(|clamp| place.is_clamp_at(clamp.position_m))
}
