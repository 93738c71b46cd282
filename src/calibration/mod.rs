//! Friction and ground from what a load cell measured.
//!
//! *Problem.* Force on a held end after known passes is given; μ_d, b and the ground's stiffness are asked, with what is sure
//! about them. The crate `calibrate` does the statistics; here scenes become its model.
//!
//! *Mesh.* A fit is repeated on ever finer fixed meshes until the difference to the next one moves no parameter by more than
//! 0.8 standard errors. The answer is a fit on that next one; half of the difference is stated as the error left. On the finest mesh, or one
//! that the scene names, the difference is added to the predictions instead.
//!
//! *Runs.* An emulator learns the forces on each mesh, from what it knows of the coarser one and few runs (`calibrate::Emulator`).
//!
//! *Load cell.* At the downstream end if that is held, else at the upstream end; the force after the vehicle has left.
//!
//! *Assumptions.* The cable was at rest before the first pass, and the noise of the readings is independent. What
//! the model leaves out (the spread of wheels, heat, bends) is not in the intervals.

mod model;
mod result;
mod unknown;
mod watch;

use ::calibrate::{Bootstrap, Calibration, Emulator, Fit, Model, Options, Prior, Profiles};

pub use ::calibrate::{BootstrapOptions, CalibrationError, DataError, Loss, Reading, Readings};
pub use result::{
    BootstrapSummary, Calibrated, FitMethod, FittedParameter, FittedReading, ModelErrorEstimate, ProfilePoint,
};
pub use unknown::{Quantity, Unknown, UnknownQuantity};

use crate::plan::PassMethod;
use crate::scene::FrictionLaw;
use crate::{Error, Progress, Scene};
pub(crate) use model::CellEnd;
use model::{CableModel, SeriesModel};
use watch::Watch;

/// Shift of a parameter by the mesh, in standard errors, above which a finer one is taken.
const MESH_SHIFT: f64 = 0.8;
/// Distance to the minimum, in standard errors, at which a fit is good enough to look at its mesh, and in the end.
const PILOT_TOLERANCE: f64 = 0.3;
const TOLERANCE: f64 = 0.03;
/// Rungs of the ladder of meshes: 6, 12 and 24 nodes per depth, corrected by 48.
const LAST_RUNG: u32 = 2;
/// Ripple of the forces as parameters change on a fixed mesh, as a share of them: as a node more slips, their slope jumps.
/// Measured on the full-scale scenes; from the coarsest rung up.
const RIPPLE: [f64; 3] = [3e-4, 1e-4, 3e-5];
/// The same of the pass law, whose steps adapt.
const LAW_RIPPLE: f64 = 1e-4;

/// A scene and what was measured in it.
#[derive(Debug, Clone, Copy)]
pub struct Series<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Readings of its load cell.
    pub readings: &'a Readings,
}

/// A measured deflection: how far the duct went down under the first vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deflection {
    /// Measured peak \[m\].
    pub value: f64,
    /// Its standard deviation \[m\].
    pub sigma: f64,
}

/// How to calibrate.
#[derive(Debug, Clone, Default)]
pub struct CalibrateOptions<'a> {
    /// What to fit; if empty, the dynamic coefficient and, but for Coulomb's law, the shape factor.
    pub unknowns: Vec<Unknown>,
    /// Prior knowledge of the ground's stiffness, which is then fitted as well.
    pub deflection: Option<Deflection>,
    /// How much residuals count.
    pub loss: Loss,
    /// Refits to data drawn anew.
    pub bootstrap: Option<BootstrapOptions>,
    /// Most model runs without those of the bootstrap; 0 takes 2000.
    pub max_evaluations: usize,
    /// Called after each model run with its share of all that are allowed; it may stop the calibration.
    pub progress: Progress<'a>,
}

/// Calibrates one scene.
///
/// # Errors
///
/// [`Error`] when scene, readings and options do not fit together, there are too few readings, a run fails, or the fit does
/// not converge.
pub fn calibrate(
    scene: &Scene,
    readings: &Readings,
    options: &CalibrateOptions<'_>,
) -> Result<Calibrated, Error> {
    calibrate_jointly(&[Series { scene, readings }], options)
}

/// Calibrates several scenes together, which share what an [`Unknown`] says they share.
///
/// # Errors
///
/// As for [`calibrate()`].
pub fn calibrate_jointly(series: &[Series<'_>], options: &CalibrateOptions<'_>) -> Result<Calibrated, Error> {
    let unknowns = unknowns(series, options)?;
    if let [only] = series {
        let free = unknowns.len() - usize::from(options.deflection.is_some());
        let needed = match only.readings.sigmas() {
            Some(_) => free.max(1),
            None => (free + 1).max(2),
        };
        only.readings.check_count(unknowns.len(), needed)?;
    }
    let models = series
        .iter()
        .map(SeriesModel::new)
        .collect::<Result<Vec<_>, _>>()?;
    let limit = match options.max_evaluations {
        0 => Options::default().max_evaluations,
        limit => limit,
    };
    let ladder = Ladder {
        watch: Watch::new(options.progress, limit),
        series,
        models: &models,
        unknowns: &unknowns,
        options,
        limit,
    };
    let answer = ladder.climb();
    if ladder.watch.is_stopped() {
        return Err(Error::Stopped);
    }
    answer
}

/// What is fitted, checked against the scenes.
fn unknowns(series: &[Series<'_>], options: &CalibrateOptions<'_>) -> Result<Vec<Unknown>, Error> {
    if series.is_empty() {
        return Err(Error::Unfit {
            key: "series",
            found: "none",
            reason: "there is nothing to fit".into(),
        });
    }
    let mut unknowns = options.unknowns.clone();
    let coulomb = |unknown: &Unknown| {
        series
            .iter()
            .enumerate()
            .any(|(index, one)| unknown.acts_on(index) && one.scene.friction.law == FrictionLaw::Coulomb)
    };
    if unknowns.is_empty() {
        unknowns.push(Unknown::shared(Quantity::DynamicCoefficient));
        let shape_factor = Unknown::shared(Quantity::ShapeFactor);
        if !coulomb(&shape_factor) {
            unknowns.push(shape_factor);
        }
    }
    let ground = Unknown::shared(Quantity::GroundStiffness);
    if options.deflection.is_some() && !unknowns.contains(&ground) {
        unknowns.push(ground);
    }
    if unknowns
        .iter()
        .any(|unknown| unknown.quantity == Quantity::ShapeFactor && coulomb(unknown))
    {
        return Err(Error::Unfit {
            key: "friction.law",
            found: "coulomb",
            reason: "it has no shape factor to be fitted".into(),
        });
    }
    if unknowns
        .iter()
        .any(|unknown| unknown.series.is_some_and(|index| index >= series.len()))
    {
        return Err(Error::Unfit {
            key: "unknowns",
            found: "a series of a higher index than there are",
            reason: "series are counted from 0".into(),
        });
    }
    Ok(unknowns)
}

/// Fits on ever finer meshes.
struct Ladder<'a> {
    series: &'a [Series<'a>],
    models: &'a [SeriesModel],
    unknowns: &'a [Unknown],
    options: &'a CalibrateOptions<'a>,
    limit: usize,
    watch: Watch<'a>,
}

/// The rung of the final fit.
struct Rung {
    level: u32,
    /// Where a fit on this rung or the one below led.
    values: Vec<f64>,
    /// What the finer mesh of the last two that were compared says more there, and how many standard errors that moves each parameter.
    difference: Vec<f64>,
    shift: Vec<f64>,
    /// Whether that is still to be added.
    corrected: bool,
    /// What was learned of the forces on the last rung that was fitted.
    emulator: Emulator,
}

impl Ladder<'_> {
    fn climb(&self) -> Result<Calibrated, Error> {
        let mut evaluations = 0;
        let rung = self.find_rung(&mut evaluations)?;
        let model = self.model(rung.level, rung.corrected.then(|| rung.difference.clone()));
        let calibration = self.calibration(
            &model,
            Some(rung.values.clone()),
            Profiles::All,
            TOLERANCE,
            evaluations,
        )?;
        let (fit, _) = self.fit(&calibration, Some(&rung.emulator))?;
        evaluations += fit.evaluations;
        let bootstrap = match &self.options.bootstrap {
            Some(options) => Some(summary(&calibration.bootstrap(&fit, options)?, options)),
            None => None,
        };
        self.answer(&fit, &rung, evaluations, bootstrap)
    }

    /// The coarsest rung that moves the parameters hardly away from those of the rung below.
    fn find_rung(&self, evaluations: &mut usize) -> Result<Rung, Error> {
        let mut rung = 0;
        let mut start = None;
        let mut coarser: Option<Emulator> = None;
        loop {
            let model = self.model(rung, None);
            // What is learned on the coarsest mesh costs least: there the intervals are explored too.
            let profiles = if rung == 0 { Profiles::All } else { Profiles::None };
            let calibration = self.calibration(&model, start, profiles, PILOT_TOLERANCE, *evaluations)?;
            let (fit, emulator) = self.fit(&calibration, coarser.as_ref())?;
            let values = fit.values();
            let finer = self
                .model(rung + 1, None)
                .predict(&values)
                .map_err(|source| CalibrationError::NoFeasibleStart { starts: 1, source })?;
            *evaluations += fit.evaluations + 1;
            let difference: Vec<f64> = finer.iter().zip(&fit.fitted).map(|(a, b)| a - b).collect();
            let shift = fit.shift(&difference);
            let enough = shift.iter().all(|shift| shift.abs() <= MESH_SHIFT);
            let last = rung == LAST_RUNG || self.models.iter().any(SeriesModel::is_meshed);
            if enough || last {
                return Ok(Rung {
                    level: if last { rung } else { rung + 1 },
                    corrected: last,
                    values,
                    difference,
                    shift,
                    emulator,
                });
            }
            start = Some(values);
            coarser = Some(emulator);
            rung += 1;
        }
    }

    /// Fits with what is left of the runs; of all that were allowed an error speaks.
    fn fit(
        &self,
        calibration: &Calibration<'_>,
        coarser: Option<&Emulator>,
    ) -> Result<(Fit, Emulator), Error> {
        calibration.fit_emulated(coarser).map_err(|error| {
            match error {
                CalibrationError::EvaluationLimit { .. } => {
                    CalibrationError::EvaluationLimit { limit: self.limit }
                }
                other => other,
            }
            .into()
        })
    }

    fn model(&self, rung: u32, correction: Option<Vec<f64>>) -> CableModel<'_> {
        CableModel {
            series: self.models,
            unknowns: self.unknowns,
            rung,
            correction,
            watch: &self.watch,
        }
    }

    /// Scans all over the range where there is no `start` from a coarser mesh.
    fn calibration<'m>(
        &self,
        model: &'m CableModel<'m>,
        start: Option<Vec<f64>>,
        profiles: Profiles,
        tolerance: f64,
        evaluations: usize,
    ) -> Result<Calibration<'m>, Error> {
        let parameters = self
            .unknowns
            .iter()
            .map(|unknown| unknown.parameter(self.prior(*unknown)))
            .collect::<Result<Vec<_>, _>>()?;
        let forces = self
            .series
            .iter()
            .flat_map(|series| series.readings.forces())
            .collect();
        let sigmas: Option<Vec<Vec<f64>>> = self
            .series
            .iter()
            .map(|series| series.readings.sigmas())
            .collect();
        let mut calibration = Calibration::new(model, parameters, forces)?;
        if let Some(sigmas) = sigmas {
            calibration = calibration.with_sigmas(sigmas.concat())?;
        }
        let law = self.models.iter().any(|series| series.method == PassMethod::Law);
        let known = start.is_some();
        let start = start.unwrap_or_else(|| self.scene_values());
        let mut options = Options::default();
        options.loss = self.options.loss;
        options.start = Some(start);
        options.scan = known.then_some(0);
        options.tolerance = tolerance;
        options.max_evaluations = self.limit.saturating_sub(evaluations).max(1);
        options.relative_noise = if law {
            LAW_RIPPLE
        } else {
            RIPPLE[model.rung.min(LAST_RUNG) as usize]
        };
        options.profiles = profiles;
        Ok(calibration.with_options(options)?)
    }

    /// What the scenes say.
    fn scene_values(&self) -> Vec<f64> {
        self.unknowns
            .iter()
            .map(|unknown| {
                let (lower, upper) = unknown.quantity.bounds();
                let scene = self.series[unknown.series.unwrap_or(0)].scene;
                unknown.quantity.value(scene).clamp(lower, upper)
            })
            .collect()
    }

    /// The ground's stiffness by the deflection: u_z is inversely proportional to it.
    fn prior(&self, unknown: Unknown) -> Option<Prior> {
        let deflection = self
            .options
            .deflection
            .filter(|_| unknown == Unknown::shared(Quantity::GroundStiffness))?;
        Some(Prior {
            value: self.models[0].peak_vertical() / deflection.value,
            sigma: deflection.sigma / deflection.value,
        })
    }

    fn answer(
        &self,
        fit: &Fit,
        rung: &Rung,
        evaluations: usize,
        bootstrap: Option<BootstrapSummary>,
    ) -> Result<Calibrated, Error> {
        let meshes = self
            .models
            .iter()
            .map(|series| series.mesh(rung.level))
            .collect::<Result<Vec<_>, _>>()?;
        let largest = fit
            .fitted
            .iter()
            .fold(0.0_f64, |most, force| most.max(force.abs()));
        let difference = rung.difference.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        let error = ModelErrorEstimate {
            relative: if largest > 0.0 {
                0.5 * difference / largest
            } else {
                0.0
            },
            standard_errors: rung.shift.iter().map(|shift| 0.5 * shift.abs()).collect(),
        };
        let mut warnings: Vec<String> = fit.warnings.iter().map(ToString::to_string).collect();
        warnings.extend(self.models.iter().filter_map(SeriesModel::concern));
        for (estimate, error) in fit.estimates.iter().zip(&error.standard_errors) {
            if *error > MESH_SHIFT {
                warnings.push(format!(
                    "the mesh may move {} by {error:.1} standard errors: its interval is too narrow",
                    estimate.name
                ));
            }
        }
        let skipped: usize = self.series.iter().map(|series| series.readings.skipped()).sum();
        if skipped > 0 {
            warnings.push(format!("{skipped} rows without a force were left out"));
        }
        Ok(Calibrated {
            titles: self
                .series
                .iter()
                .map(|series| series.scene.title.clone())
                .collect(),
            parameters: fit
                .estimates
                .iter()
                .zip(self.unknowns)
                .map(|(estimate, unknown)| FittedParameter {
                    name: estimate.name.clone(),
                    unit: unknown.quantity.unit(),
                    value: estimate.value,
                    standard_error: estimate.standard_error,
                    interval_95: [estimate.interval.lower, estimate.interval.upper],
                    identifiable: estimate.identifiable,
                    profile: estimate
                        .profile
                        .iter()
                        .map(|&(value, rise)| ProfilePoint { value, rise })
                        .collect(),
                })
                .collect(),
            correlation: fit.correlation.clone(),
            residual_rms_n: fit.residual_rms,
            r_squared: fit.r_squared,
            evaluations,
            warnings,
            noise_n: self.noise(fit),
            degrees_of_freedom: fit.degrees_of_freedom,
            method: FitMethod {
                cable: self.models[0].method.name().into(),
                load_cell: self.models.iter().map(|series| series.end.name()).collect(),
                node_spacing_m: meshes.iter().map(cable_dem::Mesh::spacing).collect(),
                vehicle_step_m: meshes.iter().map(cable_dem::Mesh::vehicle_step).collect(),
                loss: match self.options.loss {
                    Loss::Squares => "squares",
                    Loss::Huber { .. } => "huber",
                    Loss::Tukey { .. } => "tukey",
                    _ => "other",
                },
                intervals: if fit.noise_estimated {
                    format!(
                        "profile likelihood, Student's t with {:.1} degrees of freedom",
                        fit.degrees_of_freedom
                    )
                } else {
                    "profile likelihood with the given sigmas".into()
                },
            },
            model_error: error,
            fit: self.readings(fit),
            bootstrap,
        })
    }

    /// The estimated noise in N; where readings have their own sigmas, there is no single one.
    fn noise(&self, fit: &Fit) -> Option<f64> {
        let own = self
            .series
            .iter()
            .all(|series| series.readings.sigmas().is_some());
        (!own).then_some(fit.noise)
    }

    fn readings(&self, fit: &Fit) -> Vec<FittedReading> {
        let readings = self.series.iter().enumerate().flat_map(|(index, series)| {
            series
                .readings
                .readings()
                .iter()
                .map(move |reading| (index, reading))
        });
        readings
            .enumerate()
            .map(|(row, (index, reading))| FittedReading {
                series: index + 1,
                pass: reading.pass,
                force_n: reading.force,
                fitted_n: fit.fitted[row],
                residual_n: fit.residuals[row],
                weight: fit.weights[row],
            })
            .collect()
    }
}

fn summary(bootstrap: &Bootstrap, options: &BootstrapOptions) -> BootstrapSummary {
    BootstrapSummary {
        replicates: bootstrap.samples.len(),
        failed: bootstrap.failed,
        seed: options.seed,
        standard_errors: bootstrap.standard_errors.clone(),
        interval_95: bootstrap
            .intervals
            .iter()
            .map(|interval| [interval.lower, interval.upper])
            .collect(),
        evaluations: bootstrap.evaluations,
    }
}
