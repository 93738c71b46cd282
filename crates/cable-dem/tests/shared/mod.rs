//! What both test programs of the crate use.

use std::fmt::Debug;

use boussinesq::HalfSpace;
use cable_dem::{CableError, CableState, DuctedCable, Mesh, Restraint, Section};
use ground_field::DuctMotion;

/// Distance beyond the duct's ends from which vehicles come \[m\].
pub const APPROACH: f64 = 15.0;
/// EA of the full-scale experiment's cables \[N\].
pub const AXIAL_STIFFNESS: f64 = 8.01e6;
/// Their friction limits \[N/m\]: upper cable, and lower cable with the load of the others.
pub const LIMITS: [f64; 2] = [0.25 * 108.8, 0.27 * 163.2];
/// 40 km/h.
pub const SPEED: f64 = 40.0 / 3.6;

/// Of the duct 1.2 m below a load of 20 tf on ground of 800 MPa, ν = 0.4.
pub fn reference_motion() -> DuctMotion {
    testkit::truck(&HalfSpace::new(testkit::soil(800e6, 0.4)), SPEED).expect("a smooth field")
}

/// `cable` seen in a mirror across the duct's middle.
pub fn mirrored(cable: &DuctedCable) -> Result<DuctedCable, CableError> {
    let mut clamps = cable.restraints().to_vec();
    for clamp in &mut clamps {
        clamp.position = cable.length() - clamp.position;
    }
    let turned = |section: &Section| section.with_body_force(-section.body_force);
    let sections: Vec<Section> = cable.sections().iter().rev().map(turned).collect();
    let [upstream, downstream] = cable.end_positions();
    DuctedCable::new(cable.length(), cable.axial_stiffness(), cable.friction())?
        .with_ends(cable.downstream(), cable.upstream())?
        .with_end_positions([-downstream, -upstream])?
        .with_restraints(clamps)?
        .with_sections(&sections)
}

/// A clamp that bears no more than `holds` \[N\].
pub fn slipping(position: f64, stiffness: f64, holds: f64) -> Restraint {
    let clamp = Restraint::new(position, stiffness);
    let holds = Some(holds);
    Restraint { holds, ..clamp }
}

/// Nodes at which clamps pull, and with which stiffness \[N/m\]: within an element at both of its nodes, by the lever rule.
pub fn clamp_springs(cable: &DuctedCable, mesh: &Mesh) -> Vec<(usize, f64)> {
    let pulls = |clamp: &Restraint| {
        let place = clamp.position / mesh.spacing();
        let left = (place as usize).min(mesh.elements() - 1);
        let share = place - left as f64;
        let stiffness = clamp.stiffness;
        [(left, (1.0 - share) * stiffness), (left + 1, share * stiffness)]
    };
    cable.restraints().iter().flat_map(pulls).collect()
}

/// Compression along the cable \[N\]: at its upstream end, in its elements, at its downstream end.
pub fn forces(cable: &DuctedCable, state: &CableState) -> Vec<f64> {
    let ends = state.end_forces(cable).expect("the state's mesh");
    let inner = state.element_forces(cable).expect("the state's mesh");
    let upstream = std::iter::once(ends.upstream);
    upstream.chain(inner).chain([ends.downstream]).collect()
}

/// Largest magnitude, infinite for NaN.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let size = |value: f64| {
        if value.is_nan() {
            f64::INFINITY
        } else {
            value.abs()
        }
    };
    values.into_iter().map(size).fold(0.0, f64::max)
}

/// Asserts that two numbers are no farther apart than `allowed`.
#[track_caller]
pub fn assert_near(found: f64, expected: f64, allowed: f64, what: impl Debug) {
    let off = (found - expected).abs();
    assert!(
        off <= allowed,
        "{what:?}: {found}, not {expected} within {allowed}"
    );
}
