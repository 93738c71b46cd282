//! `[cable]` and `[friction]`: the cable in the duct, and what holds it there.

use cable_dem::FrictionLaw;

use crate::arrangement::Arrangement;
use crate::error::{Result, SceneError};
use crate::key::Form::Number;
use crate::range::{self, Quantity};
use crate::section::{file_words, keys};
use crate::shown::shown;

keys! {
    /// The cable, in SI.
    #[derive(Copy)]
    #[non_exhaustive]
    pub struct Cable {
        preset "A cable by its name; other keys override its values.";
        /// Weight of the cable per length; a mass per length is multiplied by g.
        weight: f64 = Number(range::WEIGHT);
        /// Young's modulus times cross-section, EA.
        axial_stiffness: f64 = Number(range::AXIAL_STIFFNESS), "`young_modulus` and `conductor_area` instead";
        /// Young's modulus of the cable as a whole, relative to the area of its conductors.
        young_modulus: Option<f64> = Number(range::CONDUCTOR_MODULUS), "`axial_stiffness` instead";
        /// Area of its conductors; with `young_modulus` it gives EA.
        conductor_area: Option<f64> = Number(range::CONDUCTOR_AREA), "`axial_stiffness` instead";
        /// Normal force on the duct, in weights of the cable.
        normal_load_factor: Option<f64> = Number(range::LOAD_FACTOR), "1";
        /// Diameter of the cable; of several in a duct it sets the normal load factor.
        diameter: Option<f64> = Number(range::DIAMETER), "none";
        /// How it lies among others in its duct.
        arrangement: Arrangement = Arrangement::FORM, "\"single\"";
    }
}

impl Cable {
    /// Puts EA in place of a modulus and an area.
    pub(crate) fn resolve(&mut self) -> Result<()> {
        let missing = |key, quantity: Quantity| Err(SceneError::missing(key, quantity.allowed()));
        let (modulus, area) = match (self.young_modulus.take(), self.conductor_area.take()) {
            (Some(modulus), Some(area)) => (modulus, area),
            (Some(_), None) => return missing("cable.conductor_area", range::CONDUCTOR_AREA),
            (None, Some(_)) => return missing("cable.young_modulus", range::CONDUCTOR_MODULUS),
            (None, None) => return Ok(()),
        };
        self.axial_stiffness = modulus * area;
        if range::AXIAL_STIFFNESS.contains(self.axial_stiffness) {
            return Ok(());
        }
        let [modulus, area, force] = [modulus, area, self.axial_stiffness].map(shown);
        let found = format!("{modulus} Pa times {area} m2, {force} N");
        let allowed = format!("a product {}", range::AXIAL_STIFFNESS.words);
        Err(SceneError::value("cable.young_modulus", found, allowed))
    }
}

keys! {
    /// Friction between cable and duct, in SI.
    #[derive(Copy)]
    pub struct Friction {
        preset "A pair of surfaces by its name; other keys override its values.";
        /// How friction follows slip.
        law: Law = Law::FORM, "\"elastic-plastic\"";
        /// Friction of the slipping cable in normal forces, μ_d.
        dynamic_coefficient: f64 = Number(range::COEFFICIENT);
        /// How steeply friction builds up before the cable slips, b: the slope is q b/2.
        shape_factor: Option<f64> = Number(range::SHAPE_FACTOR), "required, but not with Coulomb's law";
    }
}

/// The laws of friction by their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Law {
    /// Rigid until it slips; it has no shape factor.
    Coulomb,
    /// Linear elastic until it slips, with memory.
    #[default]
    ElasticPlastic,
    /// A smooth function of the slip within one time step, without memory.
    Sigmoid,
}

file_words!(Law: Coulomb "coulomb", ElasticPlastic "elastic-plastic", Sigmoid "sigmoid");

impl Friction {
    /// The law with its shape factor, which is not a number where none is given.
    pub fn law(&self) -> FrictionLaw {
        let shape_factor = self.shape_factor.unwrap_or(f64::NAN);
        match self.law {
            Law::Coulomb => FrictionLaw::Coulomb,
            Law::ElasticPlastic => FrictionLaw::ElasticPlastic { shape_factor },
            Law::Sigmoid => FrictionLaw::Sigmoid { shape_factor },
        }
    }
}
