//! What all days come to, from what is recorded of their events.

use cable_dem::PassOutcome;

use super::calendar::Calendar;
use super::day::{Act, Event, Known};
use super::extremes::Extremes;
use crate::JumpError;
use crate::peaks::peaks;
use crate::record::Record;

/// A day's extremes.
#[derive(Debug, Clone, PartialEq)]
pub struct DayRecord {
    /// Number of the day, from 1.
    pub day: u64,
    /// Its extremes.
    pub extremes: Extremes,
}

/// The cable after a moment of a day.
#[derive(Debug, Clone)]
pub struct Row {
    /// Passes of the day done.
    pub passes: u64,
    /// Θ \[N\].
    pub thermal_force: f64,
    /// The cable then.
    pub outcome: PassOutcome,
    /// Whether only the temperature has changed since the last pass.
    pub heat: bool,
}

/// The events of all days that are known.
pub struct Account<'a> {
    calendar: &'a Calendar<'a>,
    /// Those that were wanted, in the order of time.
    wanted: Vec<Record>,
    /// Others that were simulated.
    others: Vec<Record>,
}

impl<'a> Account<'a> {
    pub fn new(calendar: &'a Calendar<'a>, mut wanted: Vec<Record>, others: Vec<Record>) -> Self {
        wanted.sort_by_key(|record| record.pass);
        Self {
            calendar,
            wanted,
            others,
        }
    }

    fn at(&self, day: u64, place: usize) -> Option<&Record> {
        let number = self.calendar.number(day, place);
        let found = self.wanted.binary_search_by_key(&number, |record| record.pass);
        Some(&self.wanted[found.ok()?])
    }

    /// The extremes of all days.
    pub fn extremes(&self) -> Extremes {
        let mut extremes = Extremes::none();
        for record in self.wanted.iter().chain(&self.others) {
            extremes.see(&record.outcome);
        }
        extremes
    }

    /// The extremes of these days.
    pub fn days(&self, days: &[u64]) -> Vec<DayRecord> {
        let nothing = |&day| DayRecord {
            day,
            extremes: Extremes::none(),
        };
        let mut days: Vec<DayRecord> = days.iter().map(nothing).collect();
        for record in &self.wanted {
            let (day, _) = self.calendar.place(record.pass);
            if let Ok(index) = days.binary_search_by_key(&day, |record| record.day) {
                days[index].extremes.see(&record.outcome);
            }
        }
        days
    }

    /// What these passes did.
    pub fn passes(&self, passes: &[u64]) -> Result<Vec<Record>, JumpError> {
        let record = |&pass: &u64| {
            let (day, known) = self.calendar.known(pass)?;
            self.pass(pass, day, &known)
                .ok_or(JumpError::UnknownPass { pass })
        };
        passes.iter().map(record).collect()
    }

    fn pass(&self, pass: u64, day: u64, known: &Known) -> Option<Record> {
        let (outcome, interpolated) = match known {
            Known::Simulated(place) => {
                let record = self.at(day, *place)?;
                (record.outcome.clone(), record.interpolated)
            }
            Known::Within { at_rest: ends, like } => {
                let end = |(weight, place): &(f64, usize)| {
                    let outcome = &self.at(day, *place)?.outcome;
                    Some((*weight, at_rest(outcome)))
                };
                let ends: Vec<(f64, PassOutcome)> = ends.iter().map(end).collect::<Option<_>>()?;
                let ends = ends.iter().map(|(weight, end)| (*weight, end));
                let like = (1.0, &self.at(day, *like)?.outcome);
                (
                    PassOutcome::combined(&ends.chain([like]).collect::<Vec<_>>()),
                    true,
                )
            }
        };
        Some(Record {
            pass,
            outcome,
            interpolated,
        })
    }

    /// The last day in the order of time.
    pub fn last_day(&self) -> Vec<Row> {
        let day = self.calendar.days;
        let events = self.calendar.events(day).iter().enumerate();
        let row = |(place, event): (usize, &Event)| {
            Some(Row {
                passes: event.passes,
                thermal_force: event.thermal_force,
                outcome: self.at(day, place)?.outcome.clone(),
                heat: event.act == Act::Warm,
            })
        };
        events.filter_map(row).collect()
    }

    /// Simulated passes that show more than the simulated ones of `records`.
    pub fn peaks(&self, records: &[Record]) -> Vec<Record> {
        let simulated = |record: &&Record| !record.interpolated;
        let other = |record: &Record| {
            let pass = self.calendar.pass(record.pass)?;
            let listed = records.binary_search_by_key(&pass, |record| record.pass).is_ok();
            (!listed).then(|| Record {
                pass,
                ..record.clone()
            })
        };
        let others = self.wanted.iter().chain(&self.others).filter(simulated);
        let records: Vec<Record> = records.iter().filter(simulated).cloned().collect();
        peaks(&records, others.filter_map(other).collect())
    }
}

/// The same cable after the pass: without its peaks and its heat.
fn at_rest(outcome: &PassOutcome) -> PassOutcome {
    let mut rest = outcome.clone();
    (rest.peak, rest.lowest, rest.dissipated) = (rest.force, rest.force, 0.0);
    rest
}
