//! Day after day: some simulated, others jumped over, until each repeats the one before.

use std::collections::BTreeSet;

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome};

use super::cable::DailyCable;
use super::calendar::Calendar;
use super::day::{Act, Day};
use super::extremes::Extremes;
use super::law::LockedLaw;
use crate::error::{check, wrap};
use crate::record::left_by;
use crate::{Guide, JumpError, Jumps, Next, Record, Request, evolve, peaks};

/// What is wanted of a cable's days.
#[derive(Debug, Clone, Copy)]
pub struct DaysRequest<'a> {
    /// Passes in all.
    pub passes: u64,
    /// Passes to be recorded, from 1.
    pub wanted: &'a [u64],
    /// Days to be recorded, from 1.
    pub wanted_days: &'a [u64],
    /// Whether every day is simulated.
    pub every_day: bool,
    /// Jumps over days of another run.
    pub guide: Guide<'a>,
    /// The cable before the first day, if not as laid.
    pub start: Option<&'a CableState>,
}

/// The cable over all days.
#[derive(Debug, Clone)]
pub struct Days {
    /// The passes that were wanted.
    pub records: Vec<Record>,
    /// Other simulated passes that show a larger force or movement than all simulated ones of these
    /// before them.
    pub peaks: Vec<Record>,
    /// The days that were wanted, each with its number, from 1.
    pub days: Vec<(u64, Extremes)>,
    /// The last day in the order of time, after passes and steps of many passes.
    pub last_day: Vec<Row>,
    /// Over all days.
    pub extremes: Extremes,
    /// Movement of the cable as a whole from one day to the next, in the end \[m\].
    pub drift: f64,
    /// The day from which on every day repeats the one before but for the drift.
    pub periodic_from: Option<u64>,
    /// The cable on its last day when it was hottest, without its movement as a whole.
    pub hot: CableState,
    /// The same when it was coldest.
    pub cold: CableState,
    /// The same after the last pass.
    pub state: CableState,
    /// Passes simulated.
    pub simulated: u64,
    /// Days simulated.
    pub simulated_days: u64,
    /// Lengths of the jumps over days, 0 for a simulated day between.
    pub schedule: Vec<u64>,
    /// Linear solves of the whole cable in steps of many periods.
    pub sweeps: u64,
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
}

/// Takes `cable` on `mesh`, as laid, through days of traffic and heat: few passes simulated, each
/// by a call of `pass`, which finds the cable at the temperature of its moment. Where not every
/// pass of a `day` is simulated, the `law` carries the cable over the others. The periods of
/// `jumps` are days here, beside the first one.
///
/// # Errors
///
/// Those of `pass`; [`JumpError`] for a request without passes, if the cable finds no rest, or if
/// no day repeats the one before.
pub fn evolve_days<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    (day, law): (&Day, LockedLaw),
    jumps: &Jumps,
    request: &DaysRequest<'_>,
    pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Days, E> {
    check("passes", request.passes > 0, "at least one")?;
    let calendar = Calendar::new(day, request.passes);
    let daily = DailyCable::new(cable, mesh, &calendar, law, request.start, pass);
    let mut daily = daily.map_err(wrap)?;
    let state = daily.end.clone();
    let begin = PassOutcome::at_rest(cable, &state).map_err(wrap)?;
    let length = calendar.events.len() as u64;
    let order: Vec<usize> = (0..calendar.events.len()).collect();
    let parts = request.wanted.iter().filter_map(|pass| calendar.parts(*pass));
    let wanted: Vec<u64> = parts.flatten().map(|(number, _)| number).collect();
    let mut jumps = *jumps;
    let (jumping, most) = jumps.most_passes;
    jumps.most_passes = (jumping.saturating_mul(length), most.saturating_mul(length));
    if request.every_day {
        jumps.first_periods = u64::MAX;
    }
    let mut events = Request::new(calendar.last_number(), &order)?;
    (events.wanted, events.guide, events.start) = (&wanted, request.guide, Some(&state));
    // On the first day the cable is as laid: no later one is like that.
    events.first_passes = length;
    events.days = (!request.every_day).then_some(request.wanted_days);
    let evolution = evolve(cable, mesh, &jumps, &events, |next, state| {
        daily.happen(next, state)
    })?;
    let known = Known {
        calendar: &calendar,
        begin,
        records: &evolution.records,
    };
    let records = request.wanted.iter().filter_map(|pass| known.record(*pass));
    let records: Vec<Record> = records.collect();
    Ok(Days {
        peaks: known.peaks(&records),
        records,
        days: request
            .wanted_days
            .iter()
            .map(|&day| (day, known.extremes(day)))
            .collect(),
        last_day: known.rows(calendar.days()),
        extremes: Extremes::of(known.records.iter().map(|r| &r.outcome).chain([&known.begin])),
        drift: evolution.repeats.map_or(0.0, |(_, drift)| drift),
        periodic_from: evolution.repeats.map(|(days, _)| days + 1),
        hot: daily.hot,
        cold: daily.cold,
        state: daily.end,
        simulated: daily.simulated,
        simulated_days: known.simulated_days(),
        schedule: evolution.schedule,
        sweeps: daily.step.sweeps,
    })
}

/// What is known of the events of all days.
struct Known<'a> {
    calendar: &'a Calendar<'a>,
    /// The cable before the first day, at its temperature.
    begin: PassOutcome,
    /// Each with the number of its event, ascending.
    records: &'a [Record],
}

impl Known<'_> {
    fn event(&self, number: u64) -> Option<&Record> {
        let place = self.records.binary_search_by_key(&number, |record| record.pass);
        Some(&self.records[place.ok()?])
    }

    /// What a pass did, if it comes.
    fn record(&self, pass: u64) -> Option<Record> {
        let parts = self.calendar.parts(pass)?;
        let (like, others) = parts.split_last()?;
        let like = self.event(like.0)?;
        let at_rest = |(number, weight): &(u64, f64)| Some((*weight, left_by(&self.event(*number)?.outcome)));
        let at_rest: Vec<_> = others.iter().map(at_rest).collect::<Option<_>>()?;
        let at_rest = at_rest.iter().map(|(weight, outcome)| (*weight, outcome));
        let summands: Vec<_> = at_rest.chain([(1.0, &like.outcome)]).collect();
        let interpolated = summands.len() > 1;
        let outcome = if interpolated {
            PassOutcome::combined(&summands)
        } else {
            like.outcome.clone()
        };
        Some(Record {
            pass,
            outcome,
            interpolated: interpolated || like.interpolated,
        })
    }

    /// Simulated passes beside the `wanted` ones that show more.
    fn peaks(&self, wanted: &[Record]) -> Vec<Record> {
        let passes: BTreeSet<u64> = wanted.iter().map(|record| record.pass).collect();
        let simulated = wanted.iter().filter(|record| !record.interpolated);
        let other = |event: &Record| {
            let pass = self.calendar.pass(event.pass)?;
            let is_other = !event.interpolated && !passes.contains(&pass);
            is_other.then(|| Record {
                pass,
                ..event.clone()
            })
        };
        let others = self.records.iter().filter_map(other);
        peaks(&simulated.cloned().collect::<Vec<_>>(), others.collect())
    }

    fn simulated_days(&self) -> u64 {
        let first_of_day = |record: &&Record| (record.pass - 1) % self.calendar.events.len() as u64 == 0;
        let simulated = self.records.iter().filter(|record| !record.interpolated);
        simulated.filter(first_of_day).count() as u64
    }

    /// What is known of a day.
    fn of_day(&self, day: u64) -> &[Record] {
        let numbers = self.calendar.numbers(day);
        let place = |number: u64| self.records.partition_point(|record| record.pass < number);
        &self.records[place(numbers.start)..place(numbers.end)]
    }

    fn extremes(&self, day: u64) -> Extremes {
        let begin = (day == 1).then_some(&self.begin);
        let of_day = self.of_day(day).iter().map(|record| &record.outcome);
        Extremes::of(begin.into_iter().chain(of_day))
    }

    /// A day in the order of time.
    fn rows(&self, day: u64) -> Vec<Row> {
        let row = |record: &Record| {
            let event = self.calendar.event(record.pass);
            (event.act != Act::Warm).then(|| Row {
                passes: event.passes,
                thermal_force: event.thermal_force,
                outcome: record.outcome.clone(),
            })
        };
        self.of_day(day).iter().filter_map(row).collect()
    }
}
