//! Displacements of layered ground by a second route, to hold the crates' answers against.
//!
//! Nothing of the method is shared with the crates. In the Hankel transform (wavenumber m) every layer is a sum of four
//! solutions, of which none grows within the layer,
//!
//! ```text
//! (U, W) = (1, 1) e^(−mζ), (mζ, mζ+κ) e^(−mζ), (1, −1) e^(mη), (mη, −mη+κ) e^(mη),   κ = 3 − 4ν
//! ```
//!
//! with ζ from its top and η ≤ 0 from its bottom; the base has the first two. Surface load, continuity at the interfaces and the
//! base make one linear system for all of them at once, solved by elimination with pivots (`nalgebra`). The integrals
//!
//! ```text
//! u_r = P/2π ∫ U J1(mr) f m dm,   u_z = P/2π ∫ W J0(mr) f m dm,   f = 2 J1(ma)/(ma)
//! ```
//!
//! run over panels that halve toward m = 0 and are short against the turns of the Bessel functions, by a Gauss rule of 16 nodes
//! each, without any estimate of where less would do. Slow, plain, and right to about 1e-12 of the peak for depths that are not small
//! against the contact radius; at the surface it does not converge.
//!
//! Reference: D. M. Burmister, J. Appl. Phys. 16 (1945) 89–94.

use std::f64::consts::{PI, TAU};

use ground_field::{Base, Displacement, Soil, SoilProfile, SurfaceLoad};
use nalgebra::{DMatrix, DVector};

/// Range of m times the depth: e^−42 is below rounding.
const RANGE: f64 = 42.0;
/// Halvings toward m = 0.
const OCTAVES: i32 = 40;
/// Nodes a panel.
const NODES: usize = 16;
/// Longest panel, as the argument that mr runs through.
const TURN: f64 = 3.0;

/// A layer with its top and, but for the base, its thickness \[m\].
struct Layer {
    top: f64,
    thickness: Option<f64>,
    soil: Soil,
}

/// Displacement and traction over m: (U, W, τ/m, σ_z/m).
type State = [f64; 4];

/// Displacements \[m\] at `radii` and one `depth` \[m\] under `load`; empty for a modulus that varies within a layer.
pub fn displacements(
    profile: &SoilProfile,
    load: SurfaceLoad,
    radii: &[f64],
    depth: f64,
) -> Vec<Displacement> {
    let Some(layers) = layers(profile) else {
        return Vec::new();
    };
    let farthest = radii.iter().copied().fold(load.contact_radius(), f64::max);
    integrate(load, radii, depth, farthest, |m| transform(&layers, m, depth))
}

/// The integrals with any (U m, W m) of the wavenumber m in place of the layered ground's.
pub fn integrate(
    load: SurfaceLoad,
    radii: &[f64],
    depth: f64,
    farthest: f64,
    transform: impl Fn(f64) -> (f64, f64),
) -> Vec<Displacement> {
    let rule = gauss();
    let mut sums = vec![Displacement::ZERO; radii.len()];
    let mut to = RANGE / depth;
    for octave in 0..=OCTAVES {
        let from = if octave == OCTAVES { 0.0 } else { 0.5 * to };
        let pieces = ((to - from) * farthest / TURN).ceil().max(2.0);
        let half = 0.5 * (to - from) / pieces;
        for piece in 0..pieces as usize {
            let middle = from + half * (2 * piece + 1) as f64;
            for &(x, weight) in &rule {
                let m = middle + half * x;
                let (radial, vertical) = transform(m);
                let scale = weight * half * disc_factor(m * load.contact_radius()) * load.force() / TAU;
                for (sum, &radius) in sums.iter_mut().zip(radii) {
                    sum.radial += scale * radial * libm::j1(m * radius);
                    sum.vertical += scale * vertical * libm::j0(m * radius);
                }
            }
        }
        to = from;
    }
    sums
}

fn disc_factor(x: f64) -> f64 {
    if x < 1e-5 { 1.0 } else { 2.0 * libm::j1(x) / x }
}

fn layers(profile: &SoilProfile) -> Option<Vec<Layer>> {
    let mut top = 0.0;
    let mut list = Vec::new();
    for layer in profile.layers() {
        let thickness = layer.thickness();
        list.push(Layer {
            top,
            thickness: Some(thickness),
            soil: layer.soil()?,
        });
        top += thickness;
    }
    if let Base::HalfSpace(soil) = profile.base() {
        list.push(Layer {
            top,
            thickness: None,
            soil,
        });
    }
    Some(list)
}

/// (U m, W m) at `depth` under a unit surface pressure at wavenumber `m`.
fn transform(layers: &[Layer], m: f64, depth: f64) -> (f64, f64) {
    let unknowns: usize = layers
        .iter()
        .map(|layer| if layer.thickness.is_some() { 4 } else { 2 })
        .sum();
    let mut matrix = DMatrix::zeros(unknowns, unknowns);
    // The surface carries a pressure and no shear.
    let mut right = DVector::zeros(unknowns);
    right[1] = -1.0;
    let mut row = 2;
    for (index, layer) in layers.iter().enumerate() {
        let column = 4 * index;
        for (k, state) in layer.states(m, layer.top).into_iter().enumerate() {
            if index == 0 {
                matrix[(0, k)] = state[2];
                matrix[(1, k)] = state[3];
            } else {
                // Above minus below.
                for (c, value) in state.into_iter().enumerate() {
                    matrix[(row - 4 + c, column + k)] = -value;
                }
            }
        }
        if let Some(thickness) = layer.thickness {
            let last = index + 1 == layers.len();
            for (k, state) in layer.states(m, layer.top + thickness).into_iter().enumerate() {
                for (c, value) in state.into_iter().take(if last { 2 } else { 4 }).enumerate() {
                    matrix[(row + c, column + k)] = value;
                }
            }
            row += 4;
        }
    }
    equilibrate(&mut matrix, &mut right);
    let Some(solution) = matrix.lu().solve(&right) else {
        return (f64::NAN, f64::NAN);
    };
    let index = layers
        .iter()
        .rposition(|layer| layer.top <= depth)
        .unwrap_or_default();
    let states = layers[index].states(m, depth);
    states
        .iter()
        .enumerate()
        .fold((0.0, 0.0), |(radial, vertical), (k, state)| {
            let share = solution[4 * index + k];
            (radial + share * state[0], vertical + share * state[1])
        })
}

/// Rows to a largest entry of 1, so that displacements and tractions weigh alike in the choice of pivots.
fn equilibrate(matrix: &mut DMatrix<f64>, right: &mut DVector<f64>) {
    for (mut row, value) in matrix.row_iter_mut().zip(right.iter_mut()) {
        let scale = 1.0 / row.amax();
        row *= scale;
        *value *= scale;
    }
}

impl Layer {
    /// The layer's solutions at `depth`, each over 2μ so that its traction is of order 1: (U m, W m, τ, σ_z) for amplitudes of a unit
    /// pressure.
    fn states(&self, m: f64, depth: f64) -> Vec<State> {
        let nu = self.soil.poisson_ratio();
        let kappa = 3.0 - 4.0 * nu;
        let softness = 1.0 / (2.0 * self.soil.shear_modulus());
        let x = m * (depth - self.top);
        let e = (-x).exp();
        let down = [
            [softness * e, softness * e, -e, -e],
            [
                softness * x * e,
                softness * (x + kappa) * e,
                -(x + 1.0 - 2.0 * nu) * e,
                -(x + 2.0 - 2.0 * nu) * e,
            ],
        ];
        let Some(thickness) = self.thickness else {
            return down.to_vec();
        };
        let y = m * (depth - self.top - thickness);
        let e = y.exp();
        let up = [
            [softness * e, -softness * e, e, -e],
            [
                softness * y * e,
                softness * (kappa - y) * e,
                (y - 1.0 + 2.0 * nu) * e,
                (2.0 - 2.0 * nu - y) * e,
            ],
        ];
        down.into_iter().chain(up).collect()
    }
}

/// Gauss–Legendre nodes and weights on \[−1, 1\], by Newton's iteration on the Legendre polynomial.
fn gauss() -> Vec<(f64, f64)> {
    (0..NODES)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (NODES as f64 + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..50 {
                let (mut previous, mut current) = (1.0, x);
                for k in 1..NODES {
                    let k = k as f64;
                    let next = ((2.0 * k + 1.0) * x * current - k * previous) / (k + 1.0);
                    (previous, current) = (current, next);
                }
                slope = NODES as f64 * (x * current - previous) / (x * x - 1.0);
                x -= current / slope;
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}
