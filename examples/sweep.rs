//! What friction and depth do to the force: a table of all combinations, and what uncertain friction makes of it.
//!
//! `cargo run --release --example sweep`

use creepage::SceneFile;
use creepage::sweep::{Axis, Samples, Sweep, SweepOptions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = SceneFile::read("examples/scenes/full-scale-upper.toml")?.with(&["traffic.passes=50"])?;
    let depths = Axis::parse("duct.depth=0.9m,1.2m,2m")?;
    let table = std::env::temp_dir().join("depths-and-friction.csv");
    let all = vec![
        depths.clone(),
        Axis::parse("friction.dynamic_coefficient=0.2:0.4:0.1")?,
    ];
    let sweep = Sweep::new(scene.clone(), all, Samples::default())?;
    let summary = sweep.run(&table, &SweepOptions::default())?;
    println!(
        "{} points, {} failed: {}",
        summary.points,
        summary.failed,
        table.display()
    );

    let drawn = Axis::parse("friction.dynamic_coefficient=normal(0.3, 0.03)")?;
    let samples = Samples { count: 40, seed: 1 };
    let table = table.with_file_name("uncertain-friction.csv");
    let summary = Sweep::new(scene, vec![depths, drawn], samples)?.run(&table, &SweepOptions::default())?;
    for band in &summary.bands {
        if let Some(force) = &band.downstream_force_n {
            println!(
                "{:?}: 5 to 95 % of forces from {:.0} to {:.0} N",
                band.at, force.p05, force.p95
            );
        }
    }
    Ok(())
}
