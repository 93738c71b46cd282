//! Friction on a node that does not move: Coulomb's law on the last half element before a fixed end.
//!
//! The duct slips past a fixed end however little it moves, and Coulomb friction there turns over at once. Along the
//! cable it does so only where the cable cannot follow: when the duct turns back by s, over the length
//!
//! X = √(EA s/q),  by which the force on the end changes by 2 q X
//!
//! (Masing's rule for the anchored bar, whose first loading by D reaches √(2EA·D/q)). A mesh with h > X has no node in that
//! zone. Its chain, stuck to the duct but for the end, takes EA s/h = q X²/h of the change; the rest is the friction of
//! the end's half element,
//!
//! (h/2) Δf = 2 q X − q X²/h,  that is  φ = 2y − y²,  y = X/h,  φ = (q ± f)/(2q),
//!
//! which has turned over wholly at X = h, where the next node begins to slip. Letting it turn over at once would put the
//! force off by up to q h after the least backward motion of a vehicle's fading field: an error of first order.
//!
//! On the 30 m scene with h = 0.4 m that error was 9 % of the force of the first pass (105.8 N), with this law 0.2 %
//! (115.7 N, 115.9 N with h = 0.025 m). It remains on ends held by springs stiffer than an element, and for sheaths whose
//! screening length is below h/√2.
//!
//! Each direction has its one branch from −q to q, entered where the friction stands: turns within a branch that has not
//! come to its end are taken a little too stiff. A sheath (finite b) is sheared as its own law says.

use crate::{DuctedCable, Friction, FrictionLaw, Mesh};

/// The friction law of a fixed end's node.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FixedEndFriction {
    pub friction: Friction,
    /// h²/EA \[m²/N\]: times q the slip after which the whole half element has turned over.
    turning: f64,
}

impl FixedEndFriction {
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        Self {
            friction: cable.friction(),
            turning: mesh.spacing().powi(2) / cable.axial_stiffness(),
        }
    }

    /// Friction \[N/m\] of a node with the friction `limit` q after the duct has slipped by `slip` \[m\] past it, from `before`.
    pub fn after_slip(self, before: f64, slip: f64, limit: f64) -> f64 {
        if self.friction.law() != FrictionLaw::Coulomb || slip == 0.0 {
            return self.friction.after_slip_within(before, slip, limit);
        }
        let turned = (0.5 + 0.5 * before / limit.copysign(slip)).clamp(0.0, 1.0);
        let reached = 1.0 - (1.0 - turned).sqrt();
        let y = (reached * reached + slip.abs() / (limit * self.turning))
            .sqrt()
            .min(1.0);
        (2.0 * y * (2.0 - y) - 1.0) * limit.copysign(slip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CableError;

    /// q = 1, h²/EA = 1.
    fn node() -> Result<FixedEndFriction, CableError> {
        let cable = DuctedCable::new(10.0, 1.0, Friction::new(FrictionLaw::Coulomb, 1.0)?)?;
        Ok(FixedEndFriction::new(&cable, &Mesh::new(10.0, 1.0, 1.0)?))
    }

    #[test]
    fn many_small_slips_are_one_large_one() -> Result<(), CableError> {
        let node = node()?;
        for slip in [0.01, 0.3, 0.9, 2.0] {
            let small = (0..100).fold(1.0, |f, _| node.after_slip(f, -0.01 * slip, 1.0));
            assert!((small - node.after_slip(1.0, -slip, 1.0)).abs() < 1e-9);
        }
        Ok(())
    }

    #[test]
    fn both_directions_are_mirror_images_that_stay_within_the_limit() -> Result<(), CableError> {
        let node = node()?;
        for before in [-1.0, -0.4, 0.0, 0.7, 1.0] {
            assert_eq!(node.after_slip(before, 0.0, 1.0), before);
            for slip in [1e-300, 1e-9, 0.1, 1.0, 1e300] {
                let (up, down) = (
                    node.after_slip(before, slip, 1.0),
                    node.after_slip(-before, -slip, 1.0),
                );
                assert_eq!(up, -down);
                assert!((before - 1e-9..=1.0).contains(&up), "{before} {slip}: {up}");
            }
            assert_eq!(node.after_slip(before, 1.0, 1.0), 1.0);
        }
        Ok(())
    }
}
