//! How a design is searched for.

use crate::{Limits, Place, Progress};

/// How to design.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct DesignOptions<'a> {
    /// Where the spring is.
    pub place: Place,
    /// Where a second one is, if two are wanted at once.
    pub second: Option<Place>,
    /// What they have to stay within.
    pub limits: Limits,
    /// Called after each run of the scene; it may stop the search.
    pub progress: Progress<'a>,
}

impl DesignOptions<'_> {
    /// A spring at `place` that stays within `limits`.
    pub fn new(place: Place, limits: Limits) -> Self {
        Self {
            place,
            second: None,
            limits,
            progress: Progress::default(),
        }
    }

    /// Where springs are.
    pub(super) fn places(&self) -> Vec<Place> {
        std::iter::once(self.place).chain(self.second).collect()
    }
}
