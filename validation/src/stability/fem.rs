//! Map 3: the finite elements of `layered-fem` where finite elements are known to fail, compared with an element that does.
//!
//! A layer lies on a half-space of 100 MPa, the duct at 1.2 m. Over ν → 0.5 of both soils and the contrast of their moduli (a layer of
//! 0.3 m), and over the layer's thickness and the contrast (ν = 0.35 and 0.4). The other element is the textbook's: four nodes, bilinear,
//! full integration, on a mesh as fine as the first of the crate's; as ν → 0.5 it locks, and nothing in it says so.
//! Judged by an independent quadrature ([`crate::ground_reference`]).

use std::path::Path;

use boussinesq::HalfSpace;
use creepage::figure::{Axis, Panels};
use ground_field::{Base, Displacement, GroundError, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};
use layered_fem::LayeredFem;

use crate::Failure;
use crate::bilinear::Mesh;
use crate::ground_map::{GroundMap, ask, judge, radii, wheel};
use crate::ground_reference;
use crate::map::{Cell, DEPTH, Grid, decades};

/// Error, as a share of the peak, that is asked of the crate, and up to which an answer is right.
pub const TOLERANCE: f64 = 5e-3;
/// Modulus of the half-space \[Pa\].
const BASE: f64 = 1e8;
/// Poisson's ratios of the first map.
pub const RATIOS: [f64; 9] = [0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999, 0.499999, 0.5];
const MODELS: [&str; 2] = ["layered-fem", "bilinear element, full integration"];

fn map(
    x: Vec<f64>,
    y: Vec<f64>,
    cell: impl Fn(f64, f64) -> Result<[Cell; 2], GroundError> + Sync,
) -> Result<GroundMap, GroundError> {
    Ok(GroundMap {
        models: MODELS,
        tolerance: TOLERANCE,
        grid: Grid::fill(x, y, |_, x, y| cell(x, y))?,
    })
}

/// The map over Poisson's ratio (all of [`RATIOS`]) and `contrasts`.
pub fn incompressible(contrasts: usize) -> Result<GroundMap, GroundError> {
    map(
        decades(-4.0, 4.0, contrasts),
        RATIOS.to_vec(),
        |contrast, ratio| cell(0.3, Soil::new(contrast * BASE, ratio)?, Soil::new(BASE, ratio)?),
    )
}

/// The map over `thicknesses` and `contrasts`.
pub fn layered(contrasts: usize, thicknesses: usize) -> Result<GroundMap, GroundError> {
    let (x, y) = (decades(-4.0, 4.0, contrasts), decades(-3.0, 1.0, thicknesses));
    map(x, y, |contrast, thickness| {
        cell(
            thickness,
            Soil::new(contrast * BASE, 0.35)?,
            Soil::new(BASE, 0.4)?,
        )
    })
}

fn cell(thickness: f64, upper: Soil, base: Soil) -> Result<[Cell; 2], GroundError> {
    let profile = SoilProfile::new(vec![SoilLayer::uniform(thickness, upper)?], Base::HalfSpace(base))?;
    let (load, radii) = (wheel()?, radii());
    let exact = ground_reference::displacements(&profile, load, &radii, DEPTH);
    let own = judge(
        ask(LayeredFem::new(&profile, TOLERANCE), &radii),
        &exact,
        TOLERANCE,
    );
    let nodes = textbook(thickness, upper, base, load);
    let places: Vec<f64> = nodes.iter().map(|(radius, _)| *radius).collect();
    let exact = ground_reference::displacements(&profile, load, &places, DEPTH);
    let found = nodes.into_iter().map(|(_, value)| value).collect();
    Ok([own, judge(Ok(found), &exact, TOLERANCE)])
}

/// Displacements along the duct's depth at the nodes to 15 m, by bilinear elements with full integration; none if the system
/// cannot be solved.
fn textbook(thickness: f64, upper: Soil, base: Soil, load: SurfaceLoad) -> Vec<(f64, Displacement)> {
    const REACH: f64 = 400.0;
    const SCALE: f64 = 0.15;
    let radii = graded(&[0.0, load.contact_radius(), REACH], SCALE);
    let mut breaks = vec![0.0, thickness, DEPTH, REACH];
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    let depths = graded(&breaks, SCALE);
    let mesh = Mesh::rectangular(&with_midpoints(&radii), &with_midpoints(&depths));
    let width = 2 * radii.len() - 1;
    let far = HalfSpace::new(base);
    let (mut prescribed, mut given) = (vec![false; 2 * mesh.nodes.len()], vec![0.0; 2 * mesh.nodes.len()]);
    for (index, &[r, z]) in mesh.nodes.iter().enumerate() {
        let outer = r >= REACH || z >= REACH;
        prescribed[2 * index] = outer || index % width == 0;
        prescribed[2 * index + 1] = outer;
        if outer && let Ok(u) = far.displacement(load, r, z) {
            (given[2 * index], given[2 * index + 1]) = (u.radial, u.vertical);
        }
    }
    let mut force = vec![0.0; 2 * mesh.nodes.len()];
    for (node, pair) in mesh.nodes[..width].windows(2).enumerate() {
        let (left, right) = (pair[0][0], pair[1][0]);
        if right <= load.contact_radius() * (1.0 + 1e-9) {
            // ∫ N r dr of the two linear shape functions.
            let (length, pressure) = (right - left, load.pressure());
            force[2 * node + 1] += pressure * length * (2.0 * left + right) / 6.0;
            force[2 * node + 3] += pressure * length * (left + 2.0 * right) / 6.0;
        }
    }
    // The first node is the element's top.
    let soil = |element: usize| {
        let in_layer = mesh.nodes[mesh.elements[element][0]][1] < thickness;
        if in_layer { upper } else { base }
    };
    let Some(solution) = mesh.solve(&prescribed, &given, &force, soil) else {
        return Vec::new();
    };
    let nodes = mesh.nodes.iter().enumerate();
    nodes
        .filter(|(_, [r, z])| (z - DEPTH).abs() < 1e-9 && *r <= 15.0)
        .map(|(index, [r, _])| {
            let value = Displacement {
                radial: solution[2 * index],
                vertical: solution[2 * index + 1],
            };
            (*r, value)
        })
        .collect()
}

/// Lines through `breaks` whose spacing grows with the distance from 0, at least two intervals between neighbours.
fn graded(breaks: &[f64], scale: f64) -> Vec<f64> {
    const RATIO: f64 = 0.2;
    let mut lines = vec![breaks[0]];
    for pair in breaks.windows(2) {
        let (from, to) = ((pair[0] / scale).asinh(), (pair[1] / scale).asinh());
        let count = ((to - from) / RATIO).ceil().max(2.0) as usize;
        lines.extend((1..count).map(|k| scale * (from + (to - from) * k as f64 / count as f64).sinh()));
        lines.push(pair[1]);
    }
    lines
}

/// The lines and the mid-points between them.
fn with_midpoints(lines: &[f64]) -> Vec<f64> {
    let pairs = lines.windows(2);
    let between = pairs.flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]);
    between.chain(lines.last().copied()).collect()
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let (ratios, thicknesses) = (incompressible(17)?, layered(17, 13)?);
    let ratio = Axis::names("Poisson's ratio", RATIOS.map(|ratio| ratio.to_string()));
    let thickness = thicknesses.grid.y_axis("thickness of the layer, m");
    let panels = Panels::new(
        "Finite elements, duct at 1.2 m: outcome by contrast, Poisson's ratio and thickness of a layer",
    )
    .columns(2);
    let file = out.join("stability-fem-ratio.csv");
    let panels = ratios.write(&file, ("poisson_ratio", &ratio), "layer of 0.3 m", panels)?;
    let file = out.join("stability-fem-thickness.csv");
    let panels = thicknesses.write(&file, ("thickness_m", &thickness), "ν = 0.35 on 0.4", panels)?;
    std::fs::write(out.join("stability-fem.svg"), panels.to_svg()?)?;
    Ok(())
}
