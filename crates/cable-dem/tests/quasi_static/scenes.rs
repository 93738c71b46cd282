//! Scenes and helpers that several tests share.

use std::ops::Range;

use boussinesq::HalfSpace;
use cable_dem::{
    CableError, CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, PassOutcome, Passage, QuasiStatic,
    Restraint,
};
use ground_field::{Direction, DuctMotion};
use proptest::prelude::*;

/// Distance beyond the duct's ends from which vehicles come \[m\].
pub const APPROACH: f64 = 15.0;
/// EA of the reference cables \[N\].
pub const AXIAL_STIFFNESS: f64 = 8.01e6;
/// q b/2 of the reference cables: shear stiffness of their sheaths \[N/m²\].
pub const SHEATH_STIFFNESS: f64 = 1e8;
/// Friction limits of the reference cables \[N/m\]: upper phase, and lower phase with the load of the others.
pub const LIMITS: [f64; 2] = [0.25 * 108.8, 0.27 * 163.2];

/// Young's modulus 800 MPa, Poisson's ratio 0.4, a load of 20 tf, a duct at 1.2 m.
pub fn reference_motion() -> DuctMotion {
    let ground = HalfSpace::new(testkit::soil(800e6, 0.4));
    testkit::truck(&ground, 11.1).expect("a smooth field")
}

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

/// Nodes at which clamps pull, and with which stiffness \[N/m\]: within an element at both of its nodes, by the lever rule.
pub fn clamp_springs(cable: &DuctedCable, mesh: &Mesh) -> Vec<(usize, f64)> {
    let pulls = |clamp: &Restraint| {
        let place = clamp.position / mesh.spacing();
        let left = (place as usize).min(mesh.elements() - 1);
        let share = place - left as f64;
        [
            (left, (1.0 - share) * clamp.stiffness),
            (left + 1, share * clamp.stiffness),
        ]
    };
    cable.restraints().iter().flat_map(pulls).collect()
}

/// Largest magnitude, infinite for NaN.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |worst: f64, value| {
        if value.is_nan() {
            f64::INFINITY
        } else {
            worst.max(value.abs())
        }
    })
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
        let cable = self.solver.cable();
        let ends = self.state.end_forces(cable).expect("the state's mesh");
        let inner = self.state.element_forces(cable).expect("the state's mesh");
        let upstream = std::iter::once(ends.upstream);
        upstream.chain(inner).chain([ends.downstream]).collect()
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
        for (node, end) in [(0, cable.upstream()), (last, cable.downstream())] {
            match end {
                End::Free => {}
                End::Spring(stiffness) => force[node] -= stiffness * u[node],
                End::Fixed => force[node] = 0.0,
            }
        }
        for (node, stiffness) in clamp_springs(cable, mesh) {
            let end = [(0, cable.upstream()), (last, cable.downstream())];
            if !end.contains(&(node, End::Fixed)) {
                force[node] -= stiffness * u[node];
            }
        }
        largest(&force) / (cable.friction().limit() * h)
    }

    /// Largest friction as a share of its limit.
    pub fn utilisation(&self) -> f64 {
        largest(self.state.friction()) / self.solver.cable().friction().limit()
    }
}

/// Largest difference of two equally long lists.
pub fn largest_difference(one: &[f64], two: &[f64]) -> f64 {
    assert_eq!(one.len(), two.len());
    one.iter()
        .zip(two)
        .fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()))
}
