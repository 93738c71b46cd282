//! A document as a scene; here all sections but those of the ground and of traffic.

use std::path::Path;

use super::arrangement::CLOSEST;
use super::data::{
    Arrangement, Cable, Duct, End, Ends, Friction, FrictionLaw, Restraint, Scene, Solver, SolverMethod,
};
use super::document::Document;
use super::error::SceneError;
use super::range::{
    APPROACH, AXIAL_STIFFNESS, CLAMP, COEFFICIENT, DEPTH, DIAMETER, DUCT_LENGTH, Follows, INNER_DIAMETER,
    LATERAL_OFFSET, LOAD_FACTOR, POSITION, SHAPE_FACTOR, SLOPE, SPRING, STEP, TIME_STEP, TOLERANCE, WEIGHT,
    diameters, node_spacings, positions, shown, vehicle_steps,
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
    let restraints = restraints(&root, &duct)?;
    let (vehicles, traffic) = traffic::traffic(name, &root, ground.scaling)?;
    let heat = heat::heat(&root)?;
    let solver = solver(&root, &duct)?;
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
    is_held(&root, &scene)?;
    heat::is_possible(&root, &scene)?;
    Ok(scene)
}

/// Refuses a cable that slides out of its duct.
fn is_held(root: &Table, scene: &Scene) -> Result<(), SceneError> {
    let Ends { upstream, downstream } = scene.ends;
    let free = (upstream, downstream) == (End::Free, End::Free) && scene.restraints.is_empty();
    let (drawn, limit) = (scene.body_force().abs(), scene.friction_limit());
    match root.table("duct")?.optional("slope") {
        Some(slope) if free && drawn > 0.0 && drawn >= limit => {
            let steepest = shown(limit / (scene.cable.weight * scene.duct.cosine()));
            Err(slope.inconsistent(
                format!("{} between free ends, where the cable slides out of the duct", slope.written()),
                format!(
                    "a slope less than what friction holds, {steepest}, or an end or a clamp that holds the cable"
                ),
            ))
        }
        _ => Ok(()),
    }
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
    let room = diameters(inner, arrangement.is_of_three().then_some(CLOSEST));
    let diameter = table
        .required("diameter", &DIAMETER.allowed())?
        .quantity_within(DIAMETER, room)?;
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

fn restraints(root: &Table, duct: &Duct) -> Result<Vec<Restraint>, SceneError> {
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

fn solver(root: &Table, duct: &Duct) -> Result<Solver, SceneError> {
    let mut solver = Solver::default();
    let Some(section) = root.optional("solver") else {
        return Ok(solver);
    };
    let table = Table::new(section)?;
    // A length that must suit the duct.
    let length = |key, range: Follows| {
        let value = table.optional(key);
        value.map(|value| value.quantity_within(STEP, range)).transpose()
    };
    let gone = (
        "dynamic",
        "inertia is computed by \"explicit\", and below 200 km/h it changes next to nothing",
    );
    solver.method = table.word_unless("method", SolverMethod::WORDS, SolverMethod::Auto, gone)?;
    if let Some(tolerance) = table.optional_quantity("tolerance", TOLERANCE)? {
        solver.tolerance = tolerance;
    }
    solver.node_spacing = length("node_spacing", node_spacings(duct.length))?;
    solver.vehicle_step = length("vehicle_step", vehicle_steps(duct.length))?;
    solver.time_step = table.optional_quantity("time_step", TIME_STEP)?;
    if !solver.method.has_time_steps() {
        let allowed = "`time_step` only with the method \"auto\" or \"explicit\"";
        table.refuse("time_step", "method", allowed)?;
        solver.time_step = None;
    }
    solver.approach = table.optional_quantity("approach", APPROACH)?;
    Ok(solver)
}
