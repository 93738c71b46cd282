//! Draws the force at the fixed end of 100 m of duct against the passes: few simulated passes with jumps between them, and the
//! simulation of every pass.
//!
//! `cargo run --release --example long_term`

mod common;

use creepage::figure::{Axis, Chart, Series};
use creepage::scene::SolverMethod;
use creepage::{PassRecord, Run, Scene};

/// Passes of either run.
const SIMULATED: u64 = 1500;
const LAST: u64 = 100_000;
/// Passes that are drawn of the simulation of every one.
const SHOWN: [u64; 15] = [1, 2, 3, 5, 8, 12, 20, 35, 60, 100, 170, 300, 500, 850, 1500];

fn points<'a>(passes: impl Iterator<Item = &'a PassRecord>) -> Vec<(f64, f64)> {
    passes
        .map(|record| (record.pass as f64, record.downstream_force_n))
        .collect()
}

fn main() -> Result<(), common::Failure> {
    let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    scene.duct.length = 100.0;
    let run = |scene: &mut Scene, method, passes| -> Result<Run, common::Failure> {
        (scene.solver.method, scene.traffic.passes) = (method, passes);
        Ok(creepage::run(scene)?)
    };
    let every = run(&mut scene, SolverMethod::QuasiStatic, SIMULATED)?;
    let jumps = run(&mut scene, SolverMethod::PassLaw, LAST)?;
    let simulated = jumps.passes.iter().filter(|record| !record.interpolated);
    println!("{} of {LAST} passes simulated", jumps.cost.simulated_passes);

    let chart = Chart::new(
        "Force at the fixed end of 100 m of duct",
        Axis::logarithmic("passes").range(1.0, LAST as f64),
        Axis::linear("force, N"),
    )
    .with(Series::line("with jumps", points(jumps.passes.iter())))
    .with(Series::points(
        "passes simulated for it and listed",
        points(simulated),
    ))
    .with(Series::points(
        "every pass simulated",
        points(every.passes.iter().filter(|record| SHOWN.contains(&record.pass))),
    ));
    common::save("long-term.svg", &chart.to_svg()?)
}
