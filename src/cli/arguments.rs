//! Arguments of the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Predicts how power cables in underground ducts creep under traffic.
#[derive(Debug, Parser)]
#[command(name = "creepage", version, about, after_help = EXAMPLES)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "Examples:
  creepage run examples/scenes/full-scale-upper.toml
  creepage run my-duct.toml --set friction.dynamic_coefficient=0.3 --csv forces.csv
  creepage profile my-duct.toml --positions -1.5,0,1.5 --json";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Compute the force in the cable after every pass
    Run {
        #[command(flatten)]
        scene: SceneArguments,
        /// Measure the error by a second run with half the node spacing and vehicle step
        #[arg(long)]
        verify: bool,
        #[command(flatten)]
        output: OutputArguments,
    },
    /// Show the motion of the duct under the first vehicle
    Profile {
        #[command(flatten)]
        scene: SceneArguments,
        /// Positions along the duct, measured from the vehicle, in m: 0,0.5,1
        #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
        positions: Option<Vec<f64>>,
        #[command(flatten)]
        output: OutputArguments,
    },
    /// Check a scene without computing
    Check {
        #[command(flatten)]
        scene: SceneArguments,
    },
    /// List named values for vehicles, cables, friction and pavements, with their sources
    Presets(super::presets::Arguments),
}

#[derive(Debug, Args)]
pub struct SceneArguments {
    /// Scene file (TOML)
    pub scene: PathBuf,
    /// Override a key of the scene, such as friction.dynamic_coefficient=0.3; may be repeated
    #[arg(long, value_name = "KEY=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
}

#[derive(Debug, Args)]
pub struct OutputArguments {
    /// Print one JSON document on standard output and nothing else there
    #[arg(long)]
    pub json: bool,
    /// Write a table to this file
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("found \"{text}\"; allowed: a finite number in m")),
    }
}
