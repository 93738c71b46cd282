//! The answer of a design.

use serde::{Deserialize, Serialize};

use super::limits::{Limits, Place};
use super::trade_off::TradeOff;

/// What holds the cable best.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Design {
    /// The scene's title.
    pub title: String,
    /// What was varied.
    pub place: Place,
    /// Number of passes.
    pub passes: u64,
    /// The limits.
    pub limits: Limits,
    /// The stiffnesses within both limits \[N/m\], from and to; no upper one where a fixed end is within them too. `None` where no
    /// stiffness is.
    pub range_n_per_m: Option<(f64, Option<f64>)>,
    /// What to take: within the range, with margins to both limits. `None` where no stiffness stays within them.
    pub answer: Option<TradeOff>,
    /// Everything that was computed, by growing stiffness, from a free end or no clamp on.
    pub curve: Vec<TradeOff>,
}
