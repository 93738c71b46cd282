//! Day after day: some simulated, others jumped over, until each is like the one before.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome, laid};

use super::cable::DailyCable;
use super::day::{Act, Day, Event, Known, known};
use super::extremes::Extremes;
use super::law::LockedLaw;
use super::rate::RateStep;
use crate::error::wrap;
use crate::peaks::peaks;
use crate::record::Record;
use crate::{Guide, JumpError, Jumps, Next, Request, evolve};

/// Days simulated after the first one, before any is jumped over.
const FIRST_DAYS: u64 = 3;

/// What is wanted of a cable's days.
#[derive(Debug, Clone, Copy)]
pub struct DaysRequest<'a> {
    /// Passes in all.
    pub passes: u64,
    /// Passes to be recorded, ascending.
    pub wanted: &'a [u64],
    /// Days to be recorded, ascending, from 1.
    pub wanted_days: &'a [u64],
    /// Error that jumps over days may have, as a share of the largest force and movement.
    pub tolerance: f64,
    /// Length of the first jump, as a share of the days before it.
    pub first_jump: f64,
    /// Length over which the duct's motion changes \[m\].
    pub length_scale: f64,
    /// Force \[N\] and movement \[m\] below which all is nothing.
    pub least: (f64, f64),
    /// Whether every day is simulated.
    pub every_day: bool,
    /// Days after which no more are jumped over, and after which the run gives up.
    pub most_days: (u64, u64),
    /// Jumps of another run.
    pub guide: Guide<'a>,
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
    /// Whether only the temperature has changed since the last pass.
    pub heat: bool,
}

/// The cable over all days.
#[derive(Debug, Clone)]
pub struct Days {
    /// The passes that were wanted.
    pub records: Vec<Record>,
    /// Other simulated passes that show a larger force or movement than all simulated ones of these before them.
    pub peaks: Vec<Record>,
    /// The days that were wanted.
    pub days: Vec<DayRecord>,
    /// The last one in the order of time.
    pub last_day: Vec<Row>,
    /// Over all days.
    pub extremes: Extremes,
    /// Movement of the cable as a whole from one day to the next, in the end \[m\].
    pub drift: f64,
    /// The day from which on every day is like the one before but for that.
    pub periodic_from: Option<u64>,
    /// The cable on its last whole day when it was hottest and coldest, and after the last pass.
    pub hot: CableState,
    /// See `hot`.
    pub cold: CableState,
    /// See `hot`.
    pub state: CableState,
    /// What a cable that nothing holds has moved as a whole beside these states \[m\].
    pub offset: f64,
    /// Passes simulated.
    pub simulated: u64,
    /// Days simulated.
    pub simulated_days: u64,
    /// Lengths of the jumps over days, 0 for a simulated day between.
    pub schedule: Vec<u64>,
    /// Linear solves of the whole cable in steps of many periods.
    pub sweeps: u64,
}

/// The events of all days: those of the first, of the last, and of each between them. They have numbers, from 1.
struct Calendar<'a> {
    day: &'a Day,
    days: u64,
    first: Vec<Event>,
    between: Vec<Event>,
    last: Vec<Event>,
}

impl<'a> Calendar<'a> {
    /// Of so many passes in all.
    fn new(day: &'a Day, passes: u64) -> Self {
        let days = passes.div_ceil(day.passes).max(1);
        let of_last = passes - (days - 1) * day.passes;
        Self {
            day,
            days,
            first: day.events(if days == 1 { of_last } else { day.passes }, true),
            between: day.events(day.passes, false),
            last: day.events(of_last, false),
        }
    }

    fn events(&self, day: u64) -> &[Event] {
        match day {
            1 => &self.first,
            day if day == self.days => &self.last,
            _ => &self.between,
        }
    }

    /// The number before the first event of a day.
    fn before(&self, day: u64) -> u64 {
        match day {
            1 => 0,
            day => self.first.len() as u64 + (day - 2) * self.between.len() as u64,
        }
    }

    /// The day of the event `number`, and its place there.
    fn place(&self, number: u64) -> (u64, usize) {
        let later = (number - 1).checked_sub(self.first.len() as u64);
        let day = later.map_or(1, |later| (2 + later / self.between.len() as u64).min(self.days));
        (day, (number - 1 - self.before(day)) as usize)
    }

    /// The number of the pass that an event is.
    fn pass(&self, number: u64) -> Option<u64> {
        let (day, place) = self.place(number);
        let event = &self.events(day)[place];
        matches!(event.act, Act::Pass(_)).then_some((day - 1) * self.day.passes + event.passes)
    }

    /// How a pass is known, and the day that it comes on.
    fn known(&self, pass: u64) -> Result<(u64, Known), JumpError> {
        let day = (pass - 1) / self.day.passes + 1;
        let of_day = pass - (day - 1) * self.day.passes;
        let known = known(self.events(day), of_day, self.day.period);
        Ok((day, known.ok_or(JumpError::UnknownPass { pass })?))
    }

    /// The numbers of the events from which the wanted `passes` follow, and of those of the last day; ascending.
    fn wanted(&self, passes: &[u64]) -> Result<Vec<u64>, JumpError> {
        let last = self.before(self.days);
        let mut numbers: Vec<u64> = (last + 1..=last + self.events(self.days).len() as u64).collect();
        for &pass in passes {
            let (day, known) = self.known(pass)?;
            let before = self.before(day);
            numbers.extend(known.places().into_iter().map(|place| before + place as u64 + 1));
        }
        numbers.sort_unstable();
        numbers.dedup();
        Ok(numbers)
    }
}

/// Lets `cable` on `mesh`, as laid, live through days of traffic and heat: few passes simulated, each by a call of `pass`, which finds the
/// cable at the temperature of its moment.
///
/// # Errors
///
/// Those of `pass`; [`JumpError`] if `day` is none, the cable finds no rest, or no day becomes like the one before.
pub fn live<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    day: &Day,
    law: LockedLaw,
    request: &DaysRequest<'_>,
    pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Days, E> {
    day.check().map_err(wrap)?;
    let calendar = Calendar::new(day, request.passes);
    let (first, length) = (calendar.first.len() as u64, calendar.between.len() as u64);
    let wanted = calendar.wanted(request.wanted)?;
    let rate = RateStep::new(law, cable.friction().limit(), mesh.nodes());
    let mut daily = DailyCable::new(cable, mesh, day, rate, pass).map_err(wrap)?;
    let (mut simulated_days, mut end) = (0, None);
    let mut happen = |number: Option<u64>, place: usize, state: &mut CableState| {
        let (day, place) = number.map_or((2, place), |number| calendar.place(number));
        let event = match number {
            Some(_) => calendar.events(day)[place],
            None => calendar.between[place],
        };
        simulated_days += u64::from(place == 0);
        let pass = number.and_then(|number| calendar.pass(number));
        let outcome = daily.happen(&event, pass, state)?;
        if pass == Some(request.passes) {
            end = Some(state.clone());
        }
        Ok::<_, E>(outcome)
    };
    let mut state = laid(cable, mesh).map_err(wrap)?;
    let mut events = Vec::new();
    for pass in 1..=first {
        let outcome = happen(Some(pass), 0, &mut state)?;
        events.push(Record {
            pass,
            outcome,
            interpolated: false,
        });
    }
    let mut evolution = None;
    if calendar.days > 1 {
        let later: Vec<u64> = wanted
            .iter()
            .filter_map(|number| number.checked_sub(first))
            .filter(|n| *n > 0)
            .collect();
        let periods: Vec<u64> = request
            .wanted_days
            .iter()
            .filter(|day| **day > 1)
            .map(|day| day - 1)
            .collect();
        let first_days = if request.every_day { u64::MAX } else { FIRST_DAYS };
        let (jumping, most) = request.most_days;
        let jumps = Jumps::new(request.tolerance, request.length_scale, request.least.1)?
            .with_start(first_days, request.first_jump)?
            .with_least(request.least.0, request.least.1)?
            .with_most_passes(jumping.saturating_mul(length), most.saturating_mul(length))
            .over_days(!request.every_day);
        let order: Vec<usize> = (0..calendar.between.len()).collect();
        let last = calendar.last.len() as u64;
        let walk = Request::new((calendar.days - 2) * length + last, &order)?
            .with_one_by_one(0, last)
            .with_wanted(&later)?
            .with_periods(&periods)
            .with_state(&state)
            .with_guide(request.guide);
        let mut found = evolve(
            cable,
            mesh,
            &jumps,
            &walk,
            |next: Next, state: &mut CableState| {
                happen(next.number.map(|number| first + number), next.phase, state)
            },
        )?;
        for record in found.records.iter_mut().chain(&mut found.others) {
            record.pass += first;
        }
        events.append(&mut found.records);
        state = found.state.clone();
        evolution = Some(found);
    }
    let mut extremes = Extremes::none();
    let nothing = |&day| DayRecord {
        day,
        extremes: Extremes::none(),
    };
    let mut days: Vec<DayRecord> = request.wanted_days.iter().map(nothing).collect();
    events.sort_by_key(|record| record.pass);
    let mut others = evolution
        .as_mut()
        .map_or_else(Vec::new, |found| std::mem::take(&mut found.others));
    for record in events.iter().chain(&others) {
        extremes.see(&record.outcome);
    }
    for record in &events {
        let (day, _) = calendar.place(record.pass);
        if let Ok(index) = days.binary_search_by_key(&day, |record| record.day) {
            days[index].extremes.see(&record.outcome);
        }
    }
    let at = |day: u64, place: usize| {
        let number = calendar.before(day) + place as u64 + 1;
        let found = events.binary_search_by_key(&number, |record| record.pass);
        found.ok().map(|index| &events[index])
    };
    let mut records = Vec::with_capacity(request.wanted.len());
    for &pass in request.wanted {
        let (day, known) = calendar.known(pass)?;
        let record = recorded(pass, &known, |place| at(day, place));
        records.push(record.ok_or(JumpError::UnknownPass { pass })?);
    }
    let row = |(place, event): (usize, &Event)| {
        Some(Row {
            passes: event.passes,
            thermal_force: event.thermal_force,
            outcome: at(calendar.days, place)?.outcome.clone(),
            heat: event.act == Act::Warm,
        })
    };
    let last_day = calendar
        .events(calendar.days)
        .iter()
        .enumerate()
        .filter_map(row)
        .collect();
    others.extend(events.iter().filter(|record| !record.interpolated).cloned());
    let other = |record: Record| {
        let pass = calendar.pass(record.pass)?;
        let is_wanted = request.wanted.binary_search(&pass).is_ok();
        (!is_wanted).then_some(Record { pass, ..record })
    };
    let others = others.into_iter().filter_map(other).collect();
    let simulated: Vec<Record> = records
        .iter()
        .filter(|record| !record.interpolated)
        .cloned()
        .collect();
    let repeats = evolution.as_ref().and_then(|found| found.repeats);
    Ok(Days {
        peaks: peaks(&simulated, others),
        records,
        days,
        last_day,
        extremes,
        drift: repeats.map_or(0.0, |(_, drift)| drift),
        periodic_from: repeats.map(|(days, _)| days + 1),
        state: end.unwrap_or(state),
        hot: daily.hot,
        cold: daily.cold,
        offset: evolution.as_ref().map_or(0.0, |found| found.offset),
        simulated: daily.simulated,
        simulated_days,
        schedule: evolution.map_or_else(Vec::new, |found| found.schedule),
        sweeps: daily.rate.sweeps,
    })
}

/// What `pass` did, from the records of its day.
fn recorded<'r>(pass: u64, known: &Known, at: impl Fn(usize) -> Option<&'r Record>) -> Option<Record> {
    let (outcome, interpolated) = match known {
        Known::Simulated(place) => {
            let record = at(*place)?;
            (record.outcome.clone(), record.interpolated)
        }
        Known::Within { at_rest: ends, like } => {
            let ends: Vec<(f64, PassOutcome)> = ends
                .iter()
                .map(|(weight, place)| Some((*weight, at_rest(&at(*place)?.outcome))))
                .collect::<Option<_>>()?;
            let mut parts: Vec<(f64, &PassOutcome)> =
                ends.iter().map(|(weight, end)| (*weight, end)).collect();
            parts.push((1.0, &at(*like)?.outcome));
            (PassOutcome::combined(&parts), true)
        }
    };
    Some(Record {
        pass,
        outcome,
        interpolated,
    })
}

/// The same cable after the pass: without its peaks and its heat.
fn at_rest(outcome: &PassOutcome) -> PassOutcome {
    let mut rest = outcome.clone();
    (rest.peak, rest.lowest, rest.dissipated) = (rest.force, rest.force, 0.0);
    rest
}
