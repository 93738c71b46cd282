//! `creepage presets`: the named values and where they are from.

use std::io::Write;

use super::failure::Failure;
use super::outputs::Json;
use super::terminal;
use crate::presets::{Preset, PresetKind, all};
use crate::scene::{did_you_mean, nearest};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  creepage presets
  creepage presets t-25
  creepage presets --json")]
pub struct Arguments {
    /// Show this preset with its values as a scene file has them
    name: Option<String>,
    #[command(flatten)]
    json: Json,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let chosen: Vec<&Preset> = match &arguments.name {
        None => all().iter().collect(),
        Some(name) => vec![find(name)?],
    };
    arguments
        .json
        .print(&chosen, || print(&chosen, arguments.name.is_some()))
}

fn print(chosen: &[&Preset], with_values: bool) -> Result<(), Failure> {
    let mut out = terminal::out();
    let mut kind = None;
    for group in chosen.chunk_by(|a, b| a.kind == b.kind && a.sources == b.sources) {
        if kind != Some(group[0].kind) {
            kind = Some(group[0].kind);
            writeln!(out, "{}", heading(group[0].kind))?;
        }
        for preset in group {
            writeln!(out, "  {:<22} {}", preset.name, preset.summary)?;
            if with_values {
                writeln!(out, "\n{}", preset.toml)?;
            }
        }
        for source in &group[0].sources {
            let mark = if source.assumed { "ASSUMED, " } else { "" };
            writeln!(out, "      {}: {mark}{}", source.key, source.source)?;
        }
        writeln!(out)?;
    }
    writeln!(
        out,
        "In a scene: preset = \"NAME\" in that section; keys given next to a preset override it."
    )?;
    Ok(())
}

fn heading(kind: PresetKind) -> &'static str {
    match kind {
        PresetKind::Vehicle => "[[vehicles]]",
        PresetKind::Cable => "[cable]",
        PresetKind::Friction => "[friction]",
        PresetKind::Pavement => "[ground]",
    }
}

fn find(name: &str) -> Result<&'static Preset, Failure> {
    all().iter().find(|preset| preset.name == name).ok_or_else(|| {
        let names: Vec<&str> = all().iter().map(|preset| preset.name.as_str()).collect();
        let meant = did_you_mean(nearest(name, names.iter().copied()));
        let allowed = format!("a name that `creepage presets` lists: {}", names.join(", "));
        Failure::usage("NAME", format!("`{name}`{meant}"), allowed)
    })
}
