//! Figure 12 of the paper: force on the load cell against the passes, for both cables at 20, 30 and 40 km/h.
//!
//! K. Kashiro et al., section 4.2: the force levels off at about 550 N for the upper and 900 N for the lower cable, and does not depend on
//! the speed. The speeds are run here with the solver that has inertia in it, so that a dependence would show; the scenes' own solver,
//! without inertia, is drawn as lines.
//!
//! `cargo run --release --example figure_12`

pub mod common;

use common::{Failure, save, scene};
use creepage::figure::{Axis, Chart, Reference, Series};

/// A cable, its scene, and the force the paper reads off \[N\].
pub const CABLES: [(&str, &str, f64); 2] = [
    ("upper", "full-scale-upper.toml", 550.0),
    ("lower", "full-scale-lower.toml", 900.0),
];
/// \[km/h\]
pub const SPEEDS: [u32; 3] = [20, 30, 40];
/// Passes that are printed and drawn as points.
const LISTED: [usize; 10] = [1, 2, 5, 10, 20, 40, 60, 100, 150, 200];

/// Force at the load cell after each pass \[N\].
///
/// # Errors
///
/// Those of the scene and the run.
pub fn forces(scene_file: &str, overrides: &[String]) -> Result<Vec<f64>, Failure> {
    let run = creepage::run(&scene(scene_file, overrides)?)?;
    Ok(run.passes.iter().map(|pass| pass.downstream_force_n).collect())
}

/// What the explicit solver is told for a speed \[km/h\].
pub fn with_inertia(speed: u32) -> [String; 2] {
    [
        "solver.method=explicit".into(),
        format!("vehicles.0.speed={speed} km/h"),
    ]
}

fn main() -> Result<(), Failure> {
    let mut chart = Chart::new(
        "Figure 12: force on the load cell",
        Axis::linear("passes").range(0.0, 205.0),
        Axis::linear("force, N").range(0.0, 1000.0),
    );
    for (look, (name, file, paper)) in CABLES.into_iter().enumerate() {
        let label = format!("paper, {name}: about {paper} N");
        chart = chart.refer(Reference::horizontal(paper, label).colour(look));
        let quasi_static = forces(file, &[])?;
        let numbered = |forces: &[f64]| {
            (1u32..)
                .map(f64::from)
                .zip(forces.iter().copied())
                .collect::<Vec<_>>()
        };
        chart =
            chart.with(Series::line(format!("{name}, without inertia"), numbered(&quasi_static)).look(look));
        print!("{name:5}  pass      ");
        for pass in &LISTED {
            print!("{pass:8}");
        }
        print!("\n       no inertia");
        for pass in &LISTED {
            print!("{:8.1}", quasi_static[pass - 1]);
        }
        println!();
        for (k, speed) in SPEEDS.into_iter().enumerate() {
            let found = forces(file, &with_inertia(speed))?;
            print!("       {speed} km/h   ");
            for pass in &LISTED {
                print!("{:8.1}", found[pass - 1]);
            }
            println!();
            // Each speed at other passes, so that the markers do not hide one another.
            let points = numbered(&found).into_iter().skip(3 + 5 * k).step_by(15);
            let series = Series::points(format!("{name}, {speed} km/h"), points);
            chart = chart.with(series.colour(look).marker(k));
        }
        let last = quasi_static[quasi_static.len() - 1];
        println!(
            "       paper: about {paper} N; here {last:.1} N, {:+.0} %\n",
            100.0 * (last / paper - 1.0)
        );
    }
    save("figure-12.svg", &chart.to_svg()?)
}
