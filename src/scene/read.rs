//! A document as a scene; here all sections but those of the ground and of traffic.

use std::path::Path;

use super::check::check;
use super::data::{
    Arrangement, Cable, Duct, End, Ends, Friction, FrictionLaw, Restraint, Scene, Solver, SolverMethod,
};
use super::document::Document;
use super::error::{SceneError, Wrong, WrongKind};
use super::range::{
    APPROACH, AXIAL_STIFFNESS, CLAMP, COEFFICIENT, DEPTH, DIAMETER, DUCT_LENGTH, INNER_DIAMETER,
    LATERAL_OFFSET, LOAD_FACTOR, POSITION, SHAPE_FACTOR, SLOPE, SPRING, STEP, TIME_STEP, TOLERANCE, WEIGHT,
};
use super::table::Table;
use super::units::Dimension;
use super::value::Value;
use super::{ground, heat, traffic};

/// The scene in the file `name`.
pub fn scene(name: &str, document: &Document) -> Result<Scene, SceneError> {
    let root = Table::new(Value::root(document))?;
    let title = match root.optional("title") {
        Some(value) => value.text("a text in quotes")?,
        None => Path::new(name)
            .file_stem()
            .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
    };
    let duct = duct(&root)?;
    let ground = ground::ground(&root)?;
    let cable = cable(&root, &duct)?;
    let friction = friction(&root)?;
    let ends = ends(&root)?;
    let restraints = restraints(&root)?;
    let (vehicles, traffic) = traffic::traffic(name, &root, ground.scaling)?;
    let heat = heat::heat(&root)?;
    let solver = solver(&root)?;
    let scene = Scene {
        title,
        duct,
        ground,
        cable,
        friction,
        ends,
        restraints,
        vehicles,
        traffic,
        heat,
        solver,
    };
    check(&scene).map_err(|wrong| located(document, *wrong))?;
    Ok(scene)
}

/// What is wrong, with the place of its key, and a value as it is written there.
fn located(document: &Document, wrong: Wrong) -> SceneError {
    let (node, is_value) = document.find(&wrong.key);
    let found = match wrong.kind {
        WrongKind::OutOfRange | WrongKind::UnknownWord { .. } if is_value => document.written(&node.place),
        _ => wrong.found,
    };
    document.wrong(wrong.kind, &node.place, &wrong.key, found, wrong.allowed)
}

fn duct(root: &Table) -> Result<Duct, SceneError> {
    let table = root.table("duct")?;
    Ok(Duct {
        length: table.quantity("length", DUCT_LENGTH)?,
        depth: table.quantity("depth", DEPTH)?,
        lateral_offset: table
            .optional_quantity("lateral_offset", LATERAL_OFFSET)?
            .unwrap_or(0.0),
        inner_diameter: table.optional_quantity("inner_diameter", INNER_DIAMETER)?,
        slope: table.optional_quantity("slope", SLOPE)?.unwrap_or(0.0),
    })
}

fn cable(root: &Table, duct: &Duct) -> Result<Cable, SceneError> {
    let table = root.table("cable")?;
    let (arrangement, diameter, factor) = arrangement(root, &table, duct)?;
    Ok(Cable {
        weight: table.quantity("weight", WEIGHT)?,
        axial_stiffness: table.quantity("axial_stiffness", AXIAL_STIFFNESS)?,
        normal_load_factor: factor,
        diameter,
        arrangement,
    })
}

/// How the cable lies in the duct, its diameter, and its normal load factor: given, or as both make it.
fn arrangement(
    root: &Table,
    table: &Table,
    duct: &Duct,
) -> Result<(Arrangement, Option<f64>, f64), SceneError> {
    const FACTOR: &str = "normal_load_factor";
    let mut arrangement = table.word("arrangement", Arrangement::WORDS, Arrangement::Single)?;
    if arrangement.is_of_three() && table.alternatives("arrangement", FACTOR)?[0].is_none() {
        arrangement = Arrangement::Single;
    }
    let [diameter, factor] = table.alternatives("diameter", FACTOR)?;
    if let Some(factor) = factor {
        return Ok((arrangement, None, factor.quantity(LOAD_FACTOR)?));
    }
    if !arrangement.is_of_three() && (diameter.is_none() || duct.inner_diameter.is_none()) {
        let diameter = diameter.map(|diameter| diameter.quantity(DIAMETER)).transpose()?;
        return Ok((arrangement, diameter, 1.0));
    }
    let inner = root.table("duct")?.quantity("inner_diameter", INNER_DIAMETER)?;
    let diameter = table.quantity("diameter", DIAMETER)?;
    Ok((
        arrangement,
        Some(diameter),
        arrangement.normal_load_factor(inner, diameter),
    ))
}

fn friction(root: &Table) -> Result<Friction, SceneError> {
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
        let allowed = format!("{}; law = \"coulomb\" needs none", SHAPE_FACTOR.allowed());
        let shape_factor = table.required("shape_factor", &allowed)?.quantity(SHAPE_FACTOR)?;
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

fn ends(root: &Table) -> Result<Ends, SceneError> {
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
        let written = value.text(ALLOWED)?;
        let spring = Dimension::ForcePerLength.parse(&written);
        let meant = spring.map_or_else(
            |_| String::new(),
            |_| format!("; did you mean {{ spring = \"{written}\" }}?"),
        );
        let allowed = format!("{ALLOWED}{meant}");
        value.word_of(&[("free", End::Free), ("fixed", End::Fixed)], &allowed)
    }
}

fn restraints(root: &Table) -> Result<Vec<Restraint>, SceneError> {
    let Some(list) = root.optional("restraints") else {
        return Ok(Vec::new());
    };
    let items = list.items("a list of [[restraints]]")?;
    items.into_iter().map(restraint).collect()
}

fn restraint(item: Value) -> Result<Restraint, SceneError> {
    let table = Table::new(item)?;
    Ok(Restraint {
        position: table.quantity("position", POSITION)?,
        stiffness: table.quantity("stiffness", CLAMP)?,
    })
}

fn solver(root: &Table) -> Result<Solver, SceneError> {
    let mut solver = Solver::default();
    let Some(section) = root.optional("solver") else {
        return Ok(solver);
    };
    let table = Table::new(section)?;
    let gone = (
        "dynamic",
        "inertia is computed by \"explicit\", and below 200 km/h it changes next to nothing",
    );
    solver.method = table.word_unless("method", SolverMethod::WORDS, SolverMethod::Auto, gone)?;
    if let Some(tolerance) = table.optional_quantity("tolerance", TOLERANCE)? {
        solver.tolerance = tolerance;
    }
    solver.node_spacing = table.optional_quantity("node_spacing", STEP)?;
    solver.vehicle_step = table.optional_quantity("vehicle_step", STEP)?;
    solver.time_step = table.optional_quantity("time_step", TIME_STEP)?;
    if !solver.method.has_time_steps() {
        let allowed = "`time_step` only with the method \"auto\" or \"explicit\"";
        table.refuse("time_step", "method", allowed)?;
        solver.time_step = None;
    }
    solver.approach = table.optional_quantity("approach", APPROACH)?;
    Ok(solver)
}
