//! `creepage profile`: the motion of the duct under the first vehicle.

use std::io::Write;

use serde::Serialize;

use super::failure::Failure;
use super::outputs::OutputArguments;
use super::progress::watched;
use super::shared::{Input, SceneArguments, Threads};
use super::terminal;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  creepage profile my-duct.toml
  creepage profile my-duct.toml --positions -1.5,0,1.5 --json
  creepage profile my-duct.toml --csv motion.csv")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Positions along the duct, measured from the vehicle, in m: 0,0.5,1
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
    positions: Option<Vec<f64>>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: OutputArguments,
}

fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!(
            "found \"{text}\"; allowed: positions in m with commas between them, such as 0,0.5,1"
        )),
    }
}

#[derive(Serialize)]
struct Row {
    position_m: f64,
    longitudinal_m: f64,
    vertical_m: f64,
    longitudinal_velocity_m_per_s: f64,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let input = Input::read(&arguments.scene)?;
    let table = input.table();
    let read = [Some(&*arguments.scene.scene), table.as_deref()];
    let mut files = arguments.output.files(read.into_iter().flatten());
    let destination = arguments.output.destination(&mut files)?;
    let words = |_| "computing the ground".to_owned();
    let answer = watched(1.0, words, |_| match &arguments.positions {
        Some(positions) => crate::profile_at(&input.scene, positions),
        None => crate::profile(&input.scene),
    });
    let answer = input.located(answer)?;
    let row = |i: usize| Row {
        position_m: answer.positions_m[i],
        longitudinal_m: answer.longitudinal_m[i],
        vertical_m: answer.vertical_m[i],
        longitudinal_velocity_m_per_s: answer.longitudinal_velocity_m_per_s[i],
    };
    let rows: Vec<Row> = (0..answer.positions_m.len()).map(row).collect();
    destination.write(&answer, &rows, || print(&answer.ground, &rows))
}

fn print(ground: &str, rows: &[Row]) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(out, "ground: {ground}")?;
    let names = ["ξ, m", "D_l, µm", "D_v, µm", "V_l, µm/s"].map(str::to_owned);
    let cells = |row: &Row| {
        vec![
            format!("{:.3}", row.position_m),
            format!("{:.4}", 1e6 * row.longitudinal_m),
            format!("{:.4}", 1e6 * row.vertical_m),
            format!("{:.3}", 1e6 * row.longitudinal_velocity_m_per_s),
        ]
    };
    let rows: Vec<Vec<String>> = rows.iter().map(cells).collect();
    Ok(terminal::table(&mut out, &names, &rows)?)
}
