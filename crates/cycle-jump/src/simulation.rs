//! The cable on its way: passes simulated one by one or a period at a time, and advances that stand
//! for others.

use std::collections::BTreeSet;

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable, laid};

use crate::JumpError;
use crate::error::wrap;
use crate::peaks::largest_places;
use crate::period::{Period, difference, largest, phase_of, remove_mean};
use crate::record::Record;
use crate::request::{Jumps, Next, Request};
use crate::rounds::{Rounds, Settling, rounds};
use crate::scale::Scale;
use crate::tuning::{NEGLIGIBLE, PEAK_RATIO};
use crate::within_jump::{JumpInterval, STEADY};

/// The cable and the vehicles that drive over it.
pub struct Simulation<'a, P> {
    pub request: &'a Request<'a>,
    pub mesh: &'a Mesh,
    pub cable: RestingCable,
    pass: P,
    wanted: BTreeSet<u64>,
    pub state: CableState,
    /// Movement of a cable that nothing holds as a whole, which `state` leaves out \[m\].
    pub offset: f64,
    scale: Scale,
    /// Error of a jump, as a share of what is large.
    pub tolerance: f64,
    /// Passes simulated.
    pub simulated: u64,
    records: Vec<Record>,
    /// Whether all passes of the traffic are done: the caller counts no later ones.
    pub is_over: bool,
}

impl<'a, P> Simulation<'a, P> {
    /// Of `cable` on `mesh`.
    pub fn new(
        cable: &DuctedCable,
        mesh: &'a Mesh,
        request: &'a Request<'a>,
        jumps: &Jumps,
        pass: P,
    ) -> Result<Self, CableError> {
        let start = request.start.cloned();
        Ok(Self {
            request,
            mesh,
            cable: RestingCable::new(cable, mesh)?,
            pass,
            wanted: request.wanted.iter().chain(request.beyond).copied().collect(),
            state: start.map_or_else(|| laid(cable, mesh), Ok)?,
            offset: 0.0,
            scale: jumps.least,
            tolerance: jumps.tolerance,
            simulated: 0,
            records: Vec::new(),
            is_over: false,
        })
    }

    /// What a `change` \[m\] of the displacements changes, as shares of what is large.
    pub fn shares(&self, change: &[f64]) -> Scale {
        self.scale.shares(&self.cable, change)
    }

    /// Whether a period has several passes, of which any may show more than the wanted ones.
    fn has_candidates(&self) -> bool {
        self.request.order.len() > 1 && !self.is_over
    }

    /// The records so far, ascending.
    pub fn take_records(&mut self) -> Vec<Record> {
        let mut records = std::mem::take(&mut self.records);
        records.sort_by_key(|record| record.pass);
        records
    }

    fn record(&mut self, pass: u64, outcome: PassOutcome, interpolated: bool) {
        self.records.push(Record {
            pass,
            outcome,
            interpolated,
        });
    }

    /// Lets the periods from `done` to `all` repeat the last one, the `period`, but for a movement
    /// as a `whole` in each \[m\].
    pub fn repeat(&mut self, period: &Period, done: u64, all: u64, whole: f64) {
        for pass in self.recorded(done, all, &largest_places(period)) {
            let moved = whole * (pass.div_ceil(self.request.period()) - done) as f64;
            let place = phase_of(pass, period.len());
            self.record(pass, period.outcome(place).moved(moved), true);
        }
        self.offset += whole * (all - done) as f64;
    }

    /// The passes to be recorded after so many periods up to others without their simulation, where
    /// passes at these `places` show the largest of a period.
    fn recorded(&self, from: u64, to: u64, places: &BTreeSet<usize>) -> BTreeSet<u64> {
        let length = self.request.period();
        let mut passes: BTreeSet<u64> = self
            .wanted
            .range((from * length + 1)..=(to * length))
            .copied()
            .collect();
        for day in self
            .request
            .days
            .unwrap_or(&[])
            .iter()
            .filter(|day| (from + 1..=to).contains(*day))
        {
            passes.extend(places.iter().map(|&place| (day - 1) * length + place as u64 + 1));
        }
        passes
    }
}

impl<E, P> Simulation<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    /// Simulates the first `length` passes of a period, which follow the pass `after` where they
    /// have numbers.
    pub fn period(&mut self, length: usize, after: Option<u64>) -> Result<Period, E> {
        let before = self.state.clone();
        let mut period = Period::begin(before.displacement());
        for rounds in rounds(&self.request.order[..length]) {
            self.rounds(rounds, after, &mut period)?;
        }
        period.end(self.state.displacement());
        self.cable.release(&before, &self.state);
        if self.request.days.is_some() {
            // In a day forces come and go.
            (0..length).for_each(|place| self.scale.see(&period.phase(place).outcome));
        }
        let rest = PassOutcome::at_rest(self.cable.cable(), &self.state).map_err(wrap)?;
        self.scale.see(&rest);
        let movement = largest(self.state.displacement()) + self.offset.abs();
        self.scale.movement = self.scale.movement.max(movement);
        Ok(period)
    }

    /// Simulates rounds of a `period`. Once they will change less than a small part of the
    /// tolerance, all but the last count as done.
    fn rounds(&mut self, rounds: Rounds, after: Option<u64>, period: &mut Period) -> Result<(), E> {
        let mut settling = Settling::default();
        let mut left = rounds.times;
        while left > 0 {
            let before = self.state.displacement().to_vec();
            for _ in 0..rounds.round {
                let phase = period.len();
                let number = after.map(|after| after + 1 + phase as u64);
                let outcome = self.simulate(phase, number)?;
                period.push(&self.cable, &self.state, outcome);
            }
            left -= 1;
            let mut change = difference(self.state.displacement(), &before);
            let whole = remove_mean(&self.cable, &mut change);
            let skipped = left.saturating_sub(1);
            let is_settled = settling.is_settled(self.shares(&change), skipped, NEGLIGIBLE * self.tolerance);
            let begin = period.len();
            let passes = begin..begin + skipped * rounds.round;
            if !is_settled || skipped == 0 || !self.may_skip(after, &passes) {
                continue;
            }
            for place in passes {
                period.repeat(rounds.round, whole);
                let pass = after.map(|after| after + 1 + place as u64);
                if let Some(pass) = pass.filter(|pass| self.wanted.contains(pass)) {
                    self.record(pass, period.outcome(place), true);
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

    /// Records passes within a jump, before its last simulated period. Returned: what it changes of
    /// the forces, as a share of the largest.
    pub fn record_jump(&mut self, jump: &JumpInterval<'_>) -> Result<f64, E> {
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
        let changed = self.shares(&jump.change()).force;
        let outcomes = if changed < STEADY {
            passes.iter().map(|&pass| jump.on_line(pass)).collect()
        } else {
            jump.outcomes(&mut self.cable, &passes).map_err(wrap)?
        };
        for (pass, outcome) in passes.into_iter().zip(outcomes) {
            self.record(pass, outcome, true);
        }
        Ok(changed)
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
}
