//! Day after day: some simulated, others jumped over, until each repeats the one before.

use std::collections::BTreeMap;

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome};

use super::cable::DailyCable;
use super::calendar::Calendar;
use super::day::{Act, Day};
use super::extremes::Extremes;
use super::law::LockedLaw;
use crate::error::{check, wrap};
use crate::{Evolution, JumpError, Jumps, Next, Record, Request, evolve};

/// The cable over all days.
#[derive(Debug, Clone)]
pub struct Days {
    /// The passes that were wanted, and all others that were simulated: candidates for
    /// [`peaks`](crate::peaks). Its periods are days; its state leaves out the movement as a whole.
    pub evolution: Evolution,
    /// The days that were wanted, each with its number, from 1.
    pub days: Vec<(u64, Extremes)>,
    /// The last day in the order of time, after passes and steps of many passes.
    pub last_day: Vec<Row>,
    /// Over all days.
    pub extremes: Extremes,
    /// The cable on its last simulated day when it was hottest, without its movement as a whole.
    pub hot: CableState,
    /// The same when it was coldest.
    pub cold: CableState,
    /// Days simulated, the last one maybe in part.
    pub simulated: u64,
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
/// `jumps` are days here: with [`u64::MAX`] of them at the start every day is simulated. Of the
/// `request` nothing beyond the last pass is followed, and no pass is looked at.
///
/// # Errors
///
/// Those of `pass` and of [`evolve`]; [`JumpError::InvalidParameter`] for a request without passes or
/// with another period than that of the day.
pub fn evolve_days<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    (day, law): (&Day, LockedLaw),
    jumps: &Jumps,
    request: &Request<'_>,
    mut pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Days, E> {
    check("passes", request.passes > 0, "at least one")?;
    let is_of_day = request.period() == day.period();
    check("vehicles of a period", is_of_day, "those of the day's")?;
    let calendar = Calendar::new(day, request.passes);
    let last_day = calendar.numbers(calendar.days);
    let parts = request.wanted.iter().filter_map(|pass| calendar.parts(*pass));
    let numbers = parts.flatten().map(|(number, _)| number);
    let wanted: Vec<u64> = numbers.chain(last_day).collect();
    let order: Vec<usize> = (0..calendar.events.len()).collect();
    let mut events = Request::new(calendar.count, &order)?;
    (events.wanted, events.guide, events.start) = (&wanted, request.guide, request.start);
    events.days = request.days.or(Some(&[]));
    let (jumping, most) = jumps.most_passes;
    let in_events = |days: u64| days.saturating_mul(order.len() as u64);
    let mut jumps = *jumps;
    jumps.most_passes = (in_events(jumping), in_events(most));
    let mut daily = DailyCable::new(cable, mesh, &calendar, law, &mut pass).map_err(wrap)?;
    let happen = |next: Next, state: &mut CableState| daily.happen(next, state);
    let evolution = evolve(cable, mesh, &jumps, &events, happen)?;

    let happened = Happened {
        calendar: &calendar,
        records: &evolution.records,
    };
    let extremes = |day: &u64| (*day, Extremes::of(happened.on(*day)));
    Ok(Days {
        days: request.days.unwrap_or(&[]).iter().map(extremes).collect(),
        last_day: happened.rows(calendar.days),
        extremes: Extremes::of(&evolution.records),
        hot: daily.hot,
        cold: daily.cold,
        simulated: happened.simulated_days(),
        sweeps: daily.step.sweeps,
        evolution: Evolution {
            records: happened.passes(request.wanted),
            state: daily.last,
            simulated: daily.simulated,
            ..evolution
        },
    })
}

/// What is known of the events of all days.
struct Happened<'a> {
    calendar: &'a Calendar<'a>,
    records: &'a [Record],
}

impl Happened<'_> {
    /// The events of a `day`.
    fn on(&self, day: u64) -> &[Record] {
        let numbers = self.calendar.numbers(day);
        let place = |number| self.records.partition_point(|record| record.pass < number);
        &self.records[place(numbers.start)..place(numbers.end)]
    }

    /// The events of a `day` but for changes of temperature.
    fn rows(&self, day: u64) -> Vec<Row> {
        let row = |record: &Record| {
            let event = &self.calendar.events[self.calendar.place(record.pass)];
            (event.act != Act::Warm).then(|| Row {
                passes: event.passes,
                thermal_force: event.thermal_force,
                outcome: record.outcome.clone(),
            })
        };
        self.on(day).iter().filter_map(row).collect()
    }

    fn simulated_days(&self) -> u64 {
        let begins = |record: &&Record| self.calendar.place(record.pass) == 0 && !record.interpolated;
        self.records.iter().filter(begins).count() as u64
    }

    /// Passes that were simulated and those that are `wanted`, as far as they are known.
    fn passes(&self, wanted: &[u64]) -> Vec<Record> {
        let simulated = self.records.iter().filter(|record| !record.interpolated);
        let simulated = simulated.filter_map(|record| {
            let pass = self.calendar.pass(record.pass)?;
            Some(Record {
                pass,
                ..record.clone()
            })
        });
        let wanted = wanted.iter().filter_map(|pass| self.pass(*pass));
        let all = simulated.chain(wanted).map(|record| (record.pass, record));
        all.collect::<BTreeMap<_, _>>().into_values().collect()
    }

    /// What `pass` did, if that is known.
    fn pass(&self, pass: u64) -> Option<Record> {
        let known = |(number, weight): &(u64, f64)| {
            let place = self.records.binary_search_by_key(number, |record| record.pass);
            Some((*weight, self.records[place.ok()?].clone()))
        };
        let parts = self.calendar.parts(pass)?;
        let mut parts: Vec<(f64, Record)> = parts.iter().map(known).collect::<Option<_>>()?;
        let (_, like) = parts.pop()?;
        if parts.is_empty() {
            return Some(Record { pass, ..like });
        }
        for (_, Record { outcome, .. }) in &mut parts {
            (outcome.peak, outcome.lowest, outcome.dissipated) = (outcome.force, outcome.force, 0.0);
            outcome.restraint_ranges = outcome.restraints.iter().map(|force| [*force; 2]).collect();
        }
        let mut summands: Vec<_> = parts
            .iter()
            .map(|(weight, part)| (*weight, &part.outcome))
            .collect();
        summands.push((1.0, &like.outcome));
        Some(Record {
            pass,
            outcome: PassOutcome::combined(&summands),
            interpolated: true,
        })
    }
}
