//! A vehicle's course over the duct: where it comes from, and the duct's motion under it.

use ground_field::{Direction, DuctMotion};

use crate::error::checked;
use crate::tuning::MAX_LEFT_OUT;
use crate::{CableError, Mesh};

/// Two lengths matter: an element, and the length over which the duct's motion changes. The bend is
/// evaluated at so many points in the shorter of both,
const POINTS: usize = 4;
/// and out to so many of it from the wheels.
const ELEMENTS: usize = 8;

/// A shape of the duct's displacement that travels along the duct.
pub(crate) struct Course<F> {
    pub direction: Direction,
    /// Displacement \[m\] of the duct where x is ξ \[m\] greater than at the vehicle, positive toward growing x.
    shape: F,
    /// Distance \[m\] before and past the duct over which the vehicle is followed.
    pub approach: f64,
    /// How far its wheels reach from its origin \[m\].
    pub half_length: f64,
}

/// The course of a vehicle whose duct motion is `motion` over a duct with nodes as in `mesh`, if the motion is known far enough and the
/// mesh is fine enough for it.
pub(crate) fn as_driven(
    motion: &DuctMotion,
    mesh: &Mesh,
    approach: f64,
) -> Result<Course<impl Fn(f64) -> f64>, CableError> {
    let needed = mesh.length() + checked_approach(approach)?;
    let reach = motion.reach();
    if needed > reach * (1.0 + 1e-9) {
        return Err(CableError::OutOfReach { needed, reach });
    }
    let longest = mesh.spacing().max(mesh.vehicle_step());
    let left_out = left_out(motion, longest);
    if left_out > MAX_LEFT_OUT {
        return Err(CableError::CoarseMesh { longest, left_out });
    }
    let direction = if motion.velocity() < 0.0 {
        Direction::Reverse
    } else {
        Direction::Forward
    };
    Ok(Course {
        direction,
        // A lattice needs a few points more than the reach.
        shape: move |xi: f64| motion.longitudinal(xi.clamp(-reach, reach)),
        approach,
        half_length: motion.half_length(),
    })
}

/// The course of a displacement `shape` \[m\] at ξ \[m\] ahead of the vehicle, both positive in its `direction`.
pub(crate) fn of_shape(
    direction: Direction,
    shape: impl Fn(f64) -> f64,
    approach: f64,
) -> Result<Course<impl Fn(f64) -> f64>, CableError> {
    let sign = direction.sign();
    Ok(Course {
        direction,
        shape: move |xi: f64| sign * shape(sign * xi),
        approach: checked_approach(approach)?,
        half_length: 0.0,
    })
}

impl<F: Fn(f64) -> f64> Course<F> {
    /// The shape at every ξ \[m\] of `distances`.
    pub fn tabulate(&self, distances: impl Iterator<Item = f64>) -> Result<Vec<f64>, CableError> {
        distances
            .map(|xi| checked("displacement of the duct", (self.shape)(xi), "finite", |_| true))
            .collect()
    }
}

fn checked_approach(approach: f64) -> Result<f64, CableError> {
    checked("approach", approach, "positive and at most 1e5 m", |v| {
        v > 0.0 && v <= 1e5
    })
}

/// Share of the duct's peak displacement that elements of `length` s \[m\] leave out: the cable's nodes see nothing of the bend
/// max |D(ξ) − ½ (D(ξ − s) + D(ξ + s))| between them.
fn left_out(motion: &DuctMotion, length: f64) -> f64 {
    // Elements that are far longer than the motion would step over its peak.
    let step = length.min(motion.length_scale()) / POINTS as f64;
    let count = (motion.half_length() / step).ceil() as i64 + (ELEMENTS * POINTS) as i64;
    let bend = (-count..=count)
        .map(|j| {
            let at = |xi: f64| motion.longitudinal(xi.clamp(-motion.reach(), motion.reach()));
            let xi = step * j as f64;
            (at(xi) - 0.5 * (at(xi - length) + at(xi + length))).abs()
        })
        .fold(0.0, f64::max);
    let peak = motion.peak_longitudinal();
    if peak > 0.0 { bend / peak } else { 0.0 }
}
