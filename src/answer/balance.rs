//! Whether an answer can be true: the balance of forces.
//!
//! In equilibrium friction carries at most q = μ_d N′ per metre. So the force differs between any two points of the cable by
//! at most q times their distance and what clamps between them carry; at an end that is free it is at most q L and the
//! clamps. No solver, law or mesh may break that.

use cable_dem::{CableState, DuctedCable};

use super::record::{PassRecord, RestraintRecord, Saturation};
use crate::Error;
use crate::scene::{End, Scene};

/// Share of what friction can carry by which rounding and interpolation may exceed it.
const MARGIN: f64 = 0.01;
/// A force already reached may exceed the saturation by this share of it, which is no more than an extrapolation's error.
const NEARLY: f64 = 0.02;
/// Share of the saturation whose pass is told.
const LEVEL: f64 = 0.95;
/// Rounding of the force in an element, as a share of the largest.
const ROUNDING: f64 = 1e-9;

/// Checks the cable as `pass` left it.
pub fn of_state(cable: &DuctedCable, state: &CableState, pass: u64) -> Result<(), Error> {
    let largest = state
        .element_forces(cable)?
        .fold(0.0_f64, |largest, force| largest.max(force.abs()));
    let limit = cable.friction().limit();
    let allowed = (1.0 + MARGIN) * limit + ROUNDING * largest / state.node_spacing();
    let needed = state.friction_needed(cable)?;
    // Written so that what is not a number fails.
    if needed <= allowed {
        Ok(())
    } else {
        Err(Error::Unbalanced { pass, needed, limit })
    }
}

/// Checks the forces on the ends of a cable whose clamps carry `restraints`.
pub fn of_records(
    scene: &Scene,
    records: &[PassRecord],
    restraints: &[RestraintRecord],
) -> Result<(), Error> {
    let limit = scene.friction_limit();
    let friction = limit * scene.duct.length;
    let clamps: f64 = restraints.iter().map(|clamp| clamp.force_n.abs()).sum();
    for record in records {
        let (upstream, downstream) = (record.upstream_force_n, record.downstream_force_n);
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

/// The saturation that `records` bear out: at least what they already reach, if that is nearly it, and no more than friction
/// can carry to an end whose other end is free.
pub fn of_saturation(
    scene: &Scene,
    records: &[PassRecord],
    mut saturation: Saturation,
) -> Option<Saturation> {
    let free = scene.ends.upstream == End::Free || scene.ends.downstream == End::Free;
    let limit = scene.friction_limit() * scene.duct.length;
    if free && scene.restraints.is_empty() && saturation.force_n.abs() > (1.0 + MARGIN) * limit {
        return None;
    }
    let held = scene.ends.upstream != End::Free || scene.ends.downstream != End::Free;
    let force = |record: &PassRecord| {
        if held {
            larger(record.upstream_force_n, record.downstream_force_n)
        } else {
            record.max_compression_n
        }
    };
    let largest = records.iter().map(force).fold(0.0, larger);
    if largest.abs() > saturation.force_n.abs() {
        if largest.abs() > (1.0 + NEARLY) * saturation.force_n.abs() {
            // The force falls from there: it does not level off.
            return None;
        }
        saturation.force_n = largest;
    }
    let share = LEVEL * saturation.force_n;
    let reached = records.iter().find(|record| force(record) / share >= 1.0);
    match (reached, records.last()) {
        (Some(record), _) => saturation.passes_to_95_percent = record.pass,
        // What is said to have been reached has to be among the records.
        (None, Some(last)) if saturation.passes_to_95_percent <= last.pass => return None,
        _ => {}
    }
    Some(saturation)
}

/// The larger in size of two forces.
fn larger(a: f64, b: f64) -> f64 {
    if b.abs() > a.abs() { b } else { a }
}
