//! The duct's motion as the driver sees it.

use ground_field::{Direction, DuctMotion};

/// Which way the vehicle of `motion` drives, and the duct's displacement \[m\] ahead of it, both positive in that direction.
pub(crate) fn as_driven(motion: &DuctMotion) -> (Direction, impl Fn(f64) -> f64) {
    let direction = if motion.velocity() < 0.0 {
        Direction::Reverse
    } else {
        Direction::Forward
    };
    let sign = direction.sign();
    (direction, move |xi| sign * motion.longitudinal(sign * xi))
}
