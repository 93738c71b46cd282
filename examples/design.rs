//! How stiff may what holds the joint be, if it bears at most 300 N and moves by at most 3 mm?
//!
//! `cargo run --release --example design`

use creepage::design::{DesignOptions, design};
use creepage::{Limits, Place, Scene};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    scene.traffic.passes = 100;
    let mut limits = Limits::default();
    (limits.downstream.force_n, limits.downstream.movement_m) = (Some(300.0), Some(3e-3));
    let answer = design(&scene, &DesignOptions::new(Place::Downstream, limits))?;
    let said = match (&answer.answer, answer.range_n_per_m) {
        (Some(_), Some((low, Some(high)))) => {
            format!("a spring from {:.0} to {:.0} kN/m", 1e-3 * low, 1e-3 * high)
        }
        (Some(_), Some((low, None))) => format!("a spring from {:.0} kN/m on, or a fixed end", 1e-3 * low),
        _ => "no spring keeps both limits".to_owned(),
    };
    println!("{said}");
    Ok(())
}
