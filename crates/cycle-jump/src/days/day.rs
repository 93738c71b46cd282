//! A day of traffic and heat as a list of events.

use cable_dem::CableError;

use super::heat::DailyHeat;

/// Knots beyond this share of all periods: every one is simulated.
const NEARLY_ALL: f64 = 0.5;
/// Periods that are simulated one by one on the first morning, and growth of the steps after them.
const MORNING: u64 = 8;
const MORNING_GROWTH: f64 = 1.5;
/// Periods after a corner of the temperature at which one is simulated: the cable turns within a few.
const AFTER_A_CORNER: [u64; 6] = [0, 1, 2, 4, 8, 16];

/// A day of traffic and heat.
#[derive(Debug, Clone)]
pub struct Day {
    /// Passes of a day, at least as many as a period has; evenly over the day, the first after half an interval. The last period of the day
    /// takes those along that are too few for another one.
    pub passes: u64,
    /// Vehicles after which the traffic repeats, every day anew.
    pub period: usize,
    /// Temperature over the day.
    pub heat: DailyHeat,
    /// Times of the day at which a period is simulated, evenly.
    pub knots: u64,
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
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] if it has no whole period, no knot, or a profile without points or whose times are not those
    /// of one day in their order.
    pub(super) fn check(&self) -> Result<(), CableError> {
        let invalid = |name, value, allowed| Err(CableError::InvalidParameter { name, value, allowed });
        if self.period == 0 {
            return invalid("period of the traffic", 0.0, "at least one vehicle");
        }
        if self.passes < self.period as u64 {
            return invalid("passes a day", self.passes as f64, "at least those of a period");
        }
        if self.knots == 0 {
            return invalid("real periods a day", 0.0, "at least one");
        }
        self.heat.check()
    }

    /// Periods of a day.
    pub fn periods(&self) -> u64 {
        self.passes / self.period as u64
    }

    /// Passes done when `periods` of the day are: the last one is longer.
    fn passes_of(&self, periods: u64) -> u64 {
        if periods == self.periods() {
            self.passes
        } else {
            periods * self.period as u64
        }
    }

    /// Θ when `passes` of the day are done, which need not be whole \[N\].
    fn thermal_force(&self, passes: f64) -> f64 {
        self.heat.at(passes / self.passes as f64)
    }

    /// Θ at the last pass before `periods` are done.
    pub(super) fn before(&self, periods: f64) -> f64 {
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

    /// Whether every period of a day is simulated.
    pub fn is_simulated(&self) -> bool {
        self.knots as f64 >= NEARLY_ALL * self.periods() as f64
    }

    /// Periods of a day that are simulated, ascending: evenly, at the turns of the temperature and after its corners, and the last; on the `first` day
    /// many of the morning, when the cable is as laid.
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
        let period_of = |time: f64| (next(time) / self.period as u64).min(all - 1);
        let turns = self.heat.turns().into_iter().map(period_of);
        for turn in turns.chain(corners.then_some(0)) {
            knots.extend(after.iter().map(|after| turn + after));
        }
        let (mut next, mut step) = (0.0, 1.0);
        while first && step < all as f64 / self.knots as f64 {
            knots.push(next as u64);
            step = if next < MORNING as f64 {
                1.0
            } else {
                MORNING_GROWTH * step
            };
            next += step;
        }
        knots.retain(|knot| *knot < all);
        knots.sort_unstable();
        knots.dedup();
        knots
    }

    /// What happens in a day, the `first` or another, up to its pass number `passes`, which is simulated, and at its end, when the temperature is
    /// that of its beginning.
    pub(super) fn events(&self, passes: u64, first: bool) -> Vec<Event> {
        let whole = passes.div_ceil(self.period as u64).min(self.periods());
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
                events.push(Event {
                    act: Act::Pass((pass % self.period as u64) as usize),
                    thermal_force,
                    passes: pass + 1,
                    begins,
                });
            }
            // Two steps to the next knot, so that passes between are known well too.
            let (from, to) = (knot + 1, knots.get(k + 1).copied().unwrap_or(whole));
            let middle = from + (to - from) / 2;
            for (from, to) in [(from, middle), (middle, to)]
                .into_iter()
                .filter(|(from, to)| from < to)
            {
                events.push(Event {
                    act: Act::Step(from, to),
                    thermal_force: self.before(to as f64),
                    passes: self.passes_of(to),
                    begins: false,
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
        let act = Act::Warm;
        Self {
            act,
            thermal_force,
            passes,
            begins,
        }
    }
}

/// How the outcome of a pass follows from those of events of its day.
#[derive(Debug, PartialEq)]
pub(super) enum Known {
    /// It is that of this one.
    Simulated(usize),
    /// It lies in a step. Its weights of the cable at rest after events, and the event that shows what such a pass does beside that.
    Within { at_rest: [(f64, usize); 4], like: usize },
}

impl Known {
    /// The places of the events that it follows from.
    pub fn places(&self) -> Vec<usize> {
        match self {
            Self::Simulated(place) => vec![*place],
            Self::Within { at_rest, like } => {
                at_rest.iter().map(|(_, place)| *place).chain([*like]).collect()
            }
        }
    }
}

/// How `pass`, from 1, of a day with these `events` and so many vehicles in a period is known. In a step the cable goes straight from one end to
/// the other, and passes do beside that what those of the nearest simulated period did.
pub(super) fn known(events: &[Event], pass: u64, period: usize) -> Option<Known> {
    let period = period as u64;
    let passed = |passes: u64| {
        let is_it = |event: &Event| matches!(event.act, Act::Pass(_)) && event.passes == passes;
        events.iter().position(is_it)
    };
    if let Some(simulated) = passed(pass) {
        return Some(Known::Simulated(simulated));
    }
    let is_step = |event: &Event| matches!(event.act, Act::Step(..));
    let to = events
        .iter()
        .position(|event| is_step(event) && event.passes >= pass)?;
    let from = to.checked_sub(1)?;
    let share = (pass - events[from].passes) as f64 / (events[to].passes - events[from].passes) as f64;
    // The period after the step where that is nearer and whole, or the one before it.
    let done = (pass - 1) % period + 1;
    let after = events[to..].iter().position(|event| event.begins);
    let after = after.filter(|_| is_step(&events[from])).map(|place| to + place);
    let before = events[..to].iter().rposition(|event| event.begins);
    let shown = |begin: usize| {
        let passes = events[begin].passes;
        Some((begin, passed(passes + done)?, passed(passes + period)?))
    };
    let (begin, like, end) = after.and_then(shown).or_else(|| before.and_then(shown))?;
    let done = done as f64 / period as f64;
    let at_rest = [
        (1.0 - share, from),
        (share, to),
        (done - 1.0, begin.saturating_sub(1)),
        (-done, end),
    ];
    Some(Known::Within { at_rest, like })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pass_of_any_day_is_known_from_its_events() {
        let heat = [
            DailyHeat::Cosine {
                lowest: 0.0,
                highest: 1.0,
            },
            DailyHeat::Profile(vec![(0.1, 0.0), (0.4, 1.0), (0.45, 0.5)]),
        ];
        let days = [(1, 1), (7, 1), (90, 1), (90, 4), (97, 3), (402, 2), (200, 150)];
        for (heat, (passes, period)) in heat.iter().flat_map(|heat| days.map(|day| (heat, day))) {
            for knots in [1, 2, 5, 16, 1000] {
                let day = Day {
                    passes,
                    period,
                    heat: heat.clone(),
                    knots,
                };
                for (cut, first) in (1..=passes).flat_map(|cut| [(cut, false), (cut, true)]) {
                    let events = day.events(cut, first);
                    // Straight lines and what passes do beside them: together once the cable, whatever the event.
                    for pass in 1..=cut {
                        let sum = match known(&events, pass, period) {
                            Some(Known::Simulated(place)) => {
                                assert_eq!(events[place].passes, pass);
                                0.0
                            }
                            Some(Known::Within { at_rest, .. }) => {
                                at_rest.iter().map(|(weight, _)| weight).sum()
                            }
                            None => f64::NAN,
                        };
                        assert!(f64::abs(sum) < 1e-12, "pass {pass} of {cut}: {day:?}");
                    }
                    let last = events.iter().rfind(|event| matches!(event.act, Act::Pass(_)));
                    assert_eq!(last.map(|event| event.passes), Some(cut), "{day:?}");
                    // The day meets its hottest and its coldest moment.
                    let (hottest, _) = heat.extremes();
                    let is_met = |event: &Event| event.thermal_force == heat.at(hottest);
                    assert!(cut < passes || events.iter().any(is_met), "{day:?}");
                }
            }
        }
    }
}
