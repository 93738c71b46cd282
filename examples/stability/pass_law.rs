//! Map 5: the pass law over the duct's length in depths and the friction number EA·D/(q z²).
//!
//! The friction number compares the largest longitudinal displacement D of the duct with the displacement q z²/EA that
//! friction can impose on the cable over a depth z: small, the cable follows its duct; large, it is dragged through. Right is
//! the simulation of every pass, on the same mesh. The worst of the forces after [`PASSES`] passes counts, as a share of the
//! right one. Without guards all the law's concerns are ignored.

use std::error::Error;
use std::path::Path;

use cable_dem::{CableError, CableState, DuctedCable, FrictionLaw, Mesh, Passage, QuasiStatic};
use creepage::figure::{Axis, Panels};
use ground_field::DuctMotion;
use pass_law::{LawError, PassLaw, Resolution};

use crate::cable_map::{Cell, DEPTH, EA, Grid, LIMIT, Outcome, cable, decades, judge, silent, truck};

/// Passes after which forces are compared, from where on the law holds.
const PASSES: [u64; 3] = [20, 60, 200];
const APPROACH: f64 = 15.0;
/// Nodes a depth.
const NODES: f64 = 6.0;

fn simulated(cable: &DuctedCable, motion: &DuctMotion) -> Result<Vec<f64>, CableError> {
    let mesh = Mesh::new(cable.length(), DEPTH / NODES, 0.5 * DEPTH / NODES)?;
    let passage = Passage::new(cable, &mesh, motion, APPROACH)?;
    let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
    let mut state = CableState::at_rest(&mesh);
    let mut forces = Vec::new();
    for pass in 1..=PASSES[PASSES.len() - 1] {
        let force = solver.pass(&passage, &mut state)?.force.downstream;
        if PASSES.contains(&pass) {
            forces.push(force);
        }
    }
    Ok(forces)
}

/// What the law says: its forces, whether it warns, and whether it declines.
struct Answer {
    forces: Vec<f64>,
    warns: bool,
    declines: bool,
}

fn law(cable: &DuctedCable, motion: &DuctMotion) -> Result<Answer, LawError> {
    let resolution = Resolution::new(DEPTH)?.with_nodes_per_depth(NODES)?;
    let law = PassLaw::new(cable, &[(motion.clone(), 1.0)], resolution)?;
    let evolution = law.run(&PASSES)?;
    let concerns = law.concerns();
    Ok(Answer {
        forces: evolution
            .records
            .iter()
            .map(|record| record.downstream_force)
            .collect(),
        warns: evolution.left_table || !concerns.is_empty(),
        declines: concerns.iter().any(|concern| concern.is_fatal()),
    })
}

/// Without guards, and with them.
fn outcomes(lengths: f64, number: f64) -> Result<[Cell; 2], Box<dyn Error + Send + Sync>> {
    let sheath = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / LIMIT,
    };
    let cable = cable(lengths * DEPTH, sheath)?;
    let motion = truck(DEPTH, 10.0)?;
    let factor = number * LIMIT * DEPTH * DEPTH / EA / motion.peak_longitudinal();
    let motion = motion.scaled(factor)?;
    let right = simulated(&cable, &motion)?;
    let answer = law(&cable, &motion);
    let judged = |guarded: bool| match &answer {
        Err(_) => silent(Outcome::Failed, right[right.len() - 1]),
        Ok(answer) if guarded && answer.declines => silent(Outcome::Refused, right[right.len() - 1]),
        Ok(answer) => {
            let cells = answer.forces.iter().zip(&right);
            let cells =
                cells.map(|(&found, &right)| judge(found, right, right.abs(), guarded && answer.warns));
            let error = |cell: &Cell| (cell.force / cell.expected - 1.0).abs();
            cells
                .max_by(|a, b| error(a).total_cmp(&error(b)))
                .unwrap_or_else(|| silent(Outcome::Failed, f64::NAN))
        }
    };
    Ok([judged(false), judged(true)])
}

/// The maps without and with guards, of `lengths` × `numbers` cells.
///
/// # Errors
///
/// None for these scenes.
pub fn maps(lengths: usize, numbers: usize) -> Result<[Grid; 2], Box<dyn Error>> {
    Grid::fill_pair(
        &decades(0.5, 2.0, lengths),
        &decades(-1.5, 1.5, numbers),
        outcomes,
    )
    .map_err(|error| error as Box<dyn Error>)
}

/// Draws the map.
///
/// # Errors
///
/// As for writing files and for [`creepage::figure::Chart`].
pub fn run(out: &Path) -> Result<(), Box<dyn Error>> {
    let mut figure =
        Panels::new("Pass law: force after 20 to 200 passes, against the simulation of every pass")
            .columns(2)
            .panel_size(700.0, 480.0);
    let mut table = String::from("map,length_in_depths,friction_number,outcome,force_n,right_force_n\n");
    for (grid, name) in maps(11, 11)?.into_iter().zip(["concerns ignored", "guards on"]) {
        println!("{name}: {}", grid.summary());
        figure = figure.with(grid.map(
            name,
            Axis::logarithmic("length of the duct, depths").cells(grid.x.clone()),
            Axis::logarithmic("friction number EA·D/(q z²)").cells(grid.y.clone()),
        ));
        table += &grid.csv(name);
    }
    std::fs::write(out.join("stability-pass-law.csv"), table)?;
    std::fs::write(out.join("stability-pass-law.svg"), figure.to_svg()?)?;
    Ok(())
}
