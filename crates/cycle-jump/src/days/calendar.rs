//! Days as numbers of passes and of events.

use std::ops::Range;

use super::day::{Act, Day, Event};

/// Equal days one after the other, the last of which may end early.
pub struct Calendar<'a> {
    pub day: &'a Day,
    passes: u64,
    pub events: Vec<Event>,
    pub days: u64,
    /// Place in its day, from 0, of the last pass of all.
    pub last: usize,
    /// All events: of a last day that ends early only those up to its last pass.
    pub count: u64,
}

impl<'a> Calendar<'a> {
    /// Days up to the last of so many `passes`, at least one, with which the last day ends.
    pub fn new(day: &'a Day, passes: u64) -> Self {
        let (before, of_last) = ((passes - 1) / day.passes(), (passes - 1) % day.passes() + 1);
        let events = day.events(of_last);
        let last = place_of(&events, of_last).unwrap_or(0);
        let ends_early = of_last < day.passes();
        let of_last = if ends_early { last + 1 } else { events.len() };
        Self {
            day,
            passes,
            days: before + 1,
            last,
            count: before * events.len() as u64 + of_last as u64,
            events,
        }
    }

    /// Numbers of the events of a `day`, from 1.
    pub fn numbers(&self, day: u64) -> Range<u64> {
        let length = self.events.len() as u64;
        (day - 1) * length + 1..day * length + 1
    }

    /// Place of an event in its day, from 0.
    pub fn place(&self, number: u64) -> usize {
        ((number - 1) % self.events.len() as u64) as usize
    }

    /// The number of the pass that the event of this number is.
    pub fn pass(&self, number: u64) -> Option<u64> {
        let event = &self.events[self.place(number)];
        let before = (number - 1) / self.events.len() as u64;
        matches!(event.act, Act::Pass(_)).then_some(before * self.day.passes() + event.passes)
    }

    /// Numbers and weights of the events whose sum is what `pass` did, if it comes: the pass itself;
    /// or within a step a straight line from one end to the other, with what the same pass of the
    /// nearest simulated period did relative to that period's own line. Of all but the last of them
    /// only the cable at rest counts, without peaks and heat.
    pub fn parts(&self, pass: u64) -> Option<Vec<(u64, f64)>> {
        let before = pass.checked_sub(1).filter(|_| pass <= self.passes)? / self.day.passes();
        let (of_day, period) = (pass - before * self.day.passes(), self.day.period());
        let number = |place: usize| before * self.events.len() as u64 + place as u64 + 1;
        if let Some(simulated) = place_of(&self.events, of_day) {
            return Some(vec![(number(simulated), 1.0)]);
        }
        let is_step = |event: &Event| matches!(event.act, Act::Step(..));
        let is_around = |event: &Event| is_step(event) && event.passes >= of_day;
        let to = self.events.iter().position(is_around)?;
        let (done, all) = (self.events[to - 1].passes, self.events[to].passes);
        let share = (of_day - done) as f64 / (all - done) as f64;
        let of_period = (of_day - 1) % period + 1;
        let shown = |begin: usize| {
            let passed = |passes: u64| place_of(&self.events, self.events[begin].passes + passes);
            let (like, end) = (passed(of_period)?, passed(period)?);
            (number(end) <= self.count).then_some((begin - 1, like, end))
        };
        // After the second step from one simulated period to the next that one is nearer.
        let after = self.events[to..].iter().position(|event| event.begins);
        let after = after.filter(|_| is_step(&self.events[to - 1]));
        let after = after.and_then(|place| shown(to + place));
        let before = self.events[..to].iter().rposition(|event| event.begins);
        let (begin, like, end) = after.or_else(|| shown(before?))?;
        let done = of_period as f64 / period as f64;
        let places = [to - 1, to, begin, end, like].map(number);
        let weights = [1.0 - share, share, done - 1.0, -done, 1.0];
        Some(places.into_iter().zip(weights).collect())
    }
}

/// Place in a day of its pass number `of_day`, if it is simulated.
fn place_of(events: &[Event], of_day: u64) -> Option<usize> {
    let is_it = |event: &Event| matches!(event.act, Act::Pass(_)) && event.passes == of_day;
    events.iter().position(is_it)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::days::DailyHeat;

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
                for all in passes + 1..=2 * passes {
                    let calendar = Calendar::new(&day, all);
                    // Straight lines and what passes do relative to them: together once the cable.
                    for pass in 1..=all {
                        let parts = calendar.parts(pass).expect("a pass that comes");
                        let sum: f64 = parts.iter().map(|(_, weight)| weight).sum();
                        assert!(f64::abs(sum - 1.0) < 1e-12, "pass {pass} of {all}: {day:?}");
                        let is_known = |part: &(u64, f64)| (1..=calendar.count).contains(&part.0);
                        assert!(parts.iter().all(is_known), "pass {pass} of {all}: {day:?}");
                        let is_simulated = parts.len() == 1;
                        assert!(!is_simulated || calendar.pass(parts[0].0) == Some(pass));
                        assert!(is_simulated || pass < all);
                    }
                    assert!(calendar.parts(0).is_none() && calendar.parts(all + 1).is_none());
                    // The day meets its hottest moment.
                    let is_met = |event: &Event| event.thermal_force == heat.at(*hottest);
                    assert!(calendar.events.iter().any(is_met), "{day:?}");
                }
            }
        }
    }
}
