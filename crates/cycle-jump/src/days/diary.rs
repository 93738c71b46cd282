//! What happens in a day, noted in the order of time.

use cable_dem::CableState;

use super::extremes::Extremes;
use super::rows::Row;
use crate::record::Record;

/// A day that was lived.
#[derive(Debug, Clone)]
pub struct Lived {
    /// In the order of time.
    pub rows: Vec<Row>,
    pub extremes: Extremes,
    /// The cable when it was hottest and coldest.
    pub hot: CableState,
    pub cold: CableState,
    /// After the last pass.
    pub last: CableState,
}

impl Lived {
    /// The passes that were simulated, of a day that follows so many others.
    pub fn passes(&self, before: u64) -> impl Iterator<Item = Record> {
        let simulated = self.rows.iter().filter(|row| row.simulated && !row.heat);
        simulated.map(move |row| Record {
            pass: before + row.passes,
            outcome: row.outcome.clone(),
            interpolated: false,
        })
    }
}

/// One day under way.
pub struct Diary {
    pub rows: Vec<Row>,
    extremes: Extremes,
    /// Θ, and the cable then.
    hot: Option<CableState>,
    cold: Option<CableState>,
}

impl Diary {
    pub fn new() -> Self {
        Self {
            rows: Vec::new(),
            extremes: Extremes::none(),
            hot: None,
            cold: None,
        }
    }

    pub fn note(&mut self, row: Row, state: &CableState) {
        self.extremes.see(&row.outcome);
        self.rows.push(row);
        let thermal = state.thermal_force();
        if self.hot.as_ref().is_none_or(|hot| thermal > hot.thermal_force()) {
            self.hot = Some(state.clone());
        }
        if self
            .cold
            .as_ref()
            .is_none_or(|cold| thermal < cold.thermal_force())
        {
            self.cold = Some(state.clone());
        }
    }

    /// Adds `beside` to the extremes so far.
    pub fn add(&mut self, beside: &Extremes) {
        self.extremes = self.extremes.plus(beside);
    }

    pub fn close(self, last: CableState) -> Lived {
        Lived {
            rows: self.rows,
            extremes: self.extremes,
            hot: self.hot.unwrap_or_else(|| last.clone()),
            cold: self.cold.unwrap_or_else(|| last.clone()),
            last,
        }
    }
}
