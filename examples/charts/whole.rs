//! Chart 3: `creepage run` as it plans by itself, against the same scenes forced onto the chain of Kashiro et al., finite elements and
//! explicit discrete elements.
//!
//! The planner is asked for 10 % to 0.1 % and for no mesh; its cost is that of everything it does, coarser meshes and the estimate
//! of its error among it. The paper's chain is given the benefit of every doubt: one mesh, no estimate, the longest safe time step.
//! The error is the largest difference of the force at the load cell over all passes, as a share of it.
//!
//! *Truth.* The ground by Hankel transform at 1e-9 (`burmister`, whatever the planner takes), the cable quasi-static on 96 nodes a
//! depth, four times as fine as any point that it judges.
//!
//! *Refused.* No figure is called good where a point of the chain is both cheaper and more accurate than one of the planner's, by time
//! or by count, or where the planner misses its tolerance: the program then ends with an error that says so.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use burmister::LayeredHalfSpace;
use creepage::Scene;
use creepage::figure::{Axis, Chart, Panels, Reference, Series};
use layered_fem::LayeredFem;

use crate::passes::{APPROACH_KEY, Solver, error, motion, simulate};
use crate::stopwatch::timed;

const TOLERANCES: [f64; 7] = [0.1, 0.05, 0.03, 0.01, 5e-3, 3e-3, 1e-3];
/// Nodes a depth of the explicit chain, and the accuracies of its finite elements.
const DENSITIES: [f64; 6] = [2.0, 3.0, 6.0, 12.0, 16.0, 24.0];
const ELEMENTS: [f64; 2] = [5e-3, 5e-4];
const TRUE_DENSITY: f64 = 96.0;
const TRUE_FIELD: f64 = 1e-9;
/// The motion follows the field's accuracy, a little looser.
const TRUE_MOTION: f64 = 1e-8;

/// Names, files of `examples/scenes`, and what is set on top of them.
const SCENES: [(&str, &str, &[&str]); 4] = [
    (
        "upper cable, 30 m, 30 passes",
        "full-scale-upper.toml",
        &["traffic.passes=30"],
    ),
    (
        "lower cable, 30 m, 100 passes",
        "full-scale-lower.toml",
        &["traffic.passes=100"],
    ),
    (
        // Kashiro et al., Table 1: the pavement; rock as in their finite elements' finite depth.
        "pavement of Table 1, rock at 12 m, 30 passes",
        "full-scale-upper.toml",
        &[
            "traffic.passes=30",
            "ground.rigid_base_depth=12 m",
            "ground.layers=[{ thickness = \"5 cm\", young_modulus = \"4000 MPa\", poisson_ratio = 0.35 }, \
             { thickness = \"5 cm\", young_modulus = \"800 MPa\", poisson_ratio = 0.35 }, \
             { young_modulus = \"800 MPa\", poisson_ratio = 0.4 }]",
        ],
    ),
    (
        "duct of 100 m, N6 pavement, lorry on wheels, 30 passes",
        "full-scale-upper.toml",
        &[
            "traffic.passes=30",
            "duct.length=100 m",
            "ground={ preset = \"n6-cbr6\" }",
            "vehicles.0={ preset = \"t-25\", speed = \"40 km/h\" }",
        ],
    ),
];

const SERIES: [&str; 3] = [
    "creepage run, tolerance 10 % to 0.1 %",
    "fem at 0.5 %, explicit",
    "fem at 0.05 %, explicit",
];

struct Point {
    scene: usize,
    series: usize,
    knob: f64,
    error: f64,
    seconds: f64,
    node_updates: u64,
}

fn read(index: usize) -> Result<Scene, Box<dyn Error>> {
    let (_, file, set) = SCENES[index];
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("examples/scenes")
        .join(file);
    let mut set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
    set.push(APPROACH_KEY.to_owned());
    Ok(Scene::from_file_with(&path, &set)?)
}

fn truth(scene: &Scene) -> Result<Vec<f64>, Box<dyn Error>> {
    let field = LayeredHalfSpace::new(&scene.ground.profile)?.with_accuracy(TRUE_FIELD)?;
    let motion = motion(scene, &field, TRUE_MOTION)?;
    let passes = usize::try_from(scene.traffic.passes)?;
    let answer = simulate(scene, &motion, Solver::QuasiStatic, TRUE_DENSITY, passes, false)?;
    Ok(answer.ok_or("the truth has no limit")?.forces)
}

/// Forces by the planner's choice, its count, and what it chose.
fn planned(scene: &Scene, tolerance: f64) -> Result<(Vec<f64>, u64, String), Box<dyn Error>> {
    let mut scene = scene.clone();
    scene.solver.tolerance = tolerance;
    let run = creepage::run(&scene)?;
    if run.passes.len() as u64 != scene.traffic.passes {
        return Err("not all passes are listed".into());
    }
    let forces = run.passes.iter().map(|pass| pass.downstream_force_n).collect();
    let choice = format!(
        "{} and {} at {:.4} m",
        run.plan.ground, run.plan.cable, run.plan.node_spacing_m
    );
    Ok((forces, run.cost.node_updates, choice))
}

/// Forces by the chain of Kashiro et al. and its count, `None` where that takes too long.
fn forced(scene: &Scene, accuracy: f64, density: f64) -> Result<Option<(Vec<f64>, u64)>, Box<dyn Error>> {
    let field = LayeredFem::new(&scene.ground.profile, accuracy)?;
    let motion = motion(scene, &field, accuracy)?;
    let passes = usize::try_from(scene.traffic.passes)?;
    let answer = simulate(scene, &motion, Solver::Explicit, density, passes, true)?;
    Ok(answer.map(|answer| (answer.forces, answer.node_updates as u64)))
}

pub fn run(out: &Path) -> Result<(), Box<dyn Error>> {
    let mut points = Vec::new();
    let mut table = String::from(
        "scene,series,knob,knob_unit,error_share_of_force,processor_seconds,node_updates,what\n",
    );
    for (index, (name, ..)) in SCENES.iter().enumerate() {
        let scene = read(index)?;
        let truth = truth(&scene)?;
        let mut add =
            |series: usize, knob: f64, unit: &str, found: (&[f64], u64), seconds: f64, what: &str| {
                let point = Point {
                    scene: index,
                    series,
                    knob,
                    error: error(found.0, &truth),
                    seconds,
                    node_updates: found.1,
                };
                writeln!(
                    table,
                    "\"{name}\",\"{}\",{knob},{unit},{:.3e},{seconds:.3e},{},{what}",
                    SERIES[series], point.error, point.node_updates
                )?;
                points.push(point);
                Ok::<(), std::fmt::Error>(())
            };
        for tolerance in TOLERANCES {
            let ((forces, updates, choice), seconds) = timed(|| planned(&scene, tolerance))?;
            add(0, tolerance, "tolerance", (&forces, updates), seconds, &choice)?;
        }
        for (series, accuracy) in ELEMENTS.into_iter().enumerate() {
            for density in DENSITIES {
                let (found, seconds) = timed(|| forced(&scene, accuracy, density))?;
                if let Some((forces, updates)) = found {
                    let unit = "nodes a depth";
                    add(
                        series + 1,
                        density,
                        unit,
                        (&forces, updates),
                        seconds,
                        "fem and explicit",
                    )?;
                }
            }
        }
    }
    std::fs::write(out.join("whole.csv"), table)?;
    std::fs::write(
        out.join("whole.svg"),
        figure(
            &points,
            "The whole run: error against processor time",
            "processor time, s",
            |point| point.seconds,
        )?,
    )?;
    std::fs::write(
        out.join("whole-count.svg"),
        figure(
            &points,
            "The whole run: error against work in the cable",
            "nodes solved for or advanced",
            |point| point.node_updates as f64,
        )?,
    )?;
    judge(&points)
}

/// Whether the planner keeps its tolerance and no point of the chain beats one of its own.
fn judge(points: &[Point]) -> Result<(), Box<dyn Error>> {
    let mut complaints = String::new();
    for point in points.iter().filter(|point| point.series == 0) {
        let scene = SCENES[point.scene].0;
        if point.error > point.knob {
            writeln!(
                complaints,
                "{scene}: {:.2e} where {:.0e} was asked",
                point.error, point.knob
            )?;
        }
        let rivals = points
            .iter()
            .filter(|rival| rival.series != 0 && rival.scene == point.scene);
        for rival in rivals.filter(|rival| rival.error < point.error) {
            let (faster, lighter) = (
                rival.seconds < point.seconds,
                rival.node_updates < point.node_updates,
            );
            if faster || lighter {
                writeln!(
                    complaints,
                    "{scene}, tolerance {}: {} with {} nodes a depth is more accurate ({:.1e} < {:.1e}) and {}",
                    point.knob,
                    SERIES[rival.series],
                    rival.knob,
                    rival.error,
                    point.error,
                    if faster { "faster" } else { "updates fewer nodes" }
                )?;
            }
        }
    }
    if complaints.is_empty() {
        Ok(())
    } else {
        Err(complaints.into())
    }
}

fn figure(
    points: &[Point],
    title: &str,
    label: &str,
    cost: impl Fn(&Point) -> f64,
) -> Result<String, Box<dyn Error>> {
    let mut panels = Panels::new(title).columns(2);
    for (index, (name, ..)) in SCENES.iter().enumerate() {
        let mut chart = Chart::new(
            *name,
            Axis::logarithmic(label),
            Axis::logarithmic("error, share of the force").range(1e-5, 1.0),
        )
        .refer(Reference::horizontal(1e-2, "1 %"))
        .refer(Reference::horizontal(1e-3, "0.1 %"));
        for (series, name) in SERIES.into_iter().enumerate() {
            let mine: Vec<(f64, f64)> = points
                .iter()
                .filter(|point| point.scene == index && point.series == series)
                .map(|point| (cost(point), point.error.max(1e-5)))
                .collect();
            chart = chart.with(Series::line_points(name, mine).look(series));
        }
        panels = panels.with(chart);
    }
    Ok(panels.to_svg()?)
}
