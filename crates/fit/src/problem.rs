//! What is known and what is asked, as the crate `calibrate` takes it.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use calibrate::{Calibration, CalibrationError, Emulator, Fit, Model, ModelError, Part};
use rayon::prelude::*;

use crate::discrepancy::discrepancy;
use crate::error::study;
use crate::model::{MeshOf, SeriesModel};
use crate::noise::relative_sigmas;
use crate::options::CalibrateOptions;
use crate::parameters::Fitted;
use crate::readings::Reading;
use crate::unknown::Quantity;
use creepage_plan::Levels;
use creepage_run::Error;

/// Ripple of the forces as parameters change on a fixed mesh, relative to its typical error: as a node
/// more slips, their slope jumps. Measured on the full-scale scenes, where it is 1 to 2 % of that
/// on four meshes.
const RIPPLE: f64 = 0.02;
/// Maximum number of model runs of a fit on one mesh: it takes some fifty.
pub const MAX_RUNS: usize = 2000;

/// Scenes, their readings, and what is fitted to them.
pub struct Problem<'a> {
    pub models: &'a [SeriesModel<'a>],
    /// All readings.
    pub rows: &'a [Reading],
    /// What is fitted: of friction and ground first, then of the load cells.
    pub fitted: &'a [Fitted],
    pub options: &'a CalibrateOptions<'a>,
    pub runs: &'a Runs,
}

/// Model runs so far, and whether the caller stopped them.
#[derive(Default)]
pub struct Runs {
    count: AtomicUsize,
    stopped: AtomicBool,
}

impl Problem<'_> {
    /// What is fitted of friction and ground.
    pub fn of_model(&self) -> &[Fitted] {
        let is_of_cell = |fitted: &Fitted| fitted.unknown.quantity.is_of_cell();
        let count = self.fitted.iter().position(is_of_cell);
        &self.fitted[..count.unwrap_or(self.fitted.len())]
    }

    /// What a mesh predicts with these values of all parameters, or with those of the scenes if there are
    /// none, on ground of this stiffness.
    pub fn predict(&self, mesh: MeshOf, stiffness: f64, values: &[f64]) -> Result<Vec<f64>, Error> {
        let predicted = OnMesh(self, mesh, stiffness).predict(values);
        let mut predicted =
            predicted.map_err(|source| study(CalibrationError::NoAnswer { places: 1, source }))?;
        for (fitted, size) in self.fitted.iter().zip(values) {
            let column = fitted.parameter.column().unwrap_or_default();
            for (value, entry) in predicted.iter_mut().zip(column) {
                *value += size * entry;
            }
        }
        Ok(predicted)
    }

    /// Fits to a mesh and what is to be added to its predictions, without the errors of the cells, with
    /// profiles or without, and with what is `known` of the model before.
    pub fn fit(
        &self,
        mesh: MeshOf,
        difference: &[f64],
        has_profiles: bool,
        known: Option<Emulator>,
    ) -> Result<Fit, Error> {
        let functions = match self.options.discrepancy {
            Some(share) => discrepancy(self.rows, share)?,
            None => Vec::new(),
        };
        let model = OnMesh(self, mesh, 1.0);
        let parameters = self.fitted.iter().map(|fitted| fitted.parameter.clone());
        let pairs = self.rows.iter().zip(difference);
        let values = pairs.map(|(row, difference)| row.value - difference);
        let fit = || {
            let mut calibration = Calibration::new(&model, parameters.collect(), values.collect())?
                .with_loss(self.options.loss)
                .with_relative_noise(self.ripple(mesh))?
                .with_discrepancy(&functions)?;
            if let Some(sigmas) = self.rows.iter().map(|row| row.sigma).collect() {
                calibration = calibration.with_sigmas(sigmas)?;
            } else if let Some(relative) = relative_sigmas(self.rows) {
                calibration = calibration.with_relative_sigmas(relative)?;
            }
            if !has_profiles {
                calibration = calibration.without_profiles();
            }
            if let Some(emulator) = known {
                calibration = calibration.with_emulator(emulator);
            }
            calibration.fit()
        };
        fit().map_err(study)
    }

    /// Noise of the predictions on a mesh, as a share of them.
    fn ripple(&self, mesh: MeshOf) -> f64 {
        let level = |model: &SeriesModel<'_>| model.levels.fineness(model.level(mesh));
        let errors = self
            .models
            .iter()
            .map(|model| Levels::typical_error(level(model)));
        RIPPLE * errors.fold(0.0, f64::max)
    }

    /// Counts a model run. Once the caller has stopped the calibration every further run fails at
    /// once, which ends the search.
    fn count_run(&self) -> Result<(), Error> {
        self.check_stopped()?;
        let runs = self.runs.count.fetch_add(1, Ordering::Relaxed) + 1;
        let share = (runs as f64 / MAX_RUNS as f64).min(1.0);
        let reported = self.options.progress.report(share);
        self.runs.stopped.fetch_or(reported.is_err(), Ordering::Relaxed);
        reported
    }

    /// Whether the calibration goes on.
    pub fn check_stopped(&self) -> Result<(), Error> {
        let stopped = self.runs.stopped.load(Ordering::Relaxed);
        if stopped { Err(Error::Stopped) } else { Ok(()) }
    }
}

/// All series, each on one of its meshes, and the stiffness of the ground relative to the scene's where
/// it is not fitted.
struct OnMesh<'a>(&'a Problem<'a>, MeshOf, f64);

impl Model for OnMesh<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError> {
        let &Self(problem, mesh, stiffness) = self;
        let of_series = |(index, series): (usize, &SeriesModel<'_>)| {
            let (mut scene, mut stiffness) = (series.scene.clone(), stiffness);
            for (Fitted { unknown, .. }, &value) in problem.fitted.iter().zip(parameters) {
                if unknown.acts_on(index) {
                    unknown.quantity.set(&mut scene, value);
                    if unknown.quantity == Quantity::GroundStiffness {
                        stiffness = value;
                    }
                }
            }
            series.predict(&scene, stiffness, mesh)
        };
        let forces = problem.models.par_iter().enumerate().map(of_series);
        let forces = forces.collect::<Result<Vec<Vec<f64>>, Error>>()?;
        problem.count_run()?;
        Ok(forces.concat())
    }

    fn parts(&self) -> Vec<Part> {
        let fitted = self.0.of_model();
        let of_series = |(index, series): (usize, &SeriesModel<'_>)| {
            let acts = |&k: &usize| fitted[k].unknown.acts_on(index);
            Part {
                predictions: series.rows.len(),
                parameters: (0..fitted.len()).filter(acts).collect(),
            }
        };
        self.0.models.iter().enumerate().map(of_series).collect()
    }
}
