//! What is known and what is asked, as the crate `calibrate` takes it.

use calibrate::{Calibration, CalibrationError, Loss, Model, Options, Prior};

use super::cell::Observed;
use super::discrepancy::discrepancy;
use super::error::{study, unfit};
use super::model::{CableModel, Memory, SeriesModel};
use super::noise;
use super::options::{CalibrateOptions, Series};
use super::terms::Term;
use super::unknown::{Quantity, Unknown};
use super::watch::Watch;
use crate::Error;
use crate::readings::{Reading, Readings};
use crate::scene::FrictionLaw;

/// Coarsest level of meshes that may answer, with 12 nodes per depth, and finest that is fitted: 24 nodes per depth, corrected by 48.
pub const FIRST_LEVEL: u32 = 2;
pub const LAST_LEVEL: u32 = 3;
/// Ripple of the forces as parameters change on a fixed mesh, as a share of them: as a node more slips, their slope jumps.
/// Measured on the full-scale scenes; from the coarsest level up.
const RIPPLE: [f64; 4] = [1e-3, 3e-4, 1e-4, 3e-5];

pub struct Problem<'a> {
    pub series: &'a [Series<'a>],
    pub models: &'a [SeriesModel],
    /// What is fitted of cable and ground.
    pub unknowns: &'a [Unknown],
    /// What is fitted of the instruments.
    pub terms: &'a [Term],
    pub options: &'a CalibrateOptions<'a>,
    pub watch: &'a Watch<'a>,
    pub memory: &'a Memory,
}

impl Problem<'_> {
    /// The model on a level of meshes; `correction` is added to what it predicts.
    pub fn model(&self, level: u32, correction: Option<Vec<f64>>) -> CableModel<'_> {
        CableModel {
            series: self.models,
            unknowns: self.unknowns,
            level,
            stiffness: 1.0,
            correction,
            watch: self.watch,
            memory: self.memory,
        }
    }

    /// Every reading with its series and what it is compared with, in the order of the fit.
    pub fn readings(&self) -> impl Iterator<Item = (usize, &Reading, Observed)> {
        let series = self.series.iter().zip(self.models).enumerate();
        series.flat_map(|(index, (one, model))| {
            let list = one.readings.readings().iter().zip(&model.observed);
            list.map(move |(reading, (_, observed))| (index, reading, *observed))
        })
    }

    /// What a level of meshes predicts with these values of all parameters, on ground of this stiffness.
    pub fn predict(&self, level: u32, stiffness: f64, values: &[f64]) -> Result<Vec<f64>, Error> {
        let model = CableModel {
            stiffness,
            ..self.model(level, None)
        };
        let (of_model, of_terms) = values.split_at(self.unknowns.len());
        let mut predicted = model
            .predict(of_model)
            .map_err(|source| study(CalibrationError::NoAnswer { places: 1, source }))?;
        for (term, size) in self.terms.iter().zip(of_terms) {
            let column = term.parameter.column().unwrap_or_default();
            for (value, entry) in predicted.iter_mut().zip(column) {
                *value += size * entry;
            }
        }
        Ok(predicted)
    }

    /// Of at most so many model runs.
    pub fn calibration<'m>(
        &self,
        model: &'m CableModel<'m>,
        profiles: bool,
        runs: usize,
    ) -> Result<Calibration<'m>, Error> {
        let functions = match self.options.discrepancy {
            Some(share) => discrepancy(self.series, self.models, share)?,
            None => Vec::new(),
        };
        let readings = || self.series.iter().map(|series| series.readings);
        let sigmas: Option<Vec<Vec<f64>>> = readings().map(Readings::sigmas).collect();
        let relative = noise::relative_sigmas(self.series);
        let mut options = Options::default();
        options.loss = self.options.loss;
        options.max_evaluations = runs.max(1);
        options.relative_noise = RIPPLE[model.level.min(LAST_LEVEL) as usize];
        options.profiles = profiles;
        let build = || {
            let unknowns = self.unknowns.iter();
            let parameters = unknowns.map(|unknown| unknown.parameter(self.prior(*unknown)));
            let mut parameters = parameters.collect::<Result<Vec<_>, CalibrationError>>()?;
            parameters.extend(self.terms.iter().map(|term| term.parameter.clone()));
            let forces = readings().flat_map(Readings::values).collect();
            let calibration = Calibration::new(model, parameters, forces)?;
            let calibration = match (sigmas, relative) {
                (Some(sigmas), _) => calibration.with_sigmas(sigmas.concat())?,
                (None, Some(relative)) => calibration.with_relative_sigmas(relative)?,
                (None, None) => calibration,
            };
            let calibration = match self.options.discrepancy {
                Some(_) => calibration.with_discrepancy(&functions)?,
                None => calibration,
            };
            calibration.with_options(options)
        };
        build().map_err(study)
    }

    /// What the scenes say.
    pub fn scene_values(&self) -> Vec<f64> {
        let value = |unknown: &Unknown| {
            let (lower, upper) = unknown.quantity.bounds();
            let scene = self.series[unknown.series.unwrap_or(0)].scene;
            unknown.quantity.value(scene).clamp(lower, upper)
        };
        let terms = self.terms.iter().map(|_| 0.0);
        self.unknowns.iter().map(value).chain(terms).collect()
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
}

/// What is fitted, checked against the scenes.
pub fn unknowns(series: &[Series<'_>], options: &CalibrateOptions<'_>) -> Result<Vec<Unknown>, Error> {
    if series.is_empty() {
        return unfit("series", "none", "there is nothing to fit");
    }
    if options.discrepancy.is_some() && options.loss != Loss::Squares {
        return unfit(
            "discrepancy",
            "a robust loss beside it",
            "it takes what is left of a reading for independent noise; leave one of them out",
        );
    }
    let mut unknowns = options.unknowns.clone();
    let coulomb = |unknown: &Unknown| {
        series
            .iter()
            .enumerate()
            .any(|(index, one)| unknown.acts_on(index) && one.scene.friction.law() == FrictionLaw::Coulomb)
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
    let mut all = unknowns.iter();
    if all.any(|unknown| unknown.quantity == Quantity::ShapeFactor && coulomb(unknown)) {
        return unfit("friction.law", "coulomb", "it has no shape factor to be fitted");
    }
    let mut indices = unknowns.iter().filter_map(|unknown| unknown.series);
    if indices.any(|index| index >= series.len()) {
        let found = "a series of a higher index than there are";
        return unfit(
            "unknowns",
            found,
            "series are counted from 0, and in names from 1",
        );
    }
    let has_section = |unknown: &Unknown| {
        let Quantity::SectionCoefficient(section) = unknown.quantity else {
            return true;
        };
        let of_series = series.iter().enumerate();
        let mut scenes = of_series.filter(|(index, _)| unknown.acts_on(*index));
        scenes.all(|(_, one)| section < one.scene.route.len())
    };
    if !unknowns.iter().all(has_section) {
        let found = "no section of this number";
        return unfit("route", found, "sections of [[route]] are counted from 0");
    }
    if let [only] = series {
        // What has a prior needs no reading.
        let has_prior = |unknown: &&Unknown| {
            unknown.quantity.is_of_cell() || (options.deflection.is_some() && **unknown == ground)
        };
        let free = unknowns.len() - unknowns.iter().filter(has_prior).count();
        let needed = match only.readings.sigmas() {
            Some(_) => free.max(1),
            None => (free + 1).max(2),
        };
        only.readings.check_count(unknowns.len(), needed)?;
    }
    Ok(unknowns)
}
