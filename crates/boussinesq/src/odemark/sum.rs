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

use crate::shape::Shape;
use crate::{disc, point};

/// Half the step of the central difference, as a share of the depth.
const STEP: f64 = 1e-3;

/// Factors of m⁰, m¹ and m².
pub(super) type Powers = [f64; 3];

/// One exponential e^{−mδ} and its factor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Term {
    pub depth: f64,
    pub powers: Powers,
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

/// The terms at one depth.
#[derive(Debug, Clone, Copy)]
struct Level {
    depth: f64,
    radial: Powers,
    vertical: Powers,
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
        for term in radial {
            add(&mut sum.level(term.depth).radial, term.powers);
        }
        for term in vertical {
            add(&mut sum.level(term.depth).vertical, term.powers);
        }
        sum.levels
            .retain(|level| level.radial != [0.0; 3] || level.vertical != [0.0; 3]);
        sum
    }

    fn level(&mut self, depth: f64) -> &mut Level {
        let found = self.levels.iter().position(|level| level.depth == depth);
        let place = found.unwrap_or(self.levels.len());
        if found.is_none() {
            self.levels.push(Level {
                depth,
                radial: [0.0; 3],
                vertical: [0.0; 3],
            });
        }
        &mut self.levels[place]
    }

    /// The displacement at `radius` under `load`; not finite at the load itself.
    pub fn displacement(&self, load: SurfaceLoad, radius: f64) -> Displacement {
        let mut total = Displacement::ZERO;
        for level in &self.levels {
            let (surface, shear) = parts(load, radius, level.depth);
            let mut values = [surface, shear, Displacement::ZERO];
            if level.radial[2] != 0.0 || level.vertical[2] != 0.0 {
                let step = STEP * level.depth;
                let (_, above) = parts(load, radius, level.depth - step);
                let (_, below) = parts(load, radius, level.depth + step);
                values[2] = (above - below) * (0.5 / step);
            }
            for (power, value) in values.into_iter().enumerate() {
                // A factor of zero may stand before a value that does not exist, such as the shear terms at depth 0.
                if level.radial[power] != 0.0 {
                    total.radial += level.radial[power] * value.radial;
                }
                if level.vertical[power] != 0.0 {
                    total.vertical += level.vertical[power] * value.vertical;
                }
            }
        }
        total * load.force()
    }
}

fn add(to: &mut Powers, powers: Powers) {
    for (value, more) in to.iter_mut().zip(powers) {
        *value += more;
    }
}

/// e^{−mδ} and m e^{−mδ} in space.
fn parts(load: SurfaceLoad, radius: f64, depth: f64) -> (Displacement, Displacement) {
    let distance = point::distance(radius, depth);
    let (shape, length): (Shape, f64) = if load.is_point() {
        (point::shape(radius, depth, distance), distance)
    } else {
        disc::shape(radius, depth, distance, load.contact_radius())
    };
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
