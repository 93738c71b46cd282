//! What is asked of a design.

use super::error::DesignError;
use super::trade_off::Spring;
use crate::{Limited, Limits, Place, Progress, Scene};

/// How to design.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct DesignOptions<'a> {
    /// Where the spring is.
    pub place: Place,
    /// Where a second one is, if two are wanted at once.
    pub second: Option<Place>,
    /// What they have to stay within.
    pub limits: Limits,
    /// Called after each run of the scene; it may stop the search.
    pub progress: Progress<'a>,
}

impl DesignOptions<'_> {
    /// A spring at `place` that stays within `limits`.
    pub fn new(place: Place, limits: Limits) -> Self {
        Self {
            place,
            second: None,
            limits,
            progress: Progress::default(),
        }
    }

    /// Where springs are.
    pub(super) fn places(&self) -> Vec<Place> {
        std::iter::once(self.place).chain(self.second).collect()
    }

    /// Refuses places and limits that have no meaning, and no limits at all.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), DesignError> {
        let places = self.places();
        for place in &places {
            Spring::new(*place, 0.0).check(scene)?;
        }
        let is_clamped = |position: f64| {
            let own = scene.restraints.iter().map(|clamp| Place::Clamp(clamp.position));
            own.chain(places.iter().copied())
                .any(|place| place.is_clamp_at(position))
        };
        let invalid = |name, found, allowed| Err(DesignError::Invalid { name, found, allowed });
        if self.second == Some(self.place) {
            let allowed = "two different places for two springs";
            return invalid("number of places", 1.0, allowed);
        }
        if self.limits.all().next().is_none() {
            return invalid("number of limits", 0.0, "one or more");
        }
        for (place, quantity, limit) in self.limits.all() {
            if !(limit > 0.0 && limit.is_finite()) {
                let name = match quantity {
                    Limited::Force => "limit of force",
                    Limited::Movement => "limit of movement",
                };
                return invalid(name, limit, "a finite number greater than 0");
            }
            if let Place::Clamp(position) = place
                && !is_clamped(position)
            {
                let allowed = "that of a clamp of the scene or of the design";
                return invalid("position of a limited clamp", position, allowed);
            }
        }
        Ok(())
    }
}
