//! `creepage new`: a commented scene to start from.

use std::io::Write;
use std::path::PathBuf;

use super::failure::Failure;
use super::outputs::Force;
use super::terminal;
use crate::{Scene, template};

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
    /// Young's modulus of the ground, if it is one soil
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
        let allowed = "the name of a new file: nothing is overwritten without --force";
        return Err(Failure::usage("FILE", format!("{name}, which exists"), allowed));
    }
    let text = template(&name, &arguments.values())?;
    crate::plan(&Scene::from_toml(&name, &text)?)?;
    file.write(text.as_bytes())?;
    let next = format!("{name} is written; to compute: creepage run {name}");
    Ok(writeln!(terminal::out(), "{next}")?)
}

impl Arguments {
    /// What was given, by the key of the scene.
    fn values(&self) -> Vec<(&str, &str)> {
        let given = [
            ("title", &self.title),
            ("duct.length", &self.length),
            ("duct.depth", &self.depth),
            ("ground.layers.young_modulus", &self.modulus),
            ("ground.preset", &self.pavement),
            ("cable.preset", &self.cable),
            ("friction.dynamic_coefficient", &self.friction),
            ("ends.upstream", &self.upstream),
            ("ends.downstream", &self.downstream),
            ("vehicles.preset", &self.vehicle),
            ("vehicles.speed", &self.speed),
            ("traffic.passes", &self.passes),
        ];
        let given = given.into_iter();
        given
            .filter_map(|(key, value)| Some((key, value.as_deref()?)))
            .collect()
    }
}
