//! Map 5: jumps over passes, over the duct's length in depths, the friction number EA·D/(q z²) and the mix of the traffic.
//!
//! The friction number compares the largest longitudinal displacement D of the duct with the displacement q z²/EA that
//! friction can impose on the cable over a depth z: small, the cable follows its duct; large, it is dragged through. Right is
//! the simulation of every pass, on the same mesh. The worst of the forces on the held end after `PASSES` counts, as a share of the
//! larger of the right one and a tenth of the largest. With guards, jumps are held
//! to simulated passes. Without them, jumps of fixed lengths are taken whatever their error.

use std::path::Path;

use boussinesq::HalfSpace;
use cable_dem::{CableError, CableState, DuctedCable, FrictionLaw, Mesh, PassOutcome, Passage, QuasiStatic};
use creepage::figure::Panels;
use creepage::scene::SolverMethod;
use creepage::{Run, Scene};
use cycle_jump::{Guide, JumpError, Jumps, Next, Request, evolve};
use ground_field::{Direction, DuctLine, DuctMotion, Soil, Vehicle};

use crate::Failure;
use crate::cable_map::{EA, LIMIT, cable, judge, panels, silent};
use crate::map::{Cell, DEPTH, Grid, Outcome, WRONG, decades};

/// Passes after which forces are compared.
const PASSES: [u64; 5] = [20, 60, 120, 240, 600];
const APPROACH: f64 = 48.0;
/// Nodes a depth.
const NODES: f64 = 6.0;
/// Error of a jump.
const TOLERANCE: f64 = 5e-3;
/// Lengths of jumps that nothing holds to simulated passes.
const BLIND: [u64; 2] = [60, 500];
/// Traffic: vehicles forward and backward, in their order.
pub const MIXES: [(&str, &[usize]); 3] = [
    ("one way", &[0]),
    ("one to one", &[0, 1]),
    ("two to one", &[0, 1, 0]),
];

/// A duct with vehicles of both directions.
struct Case {
    cable: DuctedCable,
    mesh: Mesh,
    passages: [Passage; 2],
    mix: &'static [usize],
}

impl Case {
    fn new(lengths: f64, number: f64, mix: &'static [usize]) -> Result<Self, Failure> {
        let sheath = FrictionLaw::ElasticPlastic {
            shape_factor: 2e8 / LIMIT,
        };
        let cable = cable(lengths * DEPTH, sheath)?;
        let mesh = Mesh::for_depth(cable.length(), DEPTH, NODES)?;
        let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
        let passage = |direction| -> Result<Passage, Failure> {
            let point = Vehicle::point("truck", 196_133.0, 10.0)?;
            let truck = Vehicle::new("truck", point.wheels().to_vec(), 10.0, direction)?;
            let motion = DuctMotion::new(&ground, &truck, DuctLine::new(DEPTH, 0.0)?, 500.0, 1e-8)?;
            let factor = number * LIMIT * DEPTH * DEPTH / EA / motion.peak_longitudinal();
            Ok(Passage::new(&cable, &mesh, &motion.scaled(factor)?, APPROACH)?)
        };
        let passages = [passage(Direction::Forward)?, passage(Direction::Reverse)?];
        Ok(Self {
            cable,
            mesh,
            passages,
            mix,
        })
    }

    fn pass(
        &self,
        solver: &mut QuasiStatic,
        phase: usize,
        state: &mut CableState,
    ) -> Result<PassOutcome, CableError> {
        solver.pass(&self.passages[self.mix[phase]], state)
    }

    fn simulated(&self) -> Result<Vec<f64>, CableError> {
        let mut solver = QuasiStatic::new(self.cable.clone(), self.mesh)?;
        let mut state = solver.at_rest();
        let mut forces = Vec::new();
        for pass in 1..=PASSES[PASSES.len() - 1] {
            let phase = (pass - 1) as usize % self.mix.len();
            let force = self.pass(&mut solver, phase, &mut state)?.force.downstream;
            if PASSES.contains(&pass) {
                forces.push(force);
            }
        }
        Ok(forces)
    }

    fn jumped(&self, number: f64, guide: Guide<'_>) -> Result<Vec<f64>, JumpError> {
        let mut solver = QuasiStatic::new(self.cable.clone(), self.mesh)?;
        let motion = number * LIMIT * DEPTH * DEPTH / EA;
        let jumps = Jumps::new(TOLERANCE, DEPTH, (0.01 * LIMIT, 0.1 * motion))?.with_max_passes(1000, 1000);
        let mut request = Request::new(PASSES[PASSES.len() - 1], self.mix)?;
        (request.wanted, request.guide) = (&PASSES, guide);
        let evolution = evolve(
            &self.cable,
            &self.mesh,
            &jumps,
            &request,
            |Next { phase, .. }, state| self.pass(&mut solver, phase, state).map_err(JumpError::from),
        )?;
        // Of several vehicles more passes are recorded than are wanted.
        let wanted = evolution
            .records
            .iter()
            .filter(|record| PASSES.contains(&record.pass));
        Ok(wanted.map(|record| record.outcome.force.downstream).collect())
    }
}

/// The worst of `found` relative to what is `right`.
fn worst(found: &[f64], right: &[f64], warned: bool) -> Cell {
    let largest = right.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
    let scale = |right: f64| right.abs().max(0.1 * largest).max(0.01 * LIMIT);
    let error = |(found, right): &(f64, f64)| (found - right).abs() / scale(*right);
    let pairs = found.iter().copied().zip(right.iter().copied());
    pairs.max_by(|a, b| error(a).total_cmp(&error(b))).map_or_else(
        || silent(Outcome::Failed, f64::NAN),
        |(found, right)| judge(found, right, scale(right), warned),
    )
}

/// The same duct as a scene, computed with all guards of the program.
fn guarded(lengths: f64, number: f64, mix: &[usize]) -> Result<Cell, Failure> {
    let truck = |name: usize| {
        let direction = if name == 0 { "forward" } else { "reverse" };
        format!("{{ name = \"{name}\", speed = 10, load = 196133, direction = \"{direction}\" }}")
    };
    let names: Vec<String> = mix.iter().map(|vehicle| format!("\"{vehicle}\"")).collect();
    let vehicles: Vec<String> = (0..=mix.iter().copied().max().unwrap_or(0)).map(truck).collect();
    let text = format!(
        "duct = {{ length = {}, depth = {DEPTH} }}
ground = {{ longitudinal_peak = {}, layers = [{{ young_modulus = 8e8, poisson_ratio = 0.4 }}] }}
cable = {{ weight = {}, axial_stiffness = {EA} }}
friction = {{ dynamic_coefficient = 0.25, shape_factor = {} }}
ends = {{ upstream = \"free\", downstream = \"fixed\" }}
vehicles = [{}]
traffic = {{ passes = {}, sequence = [{}] }}
solver = {{ node_spacing = {}, vehicle_step = {}, tolerance = 0.05 }}",
        lengths * DEPTH,
        number * LIMIT * DEPTH * DEPTH / EA,
        LIMIT / 0.25,
        2e8 / LIMIT,
        vehicles.join(", "),
        PASSES[PASSES.len() - 1],
        names.join(", "),
        DEPTH / NODES,
        0.5 * DEPTH / NODES,
    );
    let mut scene = Scene::from_toml("cell", &text)?;
    let mut run = |method| {
        scene.solver.method = method;
        creepage::run(&scene)
    };
    let forces = |run: &Run| -> Vec<f64> {
        let listed = run.passes.iter().filter(|record| PASSES.contains(&record.pass));
        listed.map(|record| record.downstream_force_n).collect()
    };
    let (jumps, every) = (run(SolverMethod::PassLaw), run(SolverMethod::QuasiStatic));
    Ok(match (jumps, every) {
        (Ok(jumps), Ok(every)) => worst(
            &forces(&jumps),
            &forces(&every),
            jumps.error_estimate.relative > WRONG,
        ),
        _ => silent(Outcome::Refused, f64::NAN),
    })
}

/// Without guards, and with those of the jumps or of the whole program.
fn outcomes(
    lengths: f64,
    number: f64,
    mix: &'static [usize],
    by_program: bool,
) -> Result<[Cell; 2], Failure> {
    let case = Case::new(lengths, number, mix)?;
    let right = case.simulated()?;
    let jumped = |guide| match case.jumped(number, guide) {
        Ok(forces) => worst(&forces, &right, false),
        Err(JumpError::Stuck { .. }) => silent(Outcome::Refused, f64::NAN),
        Err(_) => silent(Outcome::Failed, f64::NAN),
    };
    let held = if by_program {
        guarded(lengths, number, mix)?
    } else {
        jumped(Guide::Free)
    };
    Ok([jumped(Guide::Obey(&BLIND)), held])
}

/// The map of a mix without and with guards, of `lengths` × `numbers` cells; the guards are those of the jumps, or of the whole
/// program, which also states its error.
pub fn map(
    mix: &'static [usize],
    lengths: usize,
    numbers: usize,
    by_program: bool,
) -> Result<Grid<[Cell; 2]>, Failure> {
    let cell = |_, length, number| outcomes(length, number, mix, by_program);
    Grid::fill(decades(0.5, 2.0, lengths), decades(-1.5, 1.5, numbers), cell)
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let mut figure =
        Panels::new("Jumps over passes: force after 20 to 600 passes, against the simulation of every pass")
            .columns(2)
            .panel_size(700.0, 480.0);
    let mut table = String::from("map,length_in_depths,inverse_q_number,outcome,force_n,right_force_n\n");
    for (mix, vehicles) in MIXES {
        let grid = map(vehicles, 11, 11, false)?;
        let names = ["fixed jumps, unchecked", "guards on"].map(|guards| format!("{mix}, {guards}"));
        let axes = [
            grid.x_axis("length of the duct, depths"),
            grid.y_axis("friction number EA·D/(q z²)"),
        ];
        let (charts, rows) = panels(&grid, [&names[0], &names[1]], &axes);
        figure = charts.into_iter().fold(figure, Panels::with);
        table += &rows;
    }
    crate::table::write(&out.join("stability-long-term.csv"), &table)?;
    std::fs::write(out.join("stability-long-term.svg"), figure.to_svg()?)?;
    Ok(())
}
