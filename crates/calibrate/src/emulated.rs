//! A fit by a stand-in for the model.
//!
//! The search runs on an [`Emulator`], where a run costs microseconds; the model itself runs where the answer rests: at the optimum, at
//! the ends of the intervals, at the bounds that they leave out. What it says there is learned, and the search repeated, until the two
//! agree at all of these places to the accuracy that is asked of a fit (D. R. Jones, M. Schonlau, W. J. Welch, "Efficient Global
//! Optimization of Expensive Black-Box Functions", Journal of Global Optimization 13, 1998, for the idea). A model that the
//! emulator cannot follow, because it has corners without an answer or jumps, is fitted directly.

use nalgebra::DVector;
use rayon::prelude::*;

use crate::evaluator::Evaluator;
use crate::levenberg_marquardt::LevenbergMarquardt;
use crate::profile::{Place, Witness};
use crate::search::{Point, Search, all_over, score};
use crate::solution::{Route, Solution};
use crate::station::TOLERANCE;
use crate::{Calibration, CalibrationError, Emulator, Fit, Options, Profiles};

/// Rounds of search and learning.
const MAX_ROUNDS: usize = 24;
/// Points of the stand-in that are scanned, for each parameter and one more; most of its runs in one search.
const SCAN: usize = 64;
const MAX_RUNS: usize = 200_000;
/// Score above the least of runs of a coarser model that are repeated, and how many more than the best of them, a parameter.
const VALLEY: f64 = 16.0;
const ANCHORS: usize = 2;
/// Noise of the stand-in, which is smooth.
const SMOOTH: f64 = 1e-9;
/// Accuracy of the root of the rise at an end, as a share of the end's; at a bound, as a share of its distance from what excludes it;
/// at a rival.
const END: f64 = 0.03;
const MARGIN: f64 = 0.5;
const RIVAL: f64 = 0.5;
/// Root of the rise at a bound, in that which excludes it, that is worth no second look.
const FAR: f64 = 2.0;
/// Iterations of the model's own descent at a bound.
const DESCENT: u64 = 4;
/// Distance between prediction and run, in standard errors of all readings together, at the optimum and at an end.
const NEAR_OPTIMUM: f64 = 0.2;
const NEAR_END: f64 = 0.5;
/// Distance, in the model's own noise, that a learned optimum may be off.
const RIPPLE: f64 = 3.0;

impl Calibration<'_> {
    /// Fits a model that is dear to run, as [`fit`](Self::fit) does. A smooth one takes a small part of the runs; one that the emulator
    /// cannot follow takes those of a direct fit on top of those that it wasted.
    ///
    /// The emulator is searched all over: [`Options::scan`] only says how many runs it first learns from, [`Options::restart`] means
    /// nothing, and the observer hears of descents on the emulator. The model confirms the optimum, the ends of the intervals and the
    /// excluded bounds; at a bound that is not excluded by far its own other parameters are fitted. Where three and more parameters are
    /// hardly known, an end may be a tenth of its distance off from that of a direct fit.
    ///
    /// `coarse` is what an earlier fit of the same parameters and observations with a coarser model learned; the emulator of
    /// this one is the second answer.
    ///
    /// # Errors
    ///
    /// As for [`fit`](Self::fit), and [`CalibrationError::InvalidOption`] for a `coarse` of other parameters or observations.
    pub fn fit_emulated(&self, coarse: Option<&Emulator>) -> Result<(Fit, Emulator), CalibrationError> {
        self.check_count()?;
        let units = self.units();
        let options = self.options();
        let runs = self.evaluator(&units, options.max_evaluations);
        // One that could not follow its model has nothing to teach.
        let coarse = coarse.filter(|coarse| coarse.runs() > 0);
        if coarse.is_some_and(|coarse| !coarse.is_of(self.parameters(), self.observations().len())) {
            return Err(CalibrationError::InvalidOption {
                name: "coarse emulator's parameters",
                value: self.parameters().len() as f64,
                allowed: "those of this calibration, and its observations",
            });
        }
        let mut emulation = Emulation {
            calibration: self,
            emulator: Emulator::new(self.parameters(), coarse),
            runs: &runs,
        };
        let start = options.start.as_ref().map(|start| self.free(start));
        let mut design: Vec<DVector<f64>> = start.clone().into_iter().collect();
        let dimensions = self.parameters().len();
        let score = |free: &DVector<f64>, predicted: &[f64]| {
            let residuals = runs.standardised(free, predicted);
            score(&residuals, self.observations().len(), self.sigmas().is_some())
        };
        match coarse {
            // Along the whole valley, so that what the coarse model misses is known where it may matter.
            Some(coarse) => design.extend(coarse.low_points(score, VALLEY, ANCHORS * dimensions)),
            None => design.extend(all_over(dimensions, self.scan())),
        }
        let fit = if let Some(solution) = emulation.converge(design, start)? {
            self.answer(&runs, solution)
        } else {
            let best = emulation.emulator.low_points(score, 0.0, 0);
            self.fit_directly(runs.count(), best.first().map(|best| runs.physical(best)))?
        };
        Ok((fit, emulation.emulator))
    }

    /// Fits without a stand-in after so many runs in vain, the best of which was at `best`.
    fn fit_directly(&self, runs: usize, best: Option<Vec<f64>>) -> Result<Fit, CalibrationError> {
        let limit = self.options().max_evaluations;
        let spent = CalibrationError::EvaluationLimit { limit };
        let left = Options {
            max_evaluations: limit.saturating_sub(runs),
            start: best.or_else(|| self.options().start.clone()),
            ..self.options().clone()
        };
        if left.max_evaluations == 0 {
            return Err(spent);
        }
        match self.clone().with_options(left)?.fit() {
            Ok(fit) => Ok(Fit {
                evaluations: fit.evaluations + runs,
                ..fit
            }),
            Err(CalibrationError::EvaluationLimit { .. }) => Err(spent),
            Err(error) => Err(error),
        }
    }
}

/// A stand-in and the model that it learns from.
struct Emulation<'a> {
    calibration: &'a Calibration<'a>,
    runs: &'a Evaluator<'a>,
    emulator: Emulator,
}

/// A point at which the model ran.
struct Run {
    free: DVector<f64>,
    predicted: Vec<f64>,
    residuals: DVector<f64>,
}

impl Emulation<'_> {
    /// A solution at whose witnesses the model agrees; nothing where the emulator does not come to one.
    fn converge(
        &mut self,
        design: Vec<DVector<f64>>,
        mut start: Option<DVector<f64>>,
    ) -> Result<Option<Solution>, CalibrationError> {
        let options = self.calibration.options();
        // Intervals are worth a look around an optimum that holds, or that a coarser model gave.
        let mut described = self.emulator.is_corrected();
        let Some(first) = self.run(design)? else {
            return Ok(None);
        };
        self.learn(first);
        for _ in 0..MAX_ROUNDS {
            let route = Route {
                start: start.take(),
                scan: SCAN * (1 + self.calibration.parameters().len()),
                restart: true,
                profiles: if described {
                    &options.profiles
                } else {
                    &Profiles::None
                },
                dear: false,
            };
            let Some(mut solution) = self.solve(&route) else {
                return Ok(None);
            };
            let optimum = solution.optimum.point.free.clone();
            let learned = self.emulator.known(&optimum).is_some();
            let witnesses: Vec<&Witness> = solution
                .witnesses
                .iter()
                .filter(|witness| !self.is_known(&solution, witness))
                .collect();
            let mut places = vec![optimum.clone()];
            places.extend(witnesses.iter().map(|witness| witness.point.free.clone()));
            let Some(seen) = self.run(places)? else {
                return Ok(None);
            };
            let shift = shift(&solution, &seen[0].residuals);
            let settled = self.is_settled(&solution, &seen[0], shift, learned);
            let mut agreed = settled;
            for (witness, run) in witnesses.iter().zip(&seen[1..]) {
                let far = is_far(&solution, &seen[0], witness, run);
                if let (Place::Bound(side), true) = (witness.place, settled && far) {
                    self.emulator.exclude(side);
                }
                agreed &= self.agrees(&solution, &seen[0], witness, run);
            }
            let agreed = agreed && (described || options.profiles == Profiles::None);
            let lower = if agreed {
                self.below_bounds(&solution, &seen[0], witnesses.iter().zip(&seen[1..]))?
            } else {
                Vec::new()
            };
            if agreed && lower.is_empty() {
                solution.optimum.point.residuals = seen[0].residuals.clone();
                solution.optimum.offset = solution.optimum.offset.max(shift);
                self.learn(seen);
                return Ok(Some(solution));
            }
            start = Some(optimum);
            let runs = self.emulator.runs();
            self.learn(seen);
            self.learn(lower);
            if self.emulator.runs() == runs && (described || !settled) {
                // It knows all that it asks for and still says otherwise.
                return Ok(None);
            }
            described |= settled;
        }
        Ok(None)
    }

    /// Searches on the stand-in.
    fn solve(&self, route: &Route<'_>) -> Option<Solution> {
        let runs = self.runs;
        let stand_in = Evaluator::new(
            &self.emulator,
            runs.parameters,
            runs.values,
            runs.sigmas,
            SMOOTH,
            MAX_RUNS,
        );
        self.calibration.solve(&stand_in, route).ok()
    }

    /// Runs the model where it has not run yet; nothing if it has no answer somewhere.
    fn run(&self, points: Vec<DVector<f64>>) -> Result<Option<Vec<Run>>, CalibrationError> {
        let run = |free: DVector<f64>| {
            let known = self.emulator.known(&free).map(<[f64]>::to_vec);
            let predicted = match known {
                Some(known) => Some(known),
                None => self.runs.predict(&free)?,
            };
            Ok(predicted.map(|predicted| Run {
                residuals: self.runs.standardised(&free, &predicted),
                predicted,
                free,
            }))
        };
        points.into_par_iter().map(run).collect()
    }

    fn learn(&mut self, runs: Vec<Run>) {
        self.emulator
            .learn(runs.into_iter().map(|run| (run.free, run.predicted)));
    }

    /// Whether the optimum would hardly move if the stand-in knew what the model said there. Where it has `learned` that, what is
    /// left is ripple between runs.
    fn is_settled(&self, solution: &Solution, seen: &Run, shift: f64, learned: bool) -> bool {
        let off = distance(solution, &solution.optimum.point, seen);
        let noise = self.noise(solution);
        let tolerance = self.calibration.options().tolerance;
        (learned && off <= RIPPLE * noise) || (shift <= tolerance && off <= NEAR_OPTIMUM.max(noise))
    }

    /// The model's own noise, in standard errors of all readings together.
    fn noise(&self, solution: &Solution) -> f64 {
        let optimum = &solution.optimum;
        self.runs
            .noise(&optimum.deviance.weights(&optimum.point.residuals))
    }

    /// Whether the model itself has been seen to exclude, by far, what the stand-in says is excluded by far.
    fn is_known(&self, solution: &Solution, witness: &Witness) -> bool {
        let Place::Bound(side) = witness.place else {
            return false;
        };
        self.emulator.excludes(side)
            && root(
                solution,
                &witness.point.residuals,
                &solution.optimum.point.residuals,
            ) > FAR * witness.threshold
    }

    /// Runs that the data do not exclude at bounds that they seemed to: from each such witness that is not excluded by far, the model's own
    /// other parameters are fitted.
    fn below_bounds<'w>(
        &self,
        solution: &Solution,
        at_optimum: &Run,
        witnesses: impl Iterator<Item = (&'w &'w Witness, &'w Run)>,
    ) -> Result<Vec<Run>, CalibrationError> {
        let deviance = solution.optimum.deviance;
        let search = Search {
            evaluator: self.runs,
            observer: None,
            known_noise: self.calibration.sigmas().is_some(),
            tolerance: TOLERANCE,
            loss: deviance.loss,
            dear: true,
            least_noise: self.calibration.least_noise(self.runs.sigmas),
        };
        let mut lower = Vec::new();
        for (witness, seen) in witnesses {
            let Place::Bound((k, _)) = witness.place else {
                continue;
            };
            let excluded = |residuals| root(solution, residuals, &at_optimum.residuals) >= witness.threshold;
            let decided = !excluded(&seen.residuals) || is_far(solution, at_optimum, witness, seen);
            if decided || seen.free.len() == 1 {
                continue;
            }
            let mut fixed = vec![false; seen.free.len()];
            fixed[k] = true;
            let start = Point {
                free: seen.free.clone(),
                residuals: seen.residuals.clone(),
            };
            let solver = LevenbergMarquardt::new(deviance, fixed.clone(), TOLERANCE).unverified();
            let Point { free, residuals } = search.attempt(solver, &fixed, deviance, start, DESCENT)?.point;
            if !excluded(&residuals) {
                lower.push(Run {
                    predicted: self.runs.predicted(&residuals),
                    free,
                    residuals,
                });
            }
        }
        Ok(lower)
    }

    /// Whether the model says of a witness what the stand-in says.
    fn agrees(&self, solution: &Solution, at_optimum: &Run, witness: &Witness, seen: &Run) -> bool {
        let told = root(
            solution,
            &witness.point.residuals,
            &solution.optimum.point.residuals,
        );
        let found = root(solution, &seen.residuals, &at_optimum.residuals);
        let off = (told - found).abs();
        let noise = self.noise(solution);
        let margin = (told - witness.threshold).abs();
        match witness.place {
            Place::Rival => off <= RIVAL,
            Place::End => {
                off <= (END * witness.threshold).max(noise)
                    && distance(solution, &witness.point, seen) <= NEAR_END.max(noise)
            }
            Place::Bound(_) => off <= (MARGIN * margin).max(END * witness.threshold),
        }
    }
}

/// Whether the model excludes a witness by far.
fn is_far(solution: &Solution, at_optimum: &Run, witness: &Witness, seen: &Run) -> bool {
    root(solution, &seen.residuals, &at_optimum.residuals) > FAR * witness.threshold
}

/// Root of the rise of the deviance from the optimum.
fn root(solution: &Solution, residuals: &DVector<f64>, at_optimum: &DVector<f64>) -> f64 {
    let deviance = &solution.optimum.deviance;
    (deviance.total(residuals) - deviance.total(at_optimum))
        .max(0.0)
        .sqrt()
}

/// Distance between prediction and run, in standard errors of all readings together.
fn distance(solution: &Solution, told: &Point, seen: &Run) -> f64 {
    let off = &told.residuals - &seen.residuals;
    let weights = solution.optimum.deviance.weights(&told.residuals);
    off.component_mul(&off).dot(&weights).sqrt()
}

/// How far the optimum would move, in standard errors, if the model everywhere missed the stand-in as it does there.
fn shift(solution: &Solution, seen: &DVector<f64>) -> f64 {
    let optimum = &solution.optimum;
    let off = seen - &optimum.point.residuals;
    let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
    let gradient = optimum.jacobian.tr_mul(&off.component_mul(&curvatures));
    let square = gradient.dot(&(&solution.covariance.matrix * &gradient));
    square.max(0.0).sqrt()
}
