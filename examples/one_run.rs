//! One run of one scene: the force on the joint, and what the answer is worth.
//!
//! `cargo run --release --example one_run`

use creepage::Scene;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    let run = creepage::run(&scene)?;
    for record in run
        .passes
        .iter()
        .filter(|record| [1, 10, 50, 200].contains(&record.pass))
    {
        println!(
            "after pass {:3}: {:.0} N on the joint",
            record.pass, record.downstream_force_n
        );
    }
    if let Some(saturation) = &run.saturation {
        println!("levels off at {:.0} N", saturation.force_n);
    }
    println!("estimated error: {:.2} %", 100.0 * run.error_estimate.relative);
    Ok(())
}
