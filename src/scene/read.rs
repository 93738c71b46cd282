//! A document as a scene.

use std::path::Path;

use super::data::{Duct, Scene, Solver, SolverMethod};
use super::document::Document;
use super::error::SceneError;
use super::range::{APPROACH, Follows, STEP, TIME_STEP, TOLERANCE, node_spacings, vehicle_steps};
use super::table::Table;
use super::value::Value;
use super::{cable, ground, traffic};

/// The scene in the file `name`.
pub fn scene(name: &str, document: &Document) -> Result<Scene, SceneError> {
    let root = Table::new(Value::root(document))?;
    let title = match root.optional("title") {
        Some(value) => value.text("a text in quotes")?,
        None => Path::new(name)
            .file_stem()
            .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
    };
    let duct = cable::duct(&root)?;
    let ground = ground::ground(&root)?;
    let cable = cable::cable(&root)?;
    let friction = cable::friction(&root)?;
    let ends = cable::ends(&root)?;
    let restraints = cable::restraints(&root, &duct)?;
    let (vehicles, traffic) = traffic::traffic(&root, ground.scaling)?;
    let solver = solver(&root, &duct)?;
    Ok(Scene {
        title,
        duct,
        ground,
        cable,
        friction,
        ends,
        restraints,
        vehicles,
        traffic,
        solver,
    })
}

/// `[solver]`: how to compute.
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
    solver.method = table.word("method", SolverMethod::WORDS, SolverMethod::Auto)?;
    if let Some(tolerance) = table.optional_quantity("tolerance", TOLERANCE)? {
        solver.tolerance = tolerance;
    }
    solver.node_spacing = length("node_spacing", node_spacings(duct.length))?;
    solver.vehicle_step = length("vehicle_step", vehicle_steps(duct.length))?;
    solver.time_step = table.optional_quantity("time_step", TIME_STEP)?;
    if !solver.method.has_time_steps() {
        let allowed = "`time_step` only with the method \"auto\", \"dynamic\" or \"explicit\"";
        table.refuse("time_step", "method", allowed)?;
        solver.time_step = None;
    }
    solver.approach = table.optional_quantity("approach", APPROACH)?;
    Ok(solver)
}
