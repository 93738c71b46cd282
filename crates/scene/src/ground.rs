//! `[ground]`: layers, what they lie on, and how to model them.

use ground_field::{Base, GroundError, Modulus, Soil, SoilLayer, SoilProfile};

use crate::content::Content;
use crate::error::Result;
use crate::key::Form;
use crate::key::Form::{Either, List, Number, Table};
use crate::range;
use crate::section::{file_words, keys};
use crate::stored::{Given, Stored};

keys! {
    /// The ground and how to model it, in SI.
    #[derive(Default)]
    pub struct Ground {
        preset "A pavement by its name; other keys override its values.";
        /// Model of the ground.
        model: GroundModel = GroundModel::FORM, "\"auto\"";
        /// Depth of rock that does not move.
        rigid_base_depth: Option<f64> = Number(range::RIGID_BASE_DEPTH), "no rock";
        /// Scales the ground so that each vehicle moves the duct so far along its axis.
        longitudinal_peak: Option<f64> = Number(range::LONGITUDINAL_PEAK), "not scaled";
        /// Measured deflection of the duct under the first vehicle, to which the ground is scaled.
        vertical_peak: Option<f64> = Number(range::VERTICAL_PEAK), "not scaled";
        /// Layers from the surface down.
        layers: Vec<Layer> = List(&[Table(Layer::KEYS)], 1, LAYERS);
    }
}

const LAYERS: &str = "one [[ground.layers]] or more, from the top down";

keys! {
    /// A layer of the ground, in SI. The last one reaches down to the rigid base, or without end.
    #[derive(Copy)]
    pub struct Layer {
        /// Thickness of the layer.
        thickness: Option<f64> = Number(range::THICKNESS), "the last layer has none";
        /// Young's modulus at small strains, several times that of a settlement test.
        young_modulus: Modulus = LAYER_MODULUS;
        /// Poisson's ratio.
        poisson_ratio: f64 = Number(range::POISSON);
    }
}

keys! {
    /// Young's modulus of a layer in which it varies.
    pub struct Graded {
        /// Young's modulus at the top of a layer in which it varies.
        top: f64 = Number(range::MODULUS_AT_AN_END);
        /// The same at the bottom.
        bottom: f64 = Number(range::MODULUS_AT_AN_END);
    }
}

const LAYER_MODULUS: Form = Either(&Number(range::MODULUS), Graded::KEYS);

impl Stored for Modulus {
    fn read(given: &Given) -> Result<Self> {
        let Content::Table(_) = given.node.content else {
            return f64::read(given).map(Self::Uniform);
        };
        let Graded { top, bottom } = Graded::read(given)?;
        Ok(Self::Linear { top, bottom })
    }

    fn write(&self, form: Form) -> Content {
        match *self {
            Self::Uniform(modulus) => modulus.write(form),
            Self::Linear { top, bottom } => Graded { top, bottom }.write(form),
        }
    }
}

/// Model of the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum GroundModel {
    /// The cheapest that is accurate enough.
    #[default]
    Auto,
    /// Homogeneous half-space, closed form.
    Boussinesq,
    /// Layers by Hankel transform.
    Burmister,
    /// Layers by axisymmetric finite elements.
    FiniteElements,
}

file_words! {
    GroundModel: Auto "auto", Boussinesq "boussinesq", Burmister "burmister", FiniteElements "fem";
    "; odemark is no longer there: the exact \"burmister\" costs no more than that approximation"
}

impl Ground {
    /// Its layers on what is below them.
    ///
    /// # Errors
    ///
    /// [`GroundError`] if a valid scene has none: a number out of its range, a layer without thickness above another.
    pub fn profile(&self) -> Result<SoilProfile, GroundError> {
        let Some((last, upper)) = self.layers.split_last() else {
            return SoilProfile::new(Vec::new(), Base::Rigid);
        };
        let layer =
            |layer: &Layer, thickness| SoilLayer::new(thickness, layer.young_modulus, layer.poisson_ratio);
        let of_upper = |upper: &Layer| layer(upper, upper.thickness.unwrap_or_default());
        let mut layers = upper.iter().map(of_upper).collect::<Result<Vec<_>, _>>()?;
        let base = match (self.rigid_base_depth, last.young_modulus) {
            (Some(depth), _) => {
                layers.push(layer(last, depth - self.upper_thickness())?);
                Base::Rigid
            }
            (None, Modulus::Uniform(modulus) | Modulus::Linear { bottom: modulus, .. }) => {
                Base::HalfSpace(Soil::new(modulus, last.poisson_ratio)?)
            }
        };
        SoilProfile::new(layers, base)
    }

    /// The thickness of all layers but the last \[m\].
    pub(crate) fn upper_thickness(&self) -> f64 {
        let upper = self.layers.split_last().map_or(&[][..], |(_, upper)| upper);
        upper.iter().filter_map(|layer| layer.thickness).sum()
    }

    /// The thickness of all layers \[m\]; one without end has none.
    pub fn thickness(&self) -> f64 {
        self.rigid_base_depth.unwrap_or_else(|| self.upper_thickness())
    }
}
