//! Days as numbers of passes and of events.

use std::ops::Range;

use super::day::{Act, Day, Event};

/// Equal days one after the other, the last of which may end early.
pub struct Calendar<'a> {
    pub day: &'a Day,
    passes: u64,
    pub events: Vec<Event>,
}

impl<'a> Calendar<'a> {
    /// Days up to the last of so many `passes`, with which the last day ends.
    pub fn new(day: &'a Day, passes: u64) -> Self {
        let of_last = (passes - 1) % day.passes() + 1;
        Self {
            day,
            passes,
            events: day.events(of_last),
        }
    }

    /// Events of a day.
    fn length(&self) -> u64 {
        self.events.len() as u64
    }

    /// All days.
    pub fn days(&self) -> u64 {
        self.passes.div_ceil(self.day.passes())
    }

    /// Numbers of the events of a `day`, from 1.
    pub fn numbers(&self, day: u64) -> Range<u64> {
        let before = (day - 1) * self.length();
        before + 1..before + self.length() + 1
    }

    /// Place in the day of the last pass of all.
    pub fn last(&self) -> usize {
        let of_last = self.passes - (self.days() - 1) * self.day.passes();
        self.passed(of_last).unwrap_or(0)
    }

    /// All events: of a last day that ends early only those up to its last pass.
    pub fn count(&self) -> u64 {
        if self.passes % self.day.passes() == 0 {
            self.days() * self.length()
        } else {
            (self.days() - 1) * self.length() + self.last() as u64 + 1
        }
    }

    /// Place of an event in its day, from 0.
    pub fn place(&self, number: u64) -> usize {
        ((number - 1) % self.length()) as usize
    }

    /// The number of the pass that the event of this number is.
    pub fn pass(&self, number: u64) -> Option<u64> {
        let event = &self.events[self.place(number)];
        let days = (number - 1) / self.length();
        matches!(event.act, Act::Pass(_)).then_some(days * self.day.passes() + event.passes)
    }

    /// The events whose sum is what `pass` did, none of a pass that does not come: the pass itself,
    /// or within a step a straight line from one end to the other, with what the same pass of the
    /// nearest simulated period did relative to that period's own line.
    pub fn parts(&self, pass: u64) -> Option<Vec<Part>> {
        let day = pass.checked_sub(1).filter(|_| pass <= self.passes)? / self.day.passes();
        let (of_day, period) = (pass - day * self.day.passes(), self.day.period());
        let number = |place: usize| day * self.length() + place as u64 + 1;
        let part = |place: usize, weight: f64, at_rest: bool| Part {
            number: number(place),
            weight,
            at_rest,
        };
        if let Some(simulated) = self.passed(of_day) {
            return Some(vec![part(simulated, 1.0, false)]);
        }
        let is_step = |event: &Event| matches!(event.act, Act::Step(..));
        let to = |event: &Event| is_step(event) && event.passes >= of_day;
        let to = self.events.iter().position(to)?;
        let [begin, end] = [to - 1, to].map(|place| self.events[place].passes);
        let share = (of_day - begin) as f64 / (end - begin) as f64;
        let of_period = (of_day - 1) % period + 1;
        let shown = |begin: usize| {
            let before = self.events[begin].passes;
            let (like, end) = (self.passed(before + of_period)?, self.passed(before + period)?);
            (number(end) <= self.count()).then_some((begin - 1, like, end))
        };
        // After the second step from one simulated period to the next that one is nearer.
        let after = self.events[to..].iter().position(|event| event.begins);
        let after = after
            .filter(|_| is_step(&self.events[to - 1]))
            .map(|place| to + place);
        let before = self.events[..to].iter().rposition(|event| event.begins);
        let (begin, like, end) = after.and_then(shown).or_else(|| before.and_then(shown))?;
        let done = of_period as f64 / period as f64;
        Some(vec![
            part(to - 1, 1.0 - share, true),
            part(to, share, true),
            part(begin, done - 1.0, true),
            part(end, -done, true),
            part(like, 1.0, false),
        ])
    }

    /// Place of a pass of the day, from 1, if it is simulated.
    fn passed(&self, of_day: u64) -> Option<usize> {
        let is_it = |event: &Event| matches!(event.act, Act::Pass(_)) && event.passes == of_day;
        self.events.iter().position(is_it)
    }
}

/// One summand of what a pass did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Number of an event.
    pub number: u64,
    pub weight: f64,
    /// Whether only the cable at rest after it counts, without peaks and heat during it.
    pub at_rest: bool,
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
                        let sum: f64 = parts.iter().map(|part| part.weight).sum();
                        assert!(f64::abs(sum - 1.0) < 1e-12, "pass {pass} of {all}: {day:?}");
                        let is_known = |part: &Part| (1..=calendar.count()).contains(&part.number);
                        assert!(parts.iter().all(is_known), "pass {pass} of {all}: {day:?}");
                        let is_simulated = parts.len() == 1;
                        assert!(!is_simulated || calendar.pass(parts[0].number) == Some(pass));
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
