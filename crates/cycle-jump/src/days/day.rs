//! A day of traffic and heat as a list of events.

use super::heat::DailyHeat;
use crate::JumpError;
use crate::error::check;
use crate::tuning::{AFTER_A_CORNER, MORNING, MORNING_GROWTH};

/// With knots beyond this share of all periods a step would be no longer than a period: every one
/// is simulated.
const NEARLY_ALL: f64 = 0.5;

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

    /// Whether every period of a day is simulated.
    pub fn is_simulated(&self) -> bool {
        self.knots as f64 >= NEARLY_ALL * self.periods() as f64
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

    /// Θ at the turns of the temperature between the pass `next` of the day and the one before.
    fn turns_before(&self, next: u64) -> Vec<f64> {
        let all = self.passes as f64;
        let (from, to) = ((next as f64 - 0.5) / all, (next as f64 + 0.5) / all);
        let between = |time: &f64| from < *time && *time < to.min(1.0);
        let turns = self.heat.turns().into_iter().filter(between);
        turns.map(|time| self.heat.at(time)).collect()
    }

    /// Periods of a day that are simulated, ascending: evenly, at the turns of the temperature and
    /// after its corners, and the last; on the `first` day many of the morning, when the cable is
    /// as laid.
    fn simulated(&self, first: bool) -> Vec<u64> {
        let all = self.periods();
        if self.is_simulated() {
            return (0..all).collect();
        }
        let evenly = |k: u64| (k as f64 * all as f64 / self.knots as f64).round() as u64;
        let mut knots: Vec<u64> = (0..self.knots).map(evenly).chain([all - 1]).collect();
        let corners = self.heat.has_corners();
        let after = if corners { &AFTER_A_CORNER[..] } else { &[0] };
        // A turn comes before the first pass after it.
        let next = |time: f64| (time * self.passes as f64 - 0.5).ceil().max(0.0) as u64;
        let period_of = |time: f64| (next(time) / self.period).min(all - 1);
        let turns = self.heat.turns().into_iter().map(period_of);
        for turn in turns.chain(corners.then_some(0)) {
            knots.extend(after.iter().map(|after| turn + after));
        }
        let (mut next, mut step) = (0.0, 1.0);
        while first && step < all as f64 / self.knots as f64 {
            knots.push(next as u64);
            if next >= MORNING as f64 {
                step *= MORNING_GROWTH;
            }
            next += step;
        }
        knots.retain(|knot| *knot < all);
        knots.sort_unstable();
        knots.dedup();
        knots
    }

    /// What happens in a day, the `first` or another, up to its pass number `passes`, which is
    /// simulated, and at its end, when the temperature is that of its beginning.
    pub(super) fn events(&self, passes: u64, first: bool) -> Vec<Event> {
        let whole = passes.div_ceil(self.period).min(self.periods());
        let mut knots = self.simulated(first);
        knots.retain(|knot| *knot + 1 < whole);
        knots.push(whole - 1);
        let mut events = Vec::new();
        if first {
            events.push(Event::warm(self.heat.at(0.0), 0, false));
        }
        for (k, &knot) in knots.iter().enumerate() {
            let mut begins = true;
            for pass in self.passes_of(knot)..self.passes_of(knot + 1).min(passes) {
                let thermal_force = self.thermal_force(pass as f64 + 0.5);
                for thermal_force in self.turns_before(pass).into_iter().chain([thermal_force]) {
                    events.push(Event::warm(thermal_force, pass, begins));
                    begins = false;
                }
                let act = Act::Pass((pass % self.period) as usize);
                events.push(Event {
                    act,
                    passes: pass + 1,
                    ..Event::warm(thermal_force, pass, false)
                });
            }
            // Two steps to the next knot, so that passes between are known well too.
            let (from, to) = (knot + 1, knots.get(k + 1).copied().unwrap_or(whole));
            let middle = from + (to - from) / 2;
            let steps = [(from, middle), (middle, to)];
            for (from, to) in steps.into_iter().filter(|(from, to)| from < to) {
                events.push(Event {
                    act: Act::Step(from, to),
                    ..Event::warm(self.heat_before(to as f64), self.passes_of(to), false)
                });
            }
        }
        if passes == self.passes {
            let end = self.turns_before(passes).into_iter().chain([self.heat.at(1.0)]);
            events.extend(end.map(|thermal_force| Event::warm(thermal_force, passes, false)));
        }
        events
    }
}

impl Event {
    fn warm(thermal_force: f64, passes: u64, begins: bool) -> Self {
        Self {
            act: Act::Warm,
            thermal_force,
            passes,
            begins,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::part::parts;
    use super::*;

    #[test]
    fn every_pass_of_any_day_is_known_from_its_events() {
        let (lowest, highest) = (0.0, 1.0);
        let heat = [
            (DailyHeat::Cosine { lowest, highest }, 0.5),
            (DailyHeat::Profile(vec![(0.1, 0.0), (0.4, 1.0), (0.45, 0.5)]), 0.4),
        ];
        let days = [(1, 1), (7, 1), (90, 1), (90, 4), (97, 3), (402, 2), (200, 150)];
        for ((heat, hottest), (passes, period)) in heat.iter().flat_map(|heat| days.map(|day| (heat, day))) {
            for knots in [1, 2, 5, 16, 1000] {
                let day = Day::new(passes, period, heat.clone(), knots).expect("a day");
                for (cut, first) in (1..=passes).flat_map(|cut| [(cut, false), (cut, true)]) {
                    let events = day.events(cut, first);
                    // Straight lines and what passes do relative to them: together once the cable.
                    for pass in 1..=cut {
                        let parts = parts(&events, pass, period as u64);
                        let sum: f64 = parts.iter().map(|part| part.weight).sum();
                        assert!(f64::abs(sum - 1.0) < 1e-12, "pass {pass} of {cut}: {day:?}");
                        let is_simulated = parts.len() == 1;
                        assert!(!is_simulated || events[parts[0].place].passes == pass);
                    }
                    let last = events.iter().rfind(|event| matches!(event.act, Act::Pass(_)));
                    assert_eq!(last.map(|event| event.passes), Some(cut), "{day:?}");
                    // The day meets its hottest moment.
                    let is_met = |event: &Event| event.thermal_force == heat.at(*hottest);
                    assert!(cut < passes || events.iter().any(is_met), "{day:?}");
                }
            }
        }
    }
}
