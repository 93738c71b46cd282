//! Friction and shape factor from the readings of a load cell, with what the readings determine.
//!
//! `cargo run --release --example calibrate_readings`

use creepage::{CalibrateOptions, Readings, Scene, calibrate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    let file = "examples/data/synthetic-upper.csv";
    let readings = Readings::from_csv(file, &std::fs::read(file)?)?;
    let answer = calibrate(&scene, &readings, &CalibrateOptions::default())?;
    for parameter in &answer.parameters {
        let end = |end: Option<f64>| end.map_or("open".to_owned(), |end| format!("{end:.3e}"));
        let [low, high] = parameter.interval_95.map(end);
        println!(
            "{}: {:.3e}, 95 % from {low} to {high}",
            parameter.name, parameter.value
        );
    }
    for warning in &answer.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}
