//! What is asked of a design, and what can be wrong with it.

use super::trade_off::held;
use creepage_run::{Error, Limits, Place, Progress};
use creepage_scene::Scene;

/// How to design.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct DesignOptions<'a> {
    /// Where springs are: at one place, or at two, both of the same stiffness.
    pub places: Vec<Place>,
    /// What they have to stay within.
    pub limits: Limits,
    /// Called after each run of the scene; it may stop the search.
    pub progress: Progress<'a>,
}

impl DesignOptions<'_> {
    /// A spring at `place` that stays within `limits`.
    pub fn new(place: Place, limits: Limits) -> Self {
        Self {
            places: vec![place],
            limits,
            progress: Progress::default(),
        }
    }

    /// Refuses places and limits that have no meaning, and no limits at all.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), DesignError> {
        let invalid = |name, found, allowed| Err(DesignError::Invalid { name, found, allowed });
        let count = self.places.len();
        if count == 0 || count > 2 || self.places[1..].contains(&self.places[0]) {
            return invalid("number of places", count as f64, "one, or two different places");
        }
        if self.limits.all().next().is_none() {
            return invalid("number of limits", 0.0, "one or more");
        }
        let clamps = held(scene, &self.places, 1.0)?.restraints;
        for (place, quantity, limit) in self.limits.all() {
            if !(limit > 0.0 && limit.is_finite()) {
                let name = quantity.of(["limit of force", "limit of movement"]);
                return invalid(name, limit, "a finite number greater than 0");
            }
            if let Place::Clamp(position) = place
                && !clamps.iter().any(|clamp| place.is_clamp_at(clamp.position))
            {
                let allowed = "that of a clamp of the scene or of the design";
                return invalid("position of a limited clamp", position, allowed);
            }
        }
        Ok(())
    }
}

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
    /// The limits are kept in so many ranges of stiffness, between which they are not.
    #[error(
        "the limits are kept in {0} ranges of stiffness, between which they are not: there is no single one"
    )]
    NotMonotone(usize),
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
