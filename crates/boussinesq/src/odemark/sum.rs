//! A sum of half-space fields at several depths.
//!
//! Everything [`Odemark`](crate::Odemark) computes has the Hankel transform Σ c mⁿ e^{−mδ} with n = 0, 1 or 2 and a few depths δ.
//! Back in space, for a unit force on a point or a disc,
//!
//! ```text
//! n = 0: the surface terms of the half-space at depth δ
//! n = 1: its shear terms there, divided by δ
//! n = 2: minus the derivative of those with δ
//! ```
//!
//! each radial with J₁ and vertical with J₀. The derivative is a central difference over ±0.1 % of δ, right to 1e-5: far
//! below the model's own error.

use ground_field::{Displacement, SurfaceLoad};

use crate::disc;

/// Half the step of the central difference, as a share of the depth.
const STEP: f64 = 1e-3;

/// One exponential e^{−mδ} and its factor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Term {
    pub depth: f64,
    /// Factors of m⁰, m¹ and m².
    pub powers: [f64; 3],
}

/// A transform as a list of terms.
pub(super) type Transform = Vec<Term>;

/// `transform` times `factor`, its depths moved by `shift`.
pub(super) fn scaled(transform: &[Term], factor: f64, shift: f64) -> impl Iterator<Item = Term> + '_ {
    transform.iter().map(move |term| Term {
        depth: term.depth + shift,
        powers: term.powers.map(|value| value * factor),
    })
}

/// Value of `transform` at `wavenumber`.
pub(super) fn at(transform: &[Term], wavenumber: f64) -> f64 {
    let value = |term: &Term| {
        let [constant, linear, square] = term.powers;
        (constant + wavenumber * (linear + wavenumber * square)) * (-wavenumber * term.depth).exp()
    };
    transform.iter().map(value).sum()
}

/// The terms of u_r and u_z at one depth, by powers of m.
#[derive(Debug, Clone, Copy)]
struct Level {
    depth: f64,
    powers: [[f64; 2]; 3],
}

/// A displacement field: the transforms of u_r and u_z, terms at the same depth merged.
#[derive(Debug, Clone, Default)]
pub(super) struct Sum {
    levels: Vec<Level>,
}

impl Sum {
    /// The field with these transforms.
    pub fn new(radial: &[Term], vertical: &[Term]) -> Self {
        let mut sum = Self::default();
        let radial = radial.iter().map(|term| (0, term));
        let vertical = vertical.iter().map(|term| (1, term));
        for (component, term) in radial.chain(vertical) {
            let found = sum.levels.iter().position(|level| level.depth == term.depth);
            let place = found.unwrap_or(sum.levels.len());
            if found.is_none() {
                sum.levels.push(Level {
                    depth: term.depth,
                    powers: [[0.0; 2]; 3],
                });
            }
            for (value, more) in sum.levels[place].powers.iter_mut().zip(term.powers) {
                value[component] += more;
            }
        }
        sum.levels.retain(|level| level.powers != [[0.0; 2]; 3]);
        sum
    }

    /// The displacement at `radius` under `load`; not finite at the load itself.
    pub fn displacement(&self, load: SurfaceLoad, radius: f64) -> Displacement {
        let mut total = Displacement::ZERO;
        for level in &self.levels {
            let (surface, shear) = parts(load, radius, level.depth);
            let mut values = [surface, shear, Displacement::ZERO];
            if level.powers[2] != [0.0; 2] {
                let step = STEP * level.depth;
                let (_, above) = parts(load, radius, level.depth - step);
                let (_, below) = parts(load, radius, level.depth + step);
                values[2] = (above - below) * (0.5 / step);
            }
            for ([radial, vertical], value) in level.powers.into_iter().zip(values) {
                // A factor of zero may stand before a value that does not exist, such as the shear terms at depth 0.
                if radial != 0.0 {
                    total.radial += radial * value.radial;
                }
                if vertical != 0.0 {
                    total.vertical += vertical * value.vertical;
                }
            }
        }
        total * load.force()
    }
}

/// e^{−mδ} and m e^{−mδ} in space.
fn parts(load: SurfaceLoad, radius: f64, depth: f64) -> (Displacement, Displacement) {
    let (shape, length) = disc::shape(load, radius, depth);
    let surface = Displacement {
        radial: shape.surface_radial,
        vertical: shape.surface_vertical,
    };
    let shear = Displacement {
        radial: shape.shear_radial,
        vertical: shape.shear_vertical,
    };
    (surface * (1.0 / length), shear * (1.0 / (length * depth)))
}
