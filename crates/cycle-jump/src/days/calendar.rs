//! All days as a sequence of numbered events, and which of them stand for a pass.

use std::ops::Range;

use super::day::{Act, Day, Event};

/// Days that are all alike, with the same events in each; the last may end early. Events are
/// numbered from 1 over all days.
pub struct Calendar<'a> {
    pub day: &'a Day,
    pub passes: u64,
    pub events: Vec<Event>,
    /// How many of these the last day has.
    last: usize,
}

impl<'a> Calendar<'a> {
    /// Days like this `day` with so many `passes` in all, at least one.
    pub fn new(day: &'a Day, passes: u64) -> Self {
        let of_last = (passes - 1) % day.passes() + 1;
        let events = day.events(of_last);
        let cut = events.iter().position(|event| event.is_pass(of_last));
        let is_whole = of_last == day.passes();
        Self {
            day,
            passes,
            last: cut.filter(|_| !is_whole).map_or(events.len(), |place| place + 1),
            events,
        }
    }

    /// Number of days.
    pub fn days(&self) -> u64 {
        self.passes.div_ceil(self.day.passes())
    }

    /// The numbers that the events of a `day` have.
    pub fn numbers(&self, day: u64) -> Range<u64> {
        let length = self.events.len() as u64;
        let of_day = if day == self.days() {
            self.last as u64
        } else {
            length
        };
        let begin = (day - 1).saturating_mul(length).saturating_add(1);
        begin..begin.saturating_add(of_day)
    }

    /// Number of the last event.
    pub fn last_number(&self) -> u64 {
        self.numbers(self.days()).end - 1
    }

    /// The event with this number.
    pub fn event(&self, number: u64) -> &Event {
        &self.events[((number - 1) % self.events.len() as u64) as usize]
    }

    /// The pass that the event with this number is, if it is one.
    pub fn pass(&self, number: u64) -> Option<u64> {
        let event = self.event(number);
        let before = (number - 1) / self.events.len() as u64 * self.day.passes();
        matches!(event.act, Act::Pass(_)).then_some(before + event.passes)
    }

    /// Numbers and weights of the events whose sum is the outcome of `pass`, of all but the last
    /// one only as the cable is at rest after it; nothing for a pass that does not come. Within a
    /// step the cable goes straight from one end to the other, and a pass does relative to that
    /// what the same one of the nearest simulated period did, the last event.
    pub fn parts(&self, pass: u64) -> Option<Vec<(u64, f64)>> {
        let before = pass.checked_sub(1).filter(|_| pass <= self.passes)? / self.day.passes();
        let numbers = self.numbers(before + 1);
        let events = &self.events[..(numbers.end - numbers.start) as usize];
        let part = |place: usize, weight: f64| (numbers.start + place as u64, weight);
        let pass = pass - before * self.day.passes();
        let passed = |passes: u64| events.iter().position(|event| event.is_pass(passes));
        if let Some(simulated) = passed(pass) {
            return Some(vec![part(simulated, 1.0)]);
        }
        let is_step = |event: &Event| matches!(event.act, Act::Step(..));
        let is_around = |event: &Event| is_step(event) && event.passes >= pass;
        let to = events.iter().position(is_around)?;
        let from = to.checked_sub(1)?;
        let share = (pass - events[from].passes) as f64 / (events[to].passes - events[from].passes) as f64;
        // The period after the step where that is nearer and whole, or the one before it.
        let period = self.day.period;
        let done = (pass - 1) % period + 1;
        let after = events[to..].iter().position(|event| event.begins);
        let after = after.filter(|_| is_step(&events[from])).map(|place| to + place);
        let before = events[..to].iter().rposition(|event| event.begins);
        let shown = |begin: usize| {
            let passes = events[begin].passes;
            let like = passed(passes + done)?;
            Some((begin.saturating_sub(1), like, passed(passes + period)?))
        };
        let (begin, like, end) = after.and_then(shown).or_else(|| before.and_then(shown))?;
        let done = done as f64 / period as f64;
        Some(vec![
            part(from, 1.0 - share),
            part(to, share),
            part(begin, done - 1.0),
            part(end, -done),
            part(like, 1.0),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::super::heat::DailyHeat;
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
                for (cut, whole) in (1..=passes).flat_map(|cut| [(cut, 0), (cut, 3 * passes)]) {
                    let all = whole + cut;
                    let calendar = Calendar::new(&day, all);
                    // Straight lines and what passes do relative to them: together once the cable.
                    for pass in whole + 1..=all {
                        let parts = calendar.parts(pass).expect("it comes");
                        let sum: f64 = parts.iter().map(|(_, weight)| weight).sum();
                        assert!(f64::abs(sum - 1.0) < 1e-12, "pass {pass} of {all}: {day:?}");
                        let is_simulated = parts.len() == 1;
                        assert!(!is_simulated || calendar.pass(parts[0].0) == Some(pass));
                        let last = calendar.last_number();
                        assert!(parts.iter().all(|part| (1..=last).contains(&part.0)));
                    }
                    assert!(calendar.parts(0).is_none() && calendar.parts(all + 1).is_none());
                    // The last pass is simulated, and after it at most the end of the day comes.
                    let last = (1..=calendar.last_number()).rev();
                    let last = last.map(|number| calendar.pass(number)).find(Option::is_some);
                    assert_eq!(last, Some(Some(all)), "{day:?}");
                    // The day meets its hottest moment.
                    let is_met = |event: &Event| event.thermal_force == heat.at(*hottest);
                    assert!(calendar.events.iter().any(is_met), "{day:?}");
                }
            }
        }
    }
}
