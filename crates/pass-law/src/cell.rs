//! One pass over a piece of duct with uniform locked friction: the cell problem.
//!
//! # Problem
//!
//! A long cable carries the friction f̄ everywhere, in equilibrium: EA u″ = −f̄. A vehicle passes. Far behind it friction is
//! f̄ again and the cable has advanced by a distance that is the same everywhere, G(f̄).
//!
//! # Realisation
//!
//! A piece of cable with the parabola EA u″ = −f̄ and friction f̄ at every node needs the force f̄ ℓ/2 at each end. Two
//! springs supply it, so soft that they do not notice the advance of a pass: dead loads, between which the increments of
//! displacement are as free as between free ends. Behind the entrance the advance settles exponentially toward G; three
//! equidistant readings give the limit (Aitken's extrapolation), three more nearer to the entrance its error.
//!
//! # Limits
//!
//! As |f̄| → q the vehicle's effect reaches ever farther ahead, and the advance no longer settles within the cell.

use cable_dem::{CableState, DuctedCable, End, Mesh, Passage, QuasiStatic};
use ground_field::DuctMotion;

use crate::{LawError, Resolution};

/// Length of a cell in fading lengths, beside the vehicle's own length.
const CELL_LENGTHS: f64 = 36.0;
/// Distance in depths from which vehicles come.
const APPROACH_DEPTHS: f64 = 40.0;
/// The dead loads' springs are stretched by this many times the duct's largest displacement.
const STRETCH: f64 = 3000.0;

/// Stiffness \[N/m\] and stretch \[m\] of a spring that holds `force` \[N\] as a dead load.
pub(crate) fn dead_load(force: f64, peak: f64) -> (f64, f64) {
    if force == 0.0 {
        return (0.0, 0.0);
    }
    let stretch = STRETCH.copysign(force) * peak;
    (force / stretch, stretch)
}

/// Friction varies by this share of its limit along a cell with a gradient.
const GRADIENT: f64 = 0.1;

/// One advance and what it cost.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Advance {
    /// G \[m\].
    pub value: f64,
    /// Estimated error \[m\].
    pub error: f64,
}

/// The cell problem for one vehicle.
#[derive(Debug, Clone)]
pub(crate) struct Cell<'a> {
    cable: DuctedCable,
    motion: &'a DuctMotion,
    mesh: Mesh,
    approach: f64,
    /// Cells solved.
    pub passes: usize,
}

impl<'a> Cell<'a> {
    pub fn new(
        cable: &DuctedCable,
        motion: &'a DuctMotion,
        resolution: Resolution,
    ) -> Result<Self, LawError> {
        let length = CELL_LENGTHS * resolution.fading_length(cable, motion.peak_longitudinal())
            + 2.0 * motion.half_length();
        let approach = APPROACH_DEPTHS * resolution.depth() + motion.half_length();
        let mesh = Mesh::new(length, resolution.node_spacing(), resolution.vehicle_step())?;
        Ok(Self {
            cable: DuctedCable::new(length, cable.axial_stiffness(), cable.friction())?,
            motion,
            mesh,
            approach,
            passes: 0,
        })
    }

    /// G at the locked `friction` \[N/m\].
    pub fn advance(&mut self, friction: f64) -> Result<Advance, LawError> {
        let moved = self.pass(friction, 0.0)?;
        let reading = |share: f64| moved[self.node(share)];
        let near = limit([reading(0.40), reading(0.54), reading(0.68)]);
        let far = limit([reading(0.47), reading(0.61), reading(0.75)]);
        Ok(Advance {
            value: far,
            error: (far - near).abs(),
        })
    }

    /// B \[m³/N\] at the locked `friction` \[N/m\]: what its gradient along the duct adds to the advance, Δu = G(f̄) + B ∂f̄/∂x.
    /// `slope` is G′ \[m²/N\].
    ///
    /// Two passes over cells with the gradients ±β; the difference of their advances, less what `advance`, G, makes of the
    /// local friction.
    pub fn skew(&mut self, friction: f64, advance: impl Fn(f64) -> f64) -> Result<f64, LawError> {
        let gradient = GRADIENT * self.cable.friction().limit() / self.cable.length();
        let (rising, falling) = (self.pass(friction, gradient)?, self.pass(friction, -gradient)?);
        let reading = |share: f64| {
            let node = self.node(share);
            let change = gradient * (self.mesh.spacing() * node as f64 - 0.5 * self.cable.length());
            let local = advance(friction + change) - advance(friction - change);
            0.5 * (rising[node] - falling[node] - local) / gradient
        };
        Ok(limit([reading(0.40), reading(0.51), reading(0.62)]))
    }

    /// Node at a share of the cell's length from where the vehicle enters.
    fn node(&self, share: f64) -> usize {
        let share = if self.motion.velocity() < 0.0 {
            1.0 - share
        } else {
            share
        };
        (share * self.mesh.elements() as f64).round() as usize
    }

    /// Advance of every node \[m\] in one pass over a cell with `friction` \[N/m\] in its middle and a
    /// `gradient` \[N/m²\] along it.
    fn pass(&mut self, friction: f64, gradient: f64) -> Result<Vec<f64>, LawError> {
        let length = self.cable.length();
        let (spring, stretch) = dead_load(0.5 * friction * length, self.motion.peak_longitudinal());
        // The gradient adds no force at the ends, but moves them apart.
        let (bend, twist) = (
            0.5 * friction / self.cable.axial_stiffness(),
            gradient / self.cable.axial_stiffness(),
        );
        let apart = twist * length.powi(3) / 12.0;
        let far_spring = spring * stretch / (stretch + apart);
        let far_spring = if far_spring > 0.0 { far_spring } else { 0.0 };
        let cable = self
            .cable
            .clone()
            .with_ends(End::Spring(spring), End::Spring(far_spring))?;
        let passage = Passage::new(&cable, &self.mesh, self.motion, self.approach)?;
        let place = |i: usize| self.mesh.spacing() * i as f64;
        let start: Vec<f64> = (0..self.mesh.nodes())
            .map(place)
            .map(|x| stretch + bend * x * (length - x) + twist * x * x * (0.25 * length - x / 6.0))
            .collect();
        let locked = (0..self.mesh.nodes())
            .map(|i| friction + gradient * (place(i) - 0.5 * length))
            .collect();
        let mut state = CableState::from_parts(&self.mesh, start.clone(), locked)?;
        QuasiStatic::new(cable, self.mesh)?.pass(&passage, &mut state)?;
        self.passes += 1;
        let moved = state.displacement().iter().zip(&start);
        Ok(moved.map(|(after, before)| after - before).collect())
    }

    pub fn length(&self) -> f64 {
        self.cable.length()
    }
}

/// Limit of a sequence that settles geometrically; its last member where it does not.
pub(crate) fn limit([a, b, c]: [f64; 3]) -> f64 {
    let (first, second) = (b - a, c - b);
    if second.abs() < 0.9 * first.abs() {
        c + second * second / (first - second)
    } else {
        c
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_geometric_sequence_is_extrapolated_to_its_limit() {
        for ratio in [0.6_f64, -0.3] {
            let value = limit([2.0 + ratio, 2.0 + ratio * ratio, 2.0 + ratio.powi(3)]);
            assert!((value - 2.0).abs() < 1e-14);
        }
        assert_eq!(limit([1.0, 1.0, 1.0]), 1.0);
        assert_eq!(limit([1.0, 2.0, 3.0]), 3.0);
    }
}
