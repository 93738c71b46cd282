//! Map 9: sections, over their friction relative to that of the others: what a mesh makes of friction that changes in one place.
//!
//! The duct of map 8, straight, with another friction coefficient in its middle third, twenty passes. Six nodes a depth, as a run begins with,
//! are compared with 24; the largest difference of a force on an end or in the cable after a pass counts, as a share of the largest force.
//! Where friction is the same everywhere, in the middle column, the error is that of the mesh alone.

use std::path::Path;

use creepage::figure::Panels;

use super::bends::{CLASSES, Cell, NODES, STIFFNESSES, class, duct, forces};
use crate::map::{Grid, decades};
use crate::{Failure, largest};

/// A map of `ratios` × `frictions` cells.
pub fn map(ratios: usize, frictions: usize) -> Result<Grid<Cell>, Failure> {
    let cell = |_, ratio: f64, friction: f64| -> Result<Cell, Failure> {
        let key = format!("dynamic_coefficient = {}", ratio * friction);
        let by = |nodes| -> Result<Vec<f64>, Failure> {
            let scene = duct(&key, friction, STIFFNESSES[0], nodes, 1.0)?;
            Ok(forces(&creepage::run(&scene)?))
        };
        let (usual, fine) = (by(NODES)?, by(4.0 * NODES)?);
        let force = largest(fine.iter().copied());
        let differences = usual.iter().zip(&fine).map(|(usual, fine)| usual - fine);
        Ok(Cell {
            error: largest(differences) / force,
            force,
        })
    };
    Grid::fill(decades(-1.0, 1.0, ratios), decades(-1.0, 0.0, frictions), cell)
}

/// Draws the map.
pub fn run(out: &Path) -> Result<(), Failure> {
    let map = map(9, 7)?;
    let axes = [
        map.x_axis("friction of the middle third relative to the others"),
        map.y_axis("friction coefficient of the others"),
    ];
    let title = "Sections: 6 nodes per depth against 24";
    let figure = Panels::new("What a mesh makes of friction that changes in one place")
        .panel_size(620.0, 460.0)
        .with(map.panel(title, axes, CLASSES, class));
    let table = String::from("relative_friction,friction,error,largest_force_n\n")
        + &map.lines(|ratio, friction, cell| {
            format!("{ratio:.4},{friction:.4},{:.3e},{:.1}", cell.error, cell.force)
        });
    crate::table::write(&out.join("stability-sections.csv"), &table)?;
    std::fs::write(out.join("stability-sections.svg"), figure.to_svg()?)?;
    Ok(())
}
