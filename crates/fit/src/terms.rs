//! What load cells read beside the force: a zero that is off, and a drift.
//!
//! A cell's error is the same in all runs, its drift grows with the passes from the beginning of each.

use calibrate::{Parameter, Prior};

use super::cell::Observed;
use super::error::{study, unfit};
use super::options::CalibrateOptions;
use super::row::{Instrument, Row, instruments};
use super::unknown::{Quantity, Unknown};
use crate::readings::Reading;
use creepage_plan::shown::words_if;
use creepage_run::Error;

/// Standard deviation of a cell's error before the readings, as a share of its largest force: any more would be seen at a glance.
const ERROR: f64 = 0.25;
/// Bounds, in these standard deviations.
const FARTHEST: f64 = 8.0;

/// An error of a cell that is fitted.
#[derive(Clone)]
pub struct Term {
    pub quantity: Quantity,
    pub parameter: Parameter,
}

/// A load cell.
pub struct Cell {
    pub series: usize,
    pub observed: Observed,
    /// Whether its series has other cells.
    shares: bool,
    /// What a zero off by 1 N adds to each reading of all series, and what a drift of 1 N a pass does.
    pub offset: Vec<f64>,
    pub drift: Vec<f64>,
    /// Its largest force \[N\], and passes.
    largest: f64,
    last: f64,
}

/// The load cells of all series.
pub fn cells(rows: &[Row<'_>]) -> Vec<Cell> {
    let mut cells = instruments(rows);
    cells.retain(|(_, observed)| matches!(observed, Observed::Force(_) | Observed::ForceAt(_)));
    let cell = |&(series, observed): &Instrument| {
        let of = |value: fn(&Reading) -> f64| -> Vec<f64> {
            let own = |row: &Row<'_>| row.instrument() == (series, observed);
            rows.iter()
                .map(|row| if own(row) { value(row.reading) } else { 0.0 })
                .collect()
        };
        let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(*value));
        let drift = of(|reading| reading.passes as f64);
        Cell {
            series,
            observed,
            shares: cells.iter().filter(|(other, _)| *other == series).count() > 1,
            offset: of(|_| 1.0),
            largest: most(&of(|reading| reading.value.abs())),
            last: most(&drift).max(1.0),
            drift,
        }
    };
    cells.iter().map(cell).collect()
}

impl Cell {
    /// The name of its error, with the series and the place where there are several.
    pub fn name(&self, quantity: Quantity, series: usize) -> String {
        let of_series = format!("_{}", self.series + 1);
        let of_place = format!("_{}", self.observed.place().replace(' ', ""));
        let (series, place) = (words_if(series > 1, &of_series), words_if(self.shares, &of_place));
        format!("{quantity}{series}{place}")
    }
}

/// The terms that are asked for: an error of each cell of so many series.
pub fn terms(
    series: usize,
    rows: &[Row<'_>],
    asked: &[Unknown],
    options: &CalibrateOptions<'_>,
) -> Result<Vec<Term>, Error> {
    let cells = cells(rows);
    let mut terms = Vec::new();
    for unknown in asked {
        let own: Vec<&Cell> = cells.iter().filter(|cell| unknown.acts_on(cell.series)).collect();
        if own.is_empty() {
            let reason = "there are no forces among the readings";
            return unfit("fit", "an error of a load cell", reason);
        }
        for cell in own {
            let name = cell.name(unknown.quantity, series);
            terms.push(term(cell, unknown.quantity, &name, options)?);
        }
    }
    Ok(terms)
}

/// An error of `cell` with its prior.
pub fn term(
    cell: &Cell,
    quantity: Quantity,
    name: &str,
    options: &CalibrateOptions<'_>,
) -> Result<Term, Error> {
    let largest = cell.largest.max(f64::MIN_POSITIVE);
    let (column, told, natural) = match quantity {
        Quantity::Drift => (&cell.drift, options.drift_sigma, ERROR * largest / cell.last),
        _ => (&cell.offset, options.zero_offset_sigma, ERROR * largest),
    };
    let sigma = told.unwrap_or(natural);
    let bound = FARTHEST * sigma;
    let parameter = Parameter::term(name, -bound, bound, column);
    let parameter = parameter.and_then(|parameter| parameter.with_prior(Prior { value: 0.0, sigma }));
    let parameter = parameter.map_err(study)?;
    Ok(Term { quantity, parameter })
}
