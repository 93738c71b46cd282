//! The way to the optimum: a coarse scan, a descent from its best point, and another descent from elsewhere to compare.

use nalgebra::{DMatrix, DVector};

use crate::descent::{Descent, NOISY, Optimum};
use crate::deviance::Deviance;
use crate::evaluator::{Evaluator, feasible};
use crate::loss::Rho;
use crate::point::{Point, all_over, score};
use crate::uncertainty::parameters_from_data;
use crate::{CalibrationError, Loss};

/// Repeats after which a loop is taken to go in a circle: those that end need half as many.
pub(crate) const MAX_ROUNDS: usize = 24;
/// Iterations of a descent to the optimum, and of one that is only compared with it: with 6 instead of 12, direct fits take 145 runs
/// instead of 165, and one end in a hundred is off by its interval's width (tests/calibration_coverage.rs, 2400 fits).
const ITERATIONS: u64 = 200;
const FEW_ITERATIONS: u64 = 12;
/// Next step in standard errors at which a descent that is only compared has converged, and above which the user is warned. With 0.35,
/// a direct fit takes 10 runs less and one end in a hundred moves by a sixth of its interval (the same fits).
pub(crate) const ROUGH: f64 = 0.1;
/// Change of the noise's scale, as a share, at which the rounds of fit and scale end: far below what 40 readings know of it.
const SCALE_TOLERANCE: f64 = 0.01;
/// Fall of the deviance that makes another optimum the better one: a quarter of a standard error.
pub(crate) const BETTER: f64 = 0.05;
/// Rise of the deviance up to which another minimum counts as a rival: two standard errors.
pub(crate) const RIVAL: f64 = 4.0;
/// Distance from an optimum, in free variables, of a start worth a second descent: a sixth of a range from its middle.
const ELSEWHERE: f64 = 0.7;
/// Descents from elsewhere; the tests' models have two minima, and a wave as many as the scan shows.
const RESTARTS: usize = 3;

pub(crate) struct Search<'a> {
    pub evaluator: &'a Evaluator<'a>,
    /// Whether the observations came with sigmas that are believed.
    pub known_noise: bool,
}

impl<'a> Search<'a> {
    pub fn new(evaluator: &'a Evaluator<'a>) -> Self {
        Self {
            evaluator,
            known_noise: evaluator.calibration.knows_noise,
        }
    }

    /// A descent of all parameters, as exact as the fit is asked to be.
    pub fn descent(&self, deviance: Deviance, jacobian: Option<DMatrix<f64>>) -> Descent<'_> {
        Descent {
            evaluator: self.evaluator,
            deviance,
            held: None,
            jacobian,
            verified: true,
            tolerance: self.evaluator.calibration.options.tolerance,
            iterations: ITERATIONS,
        }
    }

    /// A descent that is only compared with an optimum, whose deviance it takes; parameter `held` stays where it is.
    pub fn brief_descent(
        &self,
        deviance: Deviance,
        jacobian: Option<DMatrix<f64>>,
        held: Option<usize>,
    ) -> Descent<'_> {
        Descent {
            held,
            verified: false,
            tolerance: ROUGH,
            iterations: FEW_ITERATIONS,
            ..self.descent(deviance, jacobian)
        }
    }

    /// Scale of the noise at a point: known, or from the residuals there.
    fn scaled(&self, deviance: Deviance, residuals: &DVector<f64>, freedom: f64) -> Deviance {
        let calibration = self.evaluator.calibration;
        let (robust, least) = (
            calibration.options.loss.rho().is_robust(),
            calibration.least_noise(),
        );
        let spread = match (robust, self.known_noise) {
            (false, true) => return deviance,
            (true, false) => deviance.with_median_spread(residuals, freedom, least),
            _ => deviance,
        };
        spread.normalised(residuals, freedom, least)
    }

    /// Descends from `start`, adapting the scale of the noise. Tukey's loss is not convex: Huber's leads to it.
    pub fn refine(&self, start: Point, jacobian: Option<DMatrix<f64>>) -> Result<Optimum, CalibrationError> {
        match self.evaluator.calibration.options.loss {
            loss @ Loss::Tukey { .. } => {
                let near = self.refine_with(Rho::Huber, start, jacobian)?;
                self.refine_with(loss.rho(), near.point, Some(near.jacobian))
            }
            loss @ Loss::Squares => self.refine_with(loss.rho(), start, jacobian),
        }
    }

    fn refine_with(
        &self,
        loss: Rho,
        start: Point,
        mut jacobian: Option<DMatrix<f64>>,
    ) -> Result<Optimum, CalibrationError> {
        let calibration = self.evaluator.calibration;
        let data = calibration.observations.len();
        let freedom = (data as f64 - calibration.parameters.len() as f64).max(1.0);
        let first = Deviance {
            loss,
            data,
            spread: 1.0,
            normalisation: 1.0,
        };
        let mut deviance = self.scaled(first, &start.residuals, freedom);
        let mut point = start;
        let mut iterations = 0;
        for round in 0..MAX_ROUNDS {
            let mut optimum = self.descent(deviance, jacobian).run(point)?;
            iterations += optimum.iterations;
            optimum.iterations = iterations;
            if !optimum.converged && optimum.offset >= NOISY {
                let offset = optimum.offset;
                return Err(CalibrationError::NotConverged { iterations, offset });
            }
            let freedom = (data as f64 - parameters_from_data(&optimum)).max(0.5);
            let mut next = self.scaled(deviance, &optimum.point.residuals, freedom);
            let change = |new: f64, old: f64| (new / old).ln().abs();
            let moved = change(next.spread, deviance.spread);
            // κ jumps as a residual crosses the loss's threshold, and only weighs data against priors.
            let weighed = change(next.normalisation, deviance.normalisation);
            if moved < SCALE_TOLERANCE && weighed < 10.0 * SCALE_TOLERANCE {
                optimum.deviance = next;
                return Ok(optimum);
            }
            if round > 1 {
                // Half of a change, so that the rounds cannot go in a circle.
                next.spread = (next.spread * deviance.spread).sqrt();
            }
            deviance = next;
            point = optimum.point;
            jacobian = Some(optimum.jacobian);
        }
        Err(CalibrationError::NotConverged {
            iterations,
            offset: f64::INFINITY,
        })
    }

    /// Points all over the range, the best first; before them the start, if there is one.
    pub fn scan(&self, start: Option<DVector<f64>>, count: usize) -> Result<Vec<Point>, CalibrationError> {
        let mut places: Vec<DVector<f64>> = start.into_iter().collect();
        // Of several minima that are as good, the one next to the start is wanted.
        let started = places.len();
        let calibration = self.evaluator.calibration;
        places.extend(all_over(calibration.parameters.len(), count));
        let mut points = self.evaluator.points_with_terms(places, None)?;
        let data = calibration.observations.len();
        let score = |point: &Point| score(&point.residuals, data, self.known_noise);
        points[started..].sort_by(|a, b| score(a).total_cmp(&score(b)));
        points.retain(|point| feasible(&point.residuals));
        Ok(points)
    }

    /// Descends from the first point of `scan`, and from the best of the others to see whether they lead lower.
    ///
    /// The second answer is a minimum elsewhere that is hardly higher.
    pub fn best(&self, scan: &[Point]) -> Result<(Optimum, Option<Point>), CalibrationError> {
        let mut found = Err(CalibrationError::NoFeasibleStart {
            starts: self.evaluator.count(),
            source: self.evaluator.last_failure(),
        });
        for (index, point) in scan.iter().take(1 + RESTARTS).enumerate() {
            let descended = self.refine(point.clone(), None);
            match descended {
                Err(error) if error.is_final() => return Err(error),
                // Of several failures the first is reported.
                Err(_) if index > 0 => {}
                other => found = other,
            }
            if found.is_ok() {
                break;
            }
        }
        let mut optimum = found?;
        for _ in 0..RESTARTS {
            match self.descend_elsewhere(scan, &optimum)? {
                Some(other) if other.value() < optimum.value() - BETTER => {
                    optimum = self.refine(other.point, None)?;
                }
                other => return Ok((optimum, other.map(|other| other.point))),
            }
        }
        Ok((optimum, None))
    }

    /// A minimum elsewhere that is lower than `optimum` or hardly higher, if a descent from the best point far from it leads to one.
    fn descend_elsewhere(
        &self,
        scan: &[Point],
        optimum: &Optimum,
    ) -> Result<Option<Optimum>, CalibrationError> {
        let far = |point: &Point| (&point.free - &optimum.point.free).amax() > ELSEWHERE;
        let Some(start) = scan.iter().skip(1).find(|point| far(point)) else {
            return Ok(None);
        };
        let descent = self.brief_descent(optimum.deviance, None, None);
        match descent.run(start.clone()) {
            Ok(other) if other.value() < optimum.value() - BETTER => Ok(Some(other)),
            Ok(other) if other.value() < optimum.value() + RIVAL && far(&other.point) => Ok(Some(other)),
            Err(error) if error.is_final() => Err(error),
            Ok(_) | Err(_) => Ok(None),
        }
    }
}
