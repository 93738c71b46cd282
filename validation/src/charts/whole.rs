//! Chart 3: `creepage run` as it plans by itself, against the same scenes forced onto the chain of Kashiro et al., finite elements and
//! explicit discrete elements.
//!
//! The planner is asked for 10 % to 0.1 % and for no mesh; its cost is that of everything it does, coarser meshes and the estimate
//! of its error among it. The paper's chain is given the benefit of every doubt: one mesh, no estimate, the longest safe time step,
//! and elements no finer than the force needs. The error is the largest difference of the force at the load cell over all passes
//! that are listed, as a share of it.
//!
//! *Truth.* The ground by Hankel transform at 1e-9 (`burmister`, whatever the planner takes), every pass quasi-static on a mesh at least
//! twice as fine as the planner's at any tolerance; how far it may be off is drawn and stands in the table.
//!
//! *Refused.* No figure is called good where a point of the chain is both cheaper and more accurate than one of the planner's, by time
//! or by count, or where the planner misses its tolerance: the program then ends with an error that says so.

use std::fmt::Write as _;
use std::path::Path;

use burmister::LayeredHalfSpace;
use creepage::Scene;
use layered_fem::LayeredFem;
use rayon::prelude::*;

use crate::passes::{Solver, error, motion, simulate, truth};
use crate::precision::{Figure, Point};
use crate::stopwatch::timed;
use crate::{Failure, upper};

const TOLERANCES: [f64; 8] = [0.1, 0.05, 0.03, 0.02, 0.01, 5e-3, 3e-3, 1e-3];
/// Nodes a depth of the explicit chain, and the accuracy of its finite elements.
const DENSITIES: [f64; 7] = [2.0, 3.0, 4.0, 6.0, 12.0, 16.0, 24.0];
const ELEMENTS: f64 = 5e-3;
/// Cells of the chain that take longer than this are left out \[s\].
const BUDGET: f64 = 10.0;
const TRUE_FIELD: f64 = 1e-9;
/// The motion follows the field's accuracy, a little looser.
const TRUE_MOTION: f64 = 1e-8;
/// The same road for all that are compared.
const ROAD: &str = "solver.approach=15 m";
/// Share of the force down to which errors are drawn.
const FLOOR: f64 = 1e-5;

/// One panel: what is set on top of the full-scale experiment's upper cable, and how fine its truth is.
struct Panel {
    name: &'static str,
    set: &'static [&'static str],
    /// Nodes a depth of the truth.
    density: f64,
    /// Tolerances below this want a finer truth, which takes minutes, and are left out.
    tightest: f64,
}

const PANELS: [Panel; 4] = [
    Panel {
        name: "upper cable, 30 m, 30 passes",
        set: &["traffic.passes=30", ROAD],
        density: 192.0,
        tightest: 1e-3,
    },
    Panel {
        // Kashiro et al., Table 1: the pavement; rock as in their finite elements' finite depth.
        name: "pavement of Table 1, rock at 12 m, 30 m, 30 passes",
        set: &[
            "traffic.passes=30",
            ROAD,
            "ground.rigid_base_depth=12 m",
            "ground.layers=[{ thickness = \"5 cm\", young_modulus = \"4000 MPa\", poisson_ratio = 0.35 }, \
             { thickness = \"5 cm\", young_modulus = \"800 MPa\", poisson_ratio = 0.35 }, \
             { young_modulus = \"800 MPa\", poisson_ratio = 0.4 }]",
        ],
        density: 192.0,
        tightest: 1e-3,
    },
    Panel {
        name: "N6 pavement, lorry on wheels, 300 m, 10 passes",
        set: &[
            "traffic.passes=10",
            // A stiff slab moves farther from the wheel: 15 m would leave an error of 5 %.
            "solver.approach=40 m",
            "duct.length=300 m",
            "ground={ preset = \"n6-cbr6\" }",
            "vehicles.0={ preset = \"t-25\", speed = \"40 km/h\" }",
        ],
        density: 128.0,
        tightest: 1e-3,
    },
    Panel {
        name: "upper cable, 100 m, 5000 passes",
        set: &["traffic.passes=5000", "duct.length=100 m", ROAD],
        density: 48.0,
        tightest: 5e-3,
    },
];

const SERIES: [&str; 2] = ["creepage run, tolerance 10 % to 0.1 %", "fem and explicit"];

impl Panel {
    fn scene(&self) -> Result<Scene, Failure> {
        upper(self.set)
    }

    /// Forces after every pass, and how far they may be off.
    fn truth(&self) -> Result<(Vec<f64>, f64), Failure> {
        let scene = self.scene()?;
        let field = LayeredHalfSpace::new(&scene.ground.profile()?)?.with_accuracy(TRUE_FIELD)?;
        let motion = motion(&scene, &field, TRUE_MOTION)?;
        truth(
            &scene,
            &motion,
            self.density,
            usize::try_from(scene.traffic.passes)?,
            1,
        )
    }
}

/// Forces with the numbers of their passes, what it took, and what was chosen.
struct Found {
    passes: Vec<u64>,
    forces: Vec<f64>,
    node_updates: Option<u64>,
    choice: String,
}

fn planned(scene: &Scene, tolerance: f64) -> Result<Found, Failure> {
    let mut scene = scene.clone();
    scene.solver.tolerance = tolerance;
    let run = creepage::run(&scene)?;
    Ok(Found {
        passes: run.passes.iter().map(|record| record.pass).collect(),
        forces: run
            .passes
            .iter()
            .map(|record| record.downstream_force_n)
            .collect(),
        node_updates: (run.cost.node_updates > 0).then_some(run.cost.node_updates),
        choice: format!(
            "{} and {} at {:.4} m; estimate {:.2e}",
            run.plan.ground, run.plan.cable, run.plan.node_spacing_m, run.error_estimate.relative
        ),
    })
}

/// The chain of Kashiro et al.; `None` if that takes too long.
fn forced(scene: &Scene, density: f64) -> Result<Option<Found>, Failure> {
    let field = LayeredFem::new(&scene.ground.profile()?, ELEMENTS)?;
    let motion = motion(scene, &field, ELEMENTS)?;
    let passes = usize::try_from(scene.traffic.passes)?;
    let answer = simulate(scene, &motion, Solver::Explicit, density, passes, BUDGET)?;
    Ok(answer.map(|answer| Found {
        passes: (1..=scene.traffic.passes).collect(),
        forces: answer.forces,
        node_updates: Some(answer.node_updates as u64),
        choice: "fem and explicit".into(),
    }))
}

pub fn run(out: &Path) -> Result<(), Failure> {
    // What is right takes longest and is not timed: on all cores.
    let truths = PANELS
        .par_iter()
        .rev()
        .with_max_len(1)
        .map(Panel::truth)
        .collect::<Result<Vec<_>, _>>()?;
    let mut points = Vec::new();
    let mut table = String::from(
        "scene,series,knob,knob_unit,error_share_of_force,processor_seconds,node_updates,what\n",
    );
    for (index, (panel, (truth, uncertainty))) in PANELS.iter().zip(truths.iter().rev()).enumerate() {
        let (name, scene) = (panel.name, panel.scene()?);
        writeln!(
            table,
            "\"{name}\",truth,{},nodes a depth,{uncertainty:.3e},,,its own error",
            panel.density
        )?;
        let mut add = |series: usize, knob: f64, unit: &str, found: Option<Found>, seconds: f64| {
            let row = format!("\"{name}\",\"{}\",{knob},{unit}", SERIES[series]);
            let Some(found) = found else {
                return writeln!(table, "{row},,,,left out: more than {BUDGET} s");
            };
            let right: Vec<f64> = found
                .passes
                .iter()
                .map(|&pass| truth[pass as usize - 1])
                .collect();
            let error = error(&found.forces, &right);
            let count = found
                .node_updates
                .map_or_else(String::new, |count| count.to_string());
            points.push(Point {
                panel: index,
                series,
                knob,
                error,
                seconds,
                count: found.node_updates.map(|count| count as f64),
            });
            writeln!(table, "{row},{error:.3e},{seconds:.3e},{count},{}", found.choice)
        };
        for tolerance in TOLERANCES.into_iter().filter(|&asked| asked >= panel.tightest) {
            let (found, seconds) = timed(|| planned(&scene, tolerance))?;
            add(0, tolerance, "tolerance", Some(found), seconds)?;
        }
        let mut too_long = false;
        for density in DENSITIES {
            // What comes after a cell that takes too long takes longer.
            let (found, seconds) = if too_long {
                (None, 0.0)
            } else {
                timed(|| forced(&scene, density))?
            };
            too_long = found.is_none();
            add(1, density, "nodes a depth", found, seconds)?;
        }
    }
    crate::table::write(&out.join("whole.csv"), &table)?;
    let panels = PANELS.iter().zip(truths.iter().rev());
    let panels: Vec<(String, f64)> = panels
        .map(|(panel, truth)| (panel.name.to_owned(), truth.1))
        .collect();
    let series = SERIES.map(str::to_owned);
    let errors = ("error, share of the force", (FLOOR, 0.1));
    let seconds = Figure {
        title: "The whole run: error against processor time",
        cost: ("processor time, s", (1e-2, 60.0)),
        error: errors,
    };
    let svg = seconds.draw(&panels, &series, &points, |point| Some(point.seconds))?;
    std::fs::write(out.join("whole.svg"), svg)?;
    let count = Figure {
        title: "The whole run: error against work in the cable",
        cost: ("nodes solved for or advanced", (1e6, 5e9)),
        error: errors,
    };
    let svg = count.draw(&panels, &series, &points, |point| point.count)?;
    std::fs::write(out.join("whole-count.svg"), svg)?;
    judge(&points)
}

/// Whether the planner keeps its tolerance and no point of the chain beats one of its own.
fn judge(points: &[Point]) -> Result<(), Failure> {
    let mut complaints = String::new();
    for point in points.iter().filter(|point| point.series == 0) {
        let scene = PANELS[point.panel].name;
        if point.error > point.knob {
            writeln!(
                complaints,
                "{scene}: {:.2e} where {:.0e} was asked",
                point.error, point.knob
            )?;
        }
        let rivals = points
            .iter()
            .filter(|rival| rival.series != 0 && rival.panel == point.panel);
        for rival in rivals.filter(|rival| rival.error < point.error) {
            let (faster, lighter) = (rival.seconds < point.seconds, rival.count < point.count);
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
