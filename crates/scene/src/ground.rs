//! `[ground]`: from its keys to layers on a base, and back.

use ground_field::{Base, Modulus, Soil, SoilLayer, SoilProfile};

use crate::data::{Ground, PeakScaling};
use crate::error::{Wrong, WrongKind};
use crate::keys::{GroundKeys, LAYERS, LayerKeys};
use crate::range::{THICKNESS, shown};

impl GroundKeys {
    /// The ground with these keys, whose values are in their ranges.
    pub fn ground(&self) -> Result<Ground, Box<Wrong>> {
        let scaling = self.longitudinal_peak.map(PeakScaling::Longitudinal);
        let scaling = scaling.or(self.vertical_peak.map(PeakScaling::Vertical));
        let (model, profile) = (self.model, self.profile()?);
        Ok(Ground {
            model,
            profile,
            scaling,
        })
    }

    fn profile(&self) -> Result<SoilProfile, Box<Wrong>> {
        let rejected = |index: usize, error: ground_field::GroundError| {
            Wrong::value(
                format!("ground.layers.{index}"),
                error.to_string(),
                "another layer",
            )
        };
        let soil_layer = |index: usize, thickness: f64, layer: &LayerKeys| {
            let layer = SoilLayer::new(thickness, layer.young_modulus, layer.poisson_ratio);
            layer.map_err(|error| rejected(index, error))
        };
        let empty = || Wrong::value("ground.layers", "an empty list", LAYERS);
        let (last, upper) = self.layers.split_last().ok_or_else(empty)?;
        let key = |name: &str| format!("ground.layers.{}.{name}", upper.len());
        let mut layers = Vec::with_capacity(self.layers.len());
        for (index, layer) in upper.iter().enumerate() {
            let thickness = layer.thickness.ok_or_else(|| {
                let key = format!("ground.layers.{index}.thickness");
                Wrong::missing(key, THICKNESS.allowed())
            })?;
            layers.push(soil_layer(index, thickness, layer)?);
        }
        if let Some(thickness) = last.thickness {
            let allowed = "no thickness in the last layer: it extends down to ground.rigid_base_depth, or to infinite depth";
            let found = format!("{} m", shown(thickness));
            return Err(Wrong::value(key("thickness"), found, allowed));
        }
        let base = if let Some(depth) = self.rigid_base_depth {
            let above: f64 = layers.iter().map(SoilLayer::thickness).sum();
            if !THICKNESS.contains(depth - above) {
                let allowed = format!("a depth below the upper layers, greater than {} m", shown(above));
                let found = shown(depth);
                return Err(Wrong::at(
                    WrongKind::OutOfRange,
                    "ground.rigid_base_depth",
                    found,
                    allowed,
                ));
            }
            layers.push(soil_layer(upper.len(), depth - above, last)?);
            Base::Rigid
        } else {
            let Modulus::Uniform(modulus) = last.young_modulus else {
                let found = "a modulus that varies with depth";
                let allowed = "one value in the last layer, which extends to infinite depth; or set ground.rigid_base_depth";
                return Err(Wrong::value(key("young_modulus"), found, allowed));
            };
            Base::HalfSpace(
                Soil::new(modulus, last.poisson_ratio).map_err(|error| rejected(upper.len(), error))?,
            )
        };
        SoilProfile::new(layers, base).map_err(|error| rejected(0, error))
    }

    /// The keys of a ground.
    pub fn of(ground: &Ground) -> Self {
        let layers = ground.profile.layers();
        let mut keys = Self {
            model: ground.model,
            ..Self::default()
        };
        match ground.scaling {
            Some(PeakScaling::Longitudinal(peak)) => keys.longitudinal_peak = Some(peak),
            Some(PeakScaling::Vertical(peak)) => keys.vertical_peak = Some(peak),
            None => {}
        }
        keys.layers.extend(layers.iter().map(|layer| LayerKeys {
            thickness: Some(layer.thickness()),
            young_modulus: layer.modulus(),
            poisson_ratio: layer.poisson_ratio(),
        }));
        match (ground.profile.base(), keys.layers.last_mut()) {
            (Base::HalfSpace(soil), _) => keys.layers.push(LayerKeys {
                thickness: None,
                young_modulus: Modulus::Uniform(soil.young_modulus()),
                poisson_ratio: soil.poisson_ratio(),
            }),
            (Base::Rigid, Some(last)) => {
                keys.rigid_base_depth = Some(base_depth(layers));
                last.thickness = None;
            }
            (Base::Rigid, None) => {}
        }
        keys
    }
}

/// The depth of the base \[m\] from which the last layer's thickness is computed to the last digit, if there is one.
fn base_depth(layers: &[SoilLayer]) -> f64 {
    let Some((last, upper)) = layers.split_last() else {
        return 0.0;
    };
    let above: f64 = upper.iter().map(SoilLayer::thickness).sum();
    let sum = above + last.thickness();
    let exact = |depth: &f64| depth - above == last.thickness();
    [sum, sum.next_down(), sum.next_up()]
        .into_iter()
        .find(exact)
        .unwrap_or(sum)
}
