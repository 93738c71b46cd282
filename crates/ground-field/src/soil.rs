//! What the ground is made of: elastic layers on a half-space or on rock.

use crate::GroundError;
use crate::error::checked;

const MODULUS_ALLOWED: &str = "finite and positive";
const POISSON_ALLOWED: &str = "between 0 and 0.5, both included";

/// An isotropic linear elastic material.
///
/// ```
/// let soil = ground_field::Soil::new(80e6, 0.25)?;
/// assert_eq!(soil.shear_modulus(), 32e6);
/// # Ok::<(), ground_field::GroundError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Soil {
    young_modulus: f64,
    poisson_ratio: f64,
}

impl Soil {
    /// A soil with Young's modulus \[Pa\] and Poisson's ratio.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless the modulus is positive and the ratio in \[0, 0.5\].
    pub fn new(young_modulus: f64, poisson_ratio: f64) -> Result<Self, GroundError> {
        Ok(Self {
            young_modulus: checked("young_modulus", young_modulus, MODULUS_ALLOWED, |v| v > 0.0)?,
            poisson_ratio: checked("poisson_ratio", poisson_ratio, POISSON_ALLOWED, |v| {
                (0.0..=0.5).contains(&v)
            })?,
        })
    }

    /// Young's modulus E \[Pa\].
    pub fn young_modulus(self) -> f64 {
        self.young_modulus
    }

    /// Poisson's ratio ν.
    pub fn poisson_ratio(self) -> f64 {
        self.poisson_ratio
    }

    /// Shear modulus μ = E / (2 (1 + ν)) \[Pa\].
    pub fn shear_modulus(self) -> f64 {
        self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }
}

/// Young's modulus within a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Modulus {
    /// The same everywhere \[Pa\].
    Uniform(f64),
    /// Linear in depth from the layer's top to its bottom \[Pa\].
    Linear {
        /// At the top of the layer \[Pa\].
        top: f64,
        /// At the bottom of the layer \[Pa\].
        bottom: f64,
    },
}

/// A horizontal layer of finite thickness, bonded to its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoilLayer {
    thickness: f64,
    modulus: Modulus,
    poisson_ratio: f64,
}

impl SoilLayer {
    /// A layer of uniform soil with `thickness` \[m\].
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless the thickness is finite and positive.
    pub fn uniform(thickness: f64, soil: Soil) -> Result<Self, GroundError> {
        Self::new(
            thickness,
            Modulus::Uniform(soil.young_modulus),
            soil.poisson_ratio,
        )
    }

    /// A layer with `thickness` \[m\], a modulus that may vary with depth, and Poisson's ratio.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] for a value out of range.
    pub fn new(thickness: f64, modulus: Modulus, poisson_ratio: f64) -> Result<Self, GroundError> {
        let thickness = checked("thickness", thickness, "finite and positive", |v| v > 0.0)?;
        let (top, bottom) = match modulus {
            Modulus::Uniform(value) => (value, value),
            Modulus::Linear { top, bottom } => (top, bottom),
        };
        Soil::new(top, poisson_ratio)?;
        Soil::new(bottom, poisson_ratio)?;
        Ok(Self {
            thickness,
            modulus,
            poisson_ratio,
        })
    }

    /// Thickness \[m\].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Young's modulus, as given.
    pub fn modulus(&self) -> Modulus {
        self.modulus
    }

    /// Poisson's ratio ν.
    pub fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }

    /// Young's modulus \[Pa\] at `height` \[m\] below the layer's top.
    pub fn young_modulus_at(&self, height: f64) -> f64 {
        match self.modulus {
            Modulus::Uniform(value) => value,
            Modulus::Linear { top, bottom } => top + (bottom - top) * height / self.thickness,
        }
    }

    /// The soil at `height` \[m\] below the layer's top.
    pub fn soil_at(&self, height: f64) -> Soil {
        Soil {
            young_modulus: self.young_modulus_at(height),
            poisson_ratio: self.poisson_ratio,
        }
    }

    /// The layer's soil if it is uniform; `None` if the modulus varies with depth.
    pub fn soil(&self) -> Option<Soil> {
        match self.modulus {
            Modulus::Linear { top, bottom } if top != bottom => None,
            _ => Some(self.soil_at(0.0)),
        }
    }
}

/// What lies below the last layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Base {
    /// The same soil without end.
    HalfSpace(Soil),
    /// Rock that does not move, bonded to the last layer.
    Rigid,
}

/// The ground: bonded layers from the surface down, on a half-space or on rock.
///
/// ```
/// use ground_field::{Base, Modulus, Soil, SoilLayer, SoilProfile};
///
/// let asphalt = SoilLayer::uniform(0.1, Soil::new(4e9, 0.35)?)?;
/// let fill = SoilLayer::new(2.0, Modulus::Linear { top: 40e6, bottom: 120e6 }, 0.35)?;
/// let ground = SoilProfile::new(vec![asphalt, fill], Base::Rigid)?;
/// assert_eq!(ground.base_depth(), 2.1);
/// assert_eq!(ground.homogeneous(), None);
/// assert!(Soil::new(4e9, 0.51).is_err());
/// # Ok::<(), ground_field::GroundError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SoilProfile {
    layers: Vec<SoilLayer>,
    base: Base,
}

impl SoilProfile {
    /// `layers` from the surface down, on `base`.
    ///
    /// # Errors
    ///
    /// [`GroundError::Unsupported`] for a rigid base without any layer above it.
    pub fn new(layers: Vec<SoilLayer>, base: Base) -> Result<Self, GroundError> {
        if layers.is_empty() && base == Base::Rigid {
            return Err(GroundError::Unsupported {
                model: "soil profile",
                limit: "a rigid base needs at least one layer above it",
            });
        }
        Ok(Self { layers, base })
    }

    /// The same ground with every layer whose modulus varies cut into `count` uniform sublayers, each with the modulus at its middle:
    /// what a model of uniform layers takes in its place. The error falls with the square of `count`.
    ///
    /// The deeper a sublayer the thicker it is, in proportion to its depth plus `finest` \[m\]: a load's strains fade so. Take the depth
    /// at which the displacement is looked for.
    ///
    /// ```
    /// # use ground_field::{Base, Modulus, SoilLayer, SoilProfile};
    /// let fill = SoilLayer::new(3.0, Modulus::Linear { top: 40e6, bottom: 100e6 }, 0.35)?;
    /// let cut = SoilProfile::new(vec![fill], Base::Rigid)?.sublayered(2, 1.0)?;
    /// // 1 m and 2 m thick.
    /// assert_eq!(cut.layers()[0].modulus(), Modulus::Uniform(50e6));
    /// assert_eq!(cut.layers()[1].modulus(), Modulus::Uniform(80e6));
    /// # Ok::<(), ground_field::GroundError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] if a sublayer would have no thickness.
    pub fn sublayered(&self, count: usize, finest: f64) -> Result<Self, GroundError> {
        let mut layers = Vec::new();
        let mut top = 0.0;
        for layer in &self.layers {
            let parts = if layer.soil().is_some() { 1 } else { count.max(1) };
            let growth = 1.0 + layer.thickness / (top + finest);
            let bound = |k: usize| match k {
                0 => 0.0,
                k if k == parts => layer.thickness,
                k => (top + finest) * (growth.powf(k as f64 / parts as f64) - 1.0),
            };
            for k in 0..parts {
                let (upper, lower) = (bound(k), bound(k + 1));
                layers.push(SoilLayer::uniform(
                    lower - upper,
                    layer.soil_at(0.5 * (upper + lower)),
                )?);
            }
            top += layer.thickness;
        }
        Self::new(layers, self.base)
    }

    /// One soil everywhere.
    pub fn half_space(soil: Soil) -> Self {
        Self {
            layers: Vec::new(),
            base: Base::HalfSpace(soil),
        }
    }

    /// The layers of finite thickness, from the surface down.
    pub fn layers(&self) -> &[SoilLayer] {
        &self.layers
    }

    /// What lies below them.
    pub fn base(&self) -> Base {
        self.base
    }

    /// Depth \[m\] of the base: the sum of the layers' thicknesses.
    pub fn base_depth(&self) -> f64 {
        self.layers.iter().map(SoilLayer::thickness).sum()
    }

    /// The soil where the ground is one and the same everywhere.
    pub fn homogeneous(&self) -> Option<Soil> {
        let is = |soil| self.layers.iter().all(|layer| layer.soil() == Some(soil));
        match self.base {
            Base::HalfSpace(soil) if is(soil) => Some(soil),
            _ => None,
        }
    }
}
