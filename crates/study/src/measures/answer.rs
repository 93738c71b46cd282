//! What a comparison of measures answers. The names of the fields are those of the JSON document.

use serde::{Serialize, Serializer};

use super::unknown::{Combination, middle};
use creepage_run::{Limited, Place, Verdict};
use creepage_scene::{Cost, Ends, Restraint, Uncertain};

/// One measure with one combination of what is not known.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Outcome {
    /// The values of all unknowns.
    pub at: Combination,
    /// Whether it was computed on the coarse mesh that all share; else with the scene's own tolerance.
    #[serde(skip)]
    pub rough: bool,
    /// What it makes of each limit, and of the duct's end, first the limit that is nearest or exceeded most; none where the run failed.
    pub verdicts: Vec<Verdict>,
    /// Largest force on an end \[N\].
    pub force_n: f64,
    /// Largest movement of an end \[m\].
    pub movement_m: f64,
    /// Largest force on a clamp \[N\]; none without clamps.
    pub clamp_force_n: Option<f64>,
    /// Why the run failed.
    #[serde(skip)]
    pub failure: Option<String>,
}

impl Outcome {
    /// What the largest is of its limit: at most 1 within all limits. Nothing is known of a run that failed.
    pub fn share(&self) -> f64 {
        self.verdicts.iter().map(share).fold(0.0, f64::max)
    }

    /// Whether it was computed and keeps all limits, with the scene's tolerance by more than the estimated error.
    pub fn holds(&self) -> bool {
        let is_kept = |verdict: &Verdict| share(verdict) <= 1.0 && (self.rough || !verdict.doubtful);
        self.failure.is_none() && self.verdicts.iter().all(is_kept)
    }

    /// The same with the verdict first that is nearest to its limit.
    pub(super) fn sorted(&self) -> Self {
        let mut sorted = self.clone();
        sorted.verdicts.sort_by(|a, b| share(b).total_cmp(&share(a)));
        sorted
    }

    /// Whether its combination is `at` but for this key.
    pub fn differs_only_in(&self, key: &str, at: &Combination) -> bool {
        self.at.iter().all(|(own, value)| own == key || at[own] == *value)
    }
}

/// The outcome with its nearest limit beside it.
#[expect(clippy::ref_option, reason = "serde hands fields by reference")]
fn with_nearest<S: Serializer>(outcome: &Option<Outcome>, serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Nearest<'o> {
        end: Place,
        quantity: Limited,
        value: f64,
        limit: f64,
        #[serde(flatten)]
        outcome: &'o Outcome,
    }
    let nearest = outcome.as_ref().and_then(|outcome| {
        let verdict = outcome.verdicts.first()?;
        Some(Nearest {
            end: verdict.end,
            quantity: verdict.quantity,
            value: verdict.largest,
            limit: verdict.limit,
            outcome,
        })
    });
    nearest.serialize(serializer)
}

/// What a verdict's value is of its limit.
pub(super) fn share(verdict: &Verdict) -> f64 {
    verdict.largest / verdict.limit
}

/// A measure in all combinations.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureAnswer {
    /// Its name.
    pub name: String,
    /// What holds both ends, with the springs that were found.
    pub ends: Ends,
    /// All clamps.
    pub restraints: Vec<Restraint>,
    /// What it costs, if that is known.
    pub cost: Option<Cost>,
    /// Ends and clamps that it changes.
    pub parts: usize,
    /// Whether it keeps all limits in every combination.
    pub within_limits: bool,
    /// In how many of the combinations it keeps them.
    pub kept: usize,
    /// The worst combination; null where every run failed.
    #[serde(serialize_with = "with_nearest")]
    pub worst: Option<Outcome>,
    /// The middle of all intervals, on the coarse mesh unless it is near a limit.
    #[serde(serialize_with = "with_nearest")]
    pub nominal: Option<Outcome>,
    /// Runs that failed: combination and reason.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<(Combination, String)>,
    /// All that was computed.
    #[serde(skip)]
    pub outcomes: Vec<Outcome>,
}

/// Measures side by side.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Comparison {
    /// The scene's title.
    pub title: String,
    /// Number of passes.
    pub passes: u64,
    /// What is not known.
    pub uncertain: Vec<Uncertain>,
    /// Whether that is an assumption of this program, as the scene has no `[uncertain]`.
    pub assumed: bool,
    /// Combinations of it; between them the worst is looked for.
    pub combinations: usize,
    /// How many runs of the scene it took.
    pub runs: usize,
    /// The scene as it is first.
    pub measures: Vec<MeasureAnswer>,
    /// The measure to take: the cheapest that holds, without costs the one with the fewest parts; null where none holds.
    pub recommended: Option<String>,
    /// Where none holds, the measure that comes nearest.
    pub nearest: Option<String>,
    /// The unknown that decides whether that one holds.
    pub decides: Option<String>,
}

impl Comparison {
    /// The measure that is recommended, or comes nearest.
    pub fn best(&self) -> Option<&MeasureAnswer> {
        let name = self.recommended.as_ref().or(self.nearest.as_ref())?;
        self.measures.iter().find(|measure| measure.name == *name)
    }

    /// The combination in the middle of all intervals.
    pub fn middle(&self) -> Combination {
        middle(&self.uncertain)
    }
}

impl MeasureAnswer {
    /// What the worst is of its limit.
    pub fn share(&self) -> f64 {
        worst(&self.outcomes).map_or(f64::INFINITY, Outcome::share)
    }
}

/// The combination that comes nearest to a limit, or exceeds one most.
pub fn worst<'o>(outcomes: impl IntoIterator<Item = &'o Outcome>) -> Option<&'o Outcome> {
    let computed = outcomes.into_iter().filter(|outcome| outcome.failure.is_none());
    computed.max_by(|a, b| a.share().total_cmp(&b.share()))
}
