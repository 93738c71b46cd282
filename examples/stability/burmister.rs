//! Map 4: the crate `burmister` over the contrast of moduli and the thickness of a layer, beside the textbook's transfer matrices.
//!
//! A layer lies on a half-space of 100 MPa; the duct 1.2 m deep is below a thin layer and within a thick one. The transfer matrix
//! carries displacement and traction through the layer by both growing and decaying exponentials (D. M. Burmister,
//! J. Appl. Phys. 16 (1945) 89–94): e^(m h) overflows for thick layers, and long before that has eaten all digits. Both are integrated
//! or asked to far better than the map's tolerance, and judged by an independent quadrature ([`crate::ground_reference`]).

use std::error::Error;
use std::path::Path;

use burmister::LayeredHalfSpace;
use creepage::figure::{Axis, Panels};
use ground_field::{Base, GroundError, Soil, SoilLayer, SoilProfile};
use nalgebra::{Matrix4, Vector4};

use crate::ground_map::{DEPTH, Grid, ask, decades, judge, radii, wheel};
use crate::ground_reference;

/// Error, as a share of the peak, up to which an answer is right. Asked of the crate is 1e-8, its default.
pub const TOLERANCE: f64 = 1e-6;
/// Modulus of the half-space \[Pa\].
const BASE: f64 = 1e8;

/// The map with `contrasts` × `thicknesses` cells; the crate is model 0.
///
/// # Errors
///
/// None for the grounds of this map.
pub fn map(contrasts: usize, thicknesses: usize) -> Result<Grid, GroundError> {
    let (x, y) = (decades(-6.0, 6.0, contrasts), decades(-3.0, 2.0, thicknesses));
    Grid::fill(
        vec!["burmister", "transfer matrices"],
        x,
        y,
        |contrast, thickness| {
            let (upper, base) = (Soil::new(contrast * BASE, 0.35)?, Soil::new(BASE, 0.4)?);
            let profile =
                SoilProfile::new(vec![SoilLayer::uniform(thickness, upper)?], Base::HalfSpace(base))?;
            let (load, radii) = (wheel()?, radii());
            let exact = ground_reference::displacements(&profile, load, &radii, DEPTH);
            let farthest = radii.iter().copied().fold(0.0, f64::max);
            let transferred = ground_reference::integrate(load, &radii, DEPTH, farthest, |m| {
                transfer(upper, thickness, base, m)
            });
            Ok(vec![
                judge(
                    ask(LayeredHalfSpace::new(&profile), load, &radii),
                    &exact,
                    TOLERANCE,
                ),
                judge(Ok(transferred), &exact, TOLERANCE),
            ])
        },
    )
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

pub fn run(out: &Path) -> Result<(), Box<dyn Error>> {
    let grid = map(25, 26)?;
    grid.never_wrong()?;
    std::fs::write(
        out.join("stability-burmister.csv"),
        grid.csv("modulus_of_layer_over_base", "thickness_m", "1e-6")?,
    )?;
    let panels = Panels::new(
        "Layered ground by Hankel transform, duct at 1.2 m: outcome by contrast and thickness of a layer",
    )
    .columns(2);
    let (x, y) = (
        Axis::logarithmic("modulus of the layer over that of the half-space").cells(grid.x.clone()),
        Axis::logarithmic("thickness of the layer, m").cells(grid.y.clone()),
    );
    let panels = grid.draw(panels, &x, &y, "layer on a half-space", "1e-6");
    std::fs::write(out.join("stability-burmister.svg"), panels.to_svg()?)?;
    Ok(())
}
