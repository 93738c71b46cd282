//! What is known and what is asked, as the crate `calibrate` takes it.

use calibrate::{Calibration, CalibrationError, Emulator, Fit, Loss, Model, Options, Prior};

use super::discrepancy::discrepancy;
use super::error::{study, unfit};
use super::model::{CableModel, MeshOf, SeriesModel};
use super::noise;
use super::options::{CalibrateOptions, Series};
use super::row::Row;
use super::terms::Term;
use super::unknown::{Quantity, Unknown};
use super::watch::Watch;
use creepage_plan::Levels;
use creepage_run::Error;
use creepage_scene::{FrictionLaw, Scene};

/// Ripple of the forces as parameters change on a fixed mesh, beside its typical error: as a node more slips, their slope jumps. Measured on the
/// full-scale scenes, where it is 1 to 2 % of that on four meshes.
const RIPPLE: f64 = 0.02;

pub struct Problem<'a> {
    pub series: &'a [Series<'a>],
    pub models: &'a [SeriesModel],
    /// All readings.
    pub rows: &'a [Row<'a>],
    /// What is fitted of cable and ground.
    pub unknowns: &'a [Unknown],
    /// What is fitted of the instruments.
    pub terms: &'a [Term],
    pub options: &'a CalibrateOptions<'a>,
    /// Most runs of the model.
    pub limit: usize,
    pub watch: &'a Watch<'a>,
}

/// How to fit.
#[derive(Clone, Copy)]
pub struct Way<'a> {
    pub mesh: MeshOf,
    /// Added to what the mesh predicts, without the errors of the cells.
    pub difference: &'a [f64],
    pub profiles: bool,
    /// Most runs of the model, those included that are known before.
    pub runs: usize,
}

impl Problem<'_> {
    fn model(&self, mesh: MeshOf, stiffness: f64) -> CableModel<'_> {
        CableModel {
            series: self.models,
            unknowns: self.unknowns,
            mesh,
            stiffness,
            watch: self.watch,
        }
    }

    /// What a mesh predicts with these values of all parameters, on ground of this stiffness.
    pub fn predict(&self, mesh: MeshOf, stiffness: f64, values: &[f64]) -> Result<Vec<f64>, Error> {
        let (of_model, of_terms) = values.split_at(self.unknowns.len());
        let predicted = self.model(mesh, stiffness).predict(of_model);
        let mut predicted =
            predicted.map_err(|source| study(CalibrationError::NoAnswer { places: 1, source }))?;
        for (term, size) in self.terms.iter().zip(of_terms) {
            let column = term.parameter.column().unwrap_or_default();
            for (value, entry) in predicted.iter_mut().zip(column) {
                *value += size * entry;
            }
        }
        Ok(predicted)
    }

    /// Fits, with what is known of the model before.
    pub fn fit(&self, way: Way<'_>, known: Option<Emulator>) -> Result<Fit, Error> {
        let functions = match self.options.discrepancy {
            Some(share) => discrepancy(self.rows, share)?,
            None => Vec::new(),
        };
        let model = self.model(way.mesh, 1.0);
        let fit = || {
            let unknowns = self.unknowns.iter();
            let parameters = unknowns.map(|unknown| unknown.parameter(self.prior(*unknown)));
            let mut parameters = parameters.collect::<Result<Vec<_>, CalibrationError>>()?;
            parameters.extend(self.terms.iter().map(|term| term.parameter.clone()));
            let pairs = self.rows.iter().zip(way.difference);
            let values = pairs.map(|(row, difference)| row.reading.value - difference);
            let mut calibration = Calibration::new(&model, parameters, values.collect())?
                .with_options(self.statistics(&way))?
                .with_discrepancy(&functions)?;
            if let Some(sigmas) = self.rows.iter().map(|row| row.reading.sigma).collect() {
                calibration = calibration.with_sigmas(sigmas)?;
            } else if let Some(relative) = noise::relative_sigmas(self.rows) {
                calibration = calibration.with_relative_sigmas(relative)?;
            }
            match known {
                Some(emulator) => calibration.with_emulator(emulator).fit(),
                None => calibration.fit(),
            }
        };
        fit().map_err(|error| match error {
            // Of all meshes together.
            CalibrationError::EvaluationLimit { .. } => {
                study(CalibrationError::EvaluationLimit { limit: self.limit })
            }
            other => study(other),
        })
    }

    fn statistics(&self, way: &Way<'_>) -> Options {
        let errors = self
            .models
            .iter()
            .map(|model| Levels::typical_error(model.levels.fineness(way.mesh.level(model))));
        let mut options = Options::default();
        options.loss = self.options.loss;
        options.max_evaluations = way.runs.max(1);
        options.relative_noise = RIPPLE * errors.fold(0.0, f64::max);
        options.profiles = way.profiles;
        options
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
        let reason = "it takes what is left of a reading for independent noise; leave one of them out";
        return unfit("discrepancy", "a robust loss beside it", reason);
    }
    let [friction, shape_factor, ground] = [
        Quantity::DynamicCoefficient,
        Quantity::ShapeFactor,
        Quantity::GroundStiffness,
    ]
    .map(Unknown::shared);
    let mut unknowns = options.unknowns.clone();
    if unknowns.is_empty() {
        unknowns.push(friction);
        unknowns.extend((!is_coulomb(shape_factor, series)).then_some(shape_factor));
    }
    if options.deflection.is_some() && !unknowns.contains(&ground) {
        unknowns.push(ground);
    }
    for unknown in &unknowns {
        check(*unknown, series)?;
    }
    if let [only] = series {
        // What has a prior needs no reading.
        let has_prior = |unknown: &Unknown| {
            unknown.quantity.is_of_cell() || (options.deflection.is_some() && *unknown == ground)
        };
        let free = unknowns.iter().filter(|unknown| !has_prior(unknown)).count();
        let needed = match only.readings.sigmas() {
            Some(_) => free.max(1),
            None => (free + 1).max(2),
        };
        only.readings.check_count(unknowns.len(), needed)?;
    }
    Ok(unknowns)
}

/// Refuses what a scene of the series that it acts on does not have.
fn check(unknown: Unknown, series: &[Series<'_>]) -> Result<(), Error> {
    if unknown.series.is_some_and(|index| index >= series.len()) {
        let found = "a series of a higher index than there are";
        return unfit(
            "unknowns",
            found,
            "series are counted from 0, and in names from 1",
        );
    }
    match unknown.quantity {
        Quantity::ShapeFactor if is_coulomb(unknown, series) => {
            unfit("friction.law", "coulomb", "it has no shape factor to be fitted")
        }
        Quantity::SectionCoefficient(section)
            if scenes_of(unknown, series).any(|scene| section >= scene.route.len()) =>
        {
            let reason = "sections of [[route]] are counted from 0";
            unfit("route", "no section of this number", reason)
        }
        _ => Ok(()),
    }
}

fn scenes_of<'a>(unknown: Unknown, series: &'a [Series<'a>]) -> impl Iterator<Item = &'a Scene> {
    let own = series
        .iter()
        .enumerate()
        .filter(move |(index, _)| unknown.acts_on(*index));
    own.map(|(_, one)| one.scene)
}

fn is_coulomb(unknown: Unknown, series: &[Series<'_>]) -> bool {
    scenes_of(unknown, series).any(|scene| scene.friction.law() == FrictionLaw::Coulomb)
}
