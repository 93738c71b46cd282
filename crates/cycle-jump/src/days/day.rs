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
    /// Passes of a period.
    pub(super) period: u64,
    heat: DailyHeat,
    knots: u64,
}

/// What happens to the cable at one moment of a day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    pub act: Act,
    /// Θ during it, or at the end of a step \[N\].
    pub thermal_force: f64,
    /// Passes of the day that are done after it.
    pub passes: u64,
    /// Whether a simulated period begins with it.
    pub begins: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Act {
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

    /// Periods of a day.
    pub fn periods(&self) -> u64 {
        self.passes / self.period
    }

    /// Whether every period of a day is simulated: with half of them knots, a step would be no
    /// longer than a period.
    pub fn is_simulated(&self) -> bool {
        self.knots >= self.periods().div_ceil(2)
    }

    /// Passes done when `periods` of the day are: the last one is longer.
    fn passes_of(&self, periods: u64) -> u64 {
        if periods == self.periods() {
            self.passes
        } else {
            periods * self.period
        }
    }

    /// Θ when `passes` of the day are done, which need not be whole \[N\].
    fn thermal_force(&self, passes: f64) -> f64 {
        self.heat.at(passes / self.passes as f64)
    }

    /// Θ at the last pass before `periods` are done \[N\].
    pub(super) fn heat_before(&self, periods: f64) -> f64 {
        self.thermal_force((periods * self.period as f64 - 0.5).max(0.0))
    }

    /// Θ at the beginning and the end of the day \[N\].
    pub(super) fn heat_at_midnight(&self) -> f64 {
        self.heat.at(0.0)
    }

    /// Θ at the turns of the temperature between the pass `next` of the day and the one before.
    fn turns_before(&self, next: u64) -> Vec<f64> {
        let all = self.passes as f64;
        let (from, to) = ((next as f64 - 0.5) / all, (next as f64 + 0.5) / all);
        let between = |time: &f64| from < *time && *time < to.min(1.0);
        let turns = self.heat.turns().into_iter().filter(between);
        turns.map(|time| self.heat.at(time)).collect()
    }

    /// Periods of a day that are simulated, ascending: evenly, after midnight, when the first day
    /// finds the cable as laid, at the turns of the temperature and after its corners, the `cut` one
    /// at which the last day ends, and the last.
    fn simulated(&self, cut: u64) -> BTreeSet<u64> {
        let all = self.periods();
        if self.is_simulated() {
            return (0..all).collect();
        }
        let evenly = |k: u64| (k as f64 * all as f64 / self.knots as f64).round() as u64;
        let mut knots: BTreeSet<u64> = (0..self.knots).map(evenly).chain([cut, all - 1]).collect();
        knots.extend(AFTER_A_CORNER);
        let after = if self.heat.has_corners() {
            &AFTER_A_CORNER[..]
        } else {
            &[0]
        };
        for turn in self.heat.turns() {
            // A turn comes before the first pass after it.
            let next = (turn * self.passes as f64 - 0.5).ceil().max(0.0) as u64;
            let turn = (next / self.period).min(all - 1);
            knots.extend(after.iter().map(|after| turn + after));
        }
        knots.retain(|knot| *knot < all);
        knots
    }

    /// What happens in a day, which ends at the temperature of its beginning; its pass number `cut`
    /// is simulated in any case.
    pub(super) fn events(&self, cut: u64) -> Vec<Event> {
        let all = self.periods();
        let mut knots = self
            .simulated(((cut - 1) / self.period).min(all - 1))
            .into_iter()
            .peekable();
        let event = |act, thermal_force, passes, begins| Event {
            act,
            thermal_force,
            passes,
            begins,
        };
        let mut events = Vec::new();
        while let Some(knot) = knots.next() {
            let mut begins = true;
            for pass in self.passes_of(knot)..self.passes_of(knot + 1) {
                let heat = self.thermal_force(pass as f64 + 0.5);
                for heat in self.turns_before(pass).into_iter().chain([heat]) {
                    events.push(event(Act::Warm, heat, pass, begins));
                    begins = false;
                }
                let phase = (pass % self.period) as usize;
                events.push(event(Act::Pass(phase), heat, pass + 1, false));
            }
            // Two steps to the next knot, so that passes between are known well too.
            let (from, to) = (knot + 1, knots.peek().copied().unwrap_or(all));
            let middle = from + (to - from) / 2;
            let steps = [(from, middle), (middle, to)];
            for (from, to) in steps.into_iter().filter(|(from, to)| from < to) {
                let (heat, passes) = (self.heat_before(to as f64), self.passes_of(to));
                events.push(event(Act::Step(from, to), heat, passes, false));
            }
        }
        let end = self
            .turns_before(self.passes)
            .into_iter()
            .chain([self.heat_at_midnight()]);
        events.extend(end.map(|heat| event(Act::Warm, heat, self.passes, false)));
        events
    }
}

impl Event {
    /// Whether it is the pass after which so many are done.
    pub fn is_pass(&self, passes: u64) -> bool {
        self.passes == passes && matches!(self.act, Act::Pass(_))
    }
}
