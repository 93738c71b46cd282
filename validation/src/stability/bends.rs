//! Map 8: bends, over their radius and friction, for three cables: what it costs that the cable presses on a bend with the force of the step
//! before.
//!
//! A duct of 30 m whose middle third bends, twenty passes. Steps of half a node spacing, as a run takes them, are compared with steps sixteen
//! times shorter on the same nodes: what the bend changes of the force on an end or in the cable after a pass, relative to a straight duct with
//! the same steps. The worst counts, as a share of the largest force. The stiffer the cable, the larger the force with which it presses.

use std::path::Path;

use creepage::figure::Panels;
use creepage::{Run, Scene};

use crate::map::{DEPTH, Grid, decades};
use crate::{Failure, largest};

/// Nodes a depth.
pub const NODES: f64 = 6.0;
/// How many times shorter the steps of the reference are.
const SHORTER: f64 = 16.0;
/// Upper ends of the classes, and their names.
const ENDS: [f64; 4] = [5e-4, 2e-3, 5e-3, 2e-2];
pub const CLASSES: [&str; 5] = [
    "within 0.05 %",
    "0.05 to 0.2 %",
    "0.2 to 0.5 %",
    "0.5 to 2 %",
    "more than 2 %",
];

/// Axial stiffnesses \[N\], a panel each.
pub const STIFFNESSES: [f64; 3] = [8e6, 8e7, 8e8];

/// The radius of a bend that is none \[m\].
const STRAIGHT: f64 = 1e12;

/// What a cell shows.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    /// Difference of what the bend changes, or of the forces, as a share of the largest force.
    pub error: f64,
    /// The largest force \[N\].
    pub force: f64,
}

/// The scene of one cell, with steps so many times shorter than half a node spacing.
pub fn scene(radius: f64, friction: f64, stiffness: f64, step: f64) -> Result<Scene, creepage::SceneError> {
    duct(
        &format!("bend_radius = {radius}"),
        friction,
        stiffness,
        NODES,
        step,
    )
}

/// A duct of 30 m with this key in its middle third, on so many nodes a depth.
pub fn duct(
    key: &str,
    friction: f64,
    stiffness: f64,
    nodes: f64,
    step: f64,
) -> Result<Scene, creepage::SceneError> {
    let weight = 108.8;
    let text = format!(
        "duct = {{ length = 30, depth = {DEPTH} }}
route = [{{ length = 10 }}, {{ length = 10, {key} }}, {{ }}]
ground = {{ layers = [{{ young_modulus = 8e8, poisson_ratio = 0.4 }}] }}
cable = {{ weight = {weight}, axial_stiffness = {stiffness} }}
friction = {{ dynamic_coefficient = {friction}, shape_factor = {} }}
ends = {{ upstream = \"free\", downstream = \"fixed\" }}
vehicles = [{{ speed = 10, load = 196133 }}]
traffic = {{ passes = 20 }}
solver = {{ method = \"quasi-static\", node_spacing = {}, vehicle_step = {}, tolerance = 0.5 }}",
        2e8 / (friction * weight),
        DEPTH / nodes,
        0.5 * DEPTH / nodes / step,
    );
    Scene::from_toml("cell", &text)
}

/// Forces after the passes.
pub fn forces(run: &Run) -> Vec<f64> {
    let forces = run
        .passes
        .iter()
        .map(|pass| [pass.downstream_force_n, pass.max_compression_n]);
    forces.flatten().collect()
}

/// A map of `radii` × `frictions` cells for one cable.
pub fn map(radii: usize, frictions: usize, stiffness: f64) -> Result<Grid<Cell>, Failure> {
    let (radii, frictions) = (decades(0.2, 2.2, radii), decades(-1.0, 0.0, frictions));
    // By steps of half a node spacing, and by short ones.
    let run = |radius, friction| -> Result<[Vec<f64>; 2], Failure> {
        let by = |shorter| -> Result<Vec<f64>, Failure> {
            Ok(forces(&creepage::run(&scene(
                radius, friction, stiffness, shorter,
            )?)?))
        };
        Ok([by(1.0)?, by(SHORTER)?])
    };
    let straight = frictions.iter().map(|friction| run(STRAIGHT, *friction));
    let straight = straight.collect::<Result<Vec<_>, _>>()?;
    let columns = radii.len();
    let cell = |index: usize, radius, friction| -> Result<Cell, Failure> {
        let ([usual, short], [usual_straight, short_straight]) =
            (run(radius, friction)?, &straight[index / columns]);
        let bent = usual.iter().zip(&short).map(|(usual, short)| usual - short);
        let straight = usual_straight
            .iter()
            .zip(short_straight)
            .map(|(usual, short)| usual - short);
        let force = largest(short.iter().copied());
        Ok(Cell {
            error: largest(bent.zip(straight).map(|(bent, straight)| bent - straight)) / force,
            force,
        })
    };
    Grid::fill(radii, frictions, cell)
}

/// The class of a cell.
pub fn class(cell: &Cell) -> usize {
    ENDS.iter()
        .position(|end| cell.error <= *end)
        .unwrap_or(ENDS.len())
}

/// Draws the map.
pub fn run(out: &Path) -> Result<(), Failure> {
    let mut figure = Panels::new("What a bend changes of the forces: steps of half a node spacing, against steps sixteen times shorter")
        .columns(3)
        .panel_size(520.0, 460.0);
    let mut table = String::from("axial_stiffness_n,radius_m,friction,error,largest_force_n\n");
    for stiffness in STIFFNESSES {
        let map = map(9, 7, stiffness)?;
        let worst = map
            .cells
            .iter()
            .fold(0.0_f64, |worst, cell| worst.max(cell.error));
        let name = format!(
            "EA = {:.0} MN (at most {:.2} % off)",
            stiffness / 1e6,
            100.0 * worst
        );
        println!("{name}");
        let axes = [
            map.x_axis("radius of the bend, m"),
            map.y_axis("friction coefficient"),
        ];
        figure = figure.with(map.panel(&name, axes, CLASSES, class));
        table += &map.lines(|radius, friction, cell| {
            format!(
                "{stiffness:e},{radius:.4},{friction:.4},{:.3e},{:.1}",
                cell.error, cell.force
            )
        });
    }
    crate::table::write(&out.join("stability-bends.csv"), &table)?;
    std::fs::write(out.join("stability-bends.svg"), figure.to_svg()?)?;
    Ok(())
}
