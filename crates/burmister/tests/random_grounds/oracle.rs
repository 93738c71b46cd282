//! Layered ground by brute force, sharing nothing with the crate.
//!
//! At every wavenumber the boundary conditions are solved for the amplitudes of each layer's four solutions in twice the
//! precision, and the Hankel integral is a sum of Gauss–Legendre rules on panels that double from far below every length of the ground
//! and are nowhere longer than a few turns of the Bessel functions. Nothing is subtracted, nothing adapts.
//!
//! Each layer's solutions, (U, W) = (1, 1)e^(−x), (x, x+κ)e^(−x) with x from its top, (1, −1)e^y, (y, −y+κ)e^y with y ≤ 0 from its
//! bottom, κ = 3 − 4ν, never grow. From the base up, the growing amplitudes of a layer and the decaying ones of the next follow from its
//! own decaying ones by the four conditions of the bonded interface.

use std::f64::consts::TAU;

use testkit::gauss_legendre::gauss_legendre;

use crate::double_double::Double;

/// Thickness, shear modulus and Poisson's ratio of a layer.
#[derive(Debug, Clone, Copy)]
pub struct Layer {
    pub thickness: f64,
    pub shear: f64,
    pub poisson: f64,
}

/// Layers on a half-space (its thickness is not used) or on rock.
#[derive(Debug, Clone)]
pub struct Ground {
    pub layers: Vec<Layer>,
    pub base: Option<Layer>,
}

/// U, W, τ/m, σ/m for each of two amplitudes.
type States = [[Double; 2]; 4];

/// How fine the quadrature is.
#[derive(Debug, Clone, Copy)]
pub struct Fineness {
    /// Nodes a panel.
    pub nodes: usize,
    /// Largest phase of the Bessel functions over a panel.
    pub phase: f64,
    /// Longest wavenumber times depth, and shortest one times the ground's longest length.
    pub range: (f64, f64),
}

pub const USUAL: Fineness = Fineness {
    nodes: 20,
    phase: 20.0,
    range: (50.0, 1e-5),
};
pub const FINER: Fineness = Fineness {
    nodes: 32,
    phase: 14.0,
    range: (75.0, 1e-8),
};

impl Layer {
    /// The two solutions that decay downward, at x = m · (distance below the layer's top).
    fn falling(&self, x: Double) -> States {
        let nu = Double::from(self.poisson);
        let (one, two, four) = (Double::ONE, Double::from(2.0), Double::from(4.0));
        let mu = Double::from(self.shear);
        let kappa = Double::from(3.0) - four * nu;
        let decay = (-x).exp();
        let shear = [-two * mu, (four * nu - two - two * x) * mu];
        let normal = [-two * mu, (four * nu - four - two * x) * mu];
        scaled([[one, x], [one, x + kappa], shear, normal], decay)
    }
}

/// The two solutions that decay upward, as far above the layer's bottom as `falling` is below its top: U and σ change their signs with
/// z → −z relative to W's and τ's.
fn rising(falling: States) -> States {
    let [[a, b], [c, d], [e, f], [g, h]] = falling;
    [[a, -b], [-c, d], [-e, f], [g, -h]]
}

fn scaled(states: States, factor: Double) -> States {
    states.map(|row| row.map(|value| value * factor))
}

/// `one` · a + `other` · b for 2 × 2 matrices a and b of amplitudes.
fn combined(one: &States, a: [[Double; 2]; 2], other: &States, b: [[Double; 2]; 2]) -> States {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            one[i][0] * a[0][j] + one[i][1] * a[1][j] + other[i][0] * b[0][j] + other[i][1] * b[1][j]
        })
    })
}

/// x of [left, right] x = rhs, 4 unknowns and two right-hand sides, by elimination with scaled partial pivoting.
fn solved(left: &States, right: &States, rhs: &States) -> [[Double; 2]; 4] {
    let parts = [left, right, rhs];
    let mut rows: [[Double; 6]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| parts[j / 2][i][j % 2]));
    let size = |value: &Double| value.value().abs();
    let mut scale = rows.map(|row| row[..4].iter().map(size).fold(0.0, f64::max));
    for k in 0..4 {
        let share = |row: usize| size(&rows[row][k]) / scale[row];
        let pivot = (k..4).max_by(|&a, &b| share(a).total_cmp(&share(b)));
        let pivot = pivot.expect("rows");
        rows.swap(k, pivot);
        scale.swap(k, pivot);
        let eliminator = rows[k];
        let inverse = Double::ONE / eliminator[k];
        for row in &mut rows[k + 1..] {
            let factor = row[k] * inverse;
            for (value, above) in row.iter_mut().zip(eliminator).skip(k) {
                *value = *value - factor * above;
            }
        }
    }
    let mut x = [[Double::ZERO; 2]; 4];
    for k in (0..4).rev() {
        for (c, column) in [4, 5].into_iter().enumerate() {
            let mut value = rows[k][column];
            for j in k + 1..4 {
                value = value - rows[k][j] * x[j][c];
            }
            x[k][c] = value / rows[k][k];
        }
    }
    x
}

impl Ground {
    /// Longest length over which the ground can carry a load: its thickness by the contrast of its moduli.
    fn longest(&self) -> f64 {
        let moduli = || self.layers.iter().chain(&self.base).map(|layer| layer.shear);
        let contrast = moduli().fold(0.0, f64::max) / moduli().fold(f64::INFINITY, f64::min);
        let thickness: f64 = self.layers.iter().map(|layer| layer.thickness).sum();
        contrast * thickness
    }

    /// The same ground with an interface at `depth`, and the number of layers above it.
    fn split(&self, depth: f64) -> (Self, usize) {
        let mut layers = Vec::new();
        let mut above = 0.0;
        let mut count = None;
        let below = self.base.map(|base| Layer {
            thickness: f64::INFINITY,
            ..base
        });
        for layer in self.layers.iter().copied().chain(below) {
            let upper = depth - above;
            if count.is_none() && upper < layer.thickness {
                let of = |thickness| Layer { thickness, ..layer };
                layers.extend((upper > 0.0).then(|| of(upper)));
                count = Some(layers.len());
                layers.push(of(layer.thickness - upper.max(0.0)));
            } else {
                layers.push(layer);
            }
            above += layer.thickness;
        }
        if self.base.is_some() {
            layers.pop();
        }
        let base = self.base;
        (
            Self { layers, base },
            count.expect("the depth lies above the rock"),
        )
    }

    /// m times the transform of (u_r, u_z) under a unit pressure, below the first `above` layers.
    fn transform(&self, above: usize, m: f64) -> (f64, f64) {
        let zero = Double::ZERO;
        let identity = [[Double::ONE, zero], [zero, Double::ONE]];
        // States at the top of what lies below for its two amplitudes: for rock, its two tractions.
        let mut below: States = match &self.base {
            Some(base) => base.falling(zero),
            None => [[zero; 2], [zero; 2], identity[0], identity[1]],
        };
        let mut tops = vec![below];
        let mut passages = Vec::new();
        for layer in self.layers.iter().rev() {
            let x = Double::from(m) * Double::from(layer.thickness);
            let (near, far) = (layer.falling(zero), layer.falling(x));
            // below · d' − rising · u = falling(x) · d.
            let [a, b, c, d] = solved(&below, &scaled(rising(near), -Double::ONE), &far);
            passages.push([a, b]);
            below = combined(&near, identity, &rising(far), [c, d]);
            tops.push(below);
        }
        tops.reverse();
        passages.reverse();
        // No shear, and σ = −1, at the surface.
        let [a, b] = below[2];
        let [c, d] = below[3];
        let determinant = a * d - b * c;
        let mut amplitude = [b / determinant, -a / determinant];
        for passage in &passages[..above] {
            amplitude = std::array::from_fn(|i| passage[i][0] * amplitude[0] + passage[i][1] * amplitude[1]);
        }
        let displacement = |row: usize| {
            let states = &tops[above][row];
            (states[0] * amplitude[0] + states[1] * amplitude[1]).value()
        };
        (displacement(0), displacement(1))
    }

    /// (u_r, u_z) at `radii` and `depth` > 0 under a force of 1 N on a disc of `contact_radius`, 0 for a point load.
    pub fn displacements(
        &self,
        contact_radius: f64,
        radii: &[f64],
        depth: f64,
        fineness: Fineness,
    ) -> Vec<(f64, f64)> {
        let rule = gauss_legendre(fineness.nodes);
        let (ground, above) = self.split(depth);
        let farthest = radii.iter().fold(0.0_f64, |most, &r| most.max(r)) + contact_radius;
        let highest = fineness.range.0 / depth;
        let lowest = fineness.range.1 / self.longest().max(depth + farthest);
        let mut sums = vec![(0.0, 0.0); radii.len()];
        let (mut from, mut to) = (0.0, lowest);
        while from < highest {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            for &(t, weight) in &rule {
                let m = middle + half * t;
                let (u, w) = ground.transform(above, m);
                let x = m * contact_radius;
                let near_zero = 1.0 - x * x / 8.0;
                let pressure = if x < 1e-4 {
                    near_zero
                } else {
                    2.0 * libm::j1(x) / x
                };
                let share = weight * half * pressure / TAU;
                for (sum, &radius) in sums.iter_mut().zip(radii) {
                    sum.0 += share * u * libm::j1(m * radius);
                    sum.1 += share * w * libm::j0(m * radius);
                }
            }
            from = to;
            to = (2.0 * from).min(from + fineness.phase / farthest.max(depth));
        }
        sums
    }
}
