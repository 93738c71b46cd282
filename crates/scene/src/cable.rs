//! `[cable]`: the cable in the duct.

use crate::arrangement::Arrangement;
use crate::error::SceneError;
use crate::key::Form::Number;
use crate::key::keys;
use crate::range::{
    AXIAL_STIFFNESS, CONDUCTOR_AREA, CONDUCTOR_MODULUS, DIAMETER, LOAD_FACTOR, WEIGHT, shown,
};

keys! {
    /// The cable, in SI.
    #[derive(Copy)]
    #[non_exhaustive]
    pub struct Cable {
        preset "A cable by its name; keys beside it override its values.";
        /// Weight of the cable per length; a mass per length is multiplied by g.
        weight: f64 = Number(WEIGHT);
        /// Young's modulus times cross-section, EA.
        axial_stiffness: f64 = Number(AXIAL_STIFFNESS), "`young_modulus` and `conductor_area` instead";
        /// Young's modulus of the cable as a whole, relative to the area of its conductors.
        young_modulus: Option<f64> = Number(CONDUCTOR_MODULUS), "`axial_stiffness` instead";
        /// Area of its conductors; with `young_modulus` it gives EA.
        conductor_area: Option<f64> = Number(CONDUCTOR_AREA), "`axial_stiffness` instead";
        /// Normal force on the duct, in weights of the cable.
        normal_load_factor: Option<f64> = Number(LOAD_FACTOR), "1";
        /// Diameter of the cable; of several in a duct it sets the normal load factor.
        diameter: Option<f64> = Number(DIAMETER), "none";
        /// How it lies beside others in its duct.
        arrangement: Arrangement = Arrangement::FORM, "\"single\"";
    }
}

impl Cable {
    /// Puts EA in place of a modulus and an area.
    pub(crate) fn resolve(&mut self) -> Result<(), SceneError> {
        let (modulus, area) = match (self.young_modulus.take(), self.conductor_area.take()) {
            (Some(modulus), Some(area)) => (modulus, area),
            (Some(_), None) => {
                return Err(SceneError::missing(
                    "cable.conductor_area",
                    CONDUCTOR_AREA.allowed(),
                ));
            }
            (None, Some(_)) => {
                return Err(SceneError::missing(
                    "cable.young_modulus",
                    CONDUCTOR_MODULUS.allowed(),
                ));
            }
            (None, None) => return Ok(()),
        };
        self.axial_stiffness = modulus * area;
        if AXIAL_STIFFNESS.contains(self.axial_stiffness) {
            return Ok(());
        }
        let [modulus, area, force] = [modulus, area, self.axial_stiffness].map(shown);
        let found = format!("{modulus} Pa times {area} m2, {force} N");
        let allowed = format!("a product {}", AXIAL_STIFFNESS.words);
        Err(SceneError::value("cable.young_modulus", found, allowed))
    }
}
