//! From the runs of a model, or of its stand-in, to an optimum and what is known around it.

use nalgebra::DVector;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::evaluator::Evaluator;
use crate::fit::{Estimate, Fit, Interval, Warning};
use crate::parameter::FARTHEST;
use crate::profile::{Outcome, Place, ProfileInterval, Profiler, Witness};
use crate::search::{Optimum, Point, Search};
use crate::uncertainty::{Covariance, parameters_from_data, quantile};
use crate::valley::Valley;
use crate::{Calibration, CalibrationError, Loss, Parameter, Profiles};

/// Probability of residuals as large as these under the given sigmas, below which the sigmas are not believed.
const MISFIT: f64 = 0.001;
/// Correlation from which two parameters count as hardly told apart.
const CORRELATED: f64 = 0.99;
/// Standard errors from which a rival is another optimum, not a place beside this one.
const RIVALRY: f64 = 4.0;
/// Weight below which an observation counts as an outlier.
const OUTLIER: f64 = 0.35;
/// Degrees of freedom below which the user is warned.
const FEW: f64 = 5.0;
/// Distance to the minimum, in standard errors, that is worth a warning.
const ROUGH: f64 = 0.1;
/// Times that a profile may find a lower optimum before the fit gives up.
const MAX_OPTIMA: usize = 12;

/// How a solution is sought.
pub(crate) struct Route<'a> {
    /// Free variables to try first.
    pub start: Option<DVector<f64>>,
    /// Points all over the range to try.
    pub scan: usize,
    /// Whether to descend from elsewhere too.
    pub restart: bool,
    /// Which intervals are profiles.
    pub profiles: &'a Profiles,
    /// Whether runs are dear.
    pub dear: bool,
}

/// An optimum and what is known around it.
pub(crate) struct Solution {
    pub optimum: Optimum,
    pub covariance: Covariance,
    pub estimates: Vec<Estimate>,
    /// A minimum elsewhere that is hardly higher.
    pub rival: Option<Point>,
    /// What the answer rests on.
    pub witnesses: Vec<Witness>,
    /// Whether the observations' own sigmas were believed.
    known_noise: bool,
    warnings: Vec<Warning>,
}

impl Calibration<'_> {
    /// Searches the optimum and describes it.
    pub(crate) fn solve(
        &self,
        evaluator: &Evaluator<'_>,
        route: &Route<'_>,
    ) -> Result<Solution, CalibrationError> {
        let options = self.options();
        let mut search = Search {
            evaluator,
            observer: options.observer.clone(),
            known_noise: self.sigmas().is_some(),
            tolerance: options.tolerance,
            loss: options.loss,
            dear: route.dear,
            least_noise: self.least_noise(evaluator.sigmas),
        };
        let scan = search.scan(route.start.clone(), route.scan)?;
        let (mut optimum, rival) = search.best(&scan, route.restart)?;
        for _ in 0..MAX_OPTIMA {
            let misfit = self.misfit(&optimum);
            if misfit.is_some() {
                // The sigmas are not believed: only their ratios are.
                search.known_noise = false;
                optimum = search.refine(optimum.point.clone(), Some(optimum.jacobian.clone()))?;
            }
            match self.describe(&search, &optimum, rival.as_ref(), route.profiles)? {
                Described::Estimates {
                    estimates,
                    covariance,
                    mut witnesses,
                } => {
                    witnesses.extend(rival.clone().map(|point| Witness {
                        place: Place::Rival,
                        threshold: 0.0,
                        point,
                    }));
                    return Ok(Solution {
                        known_noise: search.known_noise,
                        optimum,
                        covariance,
                        estimates,
                        rival,
                        witnesses,
                        warnings: misfit.into_iter().collect(),
                    });
                }
                Described::Better(point) => {
                    search.known_noise = self.sigmas().is_some();
                    optimum = search.refine(point, None)?;
                }
            }
        }
        Err(CalibrationError::NotConverged {
            iterations: optimum.iterations,
            offset: f64::INFINITY,
        })
    }

    /// A rival that is no part of the optimum's own surroundings, where the intervals are all closed: one that is open says more.
    fn ambiguity(&self, solution: &Solution) -> Option<Warning> {
        let rival = solution.rival.as_ref()?;
        let own = |k: usize| {
            let free = solution.optimum.point.free[k];
            let reach = RIVALRY * solution.covariance.standard_error(k).unwrap_or(f64::INFINITY);
            (rival.free[k] - free).abs() <= reach
        };
        let closed = solution.estimates.iter().all(|estimate| estimate.identifiable);
        (closed && !(0..rival.free.len()).all(own)).then(|| Warning::Ambiguous {
            values: self
                .parameters()
                .iter()
                .zip(rival.free.iter())
                .map(|(parameter, &free)| parameter.value(parameter.bounded(free)))
                .collect(),
        })
    }

    /// Whether the residuals are larger than known sigmas allow. A robust loss judges its own spread.
    fn misfit(&self, optimum: &Optimum) -> Option<Warning> {
        if self.sigmas().is_none() || self.options().loss != Loss::Squares {
            return None;
        }
        let residuals = optimum.point.residuals.iter().take(optimum.deviance.data);
        let freedom = self.freedom(optimum);
        let sum: f64 = residuals.map(|r| r * r).sum();
        let probability = 1.0 - ChiSquared::new(freedom).ok()?.cdf(sum);
        // Residuals within the model's own rounding are no misfit.
        (freedom >= 1.0 && probability < MISFIT).then_some(Warning::Misfit {
            reduced_chi_square: sum / freedom,
            probability,
        })
    }

    /// Observations less the parameters that they determine.
    fn freedom(&self, optimum: &Optimum) -> f64 {
        let used = parameters_from_data(&optimum.jacobian, &optimum.deviance, &optimum.point.residuals);
        (self.observations().len() as f64 - used).max(0.0)
    }

    /// Estimates with their intervals, or a better optimum found on the way.
    fn describe(
        &self,
        search: &Search<'_>,
        optimum: &Optimum,
        rival: Option<&Point>,
        profiles: &Profiles,
    ) -> Result<Described, CalibrationError> {
        let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
        let covariance = Covariance::new(&optimum.jacobian, &curvatures);
        let degrees_of_freedom =
            (!search.known_noise || self.options().loss.is_robust()).then(|| self.freedom(optimum).max(0.5));
        let tail = 1.0 - self.options().confidence;
        let mut profiler = Profiler {
            search,
            optimum,
            covariance: &covariance,
            degrees_of_freedom,
            tail,
            rival,
            valley: Valley::new(&optimum.point.free),
            witnesses: Vec::new(),
        };
        let mut estimates = vec![None; self.parameters().len()];
        // What is known least first: along it the valley is followed best, and the others follow in its track.
        let mut order: Vec<usize> = (0..self.parameters().len()).collect();
        let error = |k: usize| covariance.standard_error(k).unwrap_or(f64::INFINITY);
        order.sort_by(|&a, &b| error(b).total_cmp(&error(a)));
        for k in order {
            let parameter = &self.parameters()[k];
            let free = optimum.point.free[k];
            let coordinate = parameter.bounded(free);
            let error = covariance
                .standard_error(k)
                .map(|error| error * parameter.bounded_slope(free));
            let wanted = match profiles {
                Profiles::All => true,
                Profiles::Of(names) => names.iter().any(|name| name == parameter.name()),
                Profiles::None => false,
            };
            let interval = if wanted {
                match profiler.interval(k)? {
                    Outcome::Interval(interval) => interval,
                    Outcome::Better(point) => return Ok(Described::Better(point)),
                }
            } else {
                let reach = error.map(|error| error * quantile(0.5 * tail, degrees_of_freedom));
                symmetric(parameter, coordinate, reach)
            };
            let value = |coordinate: f64| parameter.value(coordinate);
            let ends = Interval {
                lower: interval.lower.map(value),
                upper: interval.upper.map(value),
            };
            estimates[k] = Some(Estimate {
                name: parameter.name().to_owned(),
                value: value(coordinate),
                standard_error: error.map(|error| error * parameter.value_slope(coordinate)),
                interval: ends,
                identifiable: ends.is_closed(),
                profile: interval
                    .curve
                    .iter()
                    .filter(|(_, rise)| rise.is_finite())
                    .map(|&(s, rise)| (value(s), rise))
                    .collect(),
            });
        }
        Ok(Described::Estimates {
            estimates: estimates.into_iter().flatten().collect(),
            witnesses: profiler.witnesses,
            covariance,
        })
    }

    /// What a solution says.
    pub(crate) fn answer(&self, evaluator: &Evaluator<'_>, solution: Solution) -> Fit {
        let ambiguity = self.ambiguity(&solution);
        let Solution {
            optimum,
            covariance,
            estimates,
            known_noise,
            mut warnings,
            ..
        } = solution;
        warnings.extend(ambiguity);
        let data = self.observations().len();
        let standardised = &optimum.point.residuals;
        let residuals: Vec<f64> = standardised
            .iter()
            .zip(evaluator.sigmas)
            .map(|(r, sigma)| -r * sigma)
            .collect();
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        let mean = self.observations().iter().sum::<f64>() / data as f64;
        let variation: f64 = self.observations().iter().map(|y| (y - mean).powi(2)).sum();
        let weights: Vec<f64> = standardised
            .iter()
            .take(data)
            .map(|r| self.options().loss.weight(r / optimum.deviance.spread))
            .collect();
        let count = self.parameters().len();
        let correlation: Vec<Vec<Option<f64>>> = (0..count)
            .map(|i| (0..count).map(|j| covariance.correlation(i, j)).collect())
            .collect();
        let degrees_of_freedom = self.freedom(&optimum);
        let noise_estimated = !known_noise || self.options().loss.is_robust();
        for (k, estimate) in estimates.iter().enumerate() {
            if !estimate.identifiable {
                warnings.push(Warning::NotIdentifiable {
                    name: estimate.name.clone(),
                    interval: estimate.interval,
                });
            } else if optimum.point.free[k].abs() >= FARTHEST {
                warnings.push(Warning::AtBound {
                    name: estimate.name.clone(),
                    value: estimate.value,
                });
            }
            for (other, correlation) in estimates.iter().zip(&correlation[k]).take(k) {
                if let Some(correlation) = correlation.filter(|c| c.abs() > CORRELATED) {
                    warnings.push(Warning::Correlated {
                        first: other.name.clone(),
                        second: estimate.name.clone(),
                        correlation,
                    });
                }
            }
        }
        let indices: Vec<usize> = (0..data).filter(|&i| weights[i] < OUTLIER).collect();
        if !indices.is_empty() {
            warnings.push(Warning::Outliers { indices });
        }
        if optimum.offset > ROUGH {
            warnings.push(Warning::Rough {
                offset: optimum.offset,
            });
        }
        if noise_estimated && degrees_of_freedom < FEW {
            warnings.push(Warning::FewObservations { degrees_of_freedom });
        }
        Fit {
            estimates,
            correlation,
            fitted: self
                .observations()
                .iter()
                .zip(&residuals)
                .map(|(y, r)| y - r)
                .collect(),
            residual_rms: (square / data as f64).sqrt(),
            r_squared: (variation > 0.0).then(|| 1.0 - square / variation),
            residuals,
            weights,
            noise: if noise_estimated {
                optimum.deviance.noise(standardised)
            } else {
                1.0
            },
            degrees_of_freedom,
            noise_estimated,
            deviance: optimum.value(),
            evaluations: evaluator.count(),
            iterations: optimum.iterations,
            warnings,
            free: optimum.point.free.iter().copied().collect(),
            jacobian: optimum.jacobian.clone(),
            curvatures: optimum
                .deviance
                .curvatures(standardised)
                .iter()
                .zip(evaluator.sigmas)
                .map(|(curvature, sigma)| curvature / sigma)
                .collect(),
            covariance: covariance.matrix.clone(),
        }
    }
}

enum Described {
    Estimates {
        estimates: Vec<Estimate>,
        covariance: Covariance,
        witnesses: Vec<Witness>,
    },
    Better(Point),
}

/// The interval of so many standard errors to either side; open where it would leave the bounds.
fn symmetric(parameter: &Parameter, coordinate: f64, reach: Option<f64>) -> ProfileInterval {
    let [lowest, highest] = [-FARTHEST, FARTHEST].map(|free| parameter.bounded(free));
    let end = |sign: f64| {
        reach
            .map(|reach| coordinate + sign * reach)
            .filter(|end| (lowest..=highest).contains(end))
    };
    ProfileInterval {
        lower: end(-1.0),
        upper: end(1.0),
        curve: Vec::new(),
    }
}
