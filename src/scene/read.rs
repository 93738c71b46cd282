//! A document as a scene.

use std::path::Path;

use super::data::Scene;
use super::document::Document;
use super::error::SceneError;
use super::table::Table;
use super::value::Value;
use super::{cable, ground, keys, solver, traffic};

/// The scene in the file `name`.
pub fn scene(name: &str, document: &Document) -> Result<Scene, SceneError> {
    let root = Table::new(Value::root(document), keys::SCENE)?;
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
    let solver = solver::solver(&root, &duct)?;
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
