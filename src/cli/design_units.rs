//! Numbers of a design in the units that were typed.

use crate::design::{Place, Spring};
use crate::{Limited, Units};

/// How the words about a design show numbers.
pub struct Shown {
    units: Units,
}

impl Shown {
    /// In the units that were typed.
    pub fn new(units: Units) -> Self {
        Self {
            units: units.for_springs(),
        }
    }

    pub fn symbol(&self, quantity: Limited) -> &'static str {
        match quantity {
            Limited::Force => self.units.force.symbol(),
            Limited::Movement => self.units.movement.symbol(),
        }
    }

    pub fn stiffness_symbol(&self) -> &'static str {
        self.units.stiffness.symbol()
    }

    /// A force or a movement without its unit.
    pub fn number(&self, quantity: Limited, value: f64) -> String {
        match quantity {
            Limited::Force => self.units.force(value),
            Limited::Movement => self.units.movement(value),
        }
    }

    /// The same with its unit.
    pub fn shown(&self, quantity: Limited, value: f64) -> String {
        quantity.shown_in(&self.units, value)
    }

    /// The same as it was given.
    pub fn given(&self, quantity: Limited, value: f64) -> String {
        quantity.given_in(&self.units, value)
    }

    /// A stiffness without its unit, to four digits.
    pub fn stiffness(&self, spring: &Spring) -> String {
        match (spring.stiffness_n_per_m, spring.place) {
            (None, _) => "fixed".to_owned(),
            (Some(0.0), Place::Clamp(_)) => "no clamp".to_owned(),
            (Some(0.0), _) => "free".to_owned(),
            (Some(value), _) => {
                let value = self.units.stiffness.of_si(value);
                let whole = value.log10().floor();
                if (-3.0..5.0).contains(&whole) {
                    format!("{value:.*}", (3.0 - whole).max(0.0) as usize)
                } else {
                    format!("{value:.3e}")
                }
            }
        }
    }
}
