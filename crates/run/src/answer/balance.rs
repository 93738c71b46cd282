//! Whether an answer can be true: the balance of forces.
//!
//! In equilibrium friction carries at most q = μ_d N′ per metre, besides the cable's own weight
//! along the duct, p. So the force differs between any two points of the cable by at most q + |p|
//! times their distance and what clamps between them carry; at an end that is free it is at most
//! (q + |p|) L and the clamps. No solver, law or mesh may break that.

use cable_dem::{CableState, DuctedCable, EndForces};
use cycle_jump::Record;

use super::differences::larger;
use creepage_plan::Error;
use creepage_scene::{Scene, Section};

/// Share of what friction can carry by which rounding and interpolation may exceed it.
pub const MARGIN: f64 = 0.01;

/// Checks the cable as `pass` left it.
pub fn of_state(cable: &DuctedCable, state: &CableState, pass: u64) -> Result<(), Error> {
    let (share, limit) = (state.friction_share(cable)?, cable.friction().limit());
    // Written so that what is not a number fails.
    if share <= 1.0 + MARGIN {
        Ok(())
    } else {
        Err(unbalanced(pass, share * limit, limit))
    }
}

/// Forces after `pass` that need more friction than there can be \[N/m\].
fn unbalanced(pass: u64, needed: f64, limit: f64) -> Error {
    let reason = format!(
        "after pass {pass} the forces need a friction of {needed:.4e} N/m where its limit is {limit:.4e} N/m: this is no answer; \
         solver.method = \"quasi-static\" simulates every pass"
    );
    Error::NoAnswer { reason }
}

/// The most \[N\] by which the forces on both ends differ where nothing else than friction and the
/// cable's own weight acts between them, with forces of up to `largest` \[N\] in the cable, which
/// press it on bends.
pub fn carried(scene: &Scene, largest: f64) -> f64 {
    let sections = scene.sections().into_iter();
    let on = |section: Section| (section.limit_under(largest) + section.body_force.abs()) * section.length;
    sections.map(on).sum()
}

/// Checks the forces on the ends that passes leave.
pub fn of_records(scene: &Scene, records: &[Record]) -> Result<(), Error> {
    for Record { pass, outcome, .. } in records {
        let EndForces { upstream, downstream } = outcome.force;
        let forces = [upstream, downstream, outcome.max_compression];
        let friction = carried(scene, forces.into_iter().fold(0.0, larger).abs());
        // Of this pass: where it is warm, others find other forces on the clamps.
        let clamps: f64 = outcome.restraints.iter().map(|force| force.abs()).sum();
        let carried = (downstream - upstream).abs();
        if carried > (1.0 + MARGIN) * friction + clamps {
            return Err(unbalanced(
                *pass,
                carried / scene.duct.length,
                scene.friction_limit(),
            ));
        }
    }
    Ok(())
}
