//! `creepage new`: a commented scene to start from.

use std::io::Write;
use std::path::PathBuf;

use super::failure::Failure;
use super::shared::Force;
use super::terminal;
use crate::Scene;
use crate::template::{Template, TemplateGround};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "What is not given is written with its default and a comment, to be edited in the file.

Examples:
  creepage new my-duct.toml
  creepage new my-duct.toml --length \"250 m\" --depth 0.9 --vehicle t-20 --friction 0.3
  creepage new my-duct.toml --pavement n6-cbr6 --downstream \"3 MN/m\" --passes 1000"
)]
pub struct Arguments {
    /// File to write; one that exists is replaced only with --force
    file: PathBuf,
    /// Title of the scene
    #[arg(long)]
    title: Option<String>,
    /// Length of the duct
    #[arg(long)]
    length: Option<String>,
    /// Depth of the cable below the road surface
    #[arg(long)]
    depth: Option<String>,
    /// Young's modulus of the ground, where it is one soil
    #[arg(long, conflicts_with = "pavement")]
    modulus: Option<String>,
    /// Preset of a pavement, in place of one soil
    #[arg(long, value_name = "PRESET")]
    pavement: Option<String>,
    /// Preset of the cable
    #[arg(long, value_name = "PRESET")]
    cable: Option<String>,
    /// Dynamic friction coefficient
    #[arg(long, value_name = "NUMBER")]
    friction: Option<String>,
    /// End at x = 0: free, fixed or a spring's stiffness
    #[arg(long, value_name = "END")]
    upstream: Option<String>,
    /// End at x = length: free, fixed or a spring's stiffness
    #[arg(long, value_name = "END")]
    downstream: Option<String>,
    /// Preset of the vehicle
    #[arg(long, value_name = "PRESET")]
    vehicle: Option<String>,
    /// Speed of the vehicle
    #[arg(long)]
    speed: Option<String>,
    /// Number of passes
    #[arg(long)]
    passes: Option<String>,
    #[command(flatten)]
    force: Force,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let name = arguments.file.display().to_string();
    let file = arguments.force.files([]).output(&arguments.file, "toml")?;
    // Whoever made a scene keeps it.
    if !arguments.force.force && file.path().is_file() {
        return Err(Failure::Usage {
            argument: "FILE",
            found: format!("{name}, which exists"),
            allowed: "the name of a new file: nothing is overwritten without --force".into(),
        });
    }
    let text = arguments.template().to_toml(&name)?;
    crate::check(&Scene::from_toml(&name, &text)?)?;
    file.write(|out| out.write_all(text.as_bytes()))?;
    writeln!(
        terminal::out(),
        "{name} is written; to compute: creepage run {name}"
    )?;
    Ok(())
}

impl Arguments {
    /// The template with what was given in place of its defaults.
    fn template(&self) -> Template {
        let usual = Template::default();
        let given = |given: &Option<String>, usual: String| given.clone().unwrap_or(usual);
        let modulus = || self.modulus.clone().map(TemplateGround::Modulus);
        let pavement = self.pavement.clone().map(TemplateGround::Pavement);
        Template {
            title: given(&self.title, usual.title),
            length: given(&self.length, usual.length),
            depth: given(&self.depth, usual.depth),
            ground: pavement.or_else(modulus).unwrap_or(usual.ground),
            cable: given(&self.cable, usual.cable),
            friction: given(&self.friction, usual.friction),
            upstream: given(&self.upstream, usual.upstream),
            downstream: given(&self.downstream, usual.downstream),
            vehicle: given(&self.vehicle, usual.vehicle),
            speed: given(&self.speed, usual.speed),
            passes: given(&self.passes, usual.passes),
        }
    }
}
