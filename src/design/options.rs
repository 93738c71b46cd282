//! How a design is searched for.

use std::sync::Mutex;

use super::limits::Place;
use super::trade_off::TradeOff;
use crate::{Limits, Progress};

/// How to design.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct DesignOptions<'a> {
    /// Where the spring is.
    pub place: Place,
    /// What it has to stay within.
    pub limits: Limits,
    /// Called after each run of the scene; it may stop the search.
    pub progress: Progress<'a>,
    /// Takes every stiffness as soon as it is computed, for whoever looks on from another thread.
    pub tried: Option<&'a Mutex<Vec<TradeOff>>>,
}

impl DesignOptions<'_> {
    /// A spring at `place` that stays within `limits`.
    pub fn new(place: Place, limits: Limits) -> Self {
        Self {
            place,
            limits,
            progress: Progress::default(),
            tried: None,
        }
    }
}
