//! Whether an answer can be true: the balance of forces.
//!
//! In equilibrium friction carries at most q = μ_d N′ per metre, beside the cable's own weight
//! along the duct, p. So the force differs between any two points of the cable by at most q + |p|
//! times their distance and what clamps between them carry; at an end that is free it is at most
//! (q + |p|) L and the clamps. No solver, law or mesh may break that.

use cable_dem::{CableState, DuctedCable};

use super::differences::larger;
use super::record::{PassRecord, RestraintRecord};
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
        let needed = share * limit;
        Err(Error::Unbalanced { pass, needed, limit })
    }
}

/// The most \[N\] by which the forces on both ends differ where nothing else than friction and the
/// cable's own weight acts between them, with forces of up to `largest` \[N\] in the cable, which
/// press it on bends.
pub fn carried(scene: &Scene, largest: f64) -> f64 {
    let sections = scene.sections().into_iter();
    let on = |section: Section| (section.limit_under(largest) + section.body_force.abs()) * section.length;
    sections.map(on).sum()
}

/// Checks the forces on the ends of a cable whose clamps carry `restraints`.
pub fn of_records(
    scene: &Scene,
    records: &[PassRecord],
    restraints: &[RestraintRecord],
) -> Result<(), Error> {
    let limit = scene.friction_limit();
    for (index, record) in records.iter().enumerate() {
        // Of this pass: where it is warm, others find other forces on the clamps.
        let clamps = restraints.iter().map(|clamp| clamp.after_passes_n[index].abs());
        let clamps: f64 = clamps.sum();
        let (upstream, downstream) = (record.upstream_force_n, record.downstream_force_n);
        let forces = [upstream, downstream, record.max_compression_n];
        let friction = carried(scene, forces.into_iter().fold(0.0, larger).abs());
        let carried = (downstream - upstream).abs();
        if carried > (1.0 + MARGIN) * friction + clamps {
            return Err(Error::Unbalanced {
                pass: record.pass,
                needed: carried / scene.duct.length,
                limit,
            });
        }
    }
    Ok(())
}
