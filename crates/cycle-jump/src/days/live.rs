//! Day after day: some simulated, others jumped over, until each is like the one before.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome, laid};

use super::account::{Account, DayRecord, Row};
use super::cable::DailyCable;
use super::calendar::Calendar;
use super::day::Day;
use super::extremes::Extremes;
use super::law::LockedLaw;
use super::rate::RateStep;
use crate::error::wrap;
use crate::record::{Evolution, Record};
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
    /// The cable on its last day when it was hottest and coldest, and after the last pass.
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
    let rate = RateStep::new(law, cable.friction().limit(), mesh.nodes());
    let mut daily = DailyCable::new(cable, mesh, day, rate, pass).map_err(wrap)?;
    let (mut simulated_days, mut end) = (0, None);
    // An event by its number, or one that only measures, by its place in a day.
    let mut happen = |number: Option<u64>, place: usize, state: &mut CableState| {
        let (event, place) = match number.map(|number| calendar.place(number)) {
            Some((day, place)) => (calendar.events(day)[place], place),
            None => (calendar.between[place], place),
        };
        if place == 0 {
            daily.begin_day();
            simulated_days += u64::from(number.is_some());
        }
        let pass = number.and_then(|number| calendar.pass(number));
        let outcome = daily.happen(&event, pass, state)?;
        if pass == Some(request.passes) {
            end = Some(state.clone());
        }
        Ok::<_, E>(outcome)
    };
    let first = calendar.first.len() as u64;
    let mut state = laid(cable, mesh).map_err(wrap)?;
    let mut wanted = Vec::new();
    for number in 1..=first {
        wanted.push(Record {
            pass: number,
            outcome: happen(Some(number), 0, &mut state)?,
            interpolated: false,
        });
    }
    let mut later = None;
    if calendar.days > 1 {
        let act = |next: Next, state: &mut CableState| {
            let number = next.number.map(|number| first + number);
            happen(number, next.phase, state)
        };
        later = Some(later_days(cable, mesh, &calendar, request, &state, act)?);
    }
    let mut others = Vec::new();
    if let Some(later) = &mut later {
        for record in later.records.iter_mut().chain(&mut later.others) {
            record.pass += first;
        }
        wanted.append(&mut later.records);
        others.append(&mut later.others);
    }
    let account = Account::new(&calendar, wanted, others);
    let records = account.passes(request.wanted)?;
    let repeats = later.as_ref().and_then(|later| later.repeats);
    Ok(Days {
        peaks: account.peaks(&records),
        records,
        days: account.days(request.wanted_days),
        last_day: account.last_day(),
        extremes: account.extremes(),
        drift: repeats.map_or(0.0, |(_, drift)| drift),
        periodic_from: repeats.map(|(days, _)| days + 2),
        hot: daily.hot.unwrap_or_else(|| state.clone()),
        cold: daily.cold.unwrap_or_else(|| state.clone()),
        state: end.unwrap_or(state),
        offset: later.as_ref().map_or(0.0, |later| later.offset),
        simulated: daily.simulated,
        simulated_days,
        schedule: later.map_or_else(Vec::new, |later| later.schedule),
        sweeps: daily.rate.sweeps,
    })
}

/// The days after the first one, which left the cable in `state`. Events have numbers from 1 again.
fn later_days<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    calendar: &Calendar<'_>,
    request: &DaysRequest<'_>,
    state: &CableState,
    act: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Evolution, E> {
    let (first, length) = (calendar.first.len() as u64, calendar.between.len() as u64);
    let after = |numbers: &[u64], before: u64| -> Vec<u64> {
        let later = numbers.iter().filter(|number| **number > before);
        later.map(|number| number - before).collect()
    };
    let wanted = after(&calendar.wanted(request.wanted)?, first);
    let days = after(request.wanted_days, 1);
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
        .with_wanted(&wanted)?
        .with_periods(&days)
        .with_state(state)
        .with_guide(request.guide);
    evolve(cable, mesh, &jumps, &walk, act)
}
