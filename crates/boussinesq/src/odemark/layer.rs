//! One layer as if it had no bottom, under layers turned into their equivalent thickness.
//!
//! See [`Odemark`](crate::Odemark) for the equations.

use ground_field::Soil;

use super::sum::{Term, Transform, scaled};

/// Correction factor of the equivalent thickness for a large contrast of moduli: Ullidtz (1987).
const LARGE_CONTRAST: f64 = 0.8;

/// Length over which the stiff layers' rotation is averaged, as a multiple of their thickness.
const ROTATION_REACH: f64 = 1.25;

/// A layer, and what the layers above it amount to in its own soil.
#[derive(Debug, Clone)]
pub(super) struct Layer {
    soil: Soil,
    /// Depth of its top \[m\].
    pub top: f64,
    /// Thickness \[m\]; `None` for a half-space.
    pub thickness: Option<f64>,
    /// Equivalent thickness h_e of everything above \[m\].
    equivalent: f64,
    /// Length L over which the layers above, as a membrane, keep the surface from moving inward \[m\].
    membrane: f64,
    /// Share η of the layers above that acts as a plate.
    plate_share: f64,
    /// Distance a from the plate's neutral axis to the top of this layer \[m\].
    arm: f64,
}

/// Plane-strain modulus E/(1−ν²) \[Pa\].
fn plane_modulus(soil: Soil) -> f64 {
    soil.young_modulus() / (1.0 - soil.poisson_ratio() * soil.poisson_ratio())
}

impl Layer {
    /// The layer of `soil` below `above`, each with its thickness, from the surface down.
    pub fn new(above: &[(f64, Soil)], soil: Soil, thickness: Option<f64>) -> Self {
        let mut top = 0.0;
        let mut equivalent = 0.0;
        let mut excess = 0.0;
        let mut moment = 0.0;
        for &(height, upper) in above {
            let ratio = plane_modulus(upper) / plane_modulus(soil);
            let contrast = ratio.min(1.0 / ratio);
            let factor = LARGE_CONTRAST + (1.0 - LARGE_CONTRAST) * contrast.sqrt();
            // A softer layer spreads the load over its own thickness, however stiff what lies below.
            equivalent += factor * height * ratio.max(1.0).cbrt();
            let stiffer = (ratio - 1.0).max(0.0) * height;
            excess += stiffer;
            moment += stiffer * (top + 0.5 * height);
            top += height;
        }
        let (plate_share, arm) = if excess > 0.0 {
            (1.0 / (1.0 + top / excess), top - moment / excess)
        } else {
            (0.0, 0.0)
        };
        Self {
            soil,
            top,
            thickness,
            equivalent,
            membrane: excess,
            plate_share,
            arm,
        }
    }

    /// Transforms of u_r and u_z under a unit force, at `height` \[m\] below the layer's top.
    pub fn field(&self, height: f64) -> (Transform, Transform) {
        let nu = self.soil.poisson_ratio();
        let compliance = (1.0 + nu) / (std::f64::consts::TAU * self.soil.young_modulus());
        // At the layer's top; depths counted from the equivalent surface.
        let vertical = vec![Term {
            depth: self.equivalent,
            powers: [2.0 * (1.0 - nu) * compliance, self.equivalent * compliance, 0.0],
        }];
        let mut radial = vec![
            Term {
                depth: self.equivalent + self.membrane,
                powers: [-(1.0 - 2.0 * nu) * compliance, 0.0, 0.0],
            },
            Term {
                depth: self.equivalent,
                powers: [0.0, (1.0 - self.plate_share) * self.top * compliance, 0.0],
            },
        ];
        if self.plate_share > 0.0 {
            radial.extend(rotation(
                &vertical,
                self.plate_share * self.arm,
                ROTATION_REACH * self.top,
            ));
        }
        // Down to `height`: both components gain m ζ (W − U)/κ, and all of it decays with ζ.
        let kappa = 3.0 - 4.0 * nu;
        let gain: Transform = scaled(&vertical, height / kappa, 0.0)
            .chain(scaled(&radial, -height / kappa, 0.0))
            .collect();
        let gain = gain.into_iter().map(|term| Term {
            depth: term.depth,
            powers: [0.0, term.powers[0], term.powers[1]],
        });
        let gain: Transform = gain.collect();
        let down = |transform: &Transform| {
            scaled(transform, 1.0, height)
                .chain(scaled(&gain, 1.0, height))
                .collect()
        };
        (down(&radial), down(&vertical))
    }
}

/// Radial transform `arm` · m̄ · W of plate rotation, with m̄ = (1 − e^{−m reach})/reach in the place of m.
pub(super) fn rotation(vertical: &[Term], arm: f64, reach: f64) -> Transform {
    let factor = arm / reach;
    scaled(vertical, factor, 0.0)
        .chain(scaled(vertical, -factor, reach))
        .collect()
}
