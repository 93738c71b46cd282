//! The cable on its way: passes simulated a period at a time, and advances that stand for others.

use std::collections::BTreeSet;

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable, laid};

use crate::JumpError;
use crate::error::wrap;
use crate::peaks::largest_places;
use crate::period::{Period, difference, largest, phase_of, remove_mean};
use crate::record::Record;
use crate::request::{Guide, Jumps, Next, Request};
use crate::scale::Scale;
use crate::tuning::{NEGLIGIBLE, PEAK_RATIO};
use crate::within_jump::JumpInterval;

/// What simulates a pass.
pub type Pass<'a, E> = &'a mut dyn FnMut(Next, &mut CableState) -> Result<PassOutcome, E>;

/// The cable and the vehicles that drive over it.
pub struct Walk<'a, E> {
    pub request: &'a Request<'a>,
    pub cable: RestingCable,
    pass: Pass<'a, E>,
    wanted: BTreeSet<u64>,
    pub state: CableState,
    /// Movement of a cable that nothing holds as a whole, which `state` leaves out \[m\].
    pub offset: f64,
    scale: Scale,
    /// Error of a jump, as a share of what is large.
    pub tolerance: f64,
    /// Periods done.
    pub done: u64,
    /// Passes simulated.
    pub simulated: u64,
    records: Vec<Record>,
    pub guide: Guide<'a>,
    /// Lengths of the jumps, 0 for a simulated period between.
    pub schedule: Vec<u64>,
    /// Periods after which each repeats the one before, but for a movement as a whole \[m\].
    pub repeats: Option<(u64, f64)>,
    /// Whether all passes of the traffic are done: the caller counts no later ones.
    pub is_over: bool,
}

impl<'a, E: From<JumpError>> Walk<'a, E> {
    /// Of `cable` on `mesh`.
    pub fn new(
        cable: &DuctedCable,
        mesh: &Mesh,
        jumps: &Jumps,
        request: &'a Request<'a>,
        pass: Pass<'a, E>,
    ) -> Result<Self, CableError> {
        let start = request.start.cloned();
        Ok(Self {
            request,
            cable: RestingCable::new(cable, mesh)?,
            pass,
            wanted: request.wanted.iter().chain(request.beyond).copied().collect(),
            state: start.map_or_else(|| laid(cable, mesh), Ok)?,
            offset: 0.0,
            scale: jumps.least,
            tolerance: jumps.tolerance,
            done: 0,
            simulated: 0,
            records: Vec::new(),
            guide: request.guide,
            schedule: Vec::new(),
            repeats: None,
            is_over: false,
        })
    }

    /// What a `change` \[m\] of the displacements changes, as shares of what is large.
    pub fn shares(&self, change: &[f64]) -> Scale {
        self.scale.shares(&self.cable, change)
    }

    /// Simulates the next period.
    pub fn next_period(&mut self) -> Result<Period, E> {
        let length = self.request.order.len();
        let period = self.period(length, Some(self.done * length as u64))?;
        self.done += 1;
        Ok(period)
    }

    /// Simulates the first `length` passes of a period, which follow the pass `after` where they
    /// have numbers.
    pub fn period(&mut self, length: usize, after: Option<u64>) -> Result<Period, E> {
        let before = self.state.clone();
        let mut period = Period::begin(before.displacement());
        for equal in self.request.order[..length].chunk_by(|one, next| one == next) {
            self.equal_vehicles(equal.len(), after, &mut period)?;
        }
        period.end(self.state.displacement());
        self.cable.release(&before, &self.state);
        if self.request.days.is_some() {
            // In a day forces come and go.
            period.outcomes().for_each(|outcome| self.scale.see(outcome));
        }
        let rest = PassOutcome::at_rest(self.cable.cable(), &self.state).map_err(wrap)?;
        self.scale.see(&rest);
        let movement = largest(self.state.displacement()) + self.offset.abs();
        self.scale.movement = self.scale.movement.max(movement);
        Ok(period)
    }

    /// Simulates so many equal vehicles of a `period`. Once two in a row show that the others will
    /// change less than a small part of the tolerance, all but the last count as done.
    fn equal_vehicles(&mut self, count: usize, after: Option<u64>, period: &mut Period) -> Result<(), E> {
        let (mut last, mut was_settled): (Option<Scale>, bool) = (None, false);
        let mut left = count;
        while left > 0 {
            let before = self.state.displacement().to_vec();
            let number = |place: usize| after.map(|after| after + 1 + place as u64);
            let outcome = self.simulate(period.phases.len(), number(period.phases.len()))?;
            period.push(&self.state, outcome);
            left -= 1;
            let mut change = difference(self.state.displacement(), &before);
            let whole = remove_mean(&self.cable, &mut change);
            let change = self.shares(&change);
            let skipped = left.saturating_sub(1);
            let allowed = NEGLIGIBLE * self.tolerance;
            let is_settled = last.is_some_and(|last| change.remaining(last, skipped).worse() <= allowed);
            last = Some(change);
            let are_settled = std::mem::replace(&mut was_settled, is_settled) && is_settled;
            let places = period.phases.len()..period.phases.len() + skipped;
            if !are_settled || skipped == 0 || !self.may_skip(after, &places) {
                continue;
            }
            for place in places {
                period.repeat(whole);
                if let Some(pass) = number(place).filter(|pass| self.wanted.contains(pass)) {
                    self.record(pass, period.phases[place].outcome.clone(), true);
                }
            }
            if whole != 0.0 {
                let displacement = self.state.displacement().iter();
                self.place(displacement.map(|u| u + whole * skipped as f64).collect())?;
            }
            left = 1;
        }
        Ok(())
    }

    /// Whether none of the passes at these places of a period that follows the pass `after` has to
    /// be simulated.
    fn may_skip(&self, after: Option<u64>, places: &std::ops::Range<usize>) -> bool {
        after.is_none_or(|after| {
            let begin = after + places.start as u64;
            let passes = begin + 1..=after + places.end as u64;
            let is_looked_at = self.request.looked_at.iter().any(|pass| passes.contains(pass));
            begin >= self.request.first_passes && !is_looked_at
        })
    }

    /// Simulates the pass at the place `phase` of a period and records it by its `number`.
    fn simulate(&mut self, phase: usize, number: Option<u64>) -> Result<PassOutcome, E> {
        let next = Next {
            phase,
            number: number.filter(|_| !self.is_over),
        };
        let outcome = (self.pass)(next, &mut self.state)?.moved(self.offset);
        self.simulated += 1;
        if let Some(pass) = number.filter(|pass| self.has_candidates() || self.wanted.contains(pass)) {
            self.record(pass, outcome.clone(), false);
        }
        Ok(outcome)
    }

    /// Moves the cable by `advance` \[m\] and lets it come to rest.
    pub fn advance(&mut self, advance: &[f64]) -> Result<(), E> {
        let now = self.state.displacement().iter();
        let mut moved: Vec<f64> = now.zip(advance).map(|(u, y)| u + y).collect();
        self.offset += remove_mean(&self.cable, &mut moved);
        self.place(moved)
    }

    fn place(&mut self, displacement: Vec<f64>) -> Result<(), E> {
        self.state = self.cable.moved(&self.state, displacement).map_err(wrap)?;
        self.cable.settle(&mut self.state).map_err(wrap)
    }

    /// Takes the days left of `all` to repeat the last one, the `period`, but for a movement as a
    /// whole: if its advance, gone on unchanged, would change no force and no movement noticeably.
    pub fn repeat(&mut self, period: &Period, all: u64) -> bool {
        let (done, left) = (self.done, all - self.done);
        let mut change = period.rate.clone();
        let whole = remove_mean(&self.cable, &mut change);
        let change = left as f64 * self.shares(&change).worse();
        if self.request.days.is_none() || left == 0 || change > NEGLIGIBLE * self.tolerance {
            return false;
        }
        for pass in self.recorded(done, all, &largest_places(period)) {
            let moved = whole * (pass.div_ceil(self.request.period()) - done) as f64;
            let outcome = period.phases[phase_of(pass, period.phases.len())].outcome.clone();
            self.record(pass, outcome.moved(moved), true);
        }
        self.offset += whole * left as f64;
        (self.repeats, self.done) = (Some((done, whole)), all);
        true
    }

    /// Records passes within a jump, before its last simulated period.
    pub fn record_jump(&mut self, jump: &JumpInterval<'_>) -> Result<(), E> {
        let mut places = largest_places(jump.before);
        places.extend(largest_places(jump.after));
        let (length, last) = (self.request.period(), jump.begin + jump.length - 1);
        let mut passes = self.recorded(jump.begin, last, &places);
        let mut period = jump.begin;
        while self.has_candidates() && self.request.days.is_none() && period < last {
            passes.extend(places.iter().map(|&place| period * length + place as u64 + 1));
            period = (period + 1).max((PEAK_RATIO * period as f64) as u64);
        }
        let passes: Vec<u64> = passes.into_iter().collect();
        for &pass in passes.iter().filter(|pass| self.request.looked_at.contains(pass)) {
            let (mut state, _) = jump.state(&mut self.cable, pass - 1).map_err(wrap)?;
            let phase = phase_of(pass, self.request.order.len());
            let number = Some(pass);
            (self.pass)(Next { phase, number }, &mut state)?;
        }
        let outcomes = jump.outcomes(&mut self.cable, &passes).map_err(wrap)?;
        for (pass, outcome) in passes.into_iter().zip(outcomes) {
            self.record(pass, outcome, true);
        }
        Ok(())
    }

    /// The passes to be recorded after so many periods up to others without their simulation, where
    /// passes at these `places` show the largest of a period.
    fn recorded(&self, from: u64, to: u64, places: &BTreeSet<usize>) -> BTreeSet<u64> {
        let length = self.request.period();
        let wanted = self.wanted.range(from * length + 1..=to * length).copied();
        let days = self.request.days.unwrap_or(&[]).iter();
        let of_days = days.filter(|day| (from + 1..=to).contains(*day)).flat_map(|day| {
            let before = (day - 1) * length;
            places.iter().map(move |&place| before + place as u64 + 1)
        });
        wanted.chain(of_days).collect()
    }

    /// Whether a period has several passes, of which any may show more than the wanted ones.
    fn has_candidates(&self) -> bool {
        self.request.order.len() > 1 && !self.is_over
    }

    fn record(&mut self, pass: u64, outcome: PassOutcome, interpolated: bool) {
        self.records.push(Record {
            pass,
            outcome,
            interpolated,
        });
    }

    /// The records so far, ascending.
    pub fn take_records(&mut self) -> Vec<Record> {
        let mut records = std::mem::take(&mut self.records);
        records.sort_by_key(|record| record.pass);
        records
    }
}
