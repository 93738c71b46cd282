//! `[cable]` and `[friction]`: from their keys to the cable and its friction, and back.

use cable_dem::FrictionLaw;

use crate::data::{Arrangement, Cable, Duct, Friction};
use crate::error::Wrong;
use crate::keys::{CableKeys, FrictionKeys, Law};
use crate::range::{
    AXIAL_STIFFNESS, CONDUCTOR_AREA, CONDUCTOR_MODULUS, DIAMETER, INNER_DIAMETER, Quantity, SHAPE_FACTOR,
    shown,
};

impl CableKeys {
    /// The cable with these keys in `duct`; its normal load factor is given, or as its arrangement and both diameters make it.
    pub fn cable(&self, duct: &Duct) -> Result<Cable, Box<Wrong>> {
        let (arrangement, mut diameter) = (self.arrangement, self.diameter);
        let normal_load_factor = match (self.normal_load_factor, diameter, duct.inner_diameter) {
            (Some(factor), ..) => {
                diameter = None;
                factor
            }
            (None, Some(diameter), Some(inner)) => arrangement.normal_load_factor(inner, diameter),
            _ if !arrangement.is_of_three() => 1.0,
            (None, _, None) => return Err(Wrong::missing("duct.inner_diameter", INNER_DIAMETER.allowed())),
            _ => return Err(Wrong::missing("cable.diameter", DIAMETER.allowed())),
        };
        let (weight, axial_stiffness) = (self.weight, self.axial_stiffness()?);
        Ok(Cable {
            weight,
            axial_stiffness,
            normal_load_factor,
            diameter,
            arrangement,
        })
    }

    /// EA \[N\], given or as a modulus times an area.
    fn axial_stiffness(&self) -> Result<f64, Box<Wrong>> {
        let missing =
            |key: &str, quantity: Quantity| Wrong::missing(format!("cable.{key}"), quantity.allowed());
        let (modulus, area) = match (self.axial_stiffness, self.young_modulus, self.conductor_area) {
            (Some(stiffness), ..) => return Ok(stiffness),
            (None, Some(modulus), Some(area)) => (modulus, area),
            (None, Some(_), None) => return Err(missing("conductor_area", CONDUCTOR_AREA)),
            (None, None, Some(_)) => return Err(missing("young_modulus", CONDUCTOR_MODULUS)),
            (None, None, None) => return Err(missing("axial_stiffness", AXIAL_STIFFNESS)),
        };
        let stiffness = modulus * area;
        if AXIAL_STIFFNESS.contains(stiffness) {
            return Ok(stiffness);
        }
        let [modulus, area, force] = [modulus, area, stiffness].map(shown);
        let found = format!("{modulus} Pa times {area} m2, {force} N");
        let allowed = format!("a product {}", AXIAL_STIFFNESS.words);
        Err(Wrong::value("cable.young_modulus", found, allowed))
    }

    /// The keys of a cable.
    pub fn of(cable: &Cable) -> Self {
        // Of several cables the factor follows from what is known of them.
        let given = cable.arrangement == Arrangement::Single && cable.diameter.is_none();
        Self {
            weight: cable.weight,
            axial_stiffness: Some(cable.axial_stiffness),
            young_modulus: None,
            conductor_area: None,
            normal_load_factor: given.then_some(cable.normal_load_factor),
            diameter: cable.diameter,
            arrangement: cable.arrangement,
        }
    }
}

impl FrictionKeys {
    /// The friction with these keys.
    pub fn friction(&self) -> Result<Friction, Box<Wrong>> {
        let allowed = || format!("{}; law = \"coulomb\" needs none", SHAPE_FACTOR.allowed());
        let missing = || Wrong::missing("friction.shape_factor", allowed());
        let law = match (self.law, self.shape_factor) {
            (Law::Coulomb, _) => FrictionLaw::Coulomb,
            (_, None) => return Err(missing()),
            (Law::ElasticPlastic, Some(shape_factor)) => FrictionLaw::ElasticPlastic { shape_factor },
            (Law::Sigmoid, Some(shape_factor)) => FrictionLaw::Sigmoid { shape_factor },
        };
        let dynamic_coefficient = self.dynamic_coefficient;
        Ok(Friction {
            law,
            dynamic_coefficient,
        })
    }

    /// The keys of a friction.
    pub fn of(friction: &Friction) -> Self {
        let (law, shape_factor) = match friction.law {
            FrictionLaw::ElasticPlastic { shape_factor } => (Law::ElasticPlastic, Some(shape_factor)),
            FrictionLaw::Sigmoid { shape_factor } => (Law::Sigmoid, Some(shape_factor)),
            _ => (Law::Coulomb, None),
        };
        let dynamic_coefficient = friction.dynamic_coefficient;
        Self {
            law,
            dynamic_coefficient,
            shape_factor,
        }
    }
}
