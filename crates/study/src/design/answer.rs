//! What a design answers.

use serde::{Deserialize, Serialize};

use super::trade_off::{Binding, TradeOff};
use creepage_run::{Limits, Place};

/// Width of the last bracket around a stiffness, as a share of it.
pub const ACCURACY: f64 = 0.01;

/// What holds the cable best.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Design {
    /// The scene's title.
    pub title: String,
    /// What was varied: the first place of two.
    pub place: Place,
    /// All places where springs were varied.
    pub places: Vec<Place>,
    /// Number of passes.
    pub passes: u64,
    /// The limits.
    pub limits: Limits,
    /// The stiffnesses within all limits \[N/m\], from and to; no upper one where a
    /// fixed end is within them too. `None` if only a fixed end or no stiffness is.
    pub range_n_per_m: Option<(f64, Option<f64>)>,
    /// What to take: within the limits, with margins to them. `None` if nothing stays within
    /// them.
    pub answer: Option<TradeOff>,
    /// If nothing stays within the limits, what comes nearest to them.
    pub nearest: Option<TradeOff>,
    /// The limits that bind: those at the ends of the range, else those that the nearest is nearest to
    /// or exceeds most.
    pub binding: Vec<Binding>,
    /// Limits that no stiffness at these places comes near, each with the least that one comes to: then
    /// the search ends there.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub out_of_reach: Vec<Binding>,
    /// Everything that was computed with the scene's own tolerance, by growing stiffness, from a
    /// free end or no clamp on.
    pub curve: Vec<TradeOff>,
    /// How many runs of the scene it took.
    pub runs: usize,
}

impl Design {
    /// The answer, or what comes nearest to the limits.
    pub fn found(&self) -> Option<&TradeOff> {
        self.answer.as_ref().or(self.nearest.as_ref())
    }

    /// The largest share of a limit that it comes to, at most 1 within the limits.
    pub fn excess(&self) -> f64 {
        let found = self.found();
        found.map_or(f64::INFINITY, |found| found.excess(&self.limits))
    }

    /// If none was found within the limits though there may be one: by how much less than this
    /// share the nearest exceeds them, the larger of its estimated error and of the step in which
    /// stiffnesses were tried.
    pub fn doubt(&self) -> Option<f64> {
        let error = self.nearest.as_ref()?.error_estimate.max(ACCURACY);
        (self.excess() - 1.0 < error).then_some(error)
    }
}

/// The best of several designs: of those that keep their limits that with the largest margin, or
/// the softest where all are clamps, which are as soft as their limits allow; else the one nearest
/// to its limits.
pub fn best(designs: &[Design]) -> Option<&Design> {
    let mut kept = designs.iter().filter(|design| design.answer.is_some());
    let are_clamps = kept.all(|design| design.places.iter().all(|place| place.end().is_none()));
    let rank = |design: &Design| match &design.answer {
        Some(answer) if are_clamps => (false, answer.stiffness()),
        answer => (answer.is_none(), design.excess()),
    };
    let ranked = designs.iter().map(|design| (rank(design), design));
    let best = ranked.min_by(|((a, x), _), ((b, y), _)| a.cmp(b).then(x.total_cmp(y)));
    best.map(|(_, design)| design)
}
