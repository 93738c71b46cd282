//! What was measured, as the scene understands it: at which end, or where along the duct.

use cable_dem::{End, PassOutcome};

use crate::readings::{Measured, Place, Reading, Readings};
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

/// The force on each end of `scene` that readings are of: the load cells of `readings`, in the
/// order of the file.
///
/// # Errors
///
/// [`Error`] where a reading is of an end that the scene does not hold, or of no place in the duct.
pub fn force_ends(scene: &Scene, readings: &Readings) -> Result<Vec<Option<CableEnd>>, Error> {
    let end = |reading: &Reading| match Observed::of(scene, reading.measured)? {
        Observed::Force(end) => Ok(Some(end)),
        _ => Ok(None),
    };
    readings.readings().iter().map(end).collect()
}

/// What a reading is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Observed {
    /// Force on an end.
    Force(CableEnd),
    /// Movement of an end.
    Movement(CableEnd),
    /// Force in the cable at x \[m\].
    ForceAt(f64),
    /// Strain of the cable at x \[m\].
    StrainAt(f64),
    /// Deflection of the duct.
    Deflection,
}

impl Observed {
    pub fn of(scene: &Scene, measured: Measured) -> Result<Self, Error> {
        let length = scene.duct.length;
        let x = |end: CableEnd| end.of([0.0, length]);
        let inside = |place: f64| {
            if (0.0..=length).contains(&place) {
                return Ok(place);
            }
            let reason = format!("it was taken at {place} m of {length} m");
            Err(Error::unfit("duct.length", "a reading outside the duct", reason))
        };
        match measured {
            Measured::Force(Place::Natural) => held_end(scene).map(Self::Force),
            Measured::Force(Place::End(end)) if end.held_in(scene) == End::Free => {
                let reason = "readings of a load cell at this end: it was held";
                let key = end.of(["ends.upstream", "ends.downstream"]);
                Err(Error::unfit(key, "free", reason))
            }
            Measured::Force(Place::End(end)) => Ok(Self::Force(end)),
            Measured::Force(Place::At(place)) => inside(place).map(Self::ForceAt),
            Measured::Movement(Place::Natural) => {
                let reason = "an end that moved is free or on a spring";
                let end = end_but(scene, End::Fixed).map(Self::Movement);
                end.ok_or_else(|| Error::unfit("ends", "both fixed", reason))
            }
            Measured::Movement(Place::End(end)) => Ok(Self::Movement(end)),
            Measured::Movement(Place::At(place)) => {
                let reason = "movements are those of an end";
                let end = CableEnd::ALL.into_iter().find(|end| x(*end) == place);
                let between = || Error::unfit("data", "a movement between the ends", reason);
                end.map(Self::Movement).ok_or_else(between)
            }
            Measured::Strain(Place::Natural) => Ok(Self::StrainAt(x(held_end(scene)?))),
            Measured::Strain(Place::End(end)) => Ok(Self::StrainAt(x(end))),
            Measured::Strain(Place::At(place)) => inside(place).map(Self::StrainAt),
            Measured::Deflection => Ok(Self::Deflection),
        }
    }

    /// Whether it is a force, as a load cell reads it.
    pub fn is_force(self) -> bool {
        matches!(self, Self::Force(_) | Self::ForceAt(_))
    }

    /// Whether it takes the force along the cable.
    pub fn is_inside(self) -> bool {
        matches!(self, Self::ForceAt(_) | Self::StrainAt(_))
    }

    /// Where, in words.
    pub fn place(self) -> String {
        match self {
            Self::Force(end) | Self::Movement(end) => end.name().into(),
            Self::ForceAt(place) | Self::StrainAt(place) => format!("{place} m"),
            Self::Deflection => "first vehicle".into(),
        }
    }

    /// Its value after a pass with this outcome, `stage` of which is known where it is looked at.
    pub fn value(self, scene: &Scene, outcome: &PassOutcome, stage: Option<&Stage>, deflection: f64) -> f64 {
        let force = |place| stage.map_or(f64::NAN, |stage| force_at(&stage.force_profile, place));
        match self {
            Self::Force(end) => end.of([outcome.force.upstream, outcome.force.downstream]),
            Self::Movement(end) => end.of([outcome.upstream_displacement, outcome.downstream_displacement]),
            Self::ForceAt(place) => force(place),
            Self::StrainAt(place) => force(place) / scene.cable.axial_stiffness,
            Self::Deflection => deflection,
        }
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

/// A reading and what it is compared with.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    /// Index of its series.
    pub series: usize,
    pub reading: &'a Reading,
    pub observed: Observed,
}

/// The instrument of a series that a reading is of.
pub type Instrument = (usize, Observed);

impl Row<'_> {
    pub fn instrument(&self) -> Instrument {
        (self.series, self.observed)
    }
}

/// All instruments, each once.
pub fn instruments(rows: &[Row<'_>]) -> Vec<Instrument> {
    let mut instruments = Vec::new();
    for row in rows {
        if !instruments.contains(&row.instrument()) {
            instruments.push(row.instrument());
        }
    }
    instruments
}
