//! What to hold a cable with: the end spring or clamp that keeps a limit of force and one of movement.
//!
//! A stiffer end moves less and is pressed harder; a clamp takes force from the ends and lets them move less. Nothing of that is put
//! into a formula: the scene is run with many stiffnesses, which gives the curve of force against movement, and where a limit is
//! crossed the stiffness is found by Brent's method on its logarithm, each step a run of the scene (R. P. Brent, Algorithms for
//! Minimization without Derivatives, 1973, chapter 4). Every point of the answer is a run.
//!
//! Force is the largest on either end, during and after the passes; movement is the largest displacement of either end after a
//! pass. Both follow from all listed passes.
//!
//! All runs are made on one mesh, that which the stiffest end needs; the error that it leaves is told at every point.
//!
//! # Limits
//!
//! A limit that is crossed more than once as the stiffness grows is an error, since no range can be told then. Heat, which presses
//! on the ends too, is left out.

mod compare;
mod limits;
mod search;
mod trade_off;

use serde::Serialize;

pub use compare::{Measure, compare};
pub use limits::{DesignError, DesignOptions, Limits, Place, passes};
pub use search::design;
pub use trade_off::TradeOff;

/// What holds the cable best.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Design {
    /// The scene's title.
    pub title: String,
    /// What was varied.
    pub place: Place,
    /// Number of passes.
    pub passes: u64,
    /// The limits.
    pub limits: Limits,
    /// The stiffnesses that keep both limits \[N/m\], from and to; no upper one where a fixed end does too. `None` where no
    /// stiffness does.
    pub range_n_per_m: Option<(f64, Option<f64>)>,
    /// What to take: within the range, with the margins that there are to both limits. `None` where no stiffness keeps them.
    pub answer: Option<TradeOff>,
    /// Everything that was computed, by growing stiffness, from a free end or no clamp on.
    pub curve: Vec<TradeOff>,
}
