//! Chart 2: what the passes cost, by method, knob and accuracy.
//!
//! The full-scale experiment's upper cable in its duct of 30 m, and the same in 300 m, on the ground's closed form. The error is the
//! largest difference of the force at the load cell over the last half of 10, 100 and 1000 passes, as a share of it. Methods and
//! knobs: quasi-static, dynamic and explicit on one mesh of so many nodes a depth of the duct, the pass law with so many nodes in
//! its cells, and the paper's own chain, explicit with the sigmoid law and its b.
//!
//! *Truth.* Quasi-static on a mesh at least three times as fine as any quasi-static point of its panel; no chart is drawn unless it
//! agrees with the figures of an independent program that solves the whole cable at every step. The sigmoid remembers nothing and
//! tends to Coulomb's law as b grows, so it is held against that. The exact step (dynamic programming along the cable) is no method
//! of its own here: solvers take it where their iteration gives up, and it cannot be asked for.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use boussinesq::HalfSpace;
use creepage::Scene;
use creepage::figure::{Axis, Chart, Panels, Reference, Series};
use creepage::scene::FrictionLaw;
use ground_field::DuctMotion;
use pass_law::{PassLaw, Resolution};

use crate::passes::{APPROACH_KEY, Solver, cable, error, motion, simulate};
use crate::stopwatch::timed;

/// Accuracy of the duct's motion, as a share of its peak.
const MOTION: f64 = 1e-9;
const PASSES: [usize; 3] = [10, 100, 1000];
/// Lengths of the duct \[m\], and nodes a depth of the truth after [`PASSES`].
const DUCTS: [(f64, [f64; 3]); 2] = [(30.0, [96.0, 96.0, 48.0]), (300.0, [48.0, 48.0, 24.0])];
/// A quasi-static point is at least so many times coarser than the truth.
const COARSER: f64 = 3.0;
/// Coulomb's law, for the sigmoid, needs no finer mesh than this.
const COULOMB_DENSITY: f64 = 24.0;
/// Nodes a depth.
const DENSITIES: [f64; 8] = [2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0];
const LAW_DENSITIES: [f64; 5] = [3.0, 4.0, 6.0, 12.0, 24.0];
/// b of the sigmoid \[1/m\], and nodes a depth.
const SHAPE_FACTORS: [f64; 6] = [1e7, 1e8, 1e9, 1e10, 1e11, 1e12];
const SIGMOID_DENSITY: f64 = 6.0;
/// Passes and forces \[N\] on the 30 m duct, by an independent program that solves the whole cable at every step.
const INDEPENDENT: [(usize, f64); 5] = [(1, 113.35), (5, 223.25), (10, 297.5), (60, 534.8), (200, 542.2)];
/// By how much the truth may differ from them: that program's mesh is coarser.
const AGREEMENT: f64 = 3e-3;

/// A duct with its motion.
struct Case {
    scene: Scene,
    coulomb: Scene,
    motion: DuctMotion,
}

impl Case {
    fn new(length: f64) -> Result<Self, Box<dyn Error>> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes/full-scale-upper.toml");
        let set = [format!("duct.length={length} m"), APPROACH_KEY.to_owned()];
        let scene = Scene::from_file_with(&path, &set)?;
        let mut coulomb = scene.clone();
        coulomb.friction.law = FrictionLaw::Coulomb;
        let soil = scene.ground.profile.homogeneous().ok_or("the scene has layers")?;
        let motion = motion(&scene, &HalfSpace::new(soil), MOTION)?;
        Ok(Self {
            scene,
            coulomb,
            motion,
        })
    }

    /// Forces after the last half of `passes` passes, `None` where they take too long, and the count of the work.
    fn answer(&self, method: Method, knob: f64, passes: usize) -> Result<Option<Found>, Box<dyn Error>> {
        let (solver, density, scene) = match method {
            Method::PassLaw => return self.law(knob, passes).map(Some),
            Method::Solver(solver) => (solver, knob, &self.scene),
            Method::Sigmoid => {
                let mut scene = self.scene.clone();
                scene.friction.law = FrictionLaw::Sigmoid { shape_factor: knob };
                let found = simulate(
                    &scene,
                    &self.motion,
                    Solver::Explicit,
                    SIGMOID_DENSITY,
                    passes,
                    true,
                )?;
                return Ok(found.map(|answer| Found::new(&answer.forces, answer.node_updates)));
            }
        };
        let found = simulate(scene, &self.motion, solver, density, passes, true)?;
        Ok(found.map(|answer| Found::new(&answer.forces, answer.node_updates)))
    }

    fn law(&self, density: f64, passes: usize) -> Result<Found, Box<dyn Error>> {
        let resolution = Resolution::new(self.scene.duct.depth)?
            .with_nodes_per_depth(density)?
            .with_approach(self.scene.solver.approach.ok_or("the scene has no approach")?)?;
        let law = PassLaw::new(&cable(&self.scene)?, &[(self.motion.clone(), 1.0)], resolution)?;
        if let Some(concern) = law.concerns().into_iter().find(|concern| concern.is_fatal()) {
            return Err(concern.to_string().into());
        }
        let wanted: Vec<u64> = (passes.div_ceil(2)..=passes).map(|pass| pass as u64).collect();
        let run = law.run(&wanted)?;
        Ok(Found {
            forces: run.records.iter().map(|record| record.downstream_force).collect(),
            node_updates: None,
        })
    }

    fn truth(&self, scene: &Scene, density: f64, passes: usize) -> Result<Vec<f64>, Box<dyn Error>> {
        let answer = simulate(scene, &self.motion, Solver::QuasiStatic, density, passes, false)?;
        Ok(answer.ok_or("the truth has no limit")?.forces)
    }
}

/// Forces after the last half of the passes.
struct Found {
    forces: Vec<f64>,
    /// The pass law does not count them.
    node_updates: Option<usize>,
}

impl Found {
    fn new(forces: &[f64], node_updates: usize) -> Self {
        Self {
            forces: last_half(forces).to_vec(),
            node_updates: Some(node_updates),
        }
    }
}

fn last_half(forces: &[f64]) -> &[f64] {
    &forces[forces.len().div_ceil(2) - 1..]
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Method {
    Solver(Solver),
    PassLaw,
    Sigmoid,
}

/// Name, method and knobs.
const METHODS: [(&str, Method, &[f64]); 5] = [
    ("quasi-static", Method::Solver(Solver::QuasiStatic), &DENSITIES),
    ("dynamic", Method::Solver(Solver::Dynamic), &DENSITIES),
    ("explicit", Method::Solver(Solver::Explicit), &DENSITIES),
    ("pass law", Method::PassLaw, &LAW_DENSITIES),
    ("explicit, sigmoid over b", Method::Sigmoid, &SHAPE_FACTORS),
];

/// One point of the chart.
struct Point {
    panel: usize,
    method: usize,
    error: f64,
    seconds: f64,
    node_updates: Option<usize>,
}

pub fn run(out: &Path) -> Result<(), Box<dyn Error>> {
    let mut points = Vec::new();
    let mut table = String::from(
        "duct_m,passes,method,knob,knob_unit,error_share_of_force,processor_seconds,node_updates,outcome\n",
    );
    let mut panel = 0;
    for (length, densities) in DUCTS {
        let case = Case::new(length)?;
        let coulomb = case.truth(
            &case.coulomb,
            COULOMB_DENSITY,
            PASSES[2].min(passes_of_coulomb(length)),
        )?;
        for (passes, density) in PASSES.into_iter().zip(densities) {
            let truth = case.truth(&case.scene, density, passes)?;
            if length == DUCTS[0].0 {
                agree(&truth)?;
            }
            for (number, (name, method, knobs)) in METHODS.iter().enumerate() {
                let unit = if *method == Method::Sigmoid {
                    "1/m"
                } else {
                    "nodes a depth"
                };
                let truth = match method {
                    Method::Sigmoid if passes > coulomb.len() => continue,
                    Method::Sigmoid => last_half(&coulomb[..passes]),
                    _ => last_half(&truth),
                };
                let finest = match method {
                    Method::Solver(Solver::QuasiStatic) => density / COARSER,
                    _ => f64::INFINITY,
                };
                for &knob in knobs.iter().filter(|&&knob| knob <= finest) {
                    let row = format!("{length},{passes},\"{name}\",{knob:e},{unit}");
                    let found = match timed(|| case.answer(*method, knob, passes)) {
                        Ok((Some(found), seconds)) => (found, seconds),
                        Ok((None, _)) => {
                            writeln!(table, "{row},,,,left out: more than ten seconds")?;
                            continue;
                        }
                        Err(refusal) => {
                            writeln!(table, "{row},,,,\"refused: {refusal}\"")?;
                            continue;
                        }
                    };
                    let (Found { forces, node_updates }, seconds) = found;
                    let error = error(&forces, truth);
                    let count = node_updates.map_or_else(String::new, |count| count.to_string());
                    writeln!(table, "{row},{error:.3e},{seconds:.3e},{count},answered")?;
                    points.push(Point {
                        panel,
                        method: number,
                        error,
                        seconds,
                        node_updates,
                    });
                }
            }
            panel += 1;
        }
    }
    std::fs::write(out.join("cable.csv"), table)?;
    std::fs::write(
        out.join("cable.svg"),
        figure(
            &points,
            "Force at the load cell: error against processor time, by method",
            "processor time of all passes, s",
            |point| Some(point.seconds),
        )?,
    )?;
    std::fs::write(
        out.join("cable-count.svg"),
        figure(
            &points,
            "Force at the load cell: error against work, by method",
            "nodes solved for or advanced",
            |point| point.node_updates.map(|count| count as f64),
        )?,
    )?;
    Ok(())
}

/// The sigmoid in the long duct is followed for 100 passes: more would take minutes.
fn passes_of_coulomb(length: f64) -> usize {
    if length > DUCTS[0].0 { PASSES[1] } else { PASSES[2] }
}

/// Refuses a truth that the independent program does not confirm.
fn agree(truth: &[f64]) -> Result<(), Box<dyn Error>> {
    for (pass, force) in INDEPENDENT {
        if let Some(found) = truth.get(pass - 1)
            && (found / force - 1.0).abs() > AGREEMENT
        {
            return Err(format!("pass {pass}: {found:.2} N where {force} N is known").into());
        }
    }
    Ok(())
}

fn figure(
    points: &[Point],
    title: &str,
    label: &str,
    cost: impl Fn(&Point) -> Option<f64>,
) -> Result<String, Box<dyn Error>> {
    let mut panels = Panels::new(title).columns(2);
    for (row, passes) in PASSES.into_iter().enumerate() {
        for (column, (length, _)) in DUCTS.into_iter().enumerate() {
            let mut chart = Chart::new(
                format!("duct of {length} m, {passes} passes"),
                Axis::logarithmic(label),
                Axis::logarithmic("error, share of the force").range(1e-4, 2.0),
            )
            .refer(Reference::horizontal(1e-2, "1 %"))
            .refer(Reference::horizontal(1e-3, "0.1 %"));
            for (number, (name, ..)) in METHODS.iter().enumerate() {
                let mine: Vec<(f64, f64)> = points
                    .iter()
                    .filter(|point| point.panel == PASSES.len() * column + row && point.method == number)
                    .filter_map(|point| Some((cost(point)?, point.error)))
                    .filter(|(_, error)| error.is_finite() && *error > 0.0)
                    .collect();
                if !mine.is_empty() {
                    chart = chart.with(Series::line_points(*name, mine).look(number));
                }
            }
            panels = panels.with(chart);
        }
    }
    Ok(panels.to_svg()?)
}
