//! Map 4: the crate `burmister` over the contrast of moduli and the thickness of a layer, compared with the textbook's transfer matrices.
//!
//! A layer lies on a half-space of 100 MPa; the duct 1.2 m deep is below a thin layer and within a thick one. The transfer matrix
//! carries displacement and traction through the layer by both growing and decaying exponentials (D. M. Burmister,
//! J. Appl. Phys. 16 (1945) 89–94): e^(m h) overflows for thick layers, and long before that has eaten all digits. Both are integrated
//! or asked to far better than the map's tolerance, and judged by an independent quadrature ([`crate::ground_reference`]).

use std::path::Path;

use burmister::LayeredHalfSpace;
use creepage::figure::Panels;
use ground_field::{Base, GroundError, Soil, SoilLayer, SoilProfile};
use nalgebra::{Matrix4, Vector4};

use crate::Failure;
use crate::ground_map::{GroundMap, ask, judge, radii, wheel};
use crate::ground_reference;
use crate::map::{Cell, DEPTH, Grid, decades};

/// Error, as a share of the peak, up to which an answer is right. Asked of the crate is 1e-8, its default.
pub const TOLERANCE: f64 = 1e-6;
/// Modulus of the half-space \[Pa\].
const BASE: f64 = 1e8;

/// The map with `contrasts` × `thicknesses` cells.
pub fn map(contrasts: usize, thicknesses: usize) -> Result<GroundMap, GroundError> {
    let (x, y) = (decades(-6.0, 6.0, contrasts), decades(-3.0, 2.0, thicknesses));
    Ok(GroundMap {
        models: ["burmister", "transfer matrices"],
        tolerance: TOLERANCE,
        grid: Grid::fill(x, y, |_, contrast, thickness| cell(contrast, thickness))?,
    })
}

fn cell(contrast: f64, thickness: f64) -> Result<[Cell; 2], GroundError> {
    let (upper, base) = (Soil::new(contrast * BASE, 0.35)?, Soil::new(BASE, 0.4)?);
    let profile = SoilProfile::new(vec![SoilLayer::uniform(thickness, upper)?], Base::HalfSpace(base))?;
    let (load, radii) = (wheel()?, radii());
    let exact = ground_reference::displacements(&profile, load, &radii, DEPTH);
    let farthest = radii.iter().copied().fold(0.0, f64::max);
    let transferred = ground_reference::integrate(load, &radii, DEPTH, farthest, |m| {
        transfer(upper, thickness, base, m)
    });
    let own = ask(LayeredHalfSpace::new(&profile), &radii);
    Ok([own, Ok(transferred)].map(|found| judge(found, &exact, TOLERANCE)))
}

/// Four solutions in a soil at x = mζ: (U m, W m, τ, σ_z), two that decay and two that grow.
fn solutions(soil: Soil, x: f64) -> Matrix4<f64> {
    let nu = soil.poisson_ratio();
    let kappa = 3.0 - 4.0 * nu;
    let softness = 1.0 / (2.0 * soil.shear_modulus());
    let down = (-x).exp();
    let up = x.exp();
    Matrix4::from_columns(&[
        Vector4::new(softness, softness, -1.0, -1.0) * down,
        Vector4::new(
            softness * x,
            softness * (x + kappa),
            -(x + 1.0 - 2.0 * nu),
            -(x + 2.0 - 2.0 * nu),
        ) * down,
        Vector4::new(softness, -softness, 1.0, -1.0) * up,
        Vector4::new(
            softness * x,
            softness * (kappa - x),
            x - 1.0 + 2.0 * nu,
            2.0 - 2.0 * nu - x,
        ) * up,
    ])
}

/// (U m, W m) at the duct by the transfer matrix of the layer.
fn transfer(upper: Soil, thickness: f64, base: Soil, m: f64) -> (f64, f64) {
    const NOTHING: (f64, f64) = (f64::NAN, f64::NAN);
    let Some(start) = solutions(upper, 0.0).try_inverse() else {
        return NOTHING;
    };
    let down = solutions(upper, m * thickness) * start;
    let below = solutions(base, 0.0);
    // Unknown are the surface's displacement and the base's two decaying solutions.
    let system = Matrix4::from_columns(&[
        down.column(0).into_owned(),
        down.column(1).into_owned(),
        -below.column(0),
        -below.column(1),
    ]);
    // The surface carries a unit pressure and no shear.
    let Some(unknown) = system.lu().solve(&down.column(3).into_owned()) else {
        return NOTHING;
    };
    let state = if DEPTH < thickness {
        let surface = Vector4::new(unknown[0], unknown[1], 0.0, -1.0);
        solutions(upper, m * DEPTH) * start * surface
    } else {
        let decayed = solutions(base, m * (DEPTH - thickness));
        decayed.column(0) * unknown[2] + decayed.column(1) * unknown[3]
    };
    (state[0], state[1])
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let map = map(25, 26)?;
    let panels = Panels::new(
        "Layered ground by Hankel transform, duct at 1.2 m: outcome by contrast and thickness of a layer",
    )
    .columns(2);
    let thickness = map.grid.y_axis("thickness of the layer, m");
    let file = out.join("stability-burmister.csv");
    let panels = map.write(
        &file,
        ("thickness_m", &thickness),
        "layer on a half-space",
        panels,
    )?;
    std::fs::write(out.join("stability-burmister.svg"), panels.to_svg()?)?;
    Ok(())
}
