//! What a stranger may bring to the project: a ground of their own and a model to calibrate of their own.
//!
//! This crate lies outside the workspace and uses the public interface alone. Its tests put its ground below a duct
//! ([`creepage::ground_field::DuctMotion`]), a cable ([`creepage::cable_dem::QuasiStatic`]) and a whole scene (`creepage::run_with`), and its
//! cable into the calibrator ([`creepage::fitting::Calibration`]). One dependency hands on the parts.

mod joint_force;
mod measured_ground;

pub use joint_force::{BoxError, JointForce};
pub use measured_ground::MeasuredGround;
