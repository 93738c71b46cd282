//! What a comparison of measures answers. The names of the fields are those of the JSON document.

use std::collections::BTreeMap;

use serde::Serialize;

use super::unknown::{FRICTION_KEY, Unknown};
use creepage_run::{Limited, Place, Reached, Verdict};
use creepage_scene::Scene;
use creepage_scene::{Cost, End, Measure, Restraint};

/// How accurate a run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    /// On a coarse mesh that all share.
    Coarse,
    /// On one that is twice as fine.
    Finer,
    /// With the scene's own tolerance.
    Decisive,
}

/// One measure with one combination of what is not known.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The values of all unknowns \[SI\].
    pub at: Vec<f64>,
    /// How accurate it is.
    pub effort: Effort,
    /// What it makes of each limit, and of the duct's end; none where the run failed.
    pub verdicts: Vec<Verdict>,
    /// Largest force on an end \[N\].
    pub force_n: f64,
    /// Largest movement of an end \[m\].
    pub movement_m: f64,
    /// Largest force on a clamp \[N\].
    pub clamp_force_n: f64,
    /// Why the run failed.
    pub failure: Option<String>,
}

impl Outcome {
    pub(super) fn new(
        at: &[f64],
        effort: Effort,
        verdicts: Vec<Verdict>,
        [force, movement, clamp]: [f64; 3],
    ) -> Self {
        Self {
            at: at.to_vec(),
            effort,
            verdicts,
            force_n: force,
            movement_m: movement,
            clamp_force_n: clamp,
            failure: None,
        }
    }

    pub(super) fn failed(at: &[f64], effort: Effort, failure: String) -> Self {
        Self {
            failure: Some(failure),
            ..Self::new(at, effort, Vec::new(), [0.0; 3])
        }
    }

    /// The limit that is nearest or exceeded most.
    pub fn tightest(&self) -> Option<&Verdict> {
        self.verdicts.iter().max_by(|a, b| share(a).total_cmp(&share(b)))
    }

    /// What that is of its limit: at most 1 within all limits. Nothing is known of a run that failed.
    pub fn share(&self) -> f64 {
        self.tightest().map_or(0.0, share)
    }

    /// Whether it was computed and keeps all limits, with the scene's tolerance by more than the estimated error.
    pub fn holds(&self) -> bool {
        let is_doubtful = |verdict: &Verdict| verdict.doubtful && self.effort == Effort::Decisive;
        self.failure.is_none() && self.share() <= 1.0 && !self.verdicts.iter().any(is_doubtful)
    }
}

/// What a verdict's value is of its limit.
pub(super) fn share(verdict: &Verdict) -> f64 {
    verdict.largest / verdict.limit
}

/// The limit that a combination is nearest to or exceeds most.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Extreme {
    /// The end or clamp.
    pub end: Place,
    /// What is limited there.
    pub quantity: Limited,
    /// What it comes to \[N or m\].
    pub value: f64,
    /// The limit \[N or m\].
    pub limit: f64,
    /// The combination: key and value \[SI\].
    pub at: BTreeMap<String, f64>,
    /// Largest force on a clamp then \[N\]; null without clamps.
    pub clamp_force_n: Option<f64>,
    /// Largest movement of an end then \[m\].
    pub movement_m: f64,
    /// When the first limit is exceeded; null where none is.
    pub reached_after: Option<Reached>,
}

/// A measure in all combinations.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureAnswer {
    /// Its name.
    pub name: String,
    /// What holds both ends, with springs \[N/m\]: those found, where the measure looks for them.
    pub ends: HeldEnds,
    /// All clamps.
    pub restraints: Vec<HeldClamp>,
    /// What it costs, if that is known.
    pub cost: Option<Cost>,
    /// Ends and clamps that it changes.
    pub parts: usize,
    /// Whether it keeps all limits in every combination.
    pub within_limits: bool,
    /// In how many of the combinations it keeps them.
    pub kept: usize,
    /// The worst combination; null where every run failed.
    pub worst: Option<Extreme>,
    /// The middle of all intervals.
    pub nominal: Option<Extreme>,
    /// Runs that failed: combination and reason.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<(BTreeMap<String, f64>, String)>,
    /// All that was computed.
    #[serde(skip)]
    pub outcomes: Vec<Outcome>,
}

/// How an end is held: "free", "fixed" or a spring.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Held {
    /// By nothing.
    Free,
    /// It does not move.
    Fixed,
    /// By a spring of this stiffness \[N/m\].
    Spring(f64),
}

/// How both ends are held.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HeldEnds {
    /// At x = 0.
    pub upstream: Held,
    /// At x = length.
    pub downstream: Held,
}

/// A clamp.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HeldClamp {
    /// Its position along the duct \[m\].
    pub position_m: f64,
    /// Its stiffness \[N/m\].
    pub stiffness_n_per_m: f64,
    /// Force above which it slips \[N\]; null if it never does.
    pub holds_n: Option<f64>,
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
    pub uncertain: Vec<Unknown>,
    /// Combinations of it; beside them the worst is looked for.
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

    /// The place of friction among the unknowns.
    pub fn friction(&self) -> Option<usize> {
        self.uncertain
            .iter()
            .position(|unknown| unknown.key == FRICTION_KEY)
    }
}

impl MeasureAnswer {
    pub(super) fn new(
        scene: &Scene,
        measure: &Measure,
        parts: usize,
        unknowns: &[Unknown],
        outcomes: Vec<Outcome>,
        combinations: &[Vec<f64>],
    ) -> Self {
        let held = |end: End| match end {
            End::Free => Held::Free,
            End::Fixed => Held::Fixed,
            End::Spring(stiffness) => Held::Spring(stiffness),
        };
        let clamp = |clamp: &Restraint| HeldClamp {
            position_m: clamp.position,
            stiffness_n_per_m: clamp.stiffness,
            holds_n: clamp.holds,
        };
        let keys = |at: &[f64]| -> BTreeMap<String, f64> {
            let keys = unknowns.iter().map(|unknown| unknown.key.clone());
            keys.zip(at.iter().copied()).collect()
        };
        let extreme = |outcome: &Outcome| {
            let tightest = outcome.tightest()?;
            let reached = outcome
                .verdicts
                .iter()
                .filter_map(|verdict| verdict.reached_after);
            Some(Extreme {
                end: tightest.end,
                quantity: tightest.quantity,
                value: tightest.largest,
                limit: tightest.limit,
                at: keys(&outcome.at),
                clamp_force_n: (!scene.restraints.is_empty()).then_some(outcome.clamp_force_n),
                movement_m: outcome.movement_m,
                reached_after: reached.min_by_key(|reached| reached.pass),
            })
        };
        let middle: Vec<f64> = unknowns.iter().map(Unknown::middle).collect();
        let is_asked = |outcome: &&Outcome| combinations.contains(&outcome.at);
        Self {
            name: measure.name.clone(),
            ends: HeldEnds {
                upstream: held(scene.ends.upstream),
                downstream: held(scene.ends.downstream),
            },
            restraints: scene.restraints.iter().map(clamp).collect(),
            cost: measure.cost.clone(),
            parts,
            within_limits: outcomes.iter().all(Outcome::holds),
            kept: outcomes
                .iter()
                .filter(is_asked)
                .filter(|outcome| outcome.holds())
                .count(),
            worst: worst(&outcomes).and_then(extreme),
            nominal: outcomes
                .iter()
                .find(|outcome| outcome.at == middle)
                .and_then(extreme),
            failures: outcomes
                .iter()
                .filter_map(|outcome| Some((keys(&outcome.at), outcome.failure.clone()?)))
                .collect(),
            outcomes,
        }
    }

    /// What the worst is of its limit.
    pub fn share(&self) -> f64 {
        worst(&self.outcomes).map_or(f64::INFINITY, Outcome::share)
    }
}

/// The combination that comes nearest to a limit, or exceeds one most.
pub fn worst(outcomes: &[Outcome]) -> Option<&Outcome> {
    let computed = outcomes.iter().filter(|outcome| outcome.failure.is_none());
    computed.max_by(|a, b| a.share().total_cmp(&b.share()))
}
