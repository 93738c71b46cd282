//! Passes along an axis, or the time that they take where it is known; those of runs before come first.

use super::chart::lines;
use super::content::Report;
use creepage_run::{Limited, PassRecord, PastPass, answer::listed};
use creepage_scene::{CableEnd, DAYS_PER_YEAR};
use plain_figure::{Axis, Chart, Reference};

/// Passes beyond which their axis is logarithmic, but for a life in parts.
const MANY: u64 = 2000;
/// Passes that are all drawn; of more, those that a run with jumps would list.
const ALL_DRAWN: usize = 1000;
/// Units of time \[days\] of an axis that is not logarithmic, and how many of one there are at least.
const UNITS: [(f64, &str); 3] = [(DAYS_PER_YEAR, "years"), (1.0, "days"), (1.0 / 24.0, "hours")];
const FEWEST: f64 = 2.0;
/// Share of a logarithmic axis that a label needs.
const LABEL: f64 = 0.2;
/// Ticks of one that is \[days\].
const TICKS: [(f64, &str); 8] = [
    (1.0 / 1440.0, "1 min"),
    (1.0 / 144.0, "10 min"),
    (1.0 / 24.0, "1 h"),
    (1.0, "1 day"),
    (DAYS_PER_YEAR / 12.0, "1 month"),
    (DAYS_PER_YEAR, "1 year"),
    (10.0 * DAYS_PER_YEAR, "10 years"),
    (100.0 * DAYS_PER_YEAR, "100 years"),
];

pub struct PassAxis<'r> {
    /// What the runs before have left, their passes and days.
    history: &'r [PastPass],
    before: (u64, f64),
    last: u64,
    /// Days of one unit of the axis, and vehicles a day, where these are known.
    time: Option<(f64, f64)>,
    name: &'static str,
    is_linear: bool,
}

impl<'r> PassAxis<'r> {
    /// The axis of the passes of a report up to `last`.
    pub fn new(report: &'r Report, last: u64) -> Self {
        let history = &report.history[..];
        let has_days = history.iter().all(|past| past.days.is_some());
        let before = history
            .last()
            .map_or((0, 0.0), |past| (past.pass, past.days.unwrap_or(0.0)));
        let is_linear = last <= MANY || !history.is_empty();
        let per_day = report.scene.traffic.per_day.filter(|_| has_days);
        let unit = per_day.map(|per_day| {
            let days = before.1 + last as f64 / per_day;
            let mut units = UNITS.into_iter().filter(|(unit, _)| days >= FEWEST * unit);
            let linear = units.next().unwrap_or(UNITS[2]);
            if is_linear { linear } else { (1.0, "time") }
        });
        Self {
            history,
            before,
            last,
            time: unit.map(|(unit, _)| unit).zip(per_day),
            name: unit.map_or("passes", |(_, name)| name),
            is_linear,
        }
    }

    /// The title of a chart of `what` over this axis.
    pub fn title(&self, what: &str) -> String {
        let along = self.time.map_or("passes", |_| "time");
        format!("{what} against {along}")
    }

    /// The axis, which ends with the last pass where it is not logarithmic.
    pub fn axis(&self) -> Axis {
        if self.is_linear {
            return Axis::linear(self.name).range(0.0, self.place(self.last));
        }
        let axis = Axis::logarithmic(self.name);
        if self.time.is_none() {
            return axis;
        }
        // Ticks of time, from the end on as many as have room.
        let apart = (self.last as f64).powf(LABEL);
        let mut ticks: Vec<(f64, &str)> = Vec::new();
        for (time, name) in TICKS
            .into_iter()
            .rev()
            .filter(|(time, _)| *time <= self.place(self.last))
        {
            if ticks.last().is_none_or(|(later, _)| later / time >= apart) {
                ticks.push((time, name));
            }
        }
        ticks.reverse();
        axis.ticks(ticks)
    }

    /// Where a pass is on the axis.
    pub fn place(&self, pass: u64) -> f64 {
        let (before, days) = self.before;
        let time = self
            .time
            .map(|(unit, per_day)| (days + pass as f64 / per_day) / unit);
        time.unwrap_or((before + pass) as f64)
    }

    /// `chart` with what the runs before have left of each of `ends`, and a line where this one begins.
    pub fn with_history(
        &self,
        chart: Chart,
        ends: &[CableEnd],
        value: impl Fn(&PastPass, CableEnd) -> f64,
    ) -> Chart {
        if self.history.is_empty() {
            return chart;
        }
        let place = |past: &PastPass| {
            let time = self.time.zip(past.days).map(|((unit, _), days)| days / unit);
            time.unwrap_or(past.pass as f64)
        };
        let chart = lines(chart, ends, None, |end| {
            let history = self.history.iter().map(|past| (place(past), value(past, end)));
            history.collect::<Vec<_>>()
        });
        chart.refer(Reference::vertical(self.place(0), ""))
    }

    /// A value after each pass.
    pub fn series(&self, passes: &[PassRecord], value: impl Fn(&PassRecord) -> f64) -> Vec<(f64, f64)> {
        let drawn = listed(passes.last().map_or(1, |record| record.pass));
        let is_drawn = |pass: u64| passes.len() <= ALL_DRAWN || drawn.binary_search(&pass).is_ok();
        let drawn = passes.iter().filter(|record| is_drawn(record.pass));
        drawn
            .map(|record| (self.place(record.pass), value(record)))
            .collect()
    }
}

/// What a run before has left of an end.
pub fn left(past: &PastPass, end: CableEnd, quantity: Limited) -> f64 {
    end.of(quantity.of([past.force_n, past.displacement_m]))
}
