//! The cable on its way: passes simulated one by one or a period at a time, and advances that stand
//! for others.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable, laid};

use crate::JumpError;
use crate::error::wrap;
use crate::interval::JumpInterval;
use crate::peaks::largest_places;
use crate::period::{Period, difference, phase_of, remove_mean};
use crate::record::Record;
use crate::request::{Next, Request};
use crate::rounds::{Rounds, Settling, rounds};
use crate::scale::Scale;
use crate::tuning::{NEGLIGIBLE, PEAK_RATIO};

/// The cable and the vehicles that drive over it.
pub struct Simulation<'a, P> {
    pub request: &'a Request<'a>,
    pub mesh: &'a Mesh,
    pub cable: RestingCable,
    pub pass: P,
    pub state: CableState,
    /// Movement of a cable that nothing holds as a whole, which `state` leaves out \[m\].
    pub offset: f64,
    pub scale: Scale,
    /// Passes simulated.
    pub simulated: u64,
    /// The wanted passes so far.
    pub records: Vec<Record>,
    /// Others, of which some may show more than these.
    pub others: Vec<Record>,
    /// Whether all passes of the traffic are done: the caller counts no later ones.
    pub is_over: bool,
}

impl<'a, P> Simulation<'a, P> {
    /// Of `cable` on `mesh`; forces and movements below `least` count as nothing.
    pub fn new(
        cable: &DuctedCable,
        mesh: &'a Mesh,
        request: &'a Request<'a>,
        least: (f64, f64),
        pass: P,
    ) -> Result<Self, CableError> {
        let start = request.start.cloned();
        Ok(Self {
            request,
            mesh,
            cable: RestingCable::new(cable, mesh)?,
            pass,
            state: start.map_or_else(|| laid(cable, mesh), Ok)?,
            offset: 0.0,
            scale: Scale {
                force: least.0,
                movement: least.1,
            },
            simulated: 0,
            records: Vec::new(),
            others: Vec::new(),
            is_over: false,
        })
    }
}

impl<E, P> Simulation<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    /// Simulates the first `length` passes of a period, which follow the pass `after` where they have
    /// numbers.
    pub fn period(&mut self, length: usize, after: Option<u64>, tolerance: f64) -> Result<Period, E> {
        let mut period = Period::begin(self.state.displacement());
        for rounds in rounds(&self.request.order[..length]) {
            self.rounds(rounds, after, tolerance, &mut period)?;
        }
        period.end(self.state.displacement());
        if self.request.days.is_some() {
            // In a day forces come and go.
            for place in 0..period.len() {
                self.scale.see_outcome(&period.phase(place).outcome);
            }
        }
        let scale = &mut self.scale;
        scale.see(&self.cable, &self.state, self.offset).map_err(wrap)?;
        Ok(period)
    }

    /// Simulates rounds of a `period`. Once they will change less than a small part of the
    /// `tolerance`, all but the last count as done.
    fn rounds(
        &mut self,
        rounds: Rounds,
        after: Option<u64>,
        tolerance: f64,
        period: &mut Period,
    ) -> Result<(), E> {
        let mut settling = Settling::default();
        let mut left = rounds.times;
        while left > 0 {
            let before = self.state.displacement().to_vec();
            for _ in 0..rounds.round {
                let phase = period.len();
                let number = after.map(|after| after + 1 + phase as u64);
                let outcome = self.simulate(phase, number)?;
                period.push(&self.state, outcome);
            }
            left -= 1;
            let mut change = difference(self.state.displacement(), &before);
            let whole = remove_mean(&self.cable, &mut change);
            let shares = self.scale.shares(&self.cable, &change);
            let skipped = left.saturating_sub(1);
            let passes = skipped * rounds.round;
            let is_settled = settling.is_settled(shares, skipped, NEGLIGIBLE * tolerance);
            if is_settled && skipped > 0 && self.may_skip(after, period.len(), passes) {
                for _ in 0..passes {
                    let place = period.len();
                    period.repeat(rounds.round, whole);
                    if let Some(pass) = after.map(|after| after + 1 + place as u64) {
                        self.record_like(pass, period.outcome(place));
                    }
                }
                if whole != 0.0 {
                    let displacement = self.state.displacement().iter();
                    self.place(displacement.map(|u| u + whole * skipped as f64).collect())?;
                }
                left = 1;
            }
        }
        Ok(())
    }

    /// Whether none of so many passes from the `place` of a period that follows the pass `after` has
    /// to be simulated.
    fn may_skip(&self, after: Option<u64>, place: usize, passes: usize) -> bool {
        after.is_none_or(|after| {
            let begin = after + place as u64;
            let skipped = begin + 1..=begin + passes as u64;
            begin >= self.request.first_passes && !self.request.looked_at.iter().any(|p| skipped.contains(p))
        })
    }

    /// Records `pass`, if it is wanted, as one with the `outcome` of another one.
    fn record_like(&mut self, pass: u64, outcome: PassOutcome) {
        if self.request.wants(pass) {
            self.records.push(Record {
                pass,
                outcome,
                interpolated: true,
            });
        }
    }

    /// Lets the periods from `done` to `all` repeat the last one, the `period`, but for a movement as
    /// a `whole` in each \[m\].
    pub fn repeat(&mut self, period: &Period, done: u64, all: u64, whole: f64) {
        let length = self.request.period();
        for pass in self.recorded(done, all, &largest_places(period)) {
            let moved = whole * (pass.div_ceil(length) - done) as f64;
            self.record_like(pass, period.outcome(phase_of(pass, period.len())).moved(moved));
        }
        self.offset += whole * (all - done) as f64;
    }

    /// Simulates the pass at the place `phase` of a period and records it by its `number`.
    pub fn simulate(&mut self, phase: usize, number: Option<u64>) -> Result<PassOutcome, E> {
        let next = Next {
            phase,
            number: number.filter(|_| !self.is_over),
        };
        let outcome = (self.pass)(next, &mut self.state)?.moved(self.offset);
        self.simulated += 1;
        if let Some(pass) = number {
            let record = Record {
                pass,
                outcome: outcome.clone(),
                interpolated: false,
            };
            if self.request.wants(pass) {
                self.records.push(record);
            } else if self.request.period() > 1 && !self.is_over {
                self.others.push(record);
            }
        }
        Ok(outcome)
    }

    /// The passes to be recorded after so many periods up to others, ascending, where passes at these
    /// `places` show the largest of a period.
    fn recorded(&self, from: u64, to: u64, places: &[usize]) -> Vec<u64> {
        let Request {
            wanted, beyond, days, ..
        } = *self.request;
        let length = self.request.period();
        let (first, last) = (from * length, to * length);
        let within = |list: &'_ [u64]| {
            let place = |number| list.partition_point(|pass| *pass <= number);
            list[place(first)..place(last).max(place(first))].to_vec()
        };
        let days = days
            .unwrap_or(&[])
            .iter()
            .filter(|day| (from + 1..=to).contains(*day));
        let of_day = |day: &u64| {
            let before = (day - 1) * length;
            places.iter().map(move |&place| before + place as u64 + 1)
        };
        let mut passes = [within(wanted), within(beyond), days.flat_map(of_day).collect()].concat();
        passes.sort_unstable();
        passes.dedup();
        passes
    }

    /// Records the passes of the first `periods` within a jump.
    pub fn record(&mut self, jump: &JumpInterval<'_>, periods: u64) -> Result<(), E> {
        let places = jump.largest_places();
        let last = jump.begin + periods;
        let wanted = self.recorded(jump.begin, last, &places);
        for &pass in wanted.iter().filter(|pass| self.request.looked_at.contains(pass)) {
            let mut state = jump.state_before(&mut self.cable, pass).map_err(wrap)?;
            let phase = phase_of(pass, self.request.order.len());
            let number = Some(pass);
            (self.pass)(Next { phase, number }, &mut state)?;
        }
        let mut others = Vec::new();
        let (length, mut period) = (self.request.period(), jump.begin);
        while length > 1 && self.request.days.is_none() && !self.is_over && period < last {
            others.extend(places.iter().map(|&place| period * length + place as u64 + 1));
            period = (period + 1).max((PEAK_RATIO * period as f64) as u64);
        }
        for (passes, records) in [(wanted, &mut self.records), (others, &mut self.others)] {
            let outcomes = jump.outcomes(&mut self.cable, &passes).map_err(wrap)?;
            records.extend(passes.into_iter().zip(outcomes).map(|(pass, outcome)| Record {
                pass,
                outcome,
                interpolated: true,
            }));
        }
        Ok(())
    }

    /// Moves the cable by `advance` \[m\] and lets it come to rest.
    pub fn advance(&mut self, advance: &[f64]) -> Result<(), E> {
        let now = self.state.displacement().iter();
        let mut change: Vec<f64> = now.zip(advance).map(|(u, y)| u + y).collect();
        self.offset += remove_mean(&self.cable, &mut change);
        self.place(change)
    }

    fn place(&mut self, displacement: Vec<f64>) -> Result<(), E> {
        let friction = self.state.friction().to_vec();
        let thermal_force = self.state.thermal_force();
        let state = CableState::from_parts(self.mesh, displacement, friction);
        let state = state.and_then(|state| state.with_thermal_force(thermal_force));
        self.state = state.map_err(wrap)?;
        self.cable.settle(&mut self.state).map_err(wrap)
    }
}
