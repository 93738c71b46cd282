//! `[ground]`: layers, base, scaling.

use ground_field::{Base, Modulus, Soil, SoilLayer, SoilProfile};

use super::data::{Ground, GroundModel, PeakScaling};
use super::error::SceneError;
use super::range::{
    LONGITUDINAL_PEAK, MODULUS, MODULUS_AT_AN_END, POISSON, RIGID_BASE_DEPTH, THICKNESS, THICKNESSES,
    VERTICAL_PEAK, shown,
};
use super::table::Table;
use super::value::Value;

pub fn ground(root: &Table) -> Result<Ground, SceneError> {
    let table = root.table("ground")?;
    let gone = (
        "odemark",
        "the exact \"burmister\" costs no more than this approximation, which is no longer there",
    );
    let model = table.word_unless("model", GroundModel::WORDS, GroundModel::Auto, gone)?;
    let scaling = scaling(&table)?;
    let profile = profile(&table)?;
    Ok(Ground {
        model,
        profile,
        scaling,
    })
}

fn scaling(table: &Table) -> Result<Option<PeakScaling>, SceneError> {
    Ok(match table.alternatives("longitudinal_peak", "vertical_peak")? {
        [Some(value), _] => Some(PeakScaling::Longitudinal(value.quantity(LONGITUDINAL_PEAK)?)),
        [None, Some(value)] => Some(PeakScaling::Vertical(value.quantity(VERTICAL_PEAK)?)),
        [None, None] => None,
    })
}

/// A layer as the file has it.
struct Layer<'d> {
    table: Table<'d>,
    thickness: Option<f64>,
    modulus: Modulus,
    poisson_ratio: f64,
}

impl Layer<'_> {
    fn of_thickness(&self, thickness: f64) -> Result<SoilLayer, SceneError> {
        SoilLayer::new(thickness, self.modulus, self.poisson_ratio).map_err(|e| self.table.rejected(e))
    }
}

fn profile(table: &Table) -> Result<SoilProfile, SceneError> {
    let allowed = "one [[ground.layers]] or more, from the top down";
    let mut layers = table
        .required("layers", allowed)?
        .some_items(allowed)?
        .into_iter()
        .map(layer)
        .collect::<Result<Vec<_>, _>>()?;
    let Some(last) = layers.pop() else {
        return Err(table.value.inconsistent("an empty list", allowed));
    };
    let mut upper = Vec::with_capacity(layers.len() + 1);
    for layer in &layers {
        let thickness = layer.table.quantity("thickness", THICKNESS)?;
        upper.push(layer.of_thickness(thickness)?);
    }
    if let (Some(_), Some(value)) = (last.thickness, last.table.optional("thickness")) {
        let allowed = "no thickness in the last layer: it extends down to ground.rigid_base_depth, or to infinite depth";
        return Err(value.inconsistent(value.written(), allowed));
    }
    let base = if let Some(value) = table.optional("rigid_base_depth") {
        let depth = value.quantity(RIGID_BASE_DEPTH)?;
        let above: f64 = upper.iter().map(SoilLayer::thickness).sum();
        if !THICKNESSES.contains(depth - above) {
            return Err(value.out_of_range(format!(
                "a depth below the upper layers, greater than {} m",
                shown(above)
            )));
        }
        upper.push(last.of_thickness(depth - above)?);
        Base::Rigid
    } else {
        let Modulus::Uniform(modulus) = last.modulus else {
            let allowed = "one value in the last layer, which extends to infinite depth; or set ground.rigid_base_depth";
            let value = last.table.required("young_modulus", allowed)?;
            return Err(value.inconsistent("a modulus that varies with depth", allowed));
        };
        Base::HalfSpace(Soil::new(modulus, last.poisson_ratio).map_err(|e| last.table.rejected(e))?)
    };
    SoilProfile::new(upper, base).map_err(|e| table.rejected(e))
}

fn layer(value: Value) -> Result<Layer, SceneError> {
    let table = Table::new(value)?;
    Ok(Layer {
        thickness: table.optional_quantity("thickness", THICKNESS)?,
        modulus: modulus(&table)?,
        poisson_ratio: table.quantity("poisson_ratio", POISSON)?,
        table,
    })
}

fn modulus(table: &Table) -> Result<Modulus, SceneError> {
    match table.optional("young_modulus").filter(Value::is_table) {
        Some(value) => {
            let graded = Table::new(value)?;
            Ok(Modulus::Linear {
                top: graded.quantity("top", MODULUS_AT_AN_END)?,
                bottom: graded.quantity("bottom", MODULUS_AT_AN_END)?,
            })
        }
        None => table.quantity("young_modulus", MODULUS).map(Modulus::Uniform),
    }
}
