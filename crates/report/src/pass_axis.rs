//! Passes along an axis, or the time that they take where it is known; those of runs before come first.

use super::chart::lines;
use super::content::Report;
use creepage_run::{Limited, PassRecord, PastPass, answer::listed};
use creepage_scene::{CableEnd, DAYS_PER_YEAR, Unit};
use plain_figure::{Axis, Chart, Reference};

/// Passes beyond which their axis is logarithmic, but for a life in parts.
const MANY: u64 = 2000;
/// Passes that are all drawn; of more, those that a run with jumps would list.
const ALL_DRAWN: usize = 1000;
/// Units of time \[days\] of an axis that is not logarithmic, and how many of one there are at least.
const UNITS: [(f64, &str); 3] = [(DAYS_PER_YEAR, "years"), (1.0, "days"), (1.0 / 24.0, "hours")];
const MIN_UNITS: f64 = 2.0;
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
    /// What the runs before have left.
    history: &'r [PastPass],
    /// Where the first pass begins, and how far a pass goes on, in the unit of the axis.
    begin: f64,
    each: f64,
    last: u64,
    /// Days of that unit, where the vehicles a day are known.
    unit: Option<f64>,
    name: &'static str,
    is_linear: bool,
}

impl<'r> PassAxis<'r> {
    /// The axis of the passes of a report up to `last`.
    pub fn new(report: &'r Report, last: u64) -> Self {
        let history = &report.history[..];
        let (before, is_linear) = (history.last(), last <= MANY || !history.is_empty());
        let passes = Self {
            history,
            begin: before.map_or(0.0, |past| past.pass as f64),
            each: 1.0,
            last,
            unit: None,
            name: "passes",
            is_linear,
        };
        let has_days = history.iter().all(|past| past.days.is_some());
        let Some(per_day) = report.scene.traffic.per_day.filter(|_| has_days) else {
            return passes;
        };
        let begin = before.and_then(|past| past.days).unwrap_or(0.0);
        let days = begin + last as f64 / per_day;
        let is_many = |(unit, _): &(f64, &str)| days >= MIN_UNITS * unit;
        let (unit, name) = if is_linear {
            UNITS.into_iter().find(is_many).unwrap_or(UNITS[2])
        } else {
            (1.0, "time")
        };
        let (begin, each) = (begin / unit, 1.0 / (per_day * unit));
        Self {
            begin,
            each,
            unit: Some(unit),
            name,
            ..passes
        }
    }

    /// The title of a chart of `what` over this axis.
    pub fn title(&self, what: &str) -> String {
        let along = self.unit.map_or("passes", |_| "time");
        format!("{what} against {along}")
    }

    /// The axis, which ends with the last pass where it is not logarithmic.
    pub fn axis(&self) -> Axis {
        if self.is_linear {
            return Axis::linear(self.name).range(0.0, self.place(self.last));
        }
        let axis = Axis::logarithmic(self.name);
        if self.unit.is_none() {
            return axis;
        }
        // Ticks of time, from the end on as many as have room.
        let (apart, end) = ((self.last as f64).powf(LABEL), self.place(self.last));
        let mut ticks: Vec<(f64, &str)> = Vec::new();
        for (time, name) in TICKS.into_iter().rev().filter(|(time, _)| *time <= end) {
            if ticks.last().is_none_or(|(later, _)| later / time >= apart) {
                ticks.push((time, name));
            }
        }
        ticks.reverse();
        axis.ticks(ticks)
    }

    /// Where a pass is on the axis.
    pub fn place(&self, pass: u64) -> f64 {
        self.begin + self.each * pass as f64
    }

    /// `chart` with what the runs before have left of each of `ends`, and a line where this one begins.
    pub fn with_history(&self, chart: Chart, ends: &[CableEnd], quantity: Limited, unit: Unit) -> Chart {
        if self.history.is_empty() {
            return chart;
        }
        let point = |past: &PastPass, end: CableEnd| {
            let days = self.unit.zip(past.days);
            let place = days.map_or(past.pass as f64, |(unit, days)| days / unit);
            let left = end.of(quantity.of([past.force_n, past.displacement_m]));
            (place, unit.of_si(left))
        };
        let chart = lines(chart, ends, None, |end| {
            self.history.iter().map(move |past| point(past, end))
        });
        chart.refer(Reference::vertical(self.begin, ""))
    }

    /// A value after each pass.
    pub fn series(&self, passes: &[PassRecord], value: impl Fn(&PassRecord) -> f64) -> Vec<(f64, f64)> {
        let drawn = listed(passes.last().map_or(1, |record| record.pass));
        let is_drawn = |pass: u64| passes.len() <= ALL_DRAWN || drawn.binary_search(&pass).is_ok();
        let drawn = passes.iter().filter(|record| is_drawn(record.pass));
        let point = |record: &PassRecord| (self.place(record.pass), value(record));
        drawn.map(point).collect()
    }
}
