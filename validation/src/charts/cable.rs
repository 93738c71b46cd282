//! Chart 2: what the passes cost, by method, knob and accuracy.
//!
//! The full-scale experiment's upper cable in its duct of 30 m, and the same in 300 m, on the ground's closed form. The error is the
//! largest difference of the force at the load cell over the last half of 10, 100 and 1000 passes, as a share of it. Methods and
//! knobs: quasi-static and explicit on one mesh of so many nodes a depth of the duct, quasi-static with jumps over
//! passes, and the paper's own chain, explicit with the sigmoid law and its b.
//!
//! *Truth.* Quasi-static on a mesh at least three times as fine as any point that shares its method; how far it may be off is drawn
//! and stands in the table. No chart is drawn unless it agrees with the figures of an independent program that solves the whole cable
//! at every step. The sigmoid remembers nothing and tends to Coulomb's law as b
//! grows, so it is held against that.

use std::fmt::Write as _;
use std::path::Path;

use cable_dem::{Mesh, QuasiStatic};
use creepage::Scene;
use creepage::scene::Law;
use cycle_jump::{JumpError, Jumps, Next, Request, evolve};
use ground_field::DuctMotion;
use rayon::prelude::*;

use crate::passes::{APPROACH, Solver, cable, error, half_space_motion, simulate, truth};
use crate::precision::{Figure, Point};
use crate::stopwatch::timed;
use crate::{Failure, upper};

/// Accuracy of the duct's motion, as a share of its peak.
const MOTION: f64 = 1e-9;
/// Cells that take longer than this are left out \[s\].
const BUDGET: f64 = 10.0;
const LENGTHS: [f64; 2] = [30.0, 300.0];
const PASSES: [usize; 3] = [10, 100, 1000];
/// Nodes a depth of the truth, by length and passes; and of Coulomb's law with the most passes that the sigmoid is held against.
const TRUTHS: [[f64; 3]; 2] = [[96.0, 96.0, 48.0], [96.0, 48.0, 48.0]];
const COULOMB: [(f64, usize); 2] = [(48.0, 100), (48.0, 10)];
/// A quasi-static point is at least so many times coarser than the truth.
const COARSER: f64 = 3.0;
/// Nodes a depth.
const DENSITIES: [f64; 7] = [2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 24.0];
const JUMP_DENSITIES: [f64; 4] = [3.0, 6.0, 12.0, 24.0];
/// Error of a jump.
const JUMP: f64 = 1.25e-3;
/// b of the sigmoid \[1/m\], and nodes a depth.
const SHAPE_FACTORS: [f64; 6] = [1e7, 1e8, 1e9, 1e10, 1e11, 1e12];
const SIGMOID_DENSITY: f64 = 6.0;
/// Passes and forces \[N\] on the 30 m duct, by an independent program that solves the whole cable at every step.
const INDEPENDENT: [(usize, f64); 5] = [
    (1, 102.08),
    (5, 210.46),
    (10, 283.68),
    (60, 519.70),
    (200, 527.84),
];
/// By how much the truth may differ from them: that program's mesh is coarser.
const AGREEMENT: f64 = 3e-3;
/// Share of the force down to which errors are drawn.
const FLOOR: f64 = 1e-5;

/// A duct with its motion.
struct Case {
    scene: Scene,
    coulomb: Scene,
    motion: DuctMotion,
}

/// Forces after the passes, and how far they may be off.
type Truth = (Vec<f64>, f64);

impl Case {
    fn new(length: f64) -> Result<Self, Failure> {
        let scene = upper(&[format!("duct.length={length} m")])?;
        let mut coulomb = scene.clone();
        (coulomb.friction.law, coulomb.friction.shape_factor) = (Law::Coulomb, None);
        let motion = half_space_motion(&scene, MOTION)?;
        Ok(Self {
            scene,
            coulomb,
            motion,
        })
    }

    /// Forces after the last half of `passes` passes, `None` if they take too long, and the count of the work.
    fn answer(&self, method: Method, knob: f64, passes: usize) -> Result<Option<Found>, Failure> {
        let mut scene = self.scene.clone();
        let (solver, density) = match method {
            Method::Jumps => return self.jumps(knob, passes).map(Some),
            Method::Solver(solver) => (solver, knob),
            Method::Sigmoid => {
                (scene.friction.law, scene.friction.shape_factor) = (Law::Sigmoid, Some(knob));
                (Solver::Explicit, SIGMOID_DENSITY)
            }
        };
        let found = simulate(&scene, &self.motion, solver, density, passes, BUDGET)?;
        Ok(found.map(|answer| Found {
            forces: last_half(&answer.forces).to_vec(),
            node_updates: answer.node_updates,
        }))
    }

    fn jumps(&self, density: f64, passes: usize) -> Result<Found, Failure> {
        let (cable, depth) = (cable(&self.scene)?, self.scene.duct.depth);
        let mesh = Mesh::for_depth(cable.length(), depth, density)?;
        let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
        let passage = solver.passage(&self.motion, APPROACH)?;
        let motion = self.motion.peak_longitudinal();
        let least = (0.01 * cable.friction().limit(), 0.1 * motion);
        let jumps = Jumps::new(JUMP, depth, least)?.with_max_passes(passes as u64, passes as u64);
        let wanted: Vec<u64> = (half(passes)..=passes).map(|pass| pass as u64).collect();
        let mut request = Request::new(passes as u64, &[0])?;
        request.wanted = &wanted;
        let mut node_updates = 0;
        let evolution = evolve(&cable, &mesh, &jumps, &request, |_: Next, state| {
            let outcome = solver.pass(&passage, state)?;
            node_updates += outcome.statistics.node_updates;
            Ok::<_, JumpError>(outcome)
        })?;
        Ok(Found {
            forces: evolution
                .records
                .iter()
                .map(|record| record.outcome.force.downstream)
                .collect(),
            node_updates,
        })
    }
}

/// Forces after the last half of the passes.
struct Found {
    forces: Vec<f64>,
    node_updates: usize,
}

/// The first pass that counts.
fn half(passes: usize) -> usize {
    passes.div_ceil(2)
}

fn last_half(forces: &[f64]) -> &[f64] {
    &forces[half(forces.len()) - 1..]
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Method {
    Solver(Solver),
    Jumps,
    Sigmoid,
}

/// Name, method and knobs.
const METHODS: [(&str, Method, &[f64]); 4] = [
    ("quasi-static", Method::Solver(Solver::QuasiStatic), &DENSITIES),
    ("explicit", Method::Solver(Solver::Explicit), &DENSITIES),
    ("quasi-static with jumps", Method::Jumps, &JUMP_DENSITIES),
    ("explicit, sigmoid over b", Method::Sigmoid, &SHAPE_FACTORS),
];

/// One panel: a duct, a number of passes, and what is right there.
struct Panel<'a> {
    case: &'a Case,
    length: f64,
    passes: usize,
    density: f64,
    truth: Truth,
    coulomb: Option<&'a Truth>,
}

impl Panel<'_> {
    /// Measures every method; the rows of the table go to `table`.
    fn measure(&self, panel: usize, table: &mut String) -> Result<Vec<Point>, Failure> {
        let mut points = Vec::new();
        let (length, passes) = (self.length, self.passes);
        let (forces, uncertainty) = &self.truth;
        writeln!(
            table,
            "{length},{passes},truth,{},nodes a depth,{uncertainty:.3e},,,its own error",
            self.density
        )?;
        for (number, (name, method, knobs)) in METHODS.iter().enumerate() {
            let same = matches!(method, Method::Solver(Solver::QuasiStatic) | Method::Jumps);
            let finest = if same {
                self.density / COARSER
            } else {
                f64::INFINITY
            };
            let (unit, right) = match method {
                Method::Sigmoid => ("1/m", self.coulomb.map(|(forces, _)| &forces[..passes])),
                _ => ("nodes a depth", Some(&forces[..])),
            };
            let mut too_long = false;
            for &knob in knobs.iter().filter(|&&knob| knob <= finest) {
                let row = format!("{length},{passes},\"{name}\",{knob:e},{unit}");
                // What comes after a cell that takes too long takes longer.
                let answer = if too_long {
                    Ok((None, 0.0))
                } else {
                    timed(|| self.case.answer(*method, knob, passes))
                };
                let (found, seconds) = match answer {
                    Ok((Some(found), seconds)) => (found, seconds),
                    Ok((None, _)) => {
                        too_long = true;
                        writeln!(table, "{row},,,,left out: more than {BUDGET} s")?;
                        continue;
                    }
                    Err(refusal) => {
                        writeln!(table, "{row},,,,\"refused: {refusal}\"")?;
                        continue;
                    }
                };
                let right = right.ok_or_else(|| format!("{name}, {passes} passes: no truth"))?;
                let error = error(&found.forces, last_half(right));
                let count = found.node_updates;
                writeln!(table, "{row},{error:.3e},{seconds:.3e},{count},answered")?;
                points.push(Point {
                    panel,
                    series: number,
                    knob,
                    error,
                    seconds,
                    count: Some(count as f64),
                });
            }
        }
        Ok(points)
    }
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let cases = LENGTHS
        .map(Case::new)
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    // What is right takes longest and is not timed: on all cores, the longest first.
    let mut jobs: Vec<(usize, Option<usize>)> = vec![(1, Some(2)), (1, Some(1)), (0, Some(2)), (0, Some(1))];
    jobs.extend([(1, None), (0, None), (1, Some(0)), (0, Some(0))]);
    let found = jobs
        .par_iter()
        .with_max_len(1)
        .map(|&(duct, column)| {
            let case = &cases[duct];
            let (scene, density, passes) = match column {
                Some(column) => (&case.scene, TRUTHS[duct][column], PASSES[column]),
                None => (&case.coulomb, COULOMB[duct].0, COULOMB[duct].1),
            };
            truth(scene, &case.motion, density, passes, half(passes))
        })
        .collect::<Result<Vec<Truth>, _>>()?;
    let truth = |duct, column| {
        let job = jobs.iter().position(|&job| job == (duct, column));
        &found[job.expect("every truth is computed")]
    };

    let mut points = Vec::new();
    let mut table = String::from(
        "duct_m,passes,method,knob,knob_unit,error_share_of_force,processor_seconds,node_updates,outcome\n",
    );
    let mut uncertainties = Vec::new();
    for (duct, case) in cases.iter().enumerate() {
        for (column, &passes) in PASSES.iter().enumerate() {
            let panel = Panel {
                case,
                length: LENGTHS[duct],
                passes,
                density: TRUTHS[duct][column],
                truth: truth(duct, Some(column)).clone(),
                coulomb: (passes <= COULOMB[duct].1).then(|| truth(duct, None)),
            };
            if duct == 0 {
                agree(&panel.truth.0)?;
            }
            points.extend(panel.measure(uncertainties.len(), &mut table)?);
            uncertainties.push(panel.truth.1);
        }
    }
    crate::table::write(&out.join("cable.csv"), &table)?;
    let columns = LENGTHS
        .iter()
        .flat_map(|length| PASSES.map(|passes| (length, passes)));
    let names = columns.map(|(length, passes)| format!("duct of {length} m, {passes} passes"));
    let panels: Vec<(String, f64)> = names.zip(uncertainties).collect();
    let series = METHODS.map(|(name, ..)| name.to_owned());
    let errors = ("error, share of the force", (FLOOR, 2.0));
    let seconds = Figure {
        title: "Force at the load cell: error against processor time, by method",
        cost: ("processor time of all passes, s", (3e-4, 20.0)),
        error: errors,
    };
    let svg = seconds.draw(&panels, &series, &points, |point| Some(point.seconds))?;
    std::fs::write(out.join("cable.svg"), svg)?;
    let count = Figure {
        title: "Force at the load cell: error against work, by method",
        cost: ("nodes solved for or advanced", (1e4, 3e9)),
        error: errors,
    };
    let svg = count.draw(&panels, &series, &points, |point| point.count)?;
    std::fs::write(out.join("cable-count.svg"), svg)?;
    Ok(())
}

/// Refuses a truth that the independent program does not confirm.
fn agree(truth: &[f64]) -> Result<(), Failure> {
    for (pass, force) in INDEPENDENT {
        if let Some(found) = truth.get(pass - 1)
            && (found / force - 1.0).abs() > AGREEMENT
        {
            return Err(format!("pass {pass}: {found:.2} N where {force} N is known").into());
        }
    }
    Ok(())
}
