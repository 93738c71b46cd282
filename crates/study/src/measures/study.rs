//! The comparison: every measure in every combination, then closer around the worst, and what decides with the scene's tolerance.

use rayon::prelude::*;

use super::answer::{Comparison, Effort, MeasureAnswer, Outcome, share, worst};
use super::closer::closer;
use super::runs::{LimitsOf, Runs};
use super::unknown::{Unknown, combinations, unknowns};
use super::ways::{Way, parts, ways};
use crate::design::DesignError;
use crate::design::between;
use creepage_plan::ground::{Ground, road};
use creepage_run::{Error, Progress};
use creepage_scene::{Cost, Measure};
use creepage_scene::{Scene, SceneFile};

/// Runs closer around the worst of one measure, at most.
const CLOSER: usize = 4;
/// How often a stiffness or a place is looked for anew, as another combination proves worse; and combinations for which it is.
const ROUNDS: usize = 2;
const CRITICAL: usize = 4;
/// A combination is as bad as the worst if it comes so near.
const AS_BAD: f64 = 0.95;
/// Stiffnesses of a map in a factor of ten.
const PER_DECADE: f64 = 24.0;
/// Combinations that are run again on a finer mesh, at most, until the worst is one of them.
const FINER: usize = 3;
/// All combinations that are nearer to a limit than this share are run with the scene's tolerance, until one exceeds it.
const DOUBT: f64 = 0.1;

/// What is to be compared.
#[derive(Debug, Clone)]
pub struct Study {
    file: SceneFile,
    scene: Scene,
    unknowns: Vec<Unknown>,
    combinations: Vec<Vec<f64>>,
}

/// A measure that was computed.
struct Tried {
    measure: Measure,
    outcomes: Vec<Outcome>,
}

impl Study {
    /// The measures and unknowns of the scene in `file`.
    ///
    /// # Errors
    ///
    /// [`DesignError`] where the scene is wrong, or has more unknowns than can be combined.
    pub fn new(file: &SceneFile) -> Result<Self, DesignError> {
        let scene = file.scene().map_err(Error::from)?;
        let ground = Ground::new(&scene, None, road::reach(&scene))?;
        let unknowns = unknowns(&scene, &ground);
        Ok(Self {
            combinations: combinations(&unknowns)?,
            file: file.clone(),
            unknowns,
            scene,
        })
    }

    /// How many combinations, measures and, at most, runs there are.
    pub fn size(&self) -> [usize; 3] {
        let (ways, count) = (ways(&self.scene), self.combinations.len());
        let runs = |way: &Way| match way.candidates.len() {
            1 => count + CLOSER,
            candidates => ROUNDS * (CRITICAL * candidates + count + CLOSER),
        };
        let runs = ways
            .iter()
            .map(|way| runs(way) + FINER + count + CLOSER)
            .sum::<usize>();
        [count, ways.len(), runs]
    }

    /// Compares the measures by these limits.
    ///
    /// # Errors
    ///
    /// [`Error`] where the middle of all intervals is no valid scene, or `progress` stops it. Every other run that fails is stated.
    pub fn compare(&self, limits: LimitsOf<'_>, progress: Progress<'_>) -> Result<Comparison, Error> {
        let (ways, count) = (ways(&self.scene), self.combinations.len());
        let usual = |way: &Way| match way.candidates.len() {
            1 => count + 1,
            candidates => 2 * candidates + count + 1,
        };
        let coarse = ways.iter().map(usual).sum();
        let expected = [coarse, 2 * ways.len(), ways.len() + 1];
        let runs = Runs::new(&self.file, &self.unknowns, limits, progress, expected)?;
        let (plain, sought): (Vec<&Way>, Vec<&Way>) = ways.iter().partition(|way| way.candidates.len() == 1);
        let tried = plain
            .par_iter()
            .map(|way| decided(&runs, self.tried(&runs, way.candidates[0].clone())?));
        let mut tried = tried.collect::<Result<Vec<_>, _>>()?;
        let critical = self.critical(&tried);
        let sought = sought
            .par_iter()
            .map(|way| decided(&runs, self.sought(&runs, way, critical.clone())?));
        tried.extend(sought.collect::<Result<Vec<_>, _>>()?);
        Ok(self.answer(&runs, &tried))
    }

    /// The measure in all combinations, and closer around the worst.
    fn tried(&self, runs: &Runs<'_>, measure: Measure) -> Result<Tried, Error> {
        let run = |at: &Vec<f64>| runs.run(&measure, at, Effort::Coarse);
        let mut outcomes = self
            .combinations
            .par_iter()
            .map(run)
            .collect::<Result<Vec<_>, _>>()?;
        for _ in 0..CLOSER {
            let Some(at) = closer(&outcomes) else { break };
            outcomes.push(run(&at)?);
        }
        Ok(Tried { measure, outcomes })
    }

    /// The best of the candidates in the `critical` combinations, and in those that prove worse with it (cutting planes: J. E. Kelley,
    /// J. SIAM 8 (1960) 703).
    fn sought(&self, runs: &Runs<'_>, way: &Way, mut critical: Vec<Vec<f64>>) -> Result<Tried, Error> {
        let mut best: Option<Tried> = None;
        for _ in 0..ROUNDS {
            let tried = self.tried(runs, best_candidate(runs, way, &critical)?)?;
            let Some(worst) = worst(&tried.outcomes).cloned() else {
                return Ok(tried);
            };
            let is_known = |outcome: &Outcome| {
                critical.contains(&outcome.at) && outcome.share() >= AS_BAD * worst.share()
            };
            let is_known = worst.holds() || tried.outcomes.iter().any(is_known);
            let is_better = best
                .as_ref()
                .is_none_or(|best| worst.share() < largest(&best.outcomes));
            if is_better {
                best = Some(tried);
            }
            if is_known || critical.len() == CRITICAL {
                break;
            }
            critical.push(worst.at);
        }
        best.map_or_else(|| self.tried(runs, way.candidates[0].clone()), Ok)
    }

    /// The worst combinations with the first two measures.
    fn critical(&self, tried: &[Tried]) -> Vec<Vec<f64>> {
        let is_asked = |outcome: &Outcome| self.combinations.contains(&outcome.at);
        let worst = tried.iter().take(2).filter_map(|tried| {
            let worst = tried.worst(is_asked)?;
            Some(tried.outcomes[worst].at.clone())
        });
        let mut critical: Vec<Vec<f64>> = worst.collect();
        critical.dedup();
        critical
    }

    fn answer(&self, runs: &Runs<'_>, tried: &[Tried]) -> Comparison {
        let answer = |tried: &Tried| {
            let (measure, scene) = (&tried.measure, tried.measure.applied(&self.scene));
            let outcomes = tried.outcomes.clone();
            MeasureAnswer::new(
                &scene,
                measure,
                parts(measure),
                &self.unknowns,
                outcomes,
                &self.combinations,
            )
        };
        let measures: Vec<MeasureAnswer> = tried.iter().map(answer).collect();
        let recommended = recommended(&measures);
        let by_share = |a: &&MeasureAnswer, b: &&MeasureAnswer| a.share().total_cmp(&b.share());
        let nearest = measures.iter().min_by(by_share).filter(|_| recommended.is_none());
        Comparison {
            title: self.scene.title.clone(),
            passes: self.scene.traffic.passes,
            uncertain: self.unknowns.clone(),
            combinations: self.combinations.len(),
            runs: runs.count(),
            recommended: recommended.map(|measure| measure.name.clone()),
            decides: nearest.and_then(|nearest| self.decides(&nearest.outcomes)),
            nearest: nearest.map(|nearest| nearest.name.clone()),
            measures,
        }
    }

    /// The unknown whose best value helps most in the worst of the combinations.
    fn decides(&self, outcomes: &[Outcome]) -> Option<String> {
        let asked = || {
            outcomes
                .iter()
                .filter(|outcome| self.combinations.contains(&outcome.at))
        };
        let worst = asked().max_by(|a, b| a.share().total_cmp(&b.share()))?;
        let least = |unknown: &usize| {
            let differs = |outcome: &&Outcome| {
                let mut pairs = outcome.at.iter().zip(&worst.at).enumerate();
                outcome.failure.is_none() && pairs.all(|(index, (a, b))| index == *unknown || a == b)
            };
            asked()
                .filter(differs)
                .map(Outcome::share)
                .fold(f64::INFINITY, f64::min)
        };
        let all = 0..self.unknowns.len();
        let decides = all.min_by(|a, b| least(a).total_cmp(&least(b)))?;
        Some(self.unknowns[decides].key.clone())
    }
}

fn largest(outcomes: &[Outcome]) -> f64 {
    worst(outcomes).map_or(f64::INFINITY, Outcome::share)
}

/// The candidate with the smallest largest share of a limit in the `critical` combinations; of springs that with any stiffness, as a
/// spring against a spring is read between those that are run.
fn best_candidate(runs: &Runs<'_>, way: &Way, critical: &[Vec<f64>]) -> Result<Measure, Error> {
    let at_all = |measure: &Measure| {
        let run = |at: &Vec<f64>| runs.run(measure, at, Effort::Coarse);
        critical.par_iter().map(run).collect::<Result<Vec<_>, _>>()
    };
    let rows: Vec<Vec<Outcome>> = way.candidates.par_iter().map(at_all).collect::<Result<_, _>>()?;
    if way.stiffnesses.is_empty() {
        let best = way
            .candidates
            .iter()
            .zip(&rows)
            .min_by(|(_, a), (_, b)| largest(a).total_cmp(&largest(b)));
        return Ok(best.map_or_else(Measure::default, |(measure, _)| measure.clone()));
    }
    let (levels, count) = (&way.stiffnesses, critical.len());
    let at_stiffness = |stiffness: f64| {
        let of = |case: usize| {
            let limits = rows[0][case].verdicts.iter().enumerate();
            let read = limits.map(|(limit, verdict)| {
                let inverse = between(levels, stiffness, verdict.quantity).map(|(level, weight)| {
                    let known = rows[level][case].verdicts.get(limit);
                    known.map_or(
                        0.0,
                        |known| if weight > 0.0 { weight / share(known) } else { 0.0 },
                    )
                });
                1.0 / (inverse[0] + inverse[1])
            });
            read.fold(0.0, f64::max)
        };
        (0..count).map(of).fold(0.0, f64::max)
    };
    let (first, last) = (levels[0], levels[levels.len() - 1]);
    let steps = ((last / first).log10() * PER_DECADE).ceil();
    let trials = (0..=steps as usize).map(|i| first * (last / first).powf(i as f64 / steps));
    // A product has a round stiffness.
    let round = |stiffness: f64| format!("{stiffness:.1e}").parse().unwrap_or(stiffness);
    let best = trials
        .map(round)
        .min_by(|a, b| at_stiffness(*a).total_cmp(&at_stiffness(*b)));
    Ok(way.with_spring(best.unwrap_or(first)))
}

/// The measure with its worst on a finer mesh and then with the scene's tolerance; and all that is near a limit, until it is known to
/// exceed one or to hold.
fn decided(runs: &Runs<'_>, mut tried: Tried) -> Result<Tried, Error> {
    for (effort, most) in [(Effort::Finer, FINER), (Effort::Decisive, 1)] {
        for _ in 0..most {
            let Some(rough) = tried.worst(|worst| worst.effort < effort) else {
                break;
            };
            if tried.outcomes[rough].share() < largest(&tried.outcomes) {
                break;
            }
            tried.again(runs, rough, effort)?;
        }
    }
    while let Some(rough) = tried.worst(|outcome| outcome.effort < Effort::Decisive) {
        let exceeds = |outcome: &Outcome| outcome.effort == Effort::Decisive && outcome.share() > 1.0;
        let is_near = (tried.outcomes[rough].share() - 1.0).abs() < DOUBT;
        if !is_near || tried.outcomes.iter().any(exceeds) {
            break;
        }
        tried.again(runs, rough, Effort::Decisive)?;
    }
    Ok(tried)
}

impl Tried {
    /// The place of the worst of some outcomes.
    fn worst(&self, is_meant: impl Fn(&Outcome) -> bool) -> Option<usize> {
        let share = |place: &usize| self.outcomes[*place].share();
        let all = 0..self.outcomes.len();
        let meant = all.filter(|place| {
            let outcome = &self.outcomes[*place];
            outcome.failure.is_none() && is_meant(outcome)
        });
        meant.max_by(|a, b| share(a).total_cmp(&share(b)))
    }

    /// Runs one combination again with more effort. What the scene's tolerance changes there scales the others, which are coarser (space
    /// mapping: J. W. Bandler et al., IEEE Trans. Microwave Theory Tech. 42 (1994) 2536).
    fn again(&mut self, runs: &Runs<'_>, place: usize, effort: Effort) -> Result<(), Error> {
        let before = self.outcomes[place].clone();
        self.outcomes[place] = runs.run(&self.measure, &before.at, effort)?;
        if effort == Effort::Decisive {
            let after = self.outcomes[place].verdicts.clone();
            for other in self.outcomes.iter_mut().filter(|other| other.effort < effort) {
                for (limit, (old, new)) in before.verdicts.iter().zip(&after).enumerate() {
                    let scale = if old.largest > 0.0 {
                        new.largest / old.largest
                    } else {
                        1.0
                    };
                    other
                        .verdicts
                        .get_mut(limit)
                        .into_iter()
                        .for_each(|own| own.largest *= scale);
                }
            }
        }
        Ok(())
    }
}

/// The scene as it is if that holds; else the cheapest measure that does, and without costs the one with the fewest parts.
fn recommended(measures: &[MeasureAnswer]) -> Option<&MeasureAnswer> {
    let price = |measure: &MeasureAnswer| match measure.cost {
        Some(Cost::Number(cost)) => cost,
        _ if measure.parts == 0 => 0.0,
        _ => f64::INFINITY,
    };
    let holding = measures.iter().filter(|measure| measure.within_limits);
    holding.min_by(|a, b| {
        let by_price = price(a).total_cmp(&price(b)).then(a.parts.cmp(&b.parts));
        by_price.then(a.share().total_cmp(&b.share()))
    })
}
