//! What to hold a cable with: the end spring or clamp that stays within a limit of force and one of
//! movement.
//!
//! A stiffer end moves less and is pressed harder; a clamp takes force from the ends and lets them
//! move less. There is no formula for that: the scene is run with many stiffnesses, which gives the
//! curve of force against movement, and where the limits begin to be kept, or cease to be, the
//! stiffness is bracketed by bisection in ln k. Every point of the answer is a run.
//!
//! Force is the largest on an end or a clamp, during and after the passes; movement is the largest
//! displacement of an end, or at a clamp. Where the cable is heated, both count at all hours of all
//! days: the force of the hottest, the movement of the coldest. If nothing keeps the limits, the
//! nearest is that whose worst limit is exceeded by the smallest factor.
//!
//! Two springs at once have the same stiffness, as a product has.
//!
//! All runs that are answers are made on one mesh, that which the stiffest end needs; the error
//! that it leaves is stated at every point.
//!
//! # Limits
//!
//! Limits that are kept in several ranges of stiffness are an error, since there is no
//! single one then.

mod answer;
mod options;
mod runs;
mod search;
mod trade_off;

pub use answer::{Design, best};
pub use creepage_run::{ClampLimits, Limits, Place};
pub use options::{DesignError, DesignOptions};
pub use search::design;
pub use trade_off::{Binding, ClampPeak, Side, Spring, TradeOff, held};
