//! `[friction]`: friction between cable and duct.

use cable_dem::FrictionLaw;

use crate::key::Form::Number;
use crate::key::keys;
use crate::range::{COEFFICIENT, SHAPE_FACTOR};
use crate::words::file_words;

keys! {
    /// Friction between cable and duct, in SI.
    #[derive(Copy)]
    pub struct Friction {
        preset "A pair of surfaces by its name; keys beside it override its values.";
        /// How friction follows slip.
        law: Law = Law::FORM, "\"elastic-plastic\"";
        /// Friction of the slipping cable in normal forces, μ_d.
        dynamic_coefficient: f64 = Number(COEFFICIENT);
        /// How steeply friction builds up before the cable slips, b: the slope is q b/2.
        shape_factor: Option<f64> = Number(SHAPE_FACTOR), "required, but not with Coulomb's law";
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
