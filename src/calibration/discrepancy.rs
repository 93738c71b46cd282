//! A smooth error of the model beside the noise of the readings.
//!
//! At each instrument it is a Gaussian process over the logarithm of the passes since the cable was at rest,
//! of mean 0. Its standard deviation is a given share of the instrument's largest reading, the same share for
//! all. It is the same in all runs of a scene: there the model is wrong in the same way. Before the first
//! pass nothing can be wrong but a deflection.

use std::ops::RangeInclusive;

use calibrate::{CalibrationError, smooth_functions};

use super::cell::Observed;
use super::error::{study, unfit};
use super::model::SeriesModel;
use super::options::Series;
use crate::Error;

/// Length of correlation, in the logarithm of the passes: forces of a wrong law or ground miss the readings
/// by one broad curve over all passes. Found by the chart `discrepancy` (docs/charts.md): of nine wrong
/// models with a friction that gives the forces, intervals hold the truth in 97 % of the draws and more.
pub const LENGTH: f64 = 2.0;

/// Shares that may be asked for: below is less than an instrument shows, above is no knowledge.
pub const SHARES: RangeInclusive<f64> = 1e-4..=10.0;

/// Functions of all readings, by a sum of which the model may be off, of a `share` of the largest.
pub fn discrepancy(
    series: &[Series<'_>],
    models: &[SeriesModel],
    share: f64,
) -> Result<Vec<Vec<f64>>, Error> {
    if !SHARES.contains(&share) {
        return Err(study(CalibrationError::Invalid {
            what: "option discrepancy".into(),
            value: share,
            allowed: "a share of 0.0001 to 10",
        }));
    }
    // Instrument, logarithm of the passes, and what the error is a share of.
    let mut rows: Vec<((usize, Observed), f64, f64)> = Vec::new();
    for (index, (one, model)) in series.iter().zip(models).enumerate() {
        let list = || one.readings.readings().iter().zip(&model.observed);
        for (_, &(pass, observed)) in list() {
            let own = list().filter(|(_, (_, other))| *other == observed);
            let largest = own.fold(0.0_f64, |most, (reading, _)| most.max(reading.value.abs()));
            let exact = pass == 0 && observed != Observed::Deflection;
            let scale = if exact { 0.0 } else { largest };
            rows.push(((index, observed), (pass.max(1) as f64).ln(), scale));
        }
    }
    // Squares, as of numbers that are as good as 0 nothing is left.
    if rows.iter().all(|(_, _, scale)| scale * scale == 0.0) {
        let reason = "the discrepancy is a share of it; check the readings, or leave the discrepancy out";
        return unfit("discrepancy", "a largest reading of 0 after the passes", reason);
    }
    let places: Vec<f64> = rows.iter().map(|(_, place, _)| *place).collect();
    let bells = smooth_functions(&places, LENGTH);
    let mut functions = Vec::new();
    for (row, (instrument, ..)) in rows.iter().enumerate() {
        if rows[..row].iter().any(|(other, ..)| other == instrument) {
            continue;
        }
        let size = |(own, _, scale): &((usize, Observed), f64, f64)| {
            if own == instrument { share * scale } else { 0.0 }
        };
        functions.extend(bells.iter().map(|bell| -> Vec<f64> {
            let own = bell.iter().zip(&rows);
            own.map(|(value, row)| value * size(row)).collect()
        }));
    }
    Ok(functions)
}
