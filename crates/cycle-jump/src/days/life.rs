//! Day after day: some with real periods, others as those say, until each is like the one before.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome, RestingCable, laid};

use super::day::Day;
use super::diary::Lived;
use super::extremes::Extremes;
use super::law::LockedLaw;
use super::living::Living;
use super::rate::RateStep;
use super::rows::{Row, of_pass};
use crate::error::wrap;
use crate::peaks::peaks;
use crate::record::Record;
use crate::{JumpError, Next};

/// Days with real periods at the start.
const FIRST_DAYS: u64 = 2;
/// Days lived without real periods between two with them: growth, least share of the last number, and most.
const GROWTH: (f64, f64) = (0.3, 2.0);
const CAUTION: f64 = 0.9;
const MOST_FROZEN: u64 = 64;
/// Beside the tolerance: what a day may differ from the one before, and from what was expected of it, where nothing changes any more.
const STEADY: f64 = 0.3;
const EXPECTED: f64 = 0.5;
/// As long as a day changes by more than this many times the tolerance, each is lived with real periods: of a day without any a
/// thirtieth of the change is wrong.
const SETTLING: f64 = 15.0;
/// A day that changes by more than this is led by its own real periods alone; else they count half: days that follow their own
/// measurements alone never settle.
const TRANSIENT: f64 = 0.1;
const OWN: f64 = 0.5;
/// Beside the tolerance: what real days in a row may differ where that alone shows that nothing changes any more.
const CALM: f64 = 3e-3;
/// A frozen day is believed where it shows a real one but for this share.
const TRUSTED: f64 = 0.05;
/// Days that show it.
const SHOWN: usize = 3;
/// Days with real periods after which they ought to repeat.
const PATIENCE: u64 = 60;

/// What is wanted of a cable's days.
#[derive(Debug, Clone, Copy)]
pub struct DaysRequest<'a> {
    /// Passes in all.
    pub passes: u64,
    /// Passes to be recorded, ascending.
    pub wanted: &'a [u64],
    /// Days to be recorded, ascending, from 1.
    pub wanted_days: &'a [u64],
    /// Error that days without real periods may have, as a share of the largest force and of the movement over a day.
    pub tolerance: f64,
    /// Force \[N\] and movement \[m\] below which all is nothing.
    pub least: (f64, f64),
    /// Whether every day is lived with real periods.
    pub every_day: bool,
    /// Balances of the whole cable between real periods after which days ought to repeat: at least one a linear solve.
    pub most_balances: u64,
}

/// A day's extremes.
#[derive(Debug, Clone, PartialEq)]
pub struct DayRecord {
    /// Number of the day, from 1.
    pub day: u64,
    /// Its extremes.
    pub extremes: Extremes,
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
    /// Days with real periods.
    pub corrected: u64,
    /// How much days without them may be off by what such a day showed at their end: a force as a share of the day's largest, a movement of
    /// its range.
    pub surprise: (f64, f64),
    /// Linear solves of the whole cable in the steps between them.
    pub sweeps: u64,
}

/// Lets `cable` on `mesh`, as laid, live through days of traffic and heat: few passes simulated, each by a call of `pass`, which finds the
/// cable at the temperature of its moment.
///
/// # Errors
///
/// Those of `pass`; [`JumpError`] where `day` is none, the cable finds no rest, or no day becomes like the one before.
pub fn live<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    day: &Day,
    law: LockedLaw,
    request: &DaysRequest<'_>,
    pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Days, E> {
    day.check().map_err(wrap)?;
    let rate = RateStep::new(law, cable.friction().limit(), mesh.nodes());
    let resting = RestingCable::new(cable, mesh).map_err(wrap)?;
    let laid = laid(cable, mesh).map_err(wrap)?;
    Life {
        request,
        living: Living::new(day, mesh, resting, rate, pass, laid),
        records: Vec::new(),
        others: Vec::new(),
        days: Vec::new(),
        extremes: Extremes::none(),
        done: 0,
        corrected: 0,
        surprise: (0.0, 0.0),
    }
    .run()
}

/// The cable, and what it has moved as a whole beside that \[m\].
type Place = (CableState, f64);

struct Life<'a, P> {
    request: &'a DaysRequest<'a>,
    living: Living<'a, P>,
    records: Vec<Record>,
    /// Simulated passes that are not wanted.
    others: Vec<Record>,
    days: Vec<DayRecord>,
    extremes: Extremes,
    /// Days done.
    done: u64,
    corrected: u64,
    /// The largest difference between a day with real periods and what was expected of it.
    surprise: (f64, f64),
}

/// Days that are all like the one before.
#[derive(Clone)]
struct Settled {
    /// The first of them.
    day: u64,
    /// But for this movement as a whole \[m\].
    drift: f64,
    /// What a day with real periods shows beside one without, where that is known.
    beside: Option<Extremes>,
}

/// The larger of each.
fn largest(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0.max(b.0), a.1.max(b.1))
}

impl<E, P> Life<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    fn run(mut self) -> Result<Days, E> {
        let (passes, a_day) = (self.request.passes, self.living.day.passes);
        let (whole, rest) = (passes / a_day, passes % a_day);
        let all = whole + u64::from(rest > 0);
        let settled = self.until(all - 1)?;
        let drift = settled.as_ref().map_or(0.0, |settled| settled.drift);
        let passes = if rest > 0 { rest } else { a_day };
        let last = match &settled {
            Some(Settled {
                beside: Some(beside), ..
            }) if passes == a_day => {
                let lived = self.living.last(self.done * a_day, passes, beside)?;
                self.done += 1;
                self.book(&lived, &lived.extremes, passes)?;
                lived
            }
            _ => self.corrected(passes, true)?,
        };
        let Living {
            offset,
            simulated,
            rate,
            ..
        } = self.living;
        let mut known = self.records.clone();
        known.retain(|record| !record.interpolated);
        Ok(Days {
            peaks: peaks(&known, self.others),
            records: self.records,
            days: self.days,
            last_day: last.rows,
            extremes: self.extremes,
            drift,
            periodic_from: settled.map(|settled| settled.day),
            hot: last.hot,
            cold: last.cold,
            state: last.last,
            offset,
            simulated,
            corrected: self.corrected,
            surprise: self.surprise,
            sweeps: rate.sweeps,
        })
    }

    /// Lives `count` days; what they have come to, where nothing changes any more.
    fn until(&mut self, count: u64) -> Result<Option<Settled>, E> {
        let (tolerance, least) = (self.request.tolerance, self.request.least);
        let mut block = 0;
        let mut calm = 0;
        let mut before = self.place();
        let mut today = None;
        while self.done < count && (self.done < FIRST_DAYS || self.request.every_day) {
            before = self.place();
            today = Some(self.corrected(self.living.day.passes, false)?.extremes);
        }
        let Some(mut today) = today.filter(|_| self.done < count) else {
            return Ok(None);
        };
        let mut beside = today.less(&self.again(before)?);
        while self.done < count {
            if self.corrected > PATIENCE || self.living.rate.balances > self.request.most_balances {
                return Err(JumpError::NeverPeriodic { days: self.done }.into());
            }
            for _ in 0..block.min(count - self.done - 1) {
                today = self.frozen(&beside)?;
            }
            // What the next day is expected to be, and what it is.
            let start = self.place();
            let expected = self.again(start.clone())?.plus(&beside);
            let from = self.living.whole();
            let yesterday = today;
            let lived = self.corrected(self.living.day.passes, false)?;
            today = lived.extremes.clone();
            let drift = self.living.whole() - from;
            beside = today.less(&self.again(start)?);
            if block > 0 {
                self.surprise = largest(self.surprise, today.difference(&expected, least));
            }
            let larger = |(force, movement): (f64, f64)| force.max(movement);
            let is_known = larger(today.difference(&today.less(&beside), least)) < TRUSTED;
            let surprise = larger(today.difference(&expected, least));
            let change = larger(today.difference(&yesterday.moved(drift), least));
            self.living.own = if change > TRANSIENT { 1.0 } else { OWN };
            calm = if block == 0 && change < CALM * tolerance {
                calm + 1
            } else {
                0
            };
            let steady = is_known && change < STEADY * tolerance && surprise < EXPECTED * tolerance;
            if calm == SHOWN || steady && self.is_steady(tolerance)? {
                let day = self.done;
                // What the days to come are taken not to differ by.
                for before in [&expected, &yesterday.moved(drift)] {
                    self.surprise = largest(self.surprise, today.difference(before, least));
                }
                self.repeat(count, drift, &lived)?;
                return Ok(Some(Settled {
                    day,
                    drift,
                    beside: is_known.then_some(beside),
                }));
            }
            let growth = (CAUTION * tolerance / surprise.max(f64::MIN_POSITIVE)).clamp(GROWTH.0, GROWTH.1);
            block = if !is_known || change > SETTLING * tolerance {
                0
            } else {
                ((block as f64 * growth).round() as u64).clamp(1, MOST_FROZEN)
            };
        }
        Ok(None)
    }

    /// Whether frozen days change no more.
    fn is_steady(&mut self, tolerance: f64) -> Result<bool, E> {
        let here = self.place();
        let mut days = Vec::with_capacity(SHOWN);
        let mut places = Vec::with_capacity(SHOWN);
        for _ in 0..SHOWN {
            days.push(self.living.frozen()?.extremes);
            places.push(self.living.whole());
        }
        self.go(here);
        let drift = places[SHOWN - 1] - places[0];
        let (force, movement) = days[SHOWN - 1].difference(&days[0].moved(drift), self.request.least);
        Ok(force.max(movement) < STEADY * tolerance)
    }

    /// A frozen day from `start`, which is not counted.
    fn again(&mut self, start: Place) -> Result<Extremes, E> {
        let here = self.place();
        self.go(start);
        let lived = self.living.frozen()?;
        self.go(here);
        Ok(lived.extremes)
    }

    /// Where the cable is.
    fn place(&self) -> Place {
        (self.living.state.clone(), self.living.offset)
    }

    fn go(&mut self, place: Place) {
        (self.living.state, self.living.offset) = place;
    }

    fn corrected(&mut self, passes: u64, is_last: bool) -> Result<Lived, E> {
        let after = self.done * self.living.day.passes;
        let lived = self.living.corrected(after, passes, is_last)?;
        self.corrected += 1;
        self.done += 1;
        self.book(&lived, &lived.extremes, passes)?;
        Ok(lived)
    }

    /// A frozen day, whose extremes real passes would move by `beside`.
    fn frozen(&mut self, beside: &Extremes) -> Result<Extremes, E> {
        if self.living.rate.balances > self.request.most_balances {
            return Err(JumpError::NeverPeriodic { days: self.done }.into());
        }
        let lived = self.living.frozen()?;
        self.done += 1;
        let extremes = lived.extremes.plus(beside);
        self.book(&lived, &extremes, self.living.day.passes)?;
        Ok(extremes)
    }

    /// All days up to `count` are like `today` but for a drift.
    fn repeat(&mut self, count: u64, drift: f64, today: &Lived) -> Result<(), JumpError> {
        let first = self.done;
        for day in first + 1..=count {
            self.done = day;
            // Only what is wanted, and the last one's extremes.
            let is_wanted = self.request.wanted_days.binary_search(&day).is_ok();
            if is_wanted || day == count || self.has_wanted_pass(day) {
                let moved = drift * (day - first) as f64;
                let mut lived = today.clone();
                for row in &mut lived.rows {
                    row.outcome.upstream_displacement += moved;
                    row.outcome.downstream_displacement += moved;
                }
                self.book(&lived, &today.extremes.moved(moved), self.living.day.passes)?;
            }
        }
        self.living.offset += drift * (count - first) as f64;
        Ok(())
    }

    fn has_wanted_pass(&self, day: u64) -> bool {
        let a_day = self.living.day.passes;
        let wanted = self.request.wanted;
        wanted.partition_point(|pass| *pass <= (day - 1) * a_day)
            < wanted.partition_point(|pass| *pass <= day * a_day)
    }

    /// Records what is wanted of the day just done, of which `passes` were lived.
    fn book(&mut self, lived: &Lived, extremes: &Extremes, passes: u64) -> Result<(), JumpError> {
        let (day, plan) = (self.done, self.living.day);
        self.extremes.join(extremes);
        if self.request.wanted_days.binary_search(&day).is_ok() {
            self.days.push(DayRecord {
                day,
                extremes: extremes.clone(),
            });
        }
        let before = (day - 1) * plan.passes;
        let wanted = self.request.wanted;
        let is_other = |record: &Record| wanted.binary_search(&record.pass).is_err();
        self.others.extend(lived.passes(before).filter(is_other));
        let from = wanted.partition_point(|pass| *pass <= before);
        for &pass in wanted[from..].iter().take_while(|pass| **pass <= before + passes) {
            let known = of_pass(&lived.rows, &self.living.shapes, pass - before, plan.period);
            let (outcome, interpolated) = known.ok_or(JumpError::UnknownPass { pass })?;
            self.records.push(Record {
                pass,
                outcome,
                interpolated,
            });
        }
        Ok(())
    }
}
