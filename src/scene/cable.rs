//! `[duct]`, `[cable]`, `[friction]`, `[ends]`, `[[restraints]]`: what the traffic acts on.

use super::data::{Cable, Duct, End, Ends, Friction, FrictionLaw, Restraint};
use super::error::SceneError;
use super::range::{
    AXIAL_STIFFNESS, CLAMP, COEFFICIENT, DEPTH, DUCT_LENGTH, LATERAL_OFFSET, LOAD_FACTOR, POSITION,
    SHAPE_FACTOR, SPRING, WEIGHT, positions,
};
use super::table::Table;
use super::value::Value;

pub fn duct(root: &Table) -> Result<Duct, SceneError> {
    let table = root.table("duct")?;
    Ok(Duct {
        length: table.quantity("length", DUCT_LENGTH)?,
        depth: table.quantity("depth", DEPTH)?,
        lateral_offset: table
            .optional_quantity("lateral_offset", LATERAL_OFFSET)?
            .unwrap_or(0.0),
    })
}

pub fn cable(root: &Table) -> Result<Cable, SceneError> {
    let table = root.table("cable")?;
    Ok(Cable {
        weight: table.quantity("weight", WEIGHT)?,
        axial_stiffness: table.quantity("axial_stiffness", AXIAL_STIFFNESS)?,
        normal_load_factor: table
            .optional_quantity("normal_load_factor", LOAD_FACTOR)?
            .unwrap_or(1.0),
    })
}

pub fn friction(root: &Table) -> Result<Friction, SceneError> {
    const COULOMB: &str = "coulomb";
    const ELASTIC_PLASTIC: &str = "elastic-plastic";
    const SIGMOID: &str = "sigmoid";
    let table = root.table("friction")?;
    let words = [COULOMB, ELASTIC_PLASTIC, SIGMOID].map(|word| (word, word));
    let law = table.word("law", &words, ELASTIC_PLASTIC)?;
    let dynamic_coefficient = table.quantity("dynamic_coefficient", COEFFICIENT)?;
    let law = if law == COULOMB {
        let allowed = "no `shape_factor` with the law \"coulomb\"";
        table.refuse("shape_factor", "law", allowed)?;
        FrictionLaw::Coulomb
    } else {
        let shape_factor = table.quantity("shape_factor", SHAPE_FACTOR)?;
        if law == SIGMOID {
            FrictionLaw::Sigmoid { shape_factor }
        } else {
            FrictionLaw::ElasticPlastic { shape_factor }
        }
    };
    Ok(Friction {
        law,
        dynamic_coefficient,
    })
}

pub fn ends(root: &Table) -> Result<Ends, SceneError> {
    let table = root.table("ends")?;
    Ok(Ends {
        upstream: end(&table, "upstream")?,
        downstream: end(&table, "downstream")?,
    })
}

fn end(table: &Table, key: &str) -> Result<End, SceneError> {
    const ALLOWED: &str = "\"free\", \"fixed\" or { spring = \"3 MN/m\" }";
    let value = table.required(key, ALLOWED)?;
    if value.is_table() {
        let table = Table::new(value)?;
        table.quantity("spring", SPRING).map(End::Spring)
    } else {
        value.word_of(&[("free", End::Free), ("fixed", End::Fixed)], ALLOWED)
    }
}

pub fn restraints(root: &Table, duct: &Duct) -> Result<Vec<Restraint>, SceneError> {
    let Some(list) = root.optional("restraints") else {
        return Ok(Vec::new());
    };
    let items = list.items("a list of [[restraints]]")?;
    items.into_iter().map(|item| restraint(item, duct)).collect()
}

fn restraint(item: Value, duct: &Duct) -> Result<Restraint, SceneError> {
    let table = Table::new(item)?;
    let position = table.required("position", &POSITION.allowed())?;
    Ok(Restraint {
        position: position.quantity_within(POSITION, positions(duct.length))?,
        stiffness: table.quantity("stiffness", CLAMP)?,
    })
}
