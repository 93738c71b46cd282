//! Writes `examples/data/synthetic-upper.csv`: a load cell's readings as they might be, for trying the calibration.
//!
//! Not a measurement. The forces are those of the explicit solver (masses, springs and friction by central differences), which the
//! calibration does not use, with Gaussian noise. The first line of the file says so.
//!
//! ```sh
//! cargo run --release --example synthetic_series > examples/data/synthetic-upper.csv
//! ```

use creepage::Scene;
use creepage::scene::{Law, SolverMethod};

const FRICTION: f64 = 0.25;
const SHAPE_FACTOR: f64 = 2e6;
const NOISE: f64 = 4.0;
const SEED: u64 = 1;
const PASSES: u64 = 40;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    scene.friction.dynamic_coefficient = FRICTION;
    (scene.friction.law, scene.friction.shape_factor) = (Law::ElasticPlastic, Some(SHAPE_FACTOR));
    scene.traffic.passes = PASSES;
    scene.solver.method = SolverMethod::Explicit;
    scene.solver.node_spacing = Some(0.1);
    let run = creepage::run(&scene)?;

    println!(
        "# SYNTHETIC, not measured: scene full-scale-upper.toml by the explicit solver (node spacing 0.1 m, the ground at rest between passes), dynamic_coefficient {FRICTION}, \
         shape_factor {SHAPE_FACTOR:e} 1/m, Gaussian noise of {NOISE} N, seed {SEED}"
    );
    println!("# made by examples/synthetic_series.rs");
    println!("pass,force_n");
    let mut random = fastrand::Rng::with_seed(SEED);
    for pass in &run.passes {
        // G. E. P. Box, M. E. Muller, Annals of Mathematical Statistics 29, 1958.
        let radius = (-2.0 * (1.0 - random.f64()).ln()).sqrt();
        let noise = NOISE * radius * (std::f64::consts::TAU * random.f64()).cos();
        println!("{},{:.1}", pass.pass, pass.downstream_force_n + noise);
    }
    Ok(())
}
