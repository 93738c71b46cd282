//! `[duct]`, `[cable]`, `[friction]`, `[ends]`, `[[restraints]]`: what the traffic acts on.

use super::range::{
    ANY, AXIAL_STIFFNESS, COEFFICIENT, DEPTH, DUCT_LENGTH, LOAD_FACTOR, OFFSET, SHAPE_FACTOR, STIFFNESS,
    WEIGHT, positions,
};
use super::table::Table;
use super::value::Value;
use super::{Cable, Dimension, Duct, End, Ends, Friction, FrictionLaw, Restraint, SceneError, keys};

pub(super) fn duct(root: &Table) -> Result<Duct, SceneError> {
    let table = root.table("duct", keys::DUCT)?;
    Ok(Duct {
        length: table.quantity("length", Dimension::Length, DUCT_LENGTH, "\"30 m\"")?,
        depth: table.quantity("depth", Dimension::Length, DEPTH, "\"1.2 m\"")?,
        lateral_offset: table
            .optional_quantity("lateral_offset", Dimension::Length, OFFSET, "\"0.5 m\"")?
            .unwrap_or(0.0),
    })
}

pub(super) fn cable(root: &Table) -> Result<Cable, SceneError> {
    let table = root.table("cable", keys::CABLE)?;
    Ok(Cable {
        weight: table.quantity("weight", Dimension::ForcePerLength, WEIGHT, "\"108.8 N/m\"")?,
        axial_stiffness: table.quantity(
            "axial_stiffness",
            Dimension::Force,
            AXIAL_STIFFNESS,
            "\"8.01e6 N\"",
        )?,
        normal_load_factor: table
            .optional_number("normal_load_factor", LOAD_FACTOR)?
            .unwrap_or(1.0),
    })
}

pub(super) fn friction(root: &Table) -> Result<Friction, SceneError> {
    const COULOMB: &str = "coulomb";
    const ELASTIC_PLASTIC: &str = "elastic-plastic";
    const SIGMOID: &str = "sigmoid";
    let table = root.table("friction", keys::FRICTION)?;
    let words = [COULOMB, ELASTIC_PLASTIC, SIGMOID].map(|word| (word, word));
    let law = table.word("law", &words, ELASTIC_PLASTIC)?;
    let dynamic_coefficient = table.number("dynamic_coefficient", COEFFICIENT)?;
    let law = if law == COULOMB {
        table.refuse(
            "shape_factor",
            "law",
            "no `shape_factor` with the law \"coulomb\"",
        )?;
        FrictionLaw::Coulomb
    } else {
        let shape_factor = table.quantity(
            "shape_factor",
            Dimension::InverseLength,
            SHAPE_FACTOR,
            "\"2e7 1/m\"",
        )?;
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

pub(super) fn ends(root: &Table) -> Result<Ends, SceneError> {
    let table = root.table("ends", keys::ENDS)?;
    Ok(Ends {
        upstream: end(&table, "upstream")?,
        downstream: end(&table, "downstream")?,
    })
}

fn end(table: &Table, key: &str) -> Result<End, SceneError> {
    const ALLOWED: &str = "\"free\", \"fixed\" or { spring = \"3 MN/m\" }";
    let value = table.required(key, ALLOWED)?;
    if value.is_table() {
        value
            .table(keys::SPRING)?
            .quantity("spring", Dimension::ForcePerLength, STIFFNESS, "\"3 MN/m\"")
            .map(End::Spring)
    } else {
        value.word_of(&[("free", End::Free), ("fixed", End::Fixed)], ALLOWED)
    }
}

pub(super) fn restraints(root: &Table, duct: &Duct) -> Result<Vec<Restraint>, SceneError> {
    root.optional("restraints").map_or(Ok(Vec::new()), |list| {
        list.items("a list of [[restraints]]")?
            .iter()
            .map(|item| restraint(item, duct))
            .collect()
    })
}

fn restraint(item: &Value, duct: &Duct) -> Result<Restraint, SceneError> {
    const EXAMPLE: &str = "\"20 m\"";
    let table = item.table(keys::RESTRAINT)?;
    let position = table.quantity("position", Dimension::Length, ANY, EXAMPLE)?;
    let (range, allowed) = positions(duct.length);
    if !range.contains(&position) {
        return Err(table.required("position", &allowed)?.out_of_range(allowed));
    }
    Ok(Restraint {
        position,
        stiffness: table.quantity("stiffness", Dimension::ForcePerLength, STIFFNESS, "\"1 MN/m\"")?,
    })
}
