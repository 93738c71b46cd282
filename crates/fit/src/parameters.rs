//! The parameters of a fit: friction and ground of the scenes, and what load cells read besides the
//! force, a zero that is off and a drift.
//!
//! A cell's error is the same in all runs, its drift grows with the passes.

use calibrate::{Loss, Parameter, Prior, Scale};

use crate::error::study;
use crate::instrument::instruments;
use crate::model::SeriesModel;
use crate::options::{CalibrateOptions, Deflection};
use crate::readings::{Instrument, Measured, Reading};
use crate::unknown::{Quantity, Unknown};
use creepage_plan::shown::words_if;
use creepage_run::Error;
use creepage_scene::FrictionLaw;

const GROUND: Unknown = Unknown::shared(Quantity::GroundStiffness);
/// Standard deviation of a cell's error before the readings, as a share of its largest force: any
/// more would be seen at a glance.
const ERROR: f64 = 0.25;
/// Bounds of such an error, in these standard deviations.
const FARTHEST: f64 = 8.0;

/// What is fitted, and the parameter that stands for it.
#[derive(Clone)]
pub struct Fitted {
    pub unknown: Unknown,
    pub parameter: Parameter,
}

/// What is asked for, checked against the scenes, errors of cells last.
fn unknowns(models: &[SeriesModel<'_>], options: &CalibrateOptions<'_>) -> Result<Vec<Unknown>, Error> {
    if models.is_empty() {
        return Err(Error::unfit("series", "none", "there is nothing to fit"));
    }
    if options.discrepancy.is_some() && options.loss != Loss::Squares {
        let reason = "it takes what is left of a reading for independent noise; leave one of them out";
        return Err(Error::unfit("discrepancy", "a robust loss with it", reason));
    }
    let mut unknowns = options.unknowns.clone();
    if unknowns.is_empty() {
        let both = [Quantity::DynamicCoefficient, Quantity::ShapeFactor].map(Unknown::shared);
        unknowns.extend(both);
        unknowns.retain(|unknown| check(*unknown, models).is_ok());
    }
    if options.deflection.is_some() && !unknowns.contains(&GROUND) {
        unknowns.push(GROUND);
    }
    for unknown in &unknowns {
        check(*unknown, models)?;
    }
    unknowns.sort_by_key(|unknown| unknown.quantity.is_of_cell());
    Ok(unknowns)
}

/// Refuses what a scene of the series that it acts on does not have.
fn check(unknown: Unknown, models: &[SeriesModel<'_>]) -> Result<(), Error> {
    if unknown.series.is_some_and(|index| index >= models.len()) {
        let found = "a series of a higher index than there are";
        let reason = "series are counted from 0, and in names from 1";
        return Err(Error::unfit("unknowns", found, reason));
    }
    let own = models
        .iter()
        .enumerate()
        .filter(|(index, _)| unknown.acts_on(*index));
    for (_, SeriesModel { scene, .. }) in own {
        match unknown.quantity {
            Quantity::ShapeFactor if scene.friction.law() == FrictionLaw::Coulomb => {
                let reason = "it has no shape factor to be fitted";
                return Err(Error::unfit("friction.law", "coulomb", reason));
            }
            Quantity::SectionCoefficient(section) if section >= scene.route.len() => {
                let reason = "sections of [[route]] are counted from 0";
                return Err(Error::unfit("route", "no section of this number", reason));
            }
            _ => {}
        }
    }
    Ok(())
}

/// The parameters that are asked for: those of friction and ground, then an error of each cell.
pub fn parameters(
    models: &[SeriesModel<'_>],
    rows: &[Reading],
    options: &CalibrateOptions<'_>,
) -> Result<Vec<Fitted>, Error> {
    let mut fitted = Vec::new();
    for unknown in unknowns(models, options)? {
        if !unknown.quantity.is_of_cell() {
            fitted.push(of_model(unknown, models, options)?);
            continue;
        }
        let mut cells = cells(rows);
        cells.retain(|(series, _)| unknown.acts_on(*series));
        if cells.is_empty() {
            let reason = "there are no forces among the readings";
            return Err(Error::unfit("fit", "an error of a load cell", reason));
        }
        for cell in cells {
            fitted.push(error_of(cell, unknown.quantity, rows, options)?);
        }
    }
    Ok(fitted)
}

/// A parameter of friction or ground, with what a measured deflection says of the stiffness: both
/// are inversely proportional.
fn of_model(
    unknown: Unknown,
    models: &[SeriesModel<'_>],
    options: &CalibrateOptions<'_>,
) -> Result<Fitted, Error> {
    let (lower, upper) = unknown.quantity.bounds();
    let mut parameter = Parameter::new(&unknown.to_string(), lower, upper, Scale::Logarithmic);
    if let Some(Deflection { value, sigma }) = options.deflection.filter(|_| unknown == GROUND) {
        let prior = Prior {
            value: models[0].ground.motions[0].peak_vertical() / value,
            sigma: sigma / value,
        };
        parameter = parameter.and_then(|parameter| parameter.with_prior(prior));
    }
    let parameter = parameter.map_err(study)?;
    Ok(Fitted { unknown, parameter })
}

/// The load cells of all series.
pub fn cells(rows: &[Reading]) -> Vec<Instrument> {
    let mut cells = instruments(rows);
    cells.retain(|(_, measured)| matches!(measured, Measured::Force(_)));
    cells
}

/// An error of `cell`, with its prior. Its name says the series and the place where there are
/// several.
pub fn error_of(
    cell: Instrument,
    quantity: Quantity,
    rows: &[Reading],
    options: &CalibrateOptions<'_>,
) -> Result<Fitted, Error> {
    let own = || rows.iter().filter(|row| row.instrument() == cell);
    let largest = own().fold(f64::MIN_POSITIVE, |most, row| most.max(row.value.abs()));
    let last = own().fold(1.0_f64, |most, row| most.max(row.passes as f64));
    let is_drift = quantity == Quantity::Drift;
    let (given, natural) = if is_drift {
        (options.drift_sigma, ERROR * largest / last)
    } else {
        (options.zero_offset_sigma, ERROR * largest)
    };
    let entry = |row: &Reading| match row.passes {
        _ if row.instrument() != cell => 0.0,
        passes if is_drift => passes as f64,
        _ => 1.0,
    };
    let column: Vec<f64> = rows.iter().map(entry).collect();
    let of_series = format!("_{}", cell.0 + 1);
    let of_place = format!("_{}", cell.1.place().replace(' ', ""));
    let of_series = words_if(rows.iter().any(|row| row.series > 0), &of_series);
    let shares = cells(rows).iter().filter(|(series, _)| *series == cell.0).count() > 1;
    let name = format!("{quantity}{of_series}{}", words_if(shares, &of_place));
    let sigma = given.unwrap_or(natural);
    let (bound, prior) = (FARTHEST * sigma, Prior { value: 0.0, sigma });
    let parameter = Parameter::term(&name, -bound, bound, &column);
    let parameter = parameter.and_then(|parameter| parameter.with_prior(prior));
    Ok(Fitted {
        unknown: Unknown::of(quantity, cell.0),
        parameter: parameter.map_err(study)?,
    })
}
