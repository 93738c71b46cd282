//! Day after day: some simulated, others jumped over, until each repeats the one before.

use std::collections::BTreeMap;

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome, laid};

use super::cable::DailyCable;
use super::day::{Act, Day, Event, Part};
use super::extremes::Extremes;
use super::law::LockedLaw;
use crate::error::{check, wrap};
use crate::{Evolution, Guide, JumpError, Jumps, Next, Record, Request, evolve, peaks};

/// What is wanted of a cable's days.
#[derive(Debug, Clone, Copy)]
pub struct DaysRequest<'a> {
    /// Passes in all.
    pub passes: u64,
    /// Passes to be recorded, ascending, from 1 to the last.
    pub wanted: &'a [u64],
    /// Days to be recorded, ascending, from 1.
    pub wanted_days: &'a [u64],
    /// Whether every day is simulated.
    pub every_day: bool,
    /// Jumps over days of another run.
    pub guide: Guide<'a>,
}

/// The cable over all days.
#[derive(Debug, Clone)]
pub struct Days {
    /// The passes that were wanted.
    pub records: Vec<Record>,
    /// Other simulated passes that show a larger force or movement than all simulated ones of these
    /// before them.
    pub peaks: Vec<Record>,
    /// The days that were wanted.
    pub days: Vec<DayRecord>,
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
}

/// Takes `cable` on `mesh`, as laid, through days of traffic and heat: few passes simulated, each by a
/// call of `pass`, which finds the cable at the temperature of its moment. Where not every pass of a
/// `day` is simulated, the `law` carries the cable over the others. The movements below which `jumps`
/// take the cable to rest and its numbers of passes are those of days.
///
/// # Errors
///
/// Those of `pass`; [`JumpError`] for a request that makes no sense, if the cable finds no rest, or if
/// no day repeats the one before.
pub fn evolve_days<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    (day, law): (&Day, LockedLaw),
    jumps: &Jumps,
    request: &DaysRequest<'_>,
    pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Days, E> {
    let calendar = Calendar::new(day, request)?;
    let mut run = Run {
        calendar: &calendar,
        cable: DailyCable::new(cable, mesh, day, law, pass).map_err(wrap)?,
        log: BTreeMap::new(),
        simulated_days: 0,
        end: None,
    };
    let mut state = laid(cable, mesh).map_err(wrap)?;
    run.day(1, &mut state, 0.0)?;
    let (mut repeats, mut schedule) = (None, Vec::new());
    if calendar.days > 1 {
        let act = |next: Next, state: &mut CableState| {
            let day = next.number.map(|number| calendar.place(number).0);
            run.happen(day, next.phase, state)
        };
        let later = between_days(cable, mesh, &calendar, jumps, request, &state, act)?;
        for record in later.records.into_iter().chain(later.others) {
            let place = calendar.place(record.pass);
            run.log.insert(place, record);
        }
        (state, repeats, schedule) = (later.state, later.repeats, later.schedule);
        run.day(calendar.days, &mut state, later.offset)?;
    }
    let Run {
        cable,
        log,
        simulated_days,
        end,
        ..
    } = run;
    let known = request
        .wanted
        .iter()
        .filter_map(|pass| calendar.record(&log, *pass));
    let records: Vec<Record> = known.collect();
    let simulated = records.iter().filter(|record| !record.interpolated);
    let outcomes = |log: &mut dyn Iterator<Item = (&(u64, usize), &Record)>| {
        Extremes::of(log.map(|(_, record)| &record.outcome))
    };
    let day_record = |&day: &u64| DayRecord {
        day,
        extremes: outcomes(&mut log.range((day, 0)..(day + 1, 0))),
    };
    Ok(Days {
        peaks: peaks(
            &simulated.cloned().collect::<Vec<_>>(),
            calendar.others(&log, request.wanted),
        ),
        records,
        days: request.wanted_days.iter().map(day_record).collect(),
        last_day: calendar.last_day(&log),
        extremes: outcomes(&mut log.iter()),
        drift: repeats.map_or(0.0, |(_, drift)| drift),
        periodic_from: repeats.map(|(days, _)| days + 2),
        hot: cable.hot.unwrap_or_else(|| state.clone()),
        cold: cable.cold.unwrap_or_else(|| state.clone()),
        state: end.unwrap_or(state),
        simulated: cable.simulated,
        simulated_days,
        schedule,
        sweeps: cable.step.sweeps,
    })
}

/// The days between the first one, which left the cable in `state`, and the last one: periods of
/// events.
fn between_days<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    calendar: &Calendar<'_>,
    jumps: &Jumps,
    request: &DaysRequest<'_>,
    state: &CableState,
    act: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Evolution, E> {
    let length = calendar.between.len() as u64;
    let mut wanted = Vec::new();
    for &pass in request.wanted {
        let (day, parts) = calendar.parts(pass);
        let is_between = 1 < day && day < calendar.days;
        let number = |part: Part| (day - 2) * length + part.place as u64 + 1;
        wanted.extend(parts.into_iter().filter(|_| is_between).map(number));
    }
    wanted.sort_unstable();
    wanted.dedup();
    let days = request
        .wanted_days
        .iter()
        .filter(|day| **day > 1)
        .map(|day| day - 1);
    let days: Vec<u64> = days.collect();
    let (jumping, most) = jumps.most_passes;
    let mut jumps = jumps.with_most_passes(jumping.saturating_mul(length), most.saturating_mul(length));
    if request.every_day {
        jumps.first_periods = u64::MAX;
    }
    let order: Vec<usize> = (0..calendar.between.len()).collect();
    let mut events = Request::new((calendar.days - 2) * length, &order)?
        .with_wanted(&wanted)?
        .with_guide(request.guide);
    events.start = Some(state);
    events.days = (!request.every_day).then_some(&days);
    evolve(cable, mesh, &jumps, &events, act)
}

/// A run under way.
struct Run<'a, P> {
    calendar: &'a Calendar<'a>,
    cable: DailyCable<'a, P>,
    log: Log,
    simulated_days: u64,
    /// The cable after the last pass.
    end: Option<CableState>,
}

/// What is known of the events, by their day and their place in it.
type Log = BTreeMap<(u64, usize), Record>;

impl<E, P> Run<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    /// Simulates a whole `day` of a cable that was moved as a whole by `offset` \[m\].
    fn day(&mut self, day: u64, state: &mut CableState, offset: f64) -> Result<(), E> {
        for place in 0..self.calendar.events(day).len() {
            let record = Record {
                pass: 0,
                outcome: self.happen(Some(day), place, state)?.moved(offset),
                interpolated: false,
            };
            self.log.insert((day, place), record);
        }
        Ok(())
    }

    /// Lets an event happen: one of a `day`, or one between days that only measures.
    fn happen(&mut self, day: Option<u64>, place: usize, state: &mut CableState) -> Result<PassOutcome, E> {
        let calendar = self.calendar;
        let event = day.map_or(&calendar.between[..], |day| calendar.events(day))[place];
        if place == 0 {
            self.cable.begin_day();
            self.simulated_days += u64::from(day.is_some());
        }
        let pass = day.and_then(|day| calendar.pass(day, place));
        let outcome = self.cable.happen(&event, pass, state)?;
        if pass == Some(calendar.passes) {
            self.end = Some(state.clone());
        }
        Ok(outcome)
    }
}

/// The events of all days: those of the first, of the last, and of each between them.
struct Calendar<'a> {
    day: &'a Day,
    passes: u64,
    days: u64,
    first: Vec<Event>,
    between: Vec<Event>,
    last: Vec<Event>,
}

impl<'a> Calendar<'a> {
    fn new(day: &'a Day, request: &DaysRequest<'_>) -> Result<Self, JumpError> {
        let passes = request.passes;
        check("passes", passes > 0, "at least one")?;
        let days = passes.div_ceil(day.passes());
        let is_within = |numbers: &[u64], most: u64| {
            let all = (1..=most).contains(numbers.first().unwrap_or(&1));
            all && numbers.last().is_none_or(|last| *last <= most) && numbers.is_sorted_by(|a, b| a < b)
        };
        let allowed = "ascending, from 1 to the last";
        check("wanted passes", is_within(request.wanted, passes), allowed)?;
        check("wanted days", is_within(request.wanted_days, days), allowed)?;
        let of_last = passes - (days - 1) * day.passes();
        Ok(Self {
            day,
            passes,
            days,
            first: day.events(if days == 1 { of_last } else { day.passes() }, true),
            between: day.events(day.passes(), false),
            last: day.events(of_last, false),
        })
    }

    fn events(&self, day: u64) -> &[Event] {
        match day {
            1 => &self.first,
            day if day == self.days => &self.last,
            _ => &self.between,
        }
    }

    /// The day and the place of an event between the first and the last day, from its number.
    fn place(&self, number: u64) -> (u64, usize) {
        let length = self.between.len() as u64;
        (2 + (number - 1) / length, ((number - 1) % length) as usize)
    }

    /// The number of the pass that an event is.
    fn pass(&self, day: u64, place: usize) -> Option<u64> {
        let event = &self.events(day)[place];
        matches!(event.act, Act::Pass(_)).then_some((day - 1) * self.day.passes() + event.passes)
    }

    /// The day of a pass, and the summands of its outcome.
    fn parts(&self, pass: u64) -> (u64, Vec<Part>) {
        let day = (pass - 1) / self.day.passes() + 1;
        let of_day = pass - (day - 1) * self.day.passes();
        let parts = self.day.parts(self.events(day), of_day);
        (day, parts.unwrap_or_default())
    }

    /// What `pass` did.
    fn record(&self, log: &Log, pass: u64) -> Option<Record> {
        let (day, parts) = self.parts(pass);
        if let [simulated] = parts[..] {
            let record = log.get(&(day, simulated.place))?.clone();
            return Some(Record { pass, ..record });
        }
        let outcome = |part: &Part| {
            let mut outcome = log.get(&(day, part.place))?.outcome.clone();
            if part.at_rest {
                (outcome.peak, outcome.lowest, outcome.dissipated) = (outcome.force, outcome.force, 0.0);
            }
            Some((part.weight, outcome))
        };
        let outcomes: Vec<_> = parts.iter().map(outcome).collect::<Option<_>>()?;
        let summands: Vec<_> = outcomes
            .iter()
            .map(|(weight, outcome)| (*weight, outcome))
            .collect();
        Some(Record {
            pass,
            outcome: PassOutcome::combined(&summands),
            interpolated: true,
        })
    }

    /// Simulated passes that are not `wanted`.
    fn others(&self, log: &Log, wanted: &[u64]) -> Vec<Record> {
        let other = |(&(day, place), record): (&(u64, usize), &Record)| {
            let pass = self.pass(day, place).filter(|_| !record.interpolated)?;
            let record = Record {
                pass,
                ..record.clone()
            };
            wanted.binary_search(&pass).is_err().then_some(record)
        };
        log.iter().filter_map(other).collect()
    }

    /// The last day in the order of time.
    fn last_day(&self, log: &Log) -> Vec<Row> {
        let events = self.events(self.days).iter().enumerate();
        let row = |(place, event): (usize, &Event)| {
            let record = log.get(&(self.days, place)).filter(|_| event.act != Act::Warm)?;
            Some(Row {
                passes: event.passes,
                thermal_force: event.thermal_force,
                outcome: record.outcome.clone(),
            })
        };
        events.filter_map(row).collect()
    }
}
