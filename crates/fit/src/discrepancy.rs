//! A smooth error of the model in addition to the noise of the readings.
//!
//! At each instrument it is a Gaussian process over the logarithm of the passes since the cable was
//! at rest, of mean 0. Its standard deviation is a given share of the instrument's largest reading,
//! the same share for all. It is the same in all runs of a scene: there the model is wrong in the
//! same way. Before the first pass nothing can be wrong but a deflection.

use std::ops::RangeInclusive;

use calibrate::{CalibrationError, smooth_functions};

use crate::error::study;
use crate::instrument::instruments;
use crate::readings::Reading;
use creepage_run::Error;

/// Length of correlation, in the logarithm of the passes: forces of a wrong law or ground miss the
/// readings by one broad curve over all passes. Found by the chart `discrepancy` (docs/charts.md):
/// of nine wrong models with a friction that gives the forces, intervals hold the truth in 97 % of
/// the draws and more.
const LENGTH: f64 = 2.0;

/// Shares that may be asked for: below is less than an instrument shows, above is no knowledge.
pub const SHARES: RangeInclusive<f64> = 1e-4..=10.0;

/// Functions of all readings, by a sum of which the model may be off, of a `share` of the largest.
pub fn discrepancy(rows: &[Reading], share: f64) -> Result<Vec<Vec<f64>>, Error> {
    if !SHARES.contains(&share) {
        return Err(study(CalibrationError::Invalid {
            what: "option discrepancy".into(),
            value: share,
            allowed: "a share of 0.0001 to 10".into(),
        }));
    }
    let place = |row: &Reading| (row.passes.max(1) as f64).ln();
    let bells = smooth_functions(&rows.iter().map(place).collect::<Vec<_>>(), LENGTH);
    let mut functions: Vec<Vec<f64>> = Vec::new();
    for instrument in instruments(rows) {
        let own = rows.iter().filter(|row| row.instrument() == instrument);
        let largest = own.fold(0.0_f64, |most, row| most.max(row.value.abs()));
        let size = |row: &Reading| {
            let is_wrong = row.instrument() == instrument && !row.is_at_rest();
            if is_wrong { share * largest } else { 0.0 }
        };
        let sizes: Vec<f64> = rows.iter().map(size).collect();
        // Squares, as of numbers that are as good as 0 nothing is left.
        if sizes.iter().any(|size| size * size > 0.0) {
            let times = |bell: &Vec<f64>| {
                bell.iter()
                    .zip(&sizes)
                    .map(|(value, size)| value * size)
                    .collect()
            };
            functions.extend(bells.iter().map(times));
        }
    }
    if functions.is_empty() {
        let found = "a largest reading of 0 after the passes";
        let reason = "the discrepancy is a share of it; check the readings, or leave the discrepancy out";
        return Err(Error::unfit("discrepancy", found, reason));
    }
    Ok(functions)
}
