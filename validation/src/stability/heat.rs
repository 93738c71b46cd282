//! Map 6: days of heat and traffic, over the Q number, Q = q z²/(EA D) and the daily swing of the temperature.
//!
//! Above Q ≈ 3 the traffic moves no cable and heat is alone; the smaller Q, the more of friction's hold the traffic takes away. From a swing of
//! q L/(EA α) on heat slides the whole cable. Right is the simulation of every pass of every day, on the same mesh. The worst of a day's extreme
//! forces counts, as a share of the largest force of that day. The program has all its guards on.

use std::path::Path;

use creepage::figure::Panels;
use creepage::scene::SolverMethod;
use creepage::{DayExtremes, Run, Scene};

use crate::cable_map::{EA, LIMIT};
use crate::map::{DEPTH, Grid, decades};
use crate::{Failure, largest};

/// Asked of every run.
const TOLERANCE: f64 = 0.01;
/// Days of the drawn map.
const DAYS: u64 = 6;
/// Thermal expansion of copper \[1/K\].
const EXPANSION: f64 = 17e-6;
/// Nodes a depth: both ways leave the same error of the mesh.
const NODES: f64 = 6.0;
/// What becomes of a cell, in the order of [`Outcome`]; the legend's colours are those of the other maps.
const CLASSES: [&str; 6] = [
    "within 1 %, few real periods a day",
    "off by more than 1 % and than stated",
    "refused",
    "failed with an error",
    "off by more than 1 %, as stated",
    "within 1 %, real days simulated whole",
];
/// From this share of all passes on, the days that are simulated at all are simulated whole.
const WHOLE: f64 = 0.5;

/// A duct, what holds the cable in it, and its traffic.
pub struct Case {
    pub name: &'static str,
    length: f64,
    slope: &'static str,
    ends: [&'static str; 2],
    /// Vehicles forward and backward, in their order.
    sequence: &'static str,
    /// Whole numbers of times the sequence: days that follow from each other begin it anew.
    pub per_day: u64,
}

/// The rows of the figure.
pub const CASES: [Case; 3] = [
    Case {
        name: "30 m, free/fixed",
        length: 30.0,
        slope: "0 %",
        ends: ["\"free\"", "\"fixed\""],
        sequence: "0",
        per_day: 300,
    },
    Case {
        name: "36 m, free/free, 3 % slope",
        length: 36.0,
        slope: "3 %",
        ends: ["\"free\"", "\"free\""],
        sequence: "0",
        per_day: 240,
    },
    Case {
        name: "24 m, springs, two ways",
        length: 24.0,
        slope: "0 %",
        ends: ["{ spring = 1e6 }", "{ spring = 1e5 }"],
        sequence: "0, 1, 0",
        per_day: 300,
    },
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    Right,
    Wrong,
    Refused,
    Failed,
    Stated,
    RightWhole,
}

/// One scene.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    pub outcome: Outcome,
    /// True difference, and what the run says that days not simulated leave.
    pub error: f64,
    pub stated: f64,
    /// Share of the passes that were simulated.
    pub simulated: f64,
}

impl Case {
    /// The scene of one cell.
    pub fn scene(&self, number: f64, swing: f64, days: u64) -> Result<Scene, creepage::SceneError> {
        let Self {
            length,
            slope,
            ends: [upstream, downstream],
            sequence,
            per_day,
            ..
        } = self;
        let backward = if sequence.contains('1') {
            ", { name = \"1\", speed = 10, load = 196133, direction = \"reverse\" }"
        } else {
            ""
        };
        let names = sequence.replace('0', "\"0\"").replace('1', "\"1\"");
        let text = format!(
            "duct = {{ length = {length}, depth = {DEPTH}, slope = \"{slope}\" }}
ground = {{ longitudinal_peak = {}, layers = [{{ young_modulus = 8e8, poisson_ratio = 0.4 }}] }}
cable = {{ weight = {}, axial_stiffness = {EA} }}
friction = {{ dynamic_coefficient = 0.25, shape_factor = {} }}
ends = {{ upstream = {upstream}, downstream = {downstream} }}
vehicles = [{{ name = \"0\", speed = 10, load = 196133 }}{backward}]
traffic = {{ passes = {}, per_day = {per_day}, sequence = [{names}] }}
heat = {{ expansion = {EXPANSION}, daily_swing = {swing} }}
solver = {{ node_spacing = {}, vehicle_step = {}, tolerance = {TOLERANCE} }}",
            LIMIT * DEPTH * DEPTH / EA / number,
            LIMIT / 0.25,
            2e8 / LIMIT,
            days * per_day,
            DEPTH / NODES,
            0.5 * DEPTH / NODES,
        );
        Scene::from_toml("cell", &text)
    }

    fn cell(&self, number: f64, swing: f64, days: u64) -> Result<Cell, creepage::SceneError> {
        let mut scene = self.scene(number, swing, days)?;
        let mut run = |method| {
            scene.solver.method = method;
            creepage::run(&scene)
        };
        let (found, right) = match (run(SolverMethod::PassLaw), run(SolverMethod::QuasiStatic)) {
            (Ok(found), Ok(right)) => (found, right),
            (Err(creepage::Error::Inaccurate { .. } | creepage::Error::Jumps(_)), _) => {
                return Ok(unanswered(Outcome::Refused));
            }
            _ => return Ok(unanswered(Outcome::Failed)),
        };
        let (error, stated) = (worst(&found, &right), found.error_estimate.parts.temperature);
        let simulated = found.cost.simulated_passes as f64 / right.cost.simulated_passes as f64;
        Ok(Cell {
            outcome: if error <= TOLERANCE && simulated < WHOLE {
                Outcome::Right
            } else if error <= TOLERANCE {
                Outcome::RightWhole
            } else if error <= stated {
                Outcome::Stated
            } else {
                Outcome::Wrong
            },
            error,
            stated,
            simulated,
        })
    }

    /// A map of `numbers` × `swings` \[K\] cells over so many `days`.
    pub fn map(&self, numbers: usize, swings: usize, days: u64) -> Result<Grid<Cell>, creepage::SceneError> {
        let cell = |_, number, swing| self.cell(number, swing, days);
        Grid::fill(decades(-1.5, 0.7, numbers), decades(-0.3, 1.8, swings), cell)
    }

    /// Lines of the table.
    pub fn lines(&self, map: &Grid<Cell>) -> String {
        map.lines(|number, swing, cell| {
            format!(
                "{:?},{number:.5e},{swing:.5e},{:?},{:.5},{:.5},{:.4}",
                self.name, CLASSES[cell.outcome as usize], cell.error, cell.stated, cell.simulated
            )
        })
    }
}

/// How many cells came out so.
pub fn count(map: &Grid<Cell>, outcome: Outcome) -> usize {
    map.cells.iter().filter(|cell| cell.outcome == outcome).count()
}

fn unanswered(outcome: Outcome) -> Cell {
    Cell {
        outcome,
        error: f64::NAN,
        stated: f64::NAN,
        simulated: f64::NAN,
    }
}

/// Largest difference of an extreme force on any day, as a share of the largest force of that day.
fn worst(found: &Run, right: &Run) -> f64 {
    let forces = |day: &DayExtremes| {
        [
            day.downstream_max_n,
            day.downstream_min_n,
            day.upstream_max_n,
            day.upstream_min_n,
            day.max_compression_n,
            day.max_tension_n,
        ]
    };
    let days = found.days.iter().zip(&right.days);
    days.fold(0.0, |worst, (found, right)| {
        let apart = forces(found).into_iter().zip(forces(right)).map(|(a, b)| a - b);
        worst.max(largest(apart) / largest(forces(right)).max(0.01 * LIMIT))
    })
}

/// Draws the map.
pub fn run(out: &Path) -> Result<(), Failure> {
    let mut figure =
        Panels::new("Heat and traffic: extreme forces of six days, against the simulation of every pass")
            .columns(3)
            .panel_size(520.0, 460.0);
    let mut table = String::from("map,q_number,daily_swing_k,outcome,error,stated,simulated_share\n");
    for case in CASES {
        let map = case.map(7, 7, DAYS)?;
        let worst = map
            .cells
            .iter()
            .fold(0.0_f64, |worst, cell| worst.max(cell.error));
        let name = format!("{} (at most {:.1} % off)", case.name, 100.0 * worst);
        let right = count(&map, Outcome::Right) + count(&map, Outcome::RightWhole);
        println!("{name}: {right} of {} cells right", map.cells.len());
        let axes = [map.x_axis("Q = q z²/(EA D)"), map.y_axis("daily swing, K")];
        figure = figure.with(map.panel(&name, axes, CLASSES, |cell| cell.outcome as usize));
        table += &case.lines(&map);
    }
    crate::table::write(&out.join("stability-heat.csv"), &table)?;
    std::fs::write(out.join("stability-heat.svg"), figure.to_svg()?)?;
    Ok(())
}
