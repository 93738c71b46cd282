//! Day after day: some simulated, others jumped over, until each repeats the one before.

use std::collections::BTreeSet;

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome};

use super::cable::DailyCable;
use super::calendar::{Calendar, Part};
use super::day::{Act, Day};
use super::extremes::Extremes;
use super::law::LockedLaw;
use crate::error::{check, wrap};
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
    mut pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Days, E> {
    check("passes", request.passes > 0, "at least one")?;
    let calendar = Calendar::new(day, request.passes);
    let last_day = calendar.numbers(calendar.days());
    let parts = request.wanted.iter().filter_map(|pass| calendar.parts(*pass));
    let wanted: Vec<u64> = parts
        .flatten()
        .map(|part| part.number)
        .chain(last_day.clone())
        .collect();
    let order: Vec<usize> = (0..calendar.events.len()).collect();
    let mut events = Request::new(calendar.count(), &order)?;
    (events.wanted, events.guide, events.start) = (&wanted, request.guide, request.start);
    events.days = (!request.every_day).then_some(request.wanted_days);
    let (jumping, most) = jumps.most_passes;
    let length = order.len() as u64;
    let mut jumps = *jumps;
    jumps.most_passes = (jumping.saturating_mul(length), most.saturating_mul(length));
    if request.every_day {
        jumps.first_periods = u64::MAX;
    }
    let mut daily = DailyCable::new(cable, mesh, &calendar, law, &mut pass).map_err(wrap)?;
    let evolution = evolve(cable, mesh, &jumps, &events, |next, state| {
        daily.happen(next, state)
    })?;

    let of_events = Known {
        calendar: &calendar,
        records: &evolution.records,
    };
    let records: Vec<Record> = request
        .wanted
        .iter()
        .filter_map(|pass| of_events.pass(*pass))
        .collect();
    let mut simulated = records.clone();
    simulated.retain(|record| !record.interpolated);
    let row = |record: &Record| {
        let event = &calendar.events[(record.pass - last_day.start) as usize];
        let row = Row {
            passes: event.passes,
            thermal_force: event.thermal_force,
            outcome: record.outcome.clone(),
        };
        (event.act != Act::Warm).then_some(row)
    };
    let extremes = |day: &u64| (*day, Extremes::of(of_events.of_day(*day)));
    Ok(Days {
        peaks: peaks(&simulated, of_events.others(request.wanted)),
        records,
        days: request.wanted_days.iter().map(extremes).collect(),
        last_day: of_events.of_day(calendar.days()).iter().filter_map(row).collect(),
        extremes: Extremes::of(&evolution.records),
        drift: evolution.repeats.map_or(0.0, |(_, drift)| drift),
        periodic_from: evolution.repeats.map(|(days, _)| days + 1),
        hot: daily.hot,
        cold: daily.cold,
        state: daily.last,
        simulated: daily.simulated,
        simulated_days: of_events.simulated_days(),
        schedule: evolution.schedule,
        sweeps: daily.step.sweeps,
    })
}

/// What is known of the events of all days.
struct Known<'a> {
    calendar: &'a Calendar<'a>,
    records: &'a [Record],
}

impl Known<'_> {
    fn of_day(&self, day: u64) -> &[Record] {
        let numbers = self.calendar.numbers(day);
        let [from, to] = [numbers.start, numbers.end]
            .map(|number| self.records.partition_point(|record| record.pass < number));
        &self.records[from..to]
    }

    /// Days that were simulated, the last one maybe in part.
    fn simulated_days(&self) -> u64 {
        let begins = |record: &&Record| self.calendar.place(record.pass) == 0 && !record.interpolated;
        self.records.iter().filter(begins).count() as u64
    }

    /// What `pass` did, if that is known.
    fn pass(&self, pass: u64) -> Option<Record> {
        let known = |number| {
            let place = self.records.binary_search_by_key(&number, |record| record.pass);
            Some(&self.records[place.ok()?])
        };
        let parts = self.calendar.parts(pass)?;
        if let [itself] = parts[..] {
            let record = known(itself.number)?.clone();
            return Some(Record { pass, ..record });
        }
        let outcome = |part: &Part| {
            let mut outcome = known(part.number)?.outcome.clone();
            if part.at_rest {
                (outcome.peak, outcome.lowest, outcome.dissipated) = (outcome.force, outcome.force, 0.0);
                outcome.restraint_ranges = outcome.restraints.iter().map(|force| [*force; 2]).collect();
            }
            Some(outcome)
        };
        let outcomes: Vec<_> = parts.iter().map(outcome).collect::<Option<_>>()?;
        let weights = parts.iter().map(|part| part.weight);
        let summands: Vec<_> = weights.zip(&outcomes).collect();
        Some(Record {
            pass,
            outcome: PassOutcome::combined(&summands),
            interpolated: true,
        })
    }

    /// Simulated passes that are not `wanted`.
    fn others(&self, wanted: &[u64]) -> Vec<Record> {
        let wanted: BTreeSet<u64> = wanted.iter().copied().collect();
        let other = |record: &Record| {
            let pass = self.calendar.pass(record.pass)?;
            let is_other = !record.interpolated && !wanted.contains(&pass);
            is_other.then(|| Record {
                pass,
                ..record.clone()
            })
        };
        self.records.iter().filter_map(other).collect()
    }
}
