//! Arguments of the command line.

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand};

use crate::calibration::Quantity;
use crate::scene::Dimension;

/// Predicts how power cables in underground ducts creep under traffic.
#[derive(Debug, Parser)]
#[command(name = "creepage", version, about, after_help = EXAMPLES)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "Examples:
  creepage new my-duct.toml
  creepage run my-duct.toml
  creepage run my-duct.toml --set friction.dynamic_coefficient=0.3 --csv forces.csv
  creepage profile my-duct.toml --positions -1.5,0,1.5 --json
  creepage calibrate my-duct.toml --data load-cell.csv --robust
  creepage report my-duct.toml -o my-duct.html";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Compute the force in the cable after every pass
    #[command(after_help = "Examples:
  creepage run my-duct.toml
  creepage run my-duct.toml --set friction.dynamic_coefficient=0.3 --set vehicles.0.load=15tf
  creepage run my-duct.toml --json > answer.json
  creepage run my-duct.toml --csv forces.csv --verify")]
    Run {
        #[command(flatten)]
        scene: SceneArguments,
        /// Measure the error by a second run one rung finer: half the node spacing and vehicle step, nothing left out of the ground
        #[arg(long)]
        verify: bool,
        #[command(flatten)]
        output: OutputArguments,
    },
    /// Show the motion of the duct under the first vehicle
    #[command(after_help = "Examples:
  creepage profile my-duct.toml
  creepage profile my-duct.toml --positions -1.5,0,1.5 --json
  creepage profile my-duct.toml --csv motion.csv")]
    Profile {
        #[command(flatten)]
        scene: SceneArguments,
        /// Positions along the duct, measured from the vehicle, in m: 0,0.5,1
        #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
        positions: Option<Vec<f64>>,
        #[command(flatten)]
        output: OutputArguments,
    },
    /// Show which models would be used and why, with estimated error and time, the rejected ones too
    #[command(after_help = "Examples:
  creepage plan my-duct.toml
  creepage plan my-duct.toml --set solver.tolerance=0.05 --json")]
    Plan {
        #[command(flatten)]
        scene: SceneArguments,
        /// Print one JSON document on standard output and nothing else there
        #[arg(long)]
        json: bool,
    },
    /// Fit friction and ground to what a load cell measured
    #[command(after_help = "Examples:
  creepage calibrate my-duct.toml --data forces.csv
  creepage calibrate my-duct.toml --data forces.csv --fit dynamic_coefficient,shape_factor --json")]
    Calibrate {
        #[command(flatten)]
        scene: SceneArguments,
        #[command(flatten)]
        calibrate: CalibrateArguments,
        #[command(flatten)]
        output: OutputArguments,
    },
    /// Check a scene without computing
    #[command(after_help = "Examples:
  creepage check my-duct.toml
  creepage check my-duct.toml --set ground.model=boussinesq")]
    Check {
        #[command(flatten)]
        scene: SceneArguments,
    },
    /// Compute a scene with many values of some keys, on all cores
    Sweep(Box<super::sweep::Arguments>),
    /// Find the end spring or clamp that keeps limits of force and movement
    Design(Box<super::design::Arguments>),
    /// Write one self-contained page with figures: what a meeting needs
    #[cfg(feature = "plot")]
    Report(Box<super::report::Arguments>),
    /// Write a commented scene to start from
    New(Box<super::new::Arguments>),
    /// List named values for vehicles, cables, friction and pavements, with their sources
    Presets(super::presets::Arguments),
    /// Print a script that completes commands and flags in a shell
    #[command(after_help = "Examples:
  creepage completions bash > ~/.local/share/bash-completion/completions/creepage
  creepage completions fish > ~/.config/fish/completions/creepage.fish")]
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
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
pub struct CalibrateArguments {
    /// Readings: CSV with the columns pass,force_n[,sigma_n], forces after the pass at the held end (the downstream one if both are)
    #[arg(long, value_name = "FILE")]
    pub data: PathBuf,
    /// What to fit: dynamic_coefficient, shape_factor, ground_stiffness (how many times stiffer than in the scene); by default the
    /// first two, with the law coulomb the first
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    pub fit: Vec<Quantity>,
    /// Measured deflection of the duct under the first vehicle, "115 um": prior knowledge of ground_stiffness, which is fitted too
    #[arg(long, value_name = "LENGTH", requires = "deflection_sigma", value_parser = positive_length)]
    pub deflection: Option<f64>,
    /// Standard deviation of the measured deflection, "15 um"
    #[arg(long, value_name = "LENGTH", requires = "deflection", value_parser = positive_length)]
    pub deflection_sigma: Option<f64>,
    /// Let outliers not count (Tukey's loss)
    #[arg(long)]
    pub robust: bool,
    /// Refit to so many replicates of the data as well, at least 10
    #[arg(long, value_name = "N")]
    pub bootstrap: Option<usize>,
    /// Seed of the replicates
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Most model runs, without those of the bootstrap
    #[arg(long, value_name = "N", default_value_t = 2000)]
    pub max_evaluations: usize,
}

#[derive(Debug, Args)]
pub struct OutputArguments {
    /// Print one JSON document on standard output and nothing else there
    #[arg(long)]
    pub json: bool,
    /// Write a table to this file; - is standard output, where nothing else is printed then
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    #[command(flatten)]
    pub force: Force,
}

/// Whether files that are not this command's own are replaced.
#[derive(Debug, Args)]
pub struct Force {
    /// Replace a file even if it is of another kind than what is written; a file that the command reads is never replaced
    #[arg(long)]
    pub force: bool,
}

/// What stands for standard output in place of a file.
pub const STDOUT: &str = "-";

impl OutputArguments {
    /// Whether the table goes to standard output.
    pub fn is_on_stdout(&self) -> bool {
        self.csv.as_deref() == Some(Path::new(STDOUT))
    }
}

fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("found \"{text}\"; allowed: a finite number in m")),
    }
}

fn positive_length(text: &str) -> Result<f64, String> {
    match Dimension::Length.parse_argument(text) {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        Ok(_) => Err(format!(
            "found \"{text}\"; allowed: a finite, positive length such as \"115 um\""
        )),
        Err(error) => Err(format!(
            "found \"{text}\": {error}; allowed: a length such as \"115 um\""
        )),
    }
}
