//! `creepage check`: whether a scene is valid.

use std::io::Write;

use super::failure::Failure;
use super::shared::{Input, SceneArguments};
use super::terminal;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  creepage check my-duct.toml
  creepage check my-duct.toml --set ground.model=boussinesq")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::read(&arguments.scene)?;
    let plan = input.located(crate::plan(&input.scene))?;
    input.warn_all(&plan.report().warnings);
    let (scene, title) = (&input.scene, terminal::line(&input.scene.title));
    let (passes, length, depth) = (scene.traffic.passes, scene.duct.length, scene.duct.depth);
    let words = format!("valid; {passes} passes over a duct of {length} m at {depth} m depth");
    Ok(writeln!(terminal::out(), "{title}: {words}")?)
}
