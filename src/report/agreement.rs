//! Computed force against readings of a load cell.

use crate::calibration::{CellEnd, force_ends, of_forces};
use crate::readings::{Reading, Readings};
use crate::{Error, PassRecord, Run, Scene};

/// Readings beside the force computed at the same passes.
#[derive(Debug)]
pub struct Agreement {
    /// The end that pressed on the load cell.
    pub end: CellEnd,
    pub readings: Vec<Reading>,
    /// Number of readings whose pass was computed.
    pub compared: usize,
    /// Root of the mean square of measured minus computed force over these \[N\].
    pub rms_n: f64,
    /// Mean of measured minus computed force \[N\].
    pub mean_n: f64,
    /// Largest measured force \[N\].
    pub largest_n: f64,
    /// What looks mistaken: sign or unit.
    pub mistakes: Vec<String>,
    /// An error of the cell that the readings suggest.
    pub error: Option<CellError>,
}

/// An error of a load cell beside the computed force.
#[derive(Debug)]
pub enum CellError {
    /// By so much a pass \[N\].
    Drift(f64),
    /// By so much before the first pass \[N\].
    Zero(f64),
}

/// Standard errors from which on a drift or a zero is no chance, and the share of the largest force from which on it matters.
const STRIKING: f64 = 4.0;
const MATTERS: f64 = 0.02;
/// Fewest readings that suggest anything.
const FEWEST: usize = 6;

impl Agreement {
    /// Compares the readings with the run.
    ///
    /// # Errors
    ///
    /// [`Error`] where no end of the cable is held.
    pub fn new(scene: &Scene, run: &Run, readings: &Readings) -> Result<Self, Error> {
        let ends = force_ends(scene, readings)?;
        // One cell is drawn: of two, the one that the scene holds.
        let end = CellEnd::of(scene)?;
        let of_end = readings
            .readings()
            .iter()
            .zip(ends)
            .filter(|(_, cell)| *cell == Some(end));
        let readings: Vec<Reading> = of_end.map(|(reading, _)| *reading).collect();
        let computed = |reading: &Reading| Some((*reading, force_at(&run.passes, end, reading.passes)?));
        let compared: Vec<(Reading, f64)> = readings.iter().filter_map(computed).collect();
        let differences: Vec<f64> = compared.iter().map(|(read, force)| read.value - force).collect();
        // The zero reading has no sign and no size.
        let loaded = compared.iter().filter(|(reading, _)| reading.passes > 0);
        let both: Vec<(f64, f64)> = loaded.map(|(read, force)| (read.value, *force)).collect();
        let mistakes = of_forces(end.name(), &both);
        let passes: Vec<f64> = compared.iter().map(|(read, _)| read.passes as f64).collect();
        let mean = |of: fn(f64) -> f64| {
            differences.iter().map(|d| of(*d)).sum::<f64>() / differences.len().max(1) as f64
        };
        let sizes = readings.iter().map(|reading| reading.value.abs());
        let largest = sizes.fold(0.0, f64::max);
        Ok(Self {
            end,
            compared: differences.len(),
            rms_n: mean(|d| d * d).sqrt(),
            mean_n: mean(|d| d),
            largest_n: largest,
            error: if mistakes.is_empty() {
                error(&passes, &differences, MATTERS * largest)
            } else {
                None
            },
            mistakes,
            readings,
        })
    }

    /// The numbers that the page shows.
    pub fn numbers(&self) -> [f64; 3] {
        [self.rms_n, self.mean_n, self.largest_n]
    }
}

/// What a line by least squares says of the differences over the passes, if it is more than they scatter and than `least` \[N\]: its slope or its
/// value before the first pass, whichever changes forces more.
fn error(passes: &[f64], differences: &[f64], least: f64) -> Option<CellError> {
    let count = differences.len() as f64;
    if differences.len() < FEWEST {
        return None;
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
    let (place, level) = (mean(passes), mean(differences));
    let both = || passes.iter().map(|pass| pass - place).zip(differences);
    let spread: f64 = both().map(|(pass, _)| pass * pass).sum();
    let slope = both().map(|(pass, difference)| pass * difference).sum::<f64>() / spread;
    let rest = both().map(|(pass, difference)| (difference - level - slope * pass).powi(2));
    let variance = rest.sum::<f64>() / (count - 2.0);
    let reach = passes.iter().fold(0.0, |most: f64, pass| most.max(*pass));
    let zero = level - slope * place;
    let errors = [
        (
            slope * reach,
            reach * (variance / spread).sqrt(),
            CellError::Drift(slope),
        ),
        (
            zero,
            (variance * (1.0 / count + place * place / spread)).sqrt(),
            CellError::Zero(zero),
        ),
    ];
    let strikes = errors
        .into_iter()
        .filter(|(size, scatter, _)| size.abs() > least && size.abs() > STRIKING * scatter);
    strikes
        .max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))
        .map(|(.., error)| error)
}

/// Force on the end after `pass` \[N\]; between listed passes along a straight line, `None` beyond the last.
fn force_at(passes: &[PassRecord], end: CellEnd, pass: u64) -> Option<f64> {
    if pass == 0 {
        return Some(0.0);
    }
    let next = passes.partition_point(|record| record.pass < pass);
    let after = passes.get(next)?;
    if after.pass == pass || next == 0 {
        return Some(end.force(after));
    }
    let before = &passes[next - 1];
    let share = (pass - before.pass) as f64 / (after.pass - before.pass) as f64;
    Some(end.force(before) + share * (end.force(after) - end.force(before)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Differences over 20 passes: a line and a scatter of 1 N by turns.
    fn found(zero: f64, slope: f64) -> Option<CellError> {
        let passes: Vec<f64> = (1..=20).map(f64::from).collect();
        let scatter = |pass: &f64| if pass % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let differences: Vec<f64> = passes
            .iter()
            .map(|pass| zero + slope * pass + scatter(pass))
            .collect();
        error(&passes, &differences, 2.0)
    }

    #[test]
    fn a_drift_and_a_zero_are_told_apart_and_scatter_is_neither() {
        assert!(found(0.0, 0.0).is_none());
        assert!(matches!(found(0.0, 0.8), Some(CellError::Drift(slope)) if (slope - 0.8).abs() < 0.05));
        assert!(matches!(found(150.0, -0.4), Some(CellError::Zero(zero)) if (zero - 150.0).abs() < 2.0));
    }
}
