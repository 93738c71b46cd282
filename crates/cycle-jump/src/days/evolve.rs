//! Day after day: some simulated, others jumped over, until each repeats the one before.

use std::collections::{BTreeMap, BTreeSet};

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome, laid};

use super::cable::DailyCable;
use super::day::{Act, Day, Event};
use super::extremes::Extremes;
use super::law::LockedLaw;
use super::part::{Part, parts};
use crate::error::{check, wrap};
use crate::{Evolution, Guide, JumpError, Jumps, Next, Record, Request, evolve, peaks};

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
/// `jumps` are days here.
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
    let mut state = request
        .start
        .cloned()
        .map_or_else(|| laid(cable, mesh), Ok)
        .map_err(wrap)?;
    let (passes, a_day) = (request.passes, day.passes());
    let days = passes.div_ceil(a_day);
    let of_last = passes - (days - 1) * a_day;
    let mut run = Run {
        day,
        passes,
        days,
        first: day.events(if days == 1 { of_last } else { a_day }, true),
        between: day.events(a_day, false),
        last: day.events(of_last, false),
        cable: DailyCable::new(cable, mesh, day, law, pass).map_err(wrap)?,
        log: BTreeMap::new(),
        simulated_days: 0,
        end: state.clone(),
    };
    run.day(1, &mut state, 0.0)?;
    let (mut repeats, mut schedule) = (None, Vec::new());
    if run.days > 1 {
        let evolution = run.days_between(cable, mesh, jumps, request, &state)?;
        for record in evolution.records {
            let place = run.place(record.pass);
            run.log.insert(place, record);
        }
        (state, repeats, schedule) = (evolution.state, evolution.repeats, evolution.schedule);
        run.day(run.days, &mut state, evolution.offset)?;
    }
    Ok(run.answer(request, state, repeats, schedule))
}

/// A run under way.
struct Run<'a, P> {
    day: &'a Day,
    passes: u64,
    days: u64,
    /// Events of the first day, of the last one, and of each between them.
    first: Vec<Event>,
    last: Vec<Event>,
    between: Vec<Event>,
    cable: DailyCable<'a, P>,
    /// What is known of the events, by their day and their place in it.
    log: BTreeMap<(u64, usize), Record>,
    simulated_days: u64,
    /// The cable after the last pass.
    end: CableState,
}

impl<P> Run<'_, P> {
    /// What `pass` did, if that is known.
    fn record(&self, pass: u64) -> Option<Record> {
        let (day, parts) = self.parts(pass);
        if let [simulated] = parts[..] {
            let record = self.log.get(&(day, simulated.place))?.clone();
            return Some(Record { pass, ..record });
        }
        let outcome = |part: &Part| {
            let mut outcome = self.log.get(&(day, part.place))?.outcome.clone();
            if part.at_rest {
                (outcome.peak, outcome.lowest, outcome.dissipated) = (outcome.force, outcome.force, 0.0);
                outcome.restraint_ranges = outcome.restraints.iter().map(|force| [*force; 2]).collect();
            }
            Some((part.weight, outcome))
        };
        let outcomes: Vec<_> = parts.iter().map(outcome).collect::<Option<_>>()?;
        outcomes.first()?;
        let summands: Vec<_> = outcomes
            .iter()
            .map(|(weight, outcome)| (*weight, outcome))
            .collect();
        let outcome = PassOutcome::combined(&summands);
        Some(Record {
            pass,
            outcome,
            interpolated: true,
        })
    }

    /// Simulated passes that are not `wanted`.
    fn others(&self, wanted: &[u64]) -> Vec<Record> {
        let wanted: BTreeSet<u64> = wanted.iter().copied().collect();
        let other = |(&(day, place), record): (&(u64, usize), &Record)| {
            let pass = self.pass(day, place)?;
            let is_other = !record.interpolated && !wanted.contains(&pass);
            is_other.then(|| Record {
                pass,
                ..record.clone()
            })
        };
        self.log.iter().filter_map(other).collect()
    }

    /// The last day in the order of time.
    fn last_day(&self) -> Vec<Row> {
        let day = self.days;
        let events = self.events(day).iter().enumerate();
        let row = |(place, event): (usize, &Event)| {
            let record = self.log.get(&(day, place)).filter(|_| event.act != Act::Warm)?;
            Some(Row {
                passes: event.passes,
                thermal_force: event.thermal_force,
                outcome: record.outcome.clone(),
            })
        };
        events.filter_map(row).collect()
    }

    /// All that is wanted of the days, which left the cable in `state`.
    fn answer(
        self,
        request: &DaysRequest<'_>,
        state: CableState,
        repeats: Option<(u64, f64)>,
        schedule: Vec<u64>,
    ) -> Days {
        let records: Vec<Record> = request
            .wanted
            .iter()
            .filter_map(|pass| self.record(*pass))
            .collect();
        let simulated = records.iter().filter(|record| !record.interpolated);
        let simulated: Vec<Record> = simulated.cloned().collect();
        let extremes = |&day: &u64| {
            let of_day = self.log.range((day, 0)..=(day, usize::MAX));
            (day, Extremes::of(of_day.map(|(_, record)| &record.outcome)))
        };
        Days {
            peaks: peaks(&simulated, self.others(request.wanted)),
            records,
            days: request.wanted_days.iter().map(extremes).collect(),
            last_day: self.last_day(),
            extremes: Extremes::of(self.log.values().map(|record| &record.outcome)),
            drift: repeats.map_or(0.0, |(_, drift)| drift),
            periodic_from: repeats.map(|(days, _)| days + 2),
            hot: self.cable.hot.unwrap_or_else(|| state.clone()),
            cold: self.cable.cold.unwrap_or(state),
            state: self.end,
            simulated: self.cable.simulated,
            simulated_days: self.simulated_days,
            schedule,
            sweeps: self.cable.step.sweeps,
        }
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

    /// The day of a pass, and the summands of its outcome: none of a pass that does not come.
    fn parts(&self, pass: u64) -> (u64, Vec<Part>) {
        if !(1..=self.passes).contains(&pass) {
            return (0, Vec::new());
        }
        let before = (pass - 1) / self.day.passes();
        let of_day = pass - before * self.day.passes();
        (
            before + 1,
            parts(self.events(before + 1), of_day, self.day.period()),
        )
    }
}

impl<E, P> Run<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    /// Simulates a whole `day` of a cable that was moved as a whole by `offset` \[m\].
    fn day(&mut self, day: u64, state: &mut CableState, offset: f64) -> Result<(), E> {
        for place in 0..self.events(day).len() {
            let record = Record {
                pass: 0,
                outcome: self.happen(Some(day), place, state)?.moved(offset),
                interpolated: false,
            };
            self.log.insert((day, place), record);
        }
        Ok(())
    }

    /// The days between the first one, which left the cable in `state`, and the last one: periods
    /// of events.
    fn days_between(
        &mut self,
        cable: &DuctedCable,
        mesh: &Mesh,
        jumps: &Jumps,
        request: &DaysRequest<'_>,
        state: &CableState,
    ) -> Result<Evolution, E> {
        let days = self.days;
        let length = self.between.len() as u64;
        let mut wanted = Vec::new();
        for (day, parts) in request.wanted.iter().map(|pass| self.parts(*pass)) {
            let parts = parts.iter().filter(|_| 1 < day && day < days);
            wanted.extend(parts.map(|part| (day - 2) * length + part.place as u64 + 1));
        }
        let wanted_days = request.wanted_days.iter().filter(|day| **day > 1);
        let wanted_days: Vec<u64> = wanted_days.map(|day| day - 1).collect();
        let (jumping, most) = jumps.max_passes;
        let mut jumps = jumps.with_max_passes(jumping.saturating_mul(length), most.saturating_mul(length));
        if request.every_day {
            jumps.first_periods = u64::MAX;
        }
        let order: Vec<usize> = (0..length as usize).collect();
        let mut events = Request::new((days - 2) * length, &order)?;
        (events.wanted, events.guide, events.start) = (&wanted, request.guide, Some(state));
        events.days = (!request.every_day).then_some(&wanted_days);
        evolve(cable, mesh, &jumps, &events, |next, state| {
            let day = next.number.map(|number| self.place(number).0);
            self.happen(day, next.phase, state)
        })
    }

    /// Lets an event happen: one of a `day`, or one between days that only measures.
    fn happen(&mut self, day: Option<u64>, place: usize, state: &mut CableState) -> Result<PassOutcome, E> {
        if place == 0 {
            self.cable.begin_day();
            self.simulated_days += u64::from(day.is_some());
        }
        let event = day.map_or(&self.between[..], |day| self.events(day))[place];
        let pass = day.and_then(|day| self.pass(day, place));
        let outcome = self.cable.happen(&event, pass, state)?;
        if pass == Some(self.passes) {
            self.end.clone_from(state);
        }
        Ok(outcome)
    }
}
