//! What was measured, as the scene understands it: at which end, or where along the duct.

use cable_dem::{End, PassOutcome};

#[cfg(feature = "plot")]
use crate::PassRecord;
use crate::answer::{ForceProfile, Stage};
#[cfg(feature = "plot")]
use crate::readings::Readings;
use crate::readings::{Measured, Place};
use crate::{Error, Scene};

/// An end of the cable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CellEnd {
    Upstream,
    Downstream,
}

impl CellEnd {
    /// The end that is held in `scene`, the downstream one if both are.
    pub fn of(scene: &Scene) -> Result<Self, Error> {
        match (scene.ends.upstream, scene.ends.downstream) {
            (End::Free, End::Free) => Err(Error::Unfit {
                key: "ends",
                found: "both free",
                reason: "a load cell was at an end that is held".into(),
            }),
            (_, End::Free) => Ok(Self::Upstream),
            _ => Ok(Self::Downstream),
        }
    }

    /// The end that moves, the downstream one if both do.
    fn moving(scene: &Scene) -> Result<Self, Error> {
        match (scene.ends.upstream, scene.ends.downstream) {
            (End::Fixed, End::Fixed) => Err(Error::Unfit {
                key: "ends",
                found: "both fixed",
                reason: "an end that moved is free or on a spring".into(),
            }),
            (_, End::Fixed) => Ok(Self::Upstream),
            _ => Ok(Self::Downstream),
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Upstream => "upstream",
            Self::Downstream => "downstream",
        }
    }

    /// The force on it after a pass \[N\].
    #[cfg(feature = "plot")]
    pub fn force(self, record: &PassRecord) -> f64 {
        match self {
            Self::Upstream => record.upstream_force_n,
            Self::Downstream => record.downstream_force_n,
        }
    }
}

/// The force on each end of `scene` that readings are of: the load cells of `readings`, in the order of the file.
#[cfg(feature = "plot")]
pub(crate) fn force_ends(scene: &Scene, readings: &Readings) -> Result<Vec<Option<CellEnd>>, Error> {
    let ends = readings
        .readings()
        .iter()
        .map(|reading| match Observed::of(scene, reading.measured)? {
            Observed::Force(end) => Ok(Some(end)),
            _ => Ok(None),
        });
    ends.collect()
}

/// What a reading is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Observed {
    /// Force on an end.
    Force(CellEnd),
    /// Movement of an end.
    Movement(CellEnd),
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
        let at = |place: f64| {
            (0.0..=length)
                .contains(&place)
                .then_some(place)
                .ok_or(Error::Unfit {
                    key: "duct.length",
                    found: "a reading outside the duct",
                    reason: format!("it was taken at {place} m of {length} m").into(),
                })
        };
        let held = |end: CellEnd| {
            let is_free = match end {
                CellEnd::Upstream => scene.ends.upstream == End::Free,
                CellEnd::Downstream => scene.ends.downstream == End::Free,
            };
            let key = match end {
                CellEnd::Upstream => "ends.upstream",
                CellEnd::Downstream => "ends.downstream",
            };
            let reason = "readings of a load cell at this end: it was held".into();
            let found = "free";
            (!is_free)
                .then_some(Self::Force(end))
                .ok_or(Error::Unfit { key, found, reason })
        };
        match measured {
            Measured::Force(Place::Natural) => Ok(Self::Force(CellEnd::of(scene)?)),
            Measured::Force(Place::Upstream) => held(CellEnd::Upstream),
            Measured::Force(Place::Downstream) => held(CellEnd::Downstream),
            Measured::Force(Place::At(place)) => Ok(Self::ForceAt(at(place)?)),
            Measured::Movement(Place::Natural) => Ok(Self::Movement(CellEnd::moving(scene)?)),
            Measured::Movement(Place::Upstream) => Ok(Self::Movement(CellEnd::Upstream)),
            Measured::Movement(Place::Downstream) => Ok(Self::Movement(CellEnd::Downstream)),
            Measured::Movement(Place::At(place)) => {
                let ends = [(0.0, CellEnd::Upstream), (length, CellEnd::Downstream)];
                let end = ends.into_iter().find(|(x, _)| *x == place);
                end.map(|(_, end)| Self::Movement(end)).ok_or(Error::Unfit {
                    key: "data",
                    found: "a movement between the ends",
                    reason: "movements are those of an end".into(),
                })
            }
            Measured::Strain(Place::At(place)) => Ok(Self::StrainAt(at(place)?)),
            Measured::Strain(Place::Upstream) => Ok(Self::StrainAt(0.0)),
            Measured::Strain(Place::Downstream) => Ok(Self::StrainAt(length)),
            Measured::Strain(Place::Natural) => match CellEnd::of(scene)? {
                CellEnd::Upstream => Ok(Self::StrainAt(0.0)),
                CellEnd::Downstream => Ok(Self::StrainAt(length)),
            },
            Measured::Deflection => Ok(Self::Deflection),
        }
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
            Self::Force(CellEnd::Upstream) => outcome.force.upstream,
            Self::Force(CellEnd::Downstream) => outcome.force.downstream,
            Self::Movement(CellEnd::Upstream) => outcome.upstream_displacement,
            Self::Movement(CellEnd::Downstream) => outcome.downstream_displacement,
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
