//! What is asked of a design.

use super::error::DesignError;
use super::trade_off::Spring;
use creepage_run::{Limited, Limits, Place, Progress};
use creepage_scene::Scene;

/// How to design.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct DesignOptions<'a> {
    /// Where springs are: at one place, or at two at once.
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
        for place in &self.places {
            Spring::new(*place, 0.0).check(scene)?;
        }
        match self.places[..] {
            [_] => {}
            [one, other] if one != other => {}
            _ => {
                let count = self.places.len() as f64;
                return invalid("number of places", count, "one, or two different places");
            }
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
            if let Place::Clamp(position) = place {
                let own = scene.restraints.iter().map(|clamp| Place::Clamp(clamp.position));
                let mut all = own.chain(self.places.iter().copied());
                if !all.any(|place| place.is_clamp_at(position)) {
                    let allowed = "that of a clamp of the scene or of the design";
                    return invalid("position of a limited clamp", position, allowed);
                }
            }
        }
        Ok(())
    }
}
