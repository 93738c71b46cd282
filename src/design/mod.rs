//! What to hold a cable with: the end spring or clamp that stays within a limit of force and one of movement.
//!
//! A stiffer end moves less and is pressed harder; a clamp takes force from the ends and lets them move less. There is no
//! formula for that: the scene is run with many stiffnesses, which gives the curve of force against movement, and where a limit is
//! crossed the stiffness is found by Brent's method on its logarithm, each step a run of the scene (R. P. Brent, Algorithms for
//! Minimization without Derivatives, 1973, chapter 4). Every point of the answer is a run.
//!
//! Force is the largest on an end, during and after the passes; movement is the largest displacement of an end after a pass. Both follow
//! from all listed passes, and each may be limited at either end. Where no stiffness keeps the limits, the nearest is that whose worst limit
//! is exceeded by the smallest factor.
//!
//! All runs are made on one mesh, that which the stiffest end needs; the error that it leaves is stated at every point.
//!
//! # Limits
//!
//! A limit that is crossed more than once as the stiffness grows is an error, since there is no single range then. Heat, which presses
//! on the ends too, is left out.

mod compare;
mod limits;
mod options;
mod search;
mod trade_off;

pub use crate::Limits;
pub use compare::{Measure, compare};
pub use limits::{DesignError, Place};
pub use options::DesignOptions;
pub use search::design;
pub use trade_off::{Design, TradeOff};
