//! With which mesh a run ends and what it costs, from what is known of coarser ones.
//!
//! The difference between neighbouring meshes falls by 3.4 a level in the middle, and by 1.5 to 6.7 in two of three scenes; where the
//! first passes have been made on the finer mesh too, theirs tells more than half of that. Each level costs about five times the one before.
//! So the levels with which the run may end are weighed by how likely they are.
//!
//! All constants were fitted to the traces of 120 random scenes with 10⁴, 10⁶ and 10⁸ passes, and how the levels are weighed once more to
//! half of 50 others with 10³ and 10⁶ passes; `forecasts_on_many_scenes` in `tests/planner/forecast.rs` measures what they are worth.

use cable_dem::Statistics;
use cycle_jump::Record;

use super::jumps::SMALLER_SHARE;
use super::seen::SHARP;
use super::work::{GROWTH, Work};
use super::worth::{REFINEMENT_COST, allowed, worth};
use crate::answer::error_estimate::{Scale, Shares, difference, of_differences};
use crate::plan::{Levels, Plan};

/// ln of what the differences between meshes are multiplied by from one level to the next; the part of it that the first passes tell.
const FALL: f64 = -1.23;
const TOLD: f64 = 0.65;
/// ln of a difference beside that of the first passes, where only these are known.
const BESIDE_EARLY: f64 = 0.7;
/// Standard deviation of ln of a difference: with the first passes known, without, and where nothing else is.
const SPREAD_TOLD: f64 = 0.6;
const SPREAD: f64 = 0.8;
const SPREAD_ALONE: f64 = 1.0;
/// Standard deviation of ln of the work on a level that is not known.
const SPREAD_OF_WORK: f64 = 0.25;
/// What is told is most likely within a factor of two of the truth, where a truth of less than three times of it counts so much besides; the
/// standard deviation of ln of the work for a given last level; and what is tried to find it.
const WORTH_OF_ENOUGH: f64 = 0.3;
const TWICE: f64 = std::f64::consts::LN_2;
const THRICE: f64 = 1.0986;
const SPREAD_OF_END: f64 = 0.1;
const MARGIN: f64 = 0.3;
const TRIED: u32 = 200;
/// Smaller jumps take this share of the work in which the first ones are found.
const SMALLER_JUMPS: f64 = 0.5;
/// Smallest difference that counts.
const LEAST: f64 = 1e-5;

/// Passes on one level, and their work.
pub struct Level {
    pub records: Vec<Record>,
    pub work: Work,
}

/// What is known of a run.
pub struct Known<'a> {
    pub plan: &'a Plan<'a>,
    pub scale: Scale,
    /// The coarsest level.
    pub coarsest: usize,
    /// The first passes on it and on finer levels, and all passes.
    pub early: Vec<Level>,
    pub full: Vec<Level>,
    /// Work on no level's account: that of finding jumps.
    pub besides: Work,
    /// Error of the jumps.
    pub passes: Shares,
    /// About how many passes are simulated on a level.
    pub simulated: f64,
    /// Work in which jumps on the next level do not get on.
    pub stuck: Option<Work>,
}

/// One way in which the run may end.
#[derive(Debug, Clone, Copy)]
struct End {
    level: usize,
    likely: f64,
    work: Work,
}

impl Known<'_> {
    /// All passes on the next level are known.
    pub fn add(&mut self, records: Vec<Record>, work: Work) {
        if self.early.len() == self.full.len() {
            let first = &records[..self.early[0].records.len().min(records.len())];
            let mut statistics = Statistics::default();
            for record in first {
                statistics += record.outcome.statistics;
            }
            self.early.push(Level {
                work: Work::new(&statistics, 0, 0.0, 0.0),
                records: first.to_vec(),
            });
        }
        self.full.push(Level { records, work });
    }

    /// The next level to be known.
    pub fn next(&self) -> usize {
        self.coarsest + self.full.len()
    }

    pub fn next_early(&self) -> usize {
        self.coarsest + self.early.len()
    }

    /// Work of all passes on `level`.
    pub fn level_work(&self, level: usize) -> Work {
        if let Some(known) = self.full.get(level - self.coarsest) {
            return known.work;
        }
        let Some(coarser) = level.checked_sub(1).filter(|_| level > self.coarsest) else {
            let early = &self.early[0];
            return early.work.times(self.simulated / early.records.len() as f64);
        };
        self.level_work(coarser) * self.growth(level)
    }

    /// Work of a run up to `level` in which every pass is simulated; `None` where that is this run.
    fn every_pass(&self, level: usize) -> Option<Work> {
        let passes = self.plan.scene.traffic.passes as f64;
        let meshes = (self.coarsest..=level).map(|level| self.level_work(level));
        let work = meshes.fold(Work::default(), |all, work| all + work);
        (self.simulated < passes).then(|| work.times(passes / self.simulated))
    }

    /// Work of the first passes on `level`.
    pub fn early_work(&self, level: usize) -> Work {
        match self.early.get(level - self.coarsest) {
            Some(known) => known.work,
            None => self.early_work(level - 1) * self.growth(level),
        }
    }

    /// Growth of the work from the level below to `level`, or as far as known.
    fn growth(&self, level: usize) -> Work {
        let known = |levels: &[Level], place: usize| {
            (1..levels.len())
                .contains(&place)
                .then(|| levels[place].work.growth(levels[place - 1].work))
        };
        let place = level - self.coarsest;
        known(&self.early, place)
            .or_else(|| known(&self.full, self.full.len().wrapping_sub(1)))
            .or_else(|| known(&self.early, self.early.len() - 1))
            .unwrap_or(GROWTH)
    }

    /// Difference between `level` and the one below, and the standard deviation of its ln.
    fn difference(&self, level: usize) -> (Shares, f64) {
        let place = level - self.coarsest;
        if place < self.full.len() {
            return (between(&self.full, place, self.scale), 0.0);
        }
        let early = |place: usize| {
            (1..self.early.len())
                .contains(&place)
                .then(|| between(&self.early, place, self.scale))
        };
        let last = self.full.len().saturating_sub(1);
        match early(place) {
            Some(now) if last >= 1 => {
                let (whole, _) = self.difference(self.coarsest + last);
                let then = early(last).expect("known wherever all passes are");
                let steps = (place - last) as f64;
                let change = |whole: f64, then: f64, now: f64| {
                    let told = (now.max(LEAST) / then.max(LEAST)).ln();
                    whole.max(LEAST) * (TOLD * told + (1.0 - TOLD) * FALL * steps).exp()
                };
                let all = Shares {
                    force: change(whole.force, then.force, now.force),
                    movement: change(whole.movement, then.movement, now.movement),
                };
                (all, SPREAD_TOLD)
            }
            Some(now) => (now.times(BESIDE_EARLY.exp()), SPREAD_ALONE),
            None if place > 1 => {
                let (coarser, spread) = self.difference(level - 1);
                (coarser.times(FALL.exp()), spread.hypot(SPREAD))
            }
            None => (Shares::both(Levels::typical_error(self.coarsest)), SPREAD_ALONE),
        }
    }

    /// How likely a run that has come to `level` ends there: with the jumps that were found, and with smaller ones.
    fn ends_at(&self, level: usize) -> [f64; 2] {
        let Plan { scene, levels, .. } = self.plan;
        if level >= levels.finest() || levels.mesh(level + 1).is_err() {
            return [1.0, 0.0];
        }
        let still = self.scale.is_still(&self.early[0].records);
        if level == self.coarsest || still && level < SHARP {
            return [0.0; 2];
        }
        let (error, spread) = self.error(level);
        let others = Shares::both(self.plan.ground.accuracy + self.plan.choice.inertia);
        let within = |allowed: Shares| {
            let allowed = allowed.less(others);
            let excess = (error.force / allowed.force).max(error.movement / allowed.movement);
            below(
                if allowed.force > 0.0 {
                    excess.ln()
                } else {
                    f64::INFINITY
                },
                spread,
            )
        };
        let tolerance = scene.solver.tolerance;
        let found = within(allowed(tolerance, self.passes));
        let smaller = within(Shares::both((1.0 - SMALLER_SHARE) * tolerance));
        let smaller = if self.passes == Shares::default() {
            0.0
        } else {
            (smaller - found).max(0.0)
        };
        let work = REFINEMENT_COST as f64 * self.level_work(level).updates();
        let spread = if level < self.next() { 0.0 } else { SPREAD_OF_WORK };
        let affordable = below((work / worth(tolerance) as f64).ln(), spread);
        [1.0 - smaller - (1.0 - found - smaller) * affordable, smaller]
    }

    /// Error of the mesh on `level`, and the standard deviation of its ln.
    pub fn error(&self, level: usize) -> (Shares, f64) {
        let mut spread = 0.0;
        let differences: Vec<Shares> = (self.coarsest + 1..=level)
            .rev()
            .map(|level| {
                let (difference, its) = self.difference(level);
                spread = its.max(spread);
                difference
            })
            .collect();
        let listed = match self.full.last() {
            Some(known) => known.records.len(),
            None => self.early[0].records.len().max(self.simulated as usize),
        };
        (
            of_differences(&differences, listed, Levels::typical_error(level)),
            spread,
        )
    }

    /// The ways in which the run may end.
    fn ends(&self) -> Vec<End> {
        let levels = &self.plan.levels;
        let mut work = self.besides;
        for level in self.coarsest..levels.first() {
            work += self.level_work(level);
        }
        let mut ends = Vec::new();
        let mut left = 1.0;
        for level in levels.first().max(self.coarsest)..=levels.finest() {
            work += self.level_work(level);
            let ends_here = match self.stuck {
                Some(stuck) if level + 1 == self.next() => {
                    work += stuck;
                    [1.0, 0.0]
                }
                _ => self.ends_at(level),
            };
            let again = work + self.level_work(level) + self.besides.times(SMALLER_JUMPS);
            for (ends_here, work) in ends_here.into_iter().zip([work, again]) {
                ends.push(End {
                    level,
                    likely: left * ends_here,
                    work,
                });
            }
            left *= 1.0 - ends_here[0] - ends_here[1];
            if left <= 0.0 {
                break;
            }
        }
        ends
    }
}

/// What is to be expected of a run.
#[derive(Clone, Copy)]
pub struct Outlook {
    /// The most likely last level.
    pub level: usize,
    pub work: Work,
    pub mean: Work,
    /// Work where every pass is simulated.
    pub every_pass: Work,
    /// Error of the jumps.
    pub passes: Shares,
    /// Whether nothing is left to guess.
    pub certain: bool,
}

impl Outlook {
    pub fn new(known: &Known<'_>) -> Self {
        let ends = known.ends();
        let updates = |end: &End| end.work.updates().max(1.0).ln();
        let last = ends[ends.len() - 1];
        let (low, high) = (updates(&ends[0]) - MARGIN, updates(&last) + MARGIN);
        let worth = |told: f64| -> f64 {
            let of_end = |end: &End| {
                let more = updates(end) - told;
                let within = below(more.abs() - TWICE, SPREAD_OF_END);
                let enough = below(more - THRICE, SPREAD_OF_END);
                end.likely * (within + WORTH_OF_ENOUGH * enough)
            };
            ends.iter().map(of_end).sum()
        };
        let told = (0..=TRIED)
            .map(|k| low + (high - low) * f64::from(k) / f64::from(TRIED))
            .max_by(|&a, &b| worth(a).total_cmp(&worth(b)))
            .unwrap_or(high);
        // In proportion to the end whose work is nearest.
        let distance = |end: &&End| (updates(end) - told).abs();
        let nearest = ends.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let nearest = nearest.unwrap_or(&last);
        let likeliest = ends.iter().max_by(|a, b| a.likely.total_cmp(&b.likely));
        let level = likeliest.unwrap_or(&last).level;
        let work = nearest.work.times((told - updates(nearest)).exp());
        Self {
            level,
            every_pass: known.every_pass(level).unwrap_or(work),
            passes: known.passes,
            mean: ends
                .iter()
                .fold(Work::default(), |mean, end| mean + end.work.times(end.likely)),
            work,
            certain: ends
                .iter()
                .all(|end| end.level < known.next() || end.likely == 0.0),
        }
    }
}

/// How likely a number with the given `mean` and standard deviation is below zero: the logistic distribution.
fn below(mean: f64, spread: f64) -> f64 {
    1.0 / (1.0 + (1.7 * mean / spread.max(f64::MIN_POSITIVE)).exp())
}

fn between(levels: &[Level], place: usize, scale: Scale) -> Shares {
    let [coarse, fine] = [&levels[place - 1].records, &levels[place].records];
    difference(fine, coarse, scale)
}
