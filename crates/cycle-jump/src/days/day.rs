//! A day of traffic and heat as a list of events.

use std::collections::BTreeSet;

use super::heat::DailyHeat;
use crate::JumpError;
use crate::error::check;
use crate::tuning::AFTER_A_CORNER;

/// A day of traffic and heat: passes evenly over the day, the first after half an interval.
#[derive(Debug, Clone)]
pub struct Day {
    passes: u64,
    period: u64,
    heat: DailyHeat,
    knots: u64,
}

/// What happens to the cable at one moment of a day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Event {
    pub act: Act,
    /// Θ during it, or at the end of a step \[N\].
    pub thermal_force: f64,
    /// Passes of the day that are done after it.
    pub passes: u64,
    /// Whether a simulated period begins with it.
    pub begins: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Act {
    /// The temperature changes to that force.
    Warm,
    /// A vehicle passes: its place in the period of the traffic.
    Pass(usize),
    /// The traffic from one number of periods to another, in one step.
    Step(u64, u64),
}

impl Day {
    /// A day of so many `passes`. The traffic starts anew every day and repeats after `period`
    /// passes; the last period of a day also holds the passes left over. The day simulates `knots`
    /// periods at even distances, and more where the temperature turns.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] if it has no whole period, no knot, or a `heat` whose forces
    /// are not finite or whose points are not in the order of one day.
    pub fn new(passes: u64, period: usize, heat: DailyHeat, knots: u64) -> Result<Self, JumpError> {
        let period = period as u64;
        check("period of the traffic", period > 0, "at least one vehicle")?;
        check("passes a day", passes >= period, "at least those of a period")?;
        check("simulated periods a day", knots > 0, "at least one")?;
        heat.check()?;
        Ok(Self {
            passes,
            period,
            heat,
            knots,
        })
    }

    /// Passes of a day.
    pub fn passes(&self) -> u64 {
        self.passes
    }

    /// Passes of a period.
    pub(super) fn period(&self) -> u64 {
        self.period
    }

    /// Periods of a day.
    pub fn periods(&self) -> u64 {
        self.passes / self.period
    }

    /// Whether every period of a day is simulated: if steps would be no longer than a period.
    pub fn is_simulated(&self) -> bool {
        self.knots >= self.periods().div_ceil(2)
    }

    /// The period of `pass`, which counts from 0: the last one is longer.
    fn period_of(&self, pass: u64) -> u64 {
        (pass / self.period).min(self.periods() - 1)
    }

    /// Passes done when `periods` of the day are.
    fn passes_of(&self, periods: u64) -> u64 {
        if periods == self.periods() {
            self.passes
        } else {
            periods * self.period
        }
    }

    /// Θ at the last pass before `periods` are done \[N\].
    pub(super) fn heat_before(&self, periods: f64) -> f64 {
        let passes = periods * self.period as f64;
        self.heat.at((passes - 0.5).max(0.0) / self.passes as f64)
    }

    /// The cable is brought to the temperature of `time` before the pass `next` of the day, from 0,
    /// and to that of every turn since the pass before.
    fn warming(&self, next: u64, time: f64) -> impl Iterator<Item = Event> {
        let all = self.passes as f64;
        let (from, to) = ((next as f64 - 0.5) / all, (next as f64 + 0.5) / all);
        let between = move |turn: &f64| from < *turn && *turn < to.min(1.0);
        let times = self.heat.turns().into_iter().filter(between).chain([time]);
        times.map(move |time| Event::new(Act::Warm, self.heat.at(time), next))
    }

    /// Periods of a day that are simulated, ascending: evenly, at the turns of the temperature and
    /// after its corners, the last one, and that of the pass number `last`.
    fn simulated(&self, last: u64) -> Vec<u64> {
        if self.is_simulated() {
            return (0..self.periods()).collect();
        }
        let distance = self.periods() as f64 / self.knots as f64;
        let evenly = (0..self.knots).map(|k| (k as f64 * distance).round() as u64);
        // A turn comes before the first pass after it.
        let next = |time: f64| (time * self.passes as f64 - 0.5).ceil().max(0.0) as u64;
        let turns = self
            .heat
            .turns()
            .into_iter()
            .map(|time| self.period_of(next(time)));
        let shown = if self.heat.has_corners() {
            AFTER_A_CORNER.len()
        } else {
            1
        };
        let after_turns =
            turns.flat_map(|turn| AFTER_A_CORNER[..shown].iter().map(move |after| turn + after));
        let last = [last, self.passes].map(|pass| self.period_of(pass - 1));
        let all = evenly.chain(after_turns).chain(AFTER_A_CORNER).chain(last);
        let knots: BTreeSet<u64> = all.filter(|knot| *knot < self.periods()).collect();
        knots.into_iter().collect()
    }

    /// What happens in a day from midnight to midnight, its pass number `last` being simulated.
    pub(super) fn events(&self, last: u64) -> Vec<Event> {
        let knots = self.simulated(last);
        let mut events = vec![Event::new(Act::Warm, self.heat.at(0.0), 0)];
        for (k, &knot) in knots.iter().enumerate() {
            let begin = events.len();
            for pass in self.passes_of(knot)..self.passes_of(knot + 1) {
                let time = (pass as f64 + 0.5) / self.passes as f64;
                events.extend(self.warming(pass, time));
                let act = Act::Pass((pass % self.period) as usize);
                events.push(Event::new(act, self.heat.at(time), pass + 1));
            }
            events[begin].begins = true;
            let (from, to) = (knot + 1, knots.get(k + 1).copied().unwrap_or(self.periods()));
            let middle = from + (to - from) / 2;
            for (from, to) in [(from, middle), (middle, to)] {
                if from < to {
                    let thermal_force = self.heat_before(to as f64);
                    events.push(Event::new(Act::Step(from, to), thermal_force, self.passes_of(to)));
                }
            }
        }
        events.extend(self.warming(self.passes, 1.0));
        events
    }
}

impl Event {
    fn new(act: Act, thermal_force: f64, passes: u64) -> Self {
        Self {
            act,
            thermal_force,
            passes,
            begins: false,
        }
    }
}
