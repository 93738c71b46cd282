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
use super::row::{Row, instruments};
use creepage_run::Error;

/// Length of correlation, in the logarithm of the passes: forces of a wrong law or ground miss the readings
/// by one broad curve over all passes. Found by the chart `discrepancy` (docs/charts.md): of nine wrong
/// models with a friction that gives the forces, intervals hold the truth in 97 % of the draws and more.
pub const LENGTH: f64 = 2.0;

/// Shares that may be asked for: below is less than an instrument shows, above is no knowledge.
pub const SHARES: RangeInclusive<f64> = 1e-4..=10.0;

/// Functions of all readings, by a sum of which the model may be off, of a `share` of the largest.
pub fn discrepancy(rows: &[Row<'_>], share: f64) -> Result<Vec<Vec<f64>>, Error> {
    if !SHARES.contains(&share) {
        return Err(study(CalibrationError::Invalid {
            what: "option discrepancy".into(),
            value: share,
            allowed: "a share of 0.0001 to 10",
        }));
    }
    let places: Vec<f64> = rows
        .iter()
        .map(|row| (row.reading.passes.max(1) as f64).ln())
        .collect();
    let bells = smooth_functions(&places, LENGTH);
    let mut functions = Vec::new();
    for instrument in instruments(rows) {
        let own = || rows.iter().filter(|row| row.instrument() == instrument);
        let largest = own().fold(0.0_f64, |most, row| most.max(row.reading.value.abs()));
        let size = |row: &Row<'_>| {
            let is_exact = row.reading.passes == 0 && row.observed != Observed::Deflection;
            if row.instrument() == instrument && !is_exact {
                share * largest
            } else {
                0.0
            }
        };
        let function = |bell: &Vec<f64>| {
            bell.iter()
                .zip(rows)
                .map(|(value, row)| value * size(row))
                .collect()
        };
        // Squares, as of numbers that are as good as 0 nothing is left.
        if own().any(|row| size(row) * size(row) > 0.0) {
            functions.extend(bells.iter().map(function));
        }
    }
    if functions.is_empty() {
        let reason = "the discrepancy is a share of it; check the readings, or leave the discrepancy out";
        return unfit("discrepancy", "a largest reading of 0 after the passes", reason);
    }
    Ok(functions)
}
