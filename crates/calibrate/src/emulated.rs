//! A fit by an emulator of the model.
//!
//! The search runs on an [`Emulator`], where a run costs microseconds; the model itself runs where the answer rests: at the optimum, at
//! the ends of the intervals, at the bounds that they leave out. What it says there is learned, and the search repeated, until the two
//! agree at all of these places to the accuracy that is asked of a fit (D. R. Jones, M. Schonlau, W. J. Welch, "Efficient Global
//! Optimization of Expensive Black-Box Functions", Journal of Global Optimization 13, 1998, for the idea). A model that the
//! emulator cannot follow, because it has corners without an answer or jumps, is fitted directly.

use nalgebra::DVector;
use rayon::prelude::*;

use crate::deviance::information;
use crate::elsewhere;
use crate::emulator::{Doubt, least_sure};
use crate::evaluator::Evaluator;
use crate::interval::{ACCURACY, EXCLUSION, Witness};
use crate::point::{Point, all_over, score};
use crate::search::MAX_ROUNDS;
use crate::solution::{Route, Solution};
use crate::{Calibration, CalibrationError, Emulator, Fit, Part, Profiles};

/// Points of the emulator that are scanned for each parameter and one more, and for each of the others along a profile.
const SCAN: usize = 64;
/// Runs of a coarser model that are repeated, beside the best, for each parameter: they show how its error changes with it.
const ANCHORS: usize = 2;
/// Distance between prediction and run at an end, in standard errors of all readings together. Without a limit, five of 2400 fits took
/// fewer runs than they needed, and lost the truth (tests/calibration_coverage.rs).
const FOLLOWED: f64 = 0.5;
/// Deviance by which a prediction may be off at an optimum: a third of a standard error.
const TOLD: f64 = 0.1;
/// Standard error of the readings by the emulator of a difference to a coarser model, in those of all readings together, up to which it is
/// believed without a run. Runs were off by up to twice as much, which moves the end of an interval by less than its accuracy.
const SURE: f64 = 0.15;
/// Distance between optima, in free variables, at which other places might be hidden from each.
const MOVED: f64 = 0.1;
/// Distance between ends of intervals, in standard errors of all parameters together, at which a finer model is asked at both.
const NEAR: f64 = 0.5;
/// Distance, in the model's own noise, that an optimum may be off where the model has run: three standard deviations.
const RIPPLE: f64 = 3.0;

impl Calibration<'_> {
    /// Fits a model that is expensive to run, as [`fit`](Self::fit) does. A smooth one takes a small part of the runs; one that the
    /// emulator cannot follow takes those of a direct fit on top of those that were in vain.
    ///
    /// The emulator is searched all over: [`Options::scan`](crate::Options::scan) only says how many runs it
    /// first learns from. The model confirms the optimum, the ends of the intervals and the excluded bounds.
    /// Where three and more parameters are hardly known, an end may be a tenth of its distance off from that
    /// of a direct fit.
    ///
    /// ```
    /// use calibrate::{Calibration, ModelError, Parameter, Scale};
    ///
    /// let passes = [5.0, 10.0, 20.0, 40.0, 80.0];
    /// let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
    ///     Ok(passes.iter().map(|n: &f64| p[0] * (1.0 - (-n / p[1]).exp())).collect())
    /// };
    /// let parameters = vec![
    ///     Parameter::new("saturated_force", 100.0, 2000.0, Scale::Logarithmic)?,
    ///     Parameter::new("passes", 1.0, 1000.0, Scale::Logarithmic)?,
    /// ];
    /// let calibration = Calibration::new(&model, parameters, vec![124.0, 214.0, 351.0, 472.0, 541.0])?;
    /// let (fit, emulator) = calibration.fit_emulated(None)?;
    /// assert!(fit.estimates[0].interval.contains(550.0));
    /// // What was learned spares runs where the model becomes finer.
    /// let (again, _) = calibration.fit_emulated(Some(&emulator))?;
    /// assert!(again.evaluations < fit.evaluations);
    /// # Ok::<(), calibrate::CalibrationError>(())
    /// ```
    ///
    /// `coarse` is what an earlier fit of the same parameters and observations with a coarser model learned; the emulator of
    /// this one is the second answer.
    ///
    /// # Errors
    ///
    /// As for [`fit`](Self::fit), and [`CalibrationError::InvalidOption`] for a `coarse` of other parameters or observations.
    pub fn fit_emulated(&self, coarse: Option<&Emulator>) -> Result<(Fit, Emulator), CalibrationError> {
        self.check_count()?;
        let parts = self.parts()?;
        // One that could not follow its model has nothing to teach.
        let coarse = coarse.filter(|coarse| coarse.runs() > 0);
        if coarse.is_some_and(|coarse| !coarse.is_of(&self.parameters, &parts)) {
            return Err(CalibrationError::InvalidOption {
                name: "coarse emulator's parameters",
                value: self.parameters.len() as f64,
                allowed: "those of this calibration, and its observations",
            });
        }
        self.beside_discrepancy(|one, known| one.emulate(&parts, coarse, known))
    }

    /// The fit by an emulator that may have learned before.
    fn emulate(
        &self,
        parts: &[Part],
        coarse: Option<&Emulator>,
        known: Option<Emulator>,
    ) -> Result<(Fit, Emulator), CalibrationError> {
        let runs = Evaluator::new(self);
        let (dimensions, observations) = (self.parameters.len(), self.observations.len());
        let mut emulation = Emulation {
            calibration: self,
            emulator: known.unwrap_or_else(|| Emulator::new(&self.parameters, parts.to_vec(), coarse)),
            runs: &runs,
        };
        let start = self.start();
        let mut design: Vec<DVector<f64>> = start.clone().into_iter().collect();
        let of_model = self.of_model();
        let terms: Vec<usize> = (0..dimensions).filter(|k| !of_model.contains(k)).collect();
        let embedding = emulation.emulator.clone();
        let all = |of_model: DVector<f64>| embedding.with_terms(&of_model, dimensions);
        let score = |of_model: &DVector<f64>, predicted: &[f64]| {
            let point = runs.fitted_terms(all(of_model.clone()), predicted, &terms);
            score(&point.residuals, observations, self.knows_noise)
        };
        let places = match coarse {
            // Where intervals of the coarse model end, what it misses matters most.
            Some(coarse) if !coarse.ends.is_empty() => coarse.ends.clone(),
            // Along the whole valley.
            Some(coarse) => coarse.low_points(score, (2.0 * EXCLUSION).powi(2), ANCHORS * of_model.len()),
            None => all_over(of_model.len(), self.scan()),
        };
        design.extend(places.into_iter().map(all));
        // The best of a coarse model is often the start itself.
        let twice = |place: usize| {
            design[..place]
                .iter()
                .any(|other| (other - &design[place]).amax() < 1e-9)
        };
        let design = (0..design.len())
            .filter(|&place| !twice(place))
            .map(|place| design[place].clone())
            .collect();
        let fit = if let Some(solution) = emulation.converge(design, start)? {
            self.answer(&runs, solution)
        } else {
            let best = emulation.emulator.low_points(score, 0.0, 0);
            // After runs in vain, the best of which is where to begin.
            self.fit_directly(&runs, best.into_iter().next().map(all).or_else(|| self.start()))?
        };
        Ok((fit, emulation.emulator))
    }
}

/// An emulator and the model that it learns from.
struct Emulation<'a> {
    calibration: &'a Calibration<'a>,
    runs: &'a Evaluator<'a>,
    emulator: Emulator,
}

/// A point at which the model ran.
struct Run {
    point: Point,
    predicted: Vec<f64>,
}

impl Emulation<'_> {
    /// A solution at whose witnesses the model agrees; nothing where the emulator does not come to one.
    fn converge(
        &mut self,
        design: Vec<DVector<f64>>,
        mut start: Option<DVector<f64>>,
    ) -> Result<Option<Solution>, CalibrationError> {
        let wanted = self.calibration.options.profiles;
        // Intervals are worth a look around an optimum that holds, or that a coarser model gave.
        let mut profiles = if self.emulator.coarse.is_some() {
            wanted
        } else {
            Profiles::None
        };
        let Some(first) = self.run(design)? else {
            return Ok(None);
        };
        self.learn(first);
        let mut checked: Option<DVector<f64>> = None;
        for _ in 0..MAX_ROUNDS {
            let Some(mut solution) = self.solve(start.take(), profiles) else {
                return Ok(None);
            };
            let optimum = solution.optimum.point.free.clone();
            let learned = self.emulator.known(&optimum).is_some();
            let witnesses = self.doubtful(&solution);
            let mut places = vec![optimum.clone()];
            places.extend(witnesses.iter().map(|witness| witness.point.free.clone()));
            let Some(seen) = self.run(places)? else {
                return Ok(None);
            };
            let shift = solution.shift(&seen[0].point);
            let settled = self.is_settled(&solution, &seen[0], shift, learned);
            let mut agreed = settled;
            for (witness, run) in witnesses.iter().zip(&seen[1..]) {
                let found = solution.root(&run.point, &seen[0].point);
                agreed &= self.agrees(&solution, witness, found) && self.is_followed(&solution, witness, run);
                if let (Some(bound), true) = (witness.bound, settled && found > EXCLUSION * witness.threshold)
                {
                    self.emulator.excluded.push(bound);
                }
            }
            let found = agreed && profiles == wanted;
            let moved = |before: &DVector<f64>| (before - &optimum).amax() > MOVED;
            let hidden = if found && checked.as_ref().is_none_or(moved) {
                checked = Some(optimum.clone());
                self.hidden(&solution)?
            } else {
                Vec::new()
            };
            if found && hidden.is_empty() {
                solution.optimum.point.residuals = seen[0].point.residuals.clone();
                solution.optimum.offset = solution.optimum.offset.max(shift);
                self.emulator.ends = self.ends(&solution);
                self.learn(seen);
                return Ok(Some(solution));
            }
            start = Some(optimum);
            let runs = self.emulator.runs();
            self.learn(seen);
            match self.run(hidden)? {
                Some(seen) => self.learn(seen),
                None => return Ok(None),
            }
            if self.emulator.runs() == runs && (profiles == wanted || !settled) {
                // It knows all that it asks for and still says otherwise.
                return Ok(None);
            }
            if settled {
                profiles = wanted;
            }
        }
        Ok(None)
    }

    /// Searches on the emulator; nothing where that fails.
    fn solve(&self, start: Option<DVector<f64>>, profiles: Profiles) -> Option<Solution> {
        let route = Route {
            start,
            scan: SCAN * (1 + self.calibration.parameters.len()),
            profiles,
            scan_others: SCAN,
        };
        let emulator = Evaluator::emulated(self.calibration, &self.emulator);
        self.calibration.solve(&emulator, &route).ok()
    }

    /// Runs the model where it has not run yet; nothing if it has no answer somewhere.
    fn run(&self, places: Vec<DVector<f64>>) -> Result<Option<Vec<Run>>, CalibrationError> {
        let run = |free: DVector<f64>| {
            let known = self.emulator.known(&free).map(<[f64]>::to_vec);
            let predicted = match known {
                Some(known) => Some(known),
                None => self.runs.predict(&free)?,
            };
            Ok(predicted.map(|predicted| Run {
                point: Point {
                    residuals: self.runs.standardised(&free, &predicted),
                    free,
                },
                predicted,
            }))
        };
        places.into_par_iter().map(run).collect()
    }

    fn learn(&mut self, runs: Vec<Run>) {
        self.emulator
            .learn(runs.into_iter().map(|run| (run.point.free, run.predicted)));
    }

    /// Whether the optimum would hardly move if the emulator knew what the model said there, and predicts it: where readings are out of
    /// reach, the sensitivities that tell a move vanish. Where it has `learned` that, what is left is ripple between runs.
    fn is_settled(&self, solution: &Solution, seen: &Run, shift: f64, learned: bool) -> bool {
        let off = solution.distance(&solution.optimum.point, &seen.point);
        let noise = self.noise(solution);
        let tolerance = self.calibration.options.tolerance;
        let deviance = |point: &Point| solution.optimum.deviance.total(&point.residuals);
        let expected = deviance(&solution.optimum.point);
        let is_told = (deviance(&seen.point) - expected).abs() <= TOLD.max(noise);
        (shift <= tolerance && is_told) || (learned && off <= RIPPLE * noise)
    }

    /// Whether the emulator predicts the readings at the end of an interval; at a bound and at a rival only the rise counts.
    fn is_followed(&self, solution: &Solution, witness: &Witness, seen: &Run) -> bool {
        let off = solution.distance(&witness.point, &seen.point);
        witness.bound.is_some() || off <= FOLLOWED.max(self.noise(solution))
    }

    /// The model's own noise, in standard errors of all readings together.
    fn noise(&self, solution: &Solution) -> f64 {
        let optimum = &solution.optimum;
        self.runs
            .noise(&optimum.deviance.weights(&optimum.point.residuals))
    }

    /// Whether the witness stands at a bound that the model itself, or a coarser one, was seen to exclude by far, as the emulator says.
    fn is_excluded(&self, solution: &Solution, witness: &Witness) -> bool {
        let rise = solution.root(&witness.point, &solution.optimum.point);
        witness
            .bound
            .is_some_and(|bound| self.emulator.excluded.contains(&bound))
            && rise > EXCLUSION * witness.threshold
    }

    /// The witnesses that the model is asked about: the one of which the emulator is least sure, then what that leaves, until none is doubtful.
    fn doubtful<'s>(&self, solution: &'s Solution) -> Vec<&'s Witness> {
        let left = solution.witnesses.iter();
        let mut left: Vec<&Witness> = left
            .filter(|witness| !self.is_excluded(solution, witness))
            .collect();
        // The coarsest model is asked wherever an answer rests on it.
        let Some(mut doubt) = self.doubt(solution).filter(|_| self.emulator.coarse.is_some()) else {
            return left;
        };
        let place = |witness: &Witness| self.emulator.place(&witness.point.free);
        doubt.without(&self.emulator.place(&solution.optimum.point.free));
        let mut asked = Vec::new();
        loop {
            let size = |witness: &&Witness| doubt.at(&place(witness)) / self.allowed(solution, witness);
            let sizes: Vec<f64> = left.iter().map(size).collect();
            let Some(most) = least_sure(&sizes) else {
                return asked;
            };
            let witness = left.swap_remove(most);
            doubt.without(&place(witness));
            asked.push(witness);
        }
    }

    /// Standard error of an emulator at a witness up to which it is believed.
    fn allowed(&self, solution: &Solution, witness: &Witness) -> f64 {
        let rise = solution.root(&witness.point, &solution.optimum.point);
        let sure = match witness.bound {
            // Half of what would make it another answer, for two standard errors.
            Some(_) => SURE.max(0.25 * (rise - witness.threshold).abs()),
            None => SURE,
        };
        sure.max(0.5 * self.calibration.options.tolerance)
    }

    /// Where the model might fit as well, for all that the emulator knows. All finer models rest on the coarsest.
    fn hidden(&self, solution: &Solution) -> Result<Vec<DVector<f64>>, CalibrationError> {
        let Some(doubt) = self.doubt(solution).filter(|_| self.emulator.coarse.is_none()) else {
            return Ok(Vec::new());
        };
        let evaluator = Evaluator::emulated(self.calibration, &self.emulator);
        let least = FOLLOWED.max(self.noise(solution));
        elsewhere::places(&evaluator, &self.emulator, &solution.optimum, doubt, least)
    }

    /// The emulator's own error, in standard errors of all readings together.
    fn doubt(&self, solution: &Solution) -> Option<Doubt> {
        let optimum = &solution.optimum;
        let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
        self.emulator
            .doubt(|k| curvatures[k] / self.calibration.sigmas[k].powi(2))
    }

    /// Where a finer model is asked beside the optimum: at the ends of intervals, each at some distance from the others.
    fn ends(&self, solution: &Solution) -> Vec<DVector<f64>> {
        let optimum = &solution.optimum;
        let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
        let information = information(&optimum.jacobian, &curvatures);
        let length = |change: &DVector<f64>| change.dot(&(&information * change)).max(0.0).sqrt();
        let mut ends: Vec<&DVector<f64>> = Vec::new();
        for witness in solution
            .witnesses
            .iter()
            .filter(|witness| witness.bound.is_none())
        {
            let free = &witness.point.free;
            if ends.iter().all(|other| length(&(*other - free)) >= NEAR) {
                ends.push(free);
            }
        }
        ends.into_iter()
            .map(|free| self.emulator.of_model(free))
            .collect()
    }

    /// Whether the model found a root of the rise at a witness that means what the emulator's does.
    fn agrees(&self, solution: &Solution, witness: &Witness, found: f64) -> bool {
        let expected = solution.root(&witness.point, &solution.optimum.point);
        // Half of what would make it another answer.
        let margin = 0.5 * (expected - witness.threshold).abs();
        let accuracy = (ACCURACY * witness.threshold).max(self.noise(solution));
        (expected - found).abs() <= margin.max(accuracy)
    }
}
