//! What to hold a cable with: the end spring or clamp that stays within a limit of force and one of movement.
//!
//! A stiffer end moves less and is pressed harder; a clamp takes force from the ends and lets them move less. There is no
//! formula for that: the scene is run with many stiffnesses, which gives the curve of force against movement, and where a limit is
//! crossed the stiffness is bracketed ever closer, each step a run of the scene. Every point of the answer is a run.
//!
//! Force is the largest on an end or a clamp, during and after the passes; movement is the largest displacement of an end, or
//! at a clamp, after a pass. Where the cable is heated, both count at all hours of all days: the force of the hottest, the movement of the
//! coldest. Where nothing keeps the limits, the nearest is that whose worst limit is exceeded by the smallest factor.
//!
//! Two springs at once are looked for on a map of both stiffnesses (module `pair`). Of all pairs within the limits that with the largest
//! margin is taken: its largest share of a limit is the smallest. Where no movement is limited, it is that with which the ends move
//! least.
//!
//! All runs that are answers are made on one mesh, that which the stiffest end needs; the error that it leaves is stated at every point.
//!
//! # Limits
//!
//! A limit of one spring that is crossed more than once as the stiffness grows is an error, since there is no single range then.

pub(crate) mod compare;
mod doubt;
mod limits;
mod options;
mod pair;
mod runs;
mod search;
mod trade_off;

pub use crate::{ClampLimits, Limits, Place};
pub use compare::{Measure, compare};
pub use doubt::Doubt;
pub use limits::DesignError;
pub use options::DesignOptions;
pub use search::design;
pub use trade_off::{Binding, ClampPeak, Design, Side, Spring, TradeOff, best};
