//! The comparison: every measure in every combination, then closer around the worst, and what decides with the scene's tolerance.

use rayon::prelude::*;

use super::answer::{Comparison, MeasureAnswer, Outcome, share, worst};
use super::hill::top;
use super::runs::{LimitsOf, Runs, Tried};
use super::unknown::{Combination, combinations, middle, unknowns};
use super::ways::{Way, stiffness, ways, with_stiffness};
use crate::design::DesignError;
use crate::springs::read;
use creepage_run::{Error, Place, Progress};
use creepage_scene::{Cost, Measure, Scene, SceneFile, Uncertain};

/// Runs closer around the worst of one measure, at most.
const CLOSER: usize = 4;
/// A combination is as bad as the worst if it comes so near.
const AS_BAD: f64 = 0.95;
/// Stiffnesses that are read, in a factor of ten.
const PER_DECADE: f64 = 24.0;
/// Runs with the scene's own tolerance, at most, until the worst is one of them.
const DECISIVE: usize = 3;
/// All combinations that are nearer to a limit than this share are run with that tolerance, until one exceeds it.
const DOUBT: f64 = 0.1;

/// What is to be compared.
#[derive(Debug, Clone)]
pub struct Study {
    file: SceneFile,
    scene: Scene,
    unknowns: Vec<Uncertain>,
    assumed: bool,
    combinations: Vec<Combination>,
    ways: Vec<Way>,
}

impl Study {
    /// The measures and unknowns of the scene in `file`.
    ///
    /// # Errors
    ///
    /// [`DesignError`] if the scene is wrong, or has more unknowns than can be combined.
    pub fn new(file: &SceneFile) -> Result<Self, DesignError> {
        let scene = file.scene().map_err(Error::from)?;
        let (unknowns, assumed) = unknowns(&scene)?;
        Ok(Self {
            file: file.clone(),
            combinations: combinations(&unknowns)?,
            ways: ways(&scene),
            unknowns,
            assumed,
            scene,
        })
    }

    /// The clamps of all measures that are compared.
    pub fn clamps(&self) -> Vec<Place> {
        let all = self.ways.iter().flatten();
        let clamps = all.flat_map(|measure| measure.applied(&self.scene).restraints);
        clamps.map(|clamp| Place::Clamp(clamp.position)).collect()
    }

    /// How many combinations, measures and, at most, runs there are: each rough and with the scene's tolerance, and twice where a stiffness
    /// or a place is looked for, that in two and then in three combinations.
    pub fn size(&self) -> [usize; 3] {
        let count = self.combinations.len();
        let runs = |way: &Way| match way.len() {
            1 => 2 * (count + CLOSER),
            candidates => 3 * (count + CLOSER) + (2 + 3) * candidates,
        };
        [count, self.ways.len(), self.ways.iter().map(runs).sum()]
    }

    /// Compares the measures by these limits.
    ///
    /// # Errors
    ///
    /// [`Error`] if the middle of all intervals is no valid scene, or `progress` stops it. Every other run that fails is stated.
    pub fn compare(&self, limits: LimitsOf<'_>, progress: Progress<'_>) -> Result<Comparison, Error> {
        let is_sought = |way: &Way| way.len() > 1;
        let usual = |way: &Way| self.combinations.len() + if is_sought(way) { 2 * way.len() + 1 } else { 1 };
        let expected = [self.ways.iter().map(usual).sum(), self.ways.len()];
        let runs = Runs::new(&self.file, &middle(&self.unknowns), limits, progress, expected)?;
        // Stiffnesses and places are chosen for the worst combinations of what comes first.
        let (first, others) = self
            .ways
            .split_at(self.ways.partition_point(|way| !is_sought(way)));
        let of_all = |ways: &[Way], critical: &[Combination]| {
            let decided = |way: &Way| self.decided(&runs, self.sought(&runs, way, critical)?);
            ways.par_iter().map(decided).collect::<Result<Vec<_>, Error>>()
        };
        let mut measures = of_all(first, &[])?;
        let asked = |measure: &MeasureAnswer| Some(worst(self.asked(&measure.outcomes))?.at.clone());
        let mut critical: Vec<Combination> = measures.iter().filter_map(asked).collect();
        critical.dedup();
        measures.extend(of_all(others, &critical)?);
        Ok(self.answer(runs.made(), measures))
    }

    /// Those of the combinations, without what lies between them.
    fn asked<'o>(&self, outcomes: &'o [Outcome]) -> impl Iterator<Item = &'o Outcome> {
        let all = outcomes.iter();
        all.filter(|outcome| self.combinations.contains(&outcome.at))
    }

    /// The best of a way in the `critical` combinations, and in those that prove worse with it (cutting planes: J. E. Kelley, J. SIAM 8
    /// (1960) 703).
    fn sought(&self, runs: &Runs<'_>, way: &Way, critical: &[Combination]) -> Result<Tried, Error> {
        let first = self.tried(runs, &best(runs, way, critical)?)?;
        let most = first.largest();
        let is_as_bad =
            |outcome: &Outcome| critical.contains(&outcome.at) && outcome.share() >= AS_BAD * most;
        let is_good = way.len() == 1 || most <= 1.0 || first.outcomes.iter().any(is_as_bad);
        let Some(worst) = worst(&first.outcomes).filter(|_| !is_good) else {
            return Ok(first);
        };
        let critical = [critical, std::slice::from_ref(&worst.at)].concat();
        let second = self.tried(runs, &best(runs, way, &critical)?)?;
        Ok(if second.largest() < most { second } else { first })
    }

    /// The measure in all combinations, and closer around the worst.
    fn tried(&self, runs: &Runs<'_>, measure: &Measure) -> Result<Tried, Error> {
        let mut tried = runs.tried(measure, &self.combinations)?;
        for _ in 0..CLOSER {
            let Some(at) = top(&tried.outcomes) else { break };
            if !tried.add(runs.run(measure, &at, true)?) {
                break;
            }
        }
        Ok(tried)
    }

    /// What is said of a measure.
    fn decided(&self, runs: &Runs<'_>, mut tried: Tried) -> Result<MeasureAnswer, Error> {
        let middle = middle(&self.unknowns);
        let in_middle = |tried: &Tried, rough| {
            let mut outcomes = tried.outcomes.iter();
            let found = outcomes.find(|outcome| outcome.at == middle && outcome.rough == rough);
            found.and_then(Outcome::nearest)
        };
        let rough_nominal = in_middle(&tried, true);
        decide(runs, &mut tried)?;
        let held = tried.measure.applied(&self.scene);
        Ok(MeasureAnswer {
            ends: held.ends,
            restraints: held.restraints,
            parts: tried.measure.parts(),
            within_limits: tried.failures.is_empty() && tried.outcomes.iter().all(Outcome::holds),
            kept: self
                .asked(&tried.outcomes)
                .filter(|outcome| outcome.holds())
                .count(),
            worst: worst(&tried.outcomes).and_then(Outcome::nearest),
            nominal: in_middle(&tried, false).or(rough_nominal),
            name: tried.measure.name,
            cost: tried.measure.cost,
            failures: tried.failures,
            outcomes: tried.outcomes,
        })
    }

    fn answer(&self, runs: usize, measures: Vec<MeasureAnswer>) -> Comparison {
        let recommended = recommended(&measures);
        let by_share = |a: &&MeasureAnswer, b: &&MeasureAnswer| a.share().total_cmp(&b.share());
        let nearest = measures.iter().min_by(by_share).filter(|_| recommended.is_none());
        Comparison {
            title: self.scene.title.clone(),
            passes: self.scene.traffic.passes,
            uncertain: self.unknowns.clone(),
            assumed: self.assumed,
            combinations: self.combinations.len(),
            runs,
            recommended: recommended.map(|measure| measure.name.clone()),
            decides: nearest.and_then(|nearest| self.decides(&nearest.outcomes)),
            nearest: nearest.map(|nearest| nearest.name.clone()),
            measures,
        }
    }

    /// The unknown whose best value helps most in the worst of the combinations.
    fn decides(&self, outcomes: &[Outcome]) -> Option<String> {
        let worst = worst(self.asked(outcomes))?;
        let least = |key: &str| {
            let line = self
                .asked(outcomes)
                .filter(|outcome| outcome.differs_only_in(key, &worst.at));
            line.map(Outcome::share).fold(f64::INFINITY, f64::min)
        };
        let keys = worst.at.keys();
        keys.min_by(|a, b| least(a).total_cmp(&least(b))).cloned()
    }
}

/// Runs the worst with the scene's tolerance; and all that is near a limit, until the measure is known
/// to exceed one or to hold.
fn decide(runs: &Runs<'_>, tried: &mut Tried) -> Result<(), Error> {
    let (mut count, mut known) = (0, 0.0);
    while let Some(next) = worst(tried.outcomes.iter().filter(|outcome| outcome.rough)).cloned() {
        let is_near = (next.share() - 1.0).abs() < DOUBT && known <= 1.0;
        if !is_near && (count == DECISIVE || next.share() <= known) {
            break;
        }
        count += 1;
        tried.outcomes.retain(|outcome| outcome.at != next.at);
        let own = runs.run(&tried.measure, &next.at, false)?;
        if let Ok(own) = &own {
            known = own.share().max(known);
            scale(&mut tried.outcomes, &next, own);
        }
        tried.add(own);
    }
    Ok(())
}

/// What the scene's tolerance changes of one outcome scales the other rough ones for what follows
/// (space mapping: J. W. Bandler et al., IEEE Trans. Microwave Theory Tech. 42 (1994) 2536).
fn scale(outcomes: &mut [Outcome], rough: &Outcome, own: &Outcome) {
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.rough) {
        let known = rough.verdicts.iter().zip(&own.verdicts);
        for (verdict, (rough, own)) in outcome.verdicts.iter_mut().zip(known) {
            let scale = own.largest / rough.largest;
            verdict.largest *= if scale.is_finite() { scale } else { 1.0 };
        }
    }
}

/// The candidate with the smallest largest share of a limit in the `critical` combinations; of springs that with any stiffness, as a
/// spring against a spring is read between those that are run.
fn best(runs: &Runs<'_>, way: &Way, critical: &[Combination]) -> Result<Measure, Error> {
    if way.len() == 1 {
        return Ok(way[0].clone());
    }
    let rows = way.par_iter().map(|measure| runs.tried(measure, critical));
    let rows: Vec<Tried> = rows.collect::<Result<_, _>>()?;
    let levels: Vec<f64> = way.iter().filter_map(stiffness).collect();
    if levels.len() < way.len() || rows.iter().any(|row| !row.failures.is_empty()) {
        let best = rows.iter().min_by(|a, b| a.largest().total_cmp(&b.largest()));
        return Ok(best.map_or(&way[0], |best| &best.measure).clone());
    }
    // Of every case and limit, the share with any stiffness.
    let largest_with = |stiffness: &f64| {
        let mut largest: f64 = 0.0;
        for (case, outcome) in rows[0].outcomes.iter().enumerate() {
            for (limit, verdict) in outcome.verdicts.iter().enumerate() {
                let of_row = |row: usize| share(&rows[row].outcomes[case].verdicts[limit]);
                largest = largest.max(read(&levels, *stiffness, verdict.quantity, of_row));
            }
        }
        largest
    };
    let (first, last) = (levels[0], levels[levels.len() - 1]);
    let steps = ((last / first).log10() * PER_DECADE).ceil();
    let trials = (0..=steps as usize).map(|step| first * (last / first).powf(step as f64 / steps));
    // A product has a round stiffness.
    let round = |stiffness: f64| format!("{stiffness:.1e}").parse().unwrap_or(stiffness);
    let by_share = |a: &f64, b: &f64| largest_with(a).total_cmp(&largest_with(b));
    let best = trials.map(round).min_by(by_share);
    Ok(with_stiffness(&way[0], best.unwrap_or(first)))
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
