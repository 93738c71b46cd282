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
    let mut out = terminal::out();
    writeln!(
        out,
        "{}: valid; {} passes over a duct of {} m at {} m depth",
        terminal::line(&input.scene.title),
        input.scene.traffic.passes,
        input.scene.duct.length,
        input.scene.duct.depth
    )?;
    Ok(())
}
