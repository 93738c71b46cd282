//! What is asked of a design, and what can be wrong with that.

use super::options::DesignOptions;
use super::trade_off::Spring;
use crate::scene::{End, Restraint};
use crate::{Error, Limited, Place, Scene};

/// Error of a design.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DesignError {
    /// A run of the scene failed.
    #[error(transparent)]
    Analysis(#[from] Error),
    /// A limit or a position that has no meaning.
    #[error("{name}: found {found}; allowed: {allowed}")]
    Invalid {
        /// What it is.
        name: &'static str,
        /// Its value.
        found: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A limit is crossed more than once as the stiffness grows.
    #[error(
        "the {what} crosses its limit {crossings} times as the stiffness grows: there is no single range of stiffness"
    )]
    NotMonotone {
        /// What is limited.
        what: String,
        /// How often.
        crossings: usize,
    },
}

impl DesignError {
    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Analysis(error) => error.is_bad_input(),
            error => matches!(error, Self::Invalid { .. }),
        }
    }
}

/// Refuses places and limits that have no meaning, and no limits at all.
pub(super) fn check(scene: &Scene, options: &DesignOptions<'_>) -> Result<(), DesignError> {
    let places = options.places();
    for place in &places {
        check_place(*place, scene)?;
    }
    if options.second == Some(options.place) {
        return Err(DesignError::Invalid {
            name: "number of places",
            found: 1.0,
            allowed: "two different places for two springs",
        });
    }
    let mut none = true;
    for (place, quantity, limit) in options.limits.all() {
        none = false;
        positive(
            match quantity {
                Limited::Force => "limit of force",
                Limited::Movement => "limit of movement",
            },
            limit,
        )?;
        let Place::Clamp(position) = place else {
            continue;
        };
        let mut clamps = scene.restraints.iter();
        let is_there = clamps.any(|clamp| place.is_clamp_at(clamp.position))
            || places.iter().any(|place| place.is_clamp_at(position));
        if !is_there {
            return Err(DesignError::Invalid {
                name: "position of a limited clamp",
                found: position,
                allowed: "that of a clamp of the scene or of the design",
            });
        }
    }
    if none {
        return Err(DesignError::Invalid {
            name: "number of limits",
            found: 0.0,
            allowed: "one or more",
        });
    }
    Ok(())
}

/// The scene with these springs.
pub(super) fn held(scene: &Scene, springs: &[Spring]) -> Scene {
    let mut scene = scene.clone();
    for spring in springs {
        hold(spring.place, &mut scene, spring.stiffness());
    }
    scene
}

fn positive(name: &'static str, found: f64) -> Result<(), DesignError> {
    if found > 0.0 && found.is_finite() {
        return Ok(());
    }
    Err(DesignError::Invalid {
        name,
        found,
        allowed: "a finite number greater than 0",
    })
}

pub(super) fn check_place(place: Place, scene: &Scene) -> Result<(), DesignError> {
    match place {
        Place::Clamp(position) if !(0.0..=scene.duct.length).contains(&position) => {
            Err(DesignError::Invalid {
                name: "position of the clamp",
                found: position,
                allowed: "a position in the duct, from 0 m to its length",
            })
        }
        _ => Ok(()),
    }
}

/// Puts a spring of this stiffness \[N/m\] at `place`: none at 0, and a fixed end at infinity.
fn hold(place: Place, scene: &mut Scene, stiffness: f64) {
    let end = match stiffness {
        0.0 => End::Free,
        f64::INFINITY => End::Fixed,
        _ => End::Spring(stiffness),
    };
    match place {
        Place::Upstream => scene.ends.upstream = end,
        Place::Downstream => scene.ends.downstream = end,
        Place::Clamp(_) if stiffness == 0.0 => {}
        Place::Clamp(position) => scene.restraints.push(Restraint::new(position, stiffness)),
    }
}
