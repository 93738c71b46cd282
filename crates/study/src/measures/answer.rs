//! What a comparison of measures answers. The names of the fields are those of the JSON document.

use serde::Serialize;

use super::unknown::{Combination, middle};
use creepage_run::{Limited, Limits, Place, Run, Verdict};
use creepage_scene::{CableEnd, Cost, Ends, Restraint, Uncertain};

/// One measure with one combination of what is not known.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outcome {
    /// The values of all unknowns.
    pub at: Combination,
    /// Whether it was computed on the coarse mesh that all share; else with the scene's own tolerance.
    #[serde(skip)]
    pub rough: bool,
    /// What it makes of each limit, and of the duct's end.
    pub verdicts: Vec<Verdict>,
    /// Largest force on an end \[N\].
    pub force_n: f64,
    /// Largest movement of an end \[m\].
    pub movement_m: f64,
    /// Largest force on a clamp \[N\]; none without clamps.
    pub clamp_force_n: Option<f64>,
}

/// An outcome, its verdicts from the limit that is nearest or exceeded most, and that limit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Nearest {
    /// The end or clamp.
    pub end: Place,
    /// What is limited there.
    pub quantity: Limited,
    /// What it comes to \[N or m\].
    pub value: f64,
    /// The limit \[N or m\].
    pub limit: f64,
    /// All of it.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// A combination that could not be computed, and why.
pub type Failure = (Combination, String);

/// What a verdict's value is of its limit.
pub(super) fn share(verdict: &Verdict) -> f64 {
    verdict.largest / verdict.limit
}

impl Outcome {
    /// What `run` comes to with the combination `at`.
    pub(super) fn of(run: &Run, at: &Combination, rough: bool, limits: &Limits) -> Self {
        let of_ends = |quantity| CableEnd::ALL.map(|end| run.largest(end, quantity));
        let [forces, movements] = [Limited::Force, Limited::Movement].map(of_ends);
        let clamps = run.restraints.iter().map(|clamp| Place::Clamp(clamp.position_m));
        let clamps = clamps.map(|clamp| run.largest(clamp, Limited::Force));
        Self {
            at: at.clone(),
            rough,
            verdicts: limits.verdicts(run),
            force_n: forces[0].max(forces[1]),
            movement_m: movements[0].max(movements[1]),
            clamp_force_n: clamps.reduce(f64::max),
        }
    }

    /// What the largest is of its limit: at most 1 within all limits.
    pub fn share(&self) -> f64 {
        self.verdicts.iter().map(share).fold(0.0, f64::max)
    }

    /// Whether it keeps all limits, with the scene's tolerance by more than the estimated error.
    pub fn holds(&self) -> bool {
        let is_kept = |verdict: &Verdict| share(verdict) <= 1.0 && (self.rough || !verdict.doubtful);
        self.verdicts.iter().all(is_kept)
    }

    /// The same with its nearest limit.
    pub(super) fn nearest(&self) -> Option<Nearest> {
        let mut outcome = self.clone();
        outcome.verdicts.sort_by(|a, b| share(b).total_cmp(&share(a)));
        outcome.verdicts.first().copied().map(|verdict| Nearest {
            end: verdict.end,
            quantity: verdict.quantity,
            value: verdict.largest,
            limit: verdict.limit,
            outcome,
        })
    }

    /// Whether its combination is `at` but for this key.
    pub fn differs_only_in(&self, key: &str, at: &Combination) -> bool {
        self.at.iter().all(|(own, value)| own == key || at[own] == *value)
    }
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
    /// The worst combination; null if every run failed.
    pub worst: Option<Nearest>,
    /// The middle of all intervals, on the coarse mesh unless it is near a limit.
    pub nominal: Option<Nearest>,
    /// Runs that failed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<Failure>,
    /// All that was computed.
    #[serde(skip)]
    pub outcomes: Vec<Outcome>,
}

impl MeasureAnswer {
    /// What the worst is of its limit.
    pub fn share(&self) -> f64 {
        self.worst
            .as_ref()
            .map_or(f64::INFINITY, |worst| worst.value / worst.limit)
    }
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
    /// The measure to take: the cheapest that holds, without costs the one with the fewest parts; null if none holds.
    pub recommended: Option<String>,
    /// If none holds, the measure that comes nearest.
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

/// The combination that comes nearest to a limit, or exceeds one most.
pub(super) fn worst<'o>(outcomes: impl IntoIterator<Item = &'o Outcome>) -> Option<&'o Outcome> {
    let all = outcomes.into_iter();
    all.max_by(|a, b| a.share().total_cmp(&b.share()))
}
