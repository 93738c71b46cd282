//! Scenes and helpers that several tests share.

use std::ops::Range;

use cable_dem::{
    CableError, CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, PassOutcome, Passage, QuasiStatic,
};
use ground_field::{Direction, DuctMotion};
use proptest::prelude::*;

pub use super::shared::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, assert_near, clamp_springs, largest, reference_motion,
};

/// q b/2 of the reference cables: shear stiffness of their sheaths \[N/m²\].
const SHEATH_STIFFNESS: f64 = 1e8;

/// Wheels of a vehicle: where each stands \[m\], how far it moves the duct \[m\], and over which width \[m\].
pub fn any_wheels(moved: Range<f64>) -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
    prop::collection::vec((-12.0..12.0_f64, moved, 0.6..2.5_f64), 1..6)
}

/// The duct's displacement \[m\] at `xi`, of wheels that each move it in this `shape` of the distance over its width.
pub fn wheeled(wheels: &[(f64, f64, f64)], xi: f64, shape: impl Fn(f64) -> f64) -> f64 {
    let wheel = |&(x, moved, width): &(f64, f64, f64)| moved * shape((xi - x) / width);
    wheels.iter().map(wheel).sum()
}

pub fn any_end(stiffness: Range<f64>) -> impl Strategy<Value = End> {
    prop_oneof![
        Just(End::Free),
        Just(End::Fixed),
        (stiffness.start.ln()..stiffness.end.ln()).prop_map(|e| End::Spring(e.exp()))
    ]
}

/// The passage of `motion` on whatever mesh, also one too coarse to say anything of the duct.
pub fn unjudged_passage(cable: &DuctedCable, mesh: &Mesh, motion: &DuctMotion) -> Passage {
    let shape = |xi: f64| motion.longitudinal(xi);
    Passage::from_shape(cable, mesh, Direction::Forward, shape, APPROACH).expect("a valid passage")
}

/// Elastic-plastic friction with limit `limit` \[N/m\] and the reference sheath.
pub fn sheathed(limit: f64) -> Friction {
    elastic_plastic(2.0 * SHEATH_STIFFNESS / limit, limit)
}

pub fn elastic_plastic(shape_factor: f64, limit: f64) -> Friction {
    Friction::new(FrictionLaw::ElasticPlastic { shape_factor }, limit).expect("valid friction")
}

pub fn coulomb(limit: f64) -> Friction {
    Friction::new(FrictionLaw::Coulomb, limit).expect("valid friction")
}

/// A reference cable: upstream free, downstream fixed.
pub fn reference_cable(length: f64, friction: Friction) -> DuctedCable {
    cable(length, AXIAL_STIFFNESS, friction, End::Free, End::Fixed)
}

pub fn cable(
    length: f64,
    axial_stiffness: f64,
    friction: Friction,
    upstream: End,
    downstream: End,
) -> DuctedCable {
    DuctedCable::new(length, axial_stiffness, friction)
        .and_then(|cable| cable.with_ends(upstream, downstream))
        .expect("a valid cable")
}

/// One cable, its solver and its state.
#[derive(Debug, Clone)]
pub struct Run {
    pub solver: QuasiStatic,
    pub state: CableState,
}

impl Run {
    pub fn new(cable: DuctedCable, mesh: Mesh) -> Self {
        Self {
            solver: QuasiStatic::new(cable, mesh).expect("a valid solver"),
            state: CableState::at_rest(&mesh),
        }
    }

    /// And the passage of the reference's vehicle, with vehicle steps of half an element.
    pub fn under_truck(cable: &DuctedCable, spacing: f64) -> (Self, Passage) {
        let mesh = Mesh::new(cable.length(), spacing, 0.5 * spacing).expect("a valid mesh");
        let passage = Passage::new(cable, &mesh, &reference_motion(), APPROACH).expect("a valid passage");
        (Self::new(cable.clone(), mesh), passage)
    }

    pub fn try_pass(&mut self, passage: &Passage) -> Result<PassOutcome, CableError> {
        self.solver.pass(passage, &mut self.state)
    }

    pub fn pass(&mut self, passage: &Passage) -> PassOutcome {
        self.try_pass(passage).expect("an equilibrium")
    }

    /// One pass; `observe` sees the vehicle's position \[m\] and the cable at each of them.
    pub fn watch(&mut self, passage: &Passage, mut observe: impl FnMut(f64, &CableState)) -> PassOutcome {
        let watched = self
            .solver
            .pass_observed(passage, &mut self.state, |vehicle, state| {
                observe(vehicle, &state());
            });
        watched.expect("an equilibrium")
    }

    /// One pass, and the cable at the vehicle's last position, before the ground returns to rest.
    pub fn pass_and_last(&mut self, passage: &Passage) -> (PassOutcome, CableState) {
        let mut last = self.state.clone();
        let outcome = self.watch(passage, |_, cable| last.clone_from(cable));
        (outcome, last)
    }

    /// Several passes; the last one's outcome.
    pub fn passes(&mut self, count: usize, passage: &Passage) -> PassOutcome {
        (0..count).fold(PassOutcome::default(), |_, _| self.pass(passage))
    }

    /// Compression along the cable \[N\]: at its upstream end, in its elements, at its downstream end.
    pub fn forces(&self) -> Vec<f64> {
        super::shared::forces(self.solver.cable(), &self.state)
    }

    /// Largest imbalance of a node that is not fixed, as a share of the friction limit on one element: equilibrium written
    /// out anew from the cable's definition.
    pub fn imbalance(&self) -> f64 {
        let (cable, mesh) = (self.solver.cable(), self.solver.mesh());
        let (u, f) = (self.state.displacement(), self.state.friction());
        let (h, last) = (mesh.spacing(), mesh.elements());
        let k = cable.axial_stiffness() / h;
        let mut force: Vec<f64> = (0..=last)
            .map(|i| f[i] * if i == 0 || i == last { 0.5 * h } else { h })
            .collect();
        for i in 0..last {
            let tension = k * (u[i + 1] - u[i]);
            force[i] += tension;
            force[i + 1] -= tension;
        }
        let ends = [(0, cable.upstream()), (last, cable.downstream())];
        let springs = ends.map(|(node, end)| (node, end.stiffness().unwrap_or(0.0)));
        for (node, stiffness) in springs.into_iter().chain(clamp_springs(cable, mesh)) {
            force[node] -= stiffness * u[node];
        }
        for (node, _) in ends.into_iter().filter(|(_, end)| *end == End::Fixed) {
            force[node] = 0.0;
        }
        largest(force) / (cable.friction().limit() * h)
    }

    /// Largest friction as a share of its limit.
    pub fn utilisation(&self) -> f64 {
        largest(self.state.friction().iter().copied()) / self.solver.cable().friction().limit()
    }
}

/// Largest difference of two equally long lists.
pub fn largest_difference(one: &[f64], two: &[f64]) -> f64 {
    assert_eq!(one.len(), two.len());
    largest(one.iter().zip(two).map(|(a, b)| a - b))
}
