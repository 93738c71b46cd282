//! Readings of all series, in the order of a fit.

use super::cell::Observed;
use super::model::SeriesModel;
use super::options::Series;
use crate::readings::Reading;

/// A reading and what it is compared with.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    /// Index of its series.
    pub series: usize,
    pub reading: &'a Reading,
    pub observed: Observed,
}

/// The instrument of a series that a reading is of.
pub type Instrument = (usize, Observed);

impl Row<'_> {
    pub fn instrument(&self) -> Instrument {
        (self.series, self.observed)
    }
}

pub fn rows<'a>(series: &[Series<'a>], models: &[SeriesModel]) -> Vec<Row<'a>> {
    let mut rows = Vec::new();
    for (series, (one, model)) in series.iter().zip(models).enumerate() {
        let pairs = one.readings.readings().iter().zip(&model.observed);
        rows.extend(pairs.map(|(reading, &(_, observed))| Row {
            series,
            reading,
            observed,
        }));
    }
    rows
}

/// All instruments, each once.
pub fn instruments(rows: &[Row<'_>]) -> Vec<Instrument> {
    let mut instruments = Vec::new();
    for row in rows {
        if !instruments.contains(&row.instrument()) {
            instruments.push(row.instrument());
        }
    }
    instruments
}
