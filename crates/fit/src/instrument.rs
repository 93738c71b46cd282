//! What was measured, as the scene understands it: at which end, or where along the duct.

use cable_dem::{End, PassOutcome};

use crate::readings::{Instrument, Measured, Place, Reading};
use creepage_run::Error;
use creepage_run::answer::{ForceProfile, Stage};
use creepage_scene::{CableEnd, Scene};

/// The end that is held in `scene`, the downstream one if both are.
///
/// # Errors
///
/// [`Error`] if none is held.
pub fn held_end(scene: &Scene) -> Result<CableEnd, Error> {
    let reason = "a load cell was at an end that is held";
    end_but(scene, End::Free).ok_or_else(|| Error::unfit("ends", "both free", reason))
}

/// The end that is held in another way than `held`, the downstream one if both are.
fn end_but(scene: &Scene, held: End) -> Option<CableEnd> {
    let mut ends = [CableEnd::Downstream, CableEnd::Upstream].into_iter();
    ends.find(|end| end.held_in(scene) != held)
}

/// What was measured, and where in `scene`: forces and movements at an end, forces and strains at a
/// distance from the upstream one.
///
/// # Errors
///
/// [`Error`] if the scene does not hold that end, or has no such place.
pub fn located(scene: &Scene, measured: Measured) -> Result<Measured, Error> {
    let length = scene.duct.length;
    let x = |end: CableEnd| end.of([0.0, length]);
    let inside = |x: f64| {
        if (0.0..=length).contains(&x) {
            return Ok(Place::At(x));
        }
        let reason = format!("it was taken at {x} m of {length} m");
        Err(Error::unfit("duct.length", "a reading outside the duct", reason))
    };
    let located = match measured {
        Measured::Force(Place::Natural) => Measured::Force(Place::End(held_end(scene)?)),
        Measured::Force(Place::End(end)) if end.held_in(scene) == End::Free => {
            let key = end.of(["ends.upstream", "ends.downstream"]);
            let reason = "readings of a load cell at this end: it was held";
            return Err(Error::unfit(key, "free", reason));
        }
        Measured::Force(Place::At(x)) => Measured::Force(inside(x)?),
        Measured::Movement(Place::Natural) => {
            let reason = "an end that moved is free or on a spring";
            let fixed = || Error::unfit("ends", "both fixed", reason);
            Measured::Movement(Place::End(end_but(scene, End::Fixed).ok_or_else(fixed)?))
        }
        Measured::Movement(Place::At(place)) => {
            let (found, reason) = ("a movement between the ends", "movements are those of an end");
            let end = CableEnd::ALL.into_iter().find(|end| x(*end) == place);
            Measured::Movement(Place::End(
                end.ok_or_else(|| Error::unfit("data", found, reason))?,
            ))
        }
        Measured::Strain(Place::Natural) => Measured::Strain(Place::At(x(held_end(scene)?))),
        Measured::Strain(Place::End(end)) => Measured::Strain(Place::At(x(end))),
        Measured::Strain(Place::At(x)) => Measured::Strain(inside(x)?),
        Measured::Force(_) | Measured::Movement(_) | Measured::Deflection => measured,
    };
    Ok(located)
}

/// What an instrument shows after a pass with this outcome; `stage` is known where the force along
/// the cable is looked at.
pub fn shown(
    measured: Measured,
    scene: &Scene,
    outcome: &PassOutcome,
    stage: Option<&Stage>,
    deflection: f64,
) -> f64 {
    let force = |place| stage.map_or(f64::NAN, |stage| force_at(&stage.force_profile, place));
    match measured {
        Measured::Force(Place::End(end)) => end.of([outcome.force.upstream, outcome.force.downstream]),
        Measured::Force(Place::At(x)) => force(x),
        Measured::Movement(Place::End(end)) => {
            end.of([outcome.upstream_displacement, outcome.downstream_displacement])
        }
        Measured::Strain(Place::At(x)) => force(x) / scene.cable.axial_stiffness,
        Measured::Deflection => deflection,
        // Places that are not located yet.
        Measured::Force(_) | Measured::Movement(_) | Measured::Strain(_) => f64::NAN,
    }
}

/// Force at `place`, along straight lines between the middles of elements.
fn force_at(profile: &ForceProfile, place: f64) -> f64 {
    let (places, forces) = (&profile.positions_m, &profile.force_n);
    let next = places.partition_point(|other| *other < place);
    match (next.checked_sub(1), places.get(next)) {
        (Some(before), Some(&after)) => {
            let share = (place - places[before]) / (after - places[before]);
            forces[before] + share * (forces[next] - forces[before])
        }
        (None, _) => forces.first().copied().unwrap_or(f64::NAN),
        (Some(last), None) => forces[last],
    }
}

/// All instruments, in the order of the readings.
pub fn instruments(rows: &[Reading]) -> Vec<Instrument> {
    each_once(rows.iter().map(Reading::instrument))
}

/// Items without those that came before.
pub fn each_once<T: PartialEq>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut once = Vec::new();
    for item in items {
        if !once.contains(&item) {
            once.push(item);
        }
    }
    once
}
