//! How figures stand on the page: narrow, so that their text is still legible on a phone.

use super::content::Report;
use super::ends;
use super::html::Html;
use super::quantity::significant;
use crate::answer::listed;
use crate::figure::{Axis, Chart, Panels, Reference};
use crate::scene::DAYS_PER_YEAR;
use crate::{CableEnd, PassRecord, PastPass};

/// Width of a figure, and height of a chart alone, of one of several, and of one of several with legends \[px\].
pub const WIDTH: f64 = 440.0;
const ALONE: f64 = 330.0;
const STACKED: f64 = 250.0;
const WITH_LEGENDS: f64 = 300.0;
/// Passes beyond which their axis is logarithmic.
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

/// Metres to millimetres, and to micrometres, in which the duct moves.
pub const MILLI: f64 = 1e3;
pub const MICRO: f64 = 1e6;

/// Writes charts below each other with a caption, or why they could not be drawn.
pub fn figure(html: &mut Html, charts: impl IntoIterator<Item = Chart>, caption: &str) {
    let charts: Vec<Chart> = charts.into_iter().collect();
    let height = if charts.len() == 1 { ALONE } else { STACKED };
    of_height(html, charts, height, caption);
}

/// The same of charts with legends, which take room.
pub fn with_legends(html: &mut Html, charts: impl IntoIterator<Item = Chart>, caption: &str) {
    of_height(html, charts.into_iter().collect(), WITH_LEGENDS, caption);
}

fn of_height(html: &mut Html, charts: Vec<Chart>, height: f64, caption: &str) {
    let panels = Panels::new("").panel_size(WIDTH, height);
    match charts.into_iter().fold(panels, Panels::with).to_svg() {
        Ok(svg) => html.figure(&svg, caption),
        Err(error) => html.paragraph(&format!("A figure could not be drawn: {error}. {caption}")),
    }
}

/// How many parts an axis along the duct may have, and the leading digits of a round one.
const PARTS: [f64; 3] = [5.0, 4.0, 3.0];
const ROUND: [f64; 9] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
/// Least part beside the end of the duct, as a share of the others.
const LEAST_PART: f64 = 0.7;

/// Places along a duct of this length in any unit with their labels, the last one its end: in round parts that are all alike where there are such.
pub fn ticks(length: f64) -> Vec<(f64, String)> {
    let power = |part: f64| 10_f64.powf(part.log10().floor());
    let is_round = |part: &f64| {
        let leading = part / power(*part);
        ROUND.iter().any(|round| (leading / round - 1.0).abs() < 1e-9)
    };
    let mut parts = PARTS.iter().map(|parts| length / parts);
    let part = parts.find(is_round).unwrap_or_else(|| {
        let least = length / PARTS[1];
        let above = ROUND.iter().map(|round| round * power(least));
        above
            .into_iter()
            .find(|part| *part >= least)
            .unwrap_or(10.0 * power(least))
    });
    let inside = |k: &u32| part * f64::from(*k) <= length - LEAST_PART * part;
    let places = (0..=PARTS[0] as u32).filter(inside).map(|k| part * f64::from(k));
    places
        .chain([length])
        .map(|place| (place, significant(place)))
        .collect()
}

/// The axis along the duct.
pub fn along_duct(report: &Report) -> Axis {
    let Report { scene, shown, .. } = report;
    let length = shown.units.length.of_si(scene.duct.length);
    Axis::linear(shown.in_length("place along the duct"))
        .range(0.0, length)
        .ticks(ticks(length))
}

/// Passes along an axis, or the time that they take where it is known; those of runs before come first.
pub struct Passes<'r> {
    per_day: Option<f64>,
    last: u64,
    /// What the runs before have left.
    history: &'r [PastPass],
}

impl<'r> Passes<'r> {
    /// The passes of a report up to `last`.
    pub fn new(report: &'r Report, last: u64) -> Self {
        let history = &report.history[..];
        let has_days = history.iter().all(|past| past.days.is_some());
        Self {
            per_day: report.scene.traffic.per_day.filter(|_| has_days),
            last,
            history,
        }
    }

    /// Passes and days of the runs before.
    fn before(&self) -> (u64, f64) {
        let last = self.history.last();
        last.map_or((0, 0.0), |past| (past.pass, past.days.unwrap_or(0.0)))
    }

    fn days(&self) -> Option<f64> {
        Some(self.before().1 + self.last as f64 / self.per_day?)
    }

    /// Whether the axis is linear: that of few passes, and of a life in parts.
    fn is_linear(&self) -> bool {
        self.last <= MANY || !self.history.is_empty()
    }

    /// The unit of time \[days\] and its name.
    fn unit(&self) -> Option<(f64, &'static str)> {
        let days = self.days()?;
        if !self.is_linear() {
            return Some((1.0, "time"));
        }
        let unit = UNITS.into_iter().find(|(unit, _)| days >= FEWEST * unit);
        unit.or(UNITS.last().copied())
    }

    /// The title of a chart of `what` over this axis.
    pub fn title(&self, what: &str) -> String {
        let along = self.per_day.map_or("passes", |_| "time");
        format!("{what} against {along}")
    }

    /// The axis, which ends with the last pass where it is not logarithmic.
    pub fn axis(&self) -> Axis {
        let unit = self.unit();
        let name = unit.map_or("passes", |(_, name)| name);
        match unit {
            _ if self.is_linear() => Axis::linear(name).range(0.0, self.place(self.last)),
            None => Axis::logarithmic(name),
            Some(_) => Axis::logarithmic(name).ticks(self.ticks()),
        }
    }

    /// Ticks of a logarithmic axis of time, from its end on as many as have room.
    fn ticks(&self) -> Vec<(f64, &'static str)> {
        let apart = (self.last as f64).powf(LABEL);
        let mut ticks: Vec<(f64, &str)> = Vec::new();
        for (time, name) in TICKS.into_iter().rev() {
            let inside = self.days().is_some_and(|days| time <= days);
            if inside && ticks.last().is_none_or(|(later, _)| later / time >= apart) {
                ticks.push((time, name));
            }
        }
        ticks.reverse();
        ticks
    }

    /// Where a pass is on the axis.
    pub fn place(&self, pass: u64) -> f64 {
        let (before, days) = self.before();
        let days = self.per_day.map(|per_day| days + pass as f64 / per_day);
        self.place_of(before + pass, days)
    }

    /// Where a pass of all runs is, so many days after the first if they are known.
    fn place_of(&self, pass: u64, days: Option<f64>) -> f64 {
        let unit = self.unit().zip(days);
        unit.map_or(pass as f64, |((unit, _), days)| days / unit)
    }

    /// `chart` with what the runs before have left of each of `ends`, and a line where this one begins.
    pub fn with_history(
        &self,
        chart: Chart,
        ends: &[CableEnd],
        value: impl Fn(&PastPass, CableEnd) -> f64 + Copy,
    ) -> Chart {
        if self.history.is_empty() {
            return chart;
        }
        let place = |past: &PastPass| self.place_of(past.pass, past.days);
        let chart = ends::lines(chart, ends, None, |end| {
            let history = self.history.iter();
            history.map(move |past| (place(past), value(past, end)))
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
