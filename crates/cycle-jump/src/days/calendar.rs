//! All days as one list of events, with numbers.

use super::day::{Act, Day, Event, Known, known};
use crate::JumpError;

/// The events of all days: those of the first, of the last, and of each between them. They have numbers, from 1.
pub struct Calendar<'a> {
    day: &'a Day,
    pub days: u64,
    pub first: Vec<Event>,
    pub between: Vec<Event>,
    pub last: Vec<Event>,
}

impl<'a> Calendar<'a> {
    /// Of so many passes in all.
    pub fn new(day: &'a Day, passes: u64) -> Self {
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

    pub fn events(&self, day: u64) -> &[Event] {
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

    /// The number of the event at a place of a day.
    pub fn number(&self, day: u64, place: usize) -> u64 {
        self.before(day) + place as u64 + 1
    }

    /// The day of the event `number`, and its place there.
    pub fn place(&self, number: u64) -> (u64, usize) {
        let later = (number - 1).checked_sub(self.first.len() as u64);
        let day = later.map_or(1, |later| (2 + later / self.between.len() as u64).min(self.days));
        (day, (number - 1 - self.before(day)) as usize)
    }

    /// The number of the pass that an event is.
    pub fn pass(&self, number: u64) -> Option<u64> {
        let (day, place) = self.place(number);
        let event = &self.events(day)[place];
        matches!(event.act, Act::Pass(_)).then_some((day - 1) * self.day.passes + event.passes)
    }

    /// How a pass is known, and the day that it comes on.
    pub fn known(&self, pass: u64) -> Result<(u64, Known), JumpError> {
        let day = (pass - 1) / self.day.passes + 1;
        let of_day = pass - (day - 1) * self.day.passes;
        let known = known(self.events(day), of_day, self.day.period);
        Ok((day, known.ok_or(JumpError::UnknownPass { pass })?))
    }

    /// The numbers of the events from which the wanted `passes` follow, and of those of the last day; ascending.
    pub fn wanted(&self, passes: &[u64]) -> Result<Vec<u64>, JumpError> {
        let last = self.before(self.days);
        let mut numbers: Vec<u64> = (last + 1..=last + self.events(self.days).len() as u64).collect();
        for &pass in passes {
            let (day, known) = self.known(pass)?;
            numbers.extend(known.places().into_iter().map(|place| self.number(day, place)));
        }
        numbers.sort_unstable();
        numbers.dedup();
        Ok(numbers)
    }
}
