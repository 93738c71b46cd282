//! The cable on the way: vehicles that drive over it, pass by pass or a period at a time, and advances that stand for others.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable, laid};

use crate::JumpError;
use crate::error::wrap;
use crate::jumped::Jumped;
use crate::peaks::largest_places;
use crate::period::{Period, Phase, difference, phase_of, take_whole};
use crate::record::Record;
use crate::request::{Jumps, Next, Request};
use crate::scale::Scale;
use crate::stretches::{Stretch, stretches};

/// Change of forces and movements still to come in the rounds of a stretch, as a share of the tolerance, below which they count as done.
const SETTLED: f64 = 0.1;
/// Changes fall more slowly than geometrically: what is still to come is so many times the sum of a geometric series.
const SLOWLY: f64 = 3.0;
/// Rounds in a row that show it.
const SHOWN: usize = 2;

/// Passes within a jump at which a vehicle is looked at that shows the largest of something are so far apart, as a ratio.
const APART: f64 = 1.1;

/// The cable and the vehicles that drive over it.
pub struct Drive<'a, P> {
    pub request: &'a Request<'a>,
    pub mesh: &'a Mesh,
    pub cable: RestingCable,
    pub pass: P,
    pub state: CableState,
    /// What a cable that nothing holds has moved as a whole \[m\].
    pub offset: f64,
    pub scale: Scale,
    /// Passes simulated.
    pub simulated: u64,
    /// The wanted passes so far.
    pub records: Vec<Record>,
    /// Others, of which some may show more than these.
    pub others: Vec<Record>,
    /// Passes before this one have no number any more: the traffic is done, and what comes after it is looked at.
    pub numbered_from: u64,
    /// Whether periods are days, in which forces come and go.
    pub over_days: bool,
}

impl<'a, P> Drive<'a, P> {
    /// Over `cable` on `mesh` as laid; forces and movements below the least of `jumps` count as nothing.
    pub fn new(
        cable: &DuctedCable,
        mesh: &'a Mesh,
        request: &'a Request<'a>,
        jumps: &Jumps,
        pass: P,
    ) -> Result<Self, CableError> {
        Ok(Self {
            request,
            mesh,
            cable: RestingCable::new(cable, mesh)?,
            pass,
            state: request
                .state
                .map_or_else(|| laid(cable, mesh), |state| Ok(state.clone()))?,
            offset: 0.0,
            scale: Scale {
                force: jumps.least.0,
                movement: jumps.least.1,
            },
            simulated: 0,
            records: Vec::with_capacity(request.wanted.len()),
            others: Vec::new(),
            numbered_from: 1,
            over_days: jumps.of_days,
        })
    }
}

impl<E, P> Drive<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    /// Simulates one period, whose passes follow the pass `after` where they have numbers. In stretches of equal rounds those that would
    /// change less than a small part of the `tolerance` count as done.
    pub fn period(&mut self, after: Option<u64>, tolerance: f64) -> Result<Period, E> {
        let start = self.state.displacement().to_vec();
        let length = self.request.order.len();
        let mut phases = Vec::with_capacity(length);
        let mut places = Vec::with_capacity(length);
        for Stretch { round, times } in stretches(self.request.order) {
            let mut settling = Settling::default();
            let mut before = self.state.displacement().to_vec();
            let mut done = 0;
            while done < times {
                for _ in 0..round {
                    let phase = places.len();
                    let number = after.map(|after| after + 1 + phase as u64);
                    let number = number.filter(|number| *number >= self.numbered_from);
                    let outcome = self.simulate(Next { phase, number })?;
                    places.push((phases.len(), 0.0));
                    phases.push(Phase::new(&start, &self.state, outcome));
                }
                done += 1;
                let mut change = difference(self.state.displacement(), &before);
                let whole = take_whole(&self.cable, &mut change);
                // The last round is simulated in any case.
                let left = (times - done).saturating_sub(1);
                let shares = self.scale.shares(&self.cable, &change);
                let is_settled = settling.is_settled(shares, left, SETTLED * tolerance);
                if is_settled && left > 0 && self.may_skip(after, places.len(), round * left) {
                    let last = phases.len() - round;
                    for skipped in 0..round * left {
                        let (phase, moved) = (last + skipped % round, whole * (skipped / round + 1) as f64);
                        self.note_skipped(after, places.len(), &phases[phase].outcome, moved);
                        places.push((phase, moved));
                    }
                    self.move_whole(whole * left as f64)?;
                    done += left;
                }
                before.copy_from_slice(self.state.displacement());
            }
        }
        if self.over_days {
            for phase in &phases {
                self.scale.see_outcome(&phase.outcome);
            }
        }
        self.scale
            .see(&self.cable, &self.state, self.offset)
            .map_err(wrap)?;
        Ok(Period::new(&start, &self.state, phases, places))
    }

    /// Whether none of so many passes from the `place` of a period that follows the pass `after` has to be simulated.
    fn may_skip(&self, after: Option<u64>, place: usize, passes: usize) -> bool {
        let Request {
            one_by_one: (first, last),
            ..
        } = self.request;
        after.is_none_or(|after| {
            let begin = after + place as u64;
            let end = begin + passes as u64;
            let is_looked_at = |pass: &u64| (begin + 1..=end).contains(pass);
            let looked_at = self.request.looked_at.iter().any(is_looked_at);
            begin >= *first && end <= self.request.passes.saturating_sub(*last) && !looked_at
        })
    }

    /// Records a pass that counts as done, if it is wanted: it did what the same one of the last simulated round did.
    fn note_skipped(&mut self, after: Option<u64>, place: usize, of_round: &PassOutcome, moved: f64) {
        let Some(pass) = after.map(|after| after + 1 + place as u64) else {
            return;
        };
        if self.request.wants(pass) {
            self.record_like(pass, of_round, moved);
        }
    }

    /// Records `pass` as one that did what a simulated one did, with the cable `moved` as a whole since then \[m\].
    fn record_like(&mut self, pass: u64, simulated: &PassOutcome, moved: f64) {
        self.records.push(Record {
            pass,
            outcome: simulated.clone().moved(moved),
            interpolated: true,
        });
    }

    /// Lets the periods after `done` up to `all` be like the last one, the `period`, but for a movement as a `whole` in each \[m\].
    pub fn repeat(&mut self, period: &Period, done: u64, all: u64, whole: f64) {
        let length = period.len() as u64;
        let range = done * length + 1..=all * length;
        for pass in self.request.recorded(range, &largest_places(period)) {
            let moved = whole * (pass.div_ceil(length) - done) as f64;
            self.record_like(pass, &period.phase(phase_of(pass, period.len())).outcome, moved);
        }
        self.offset += whole * (all - done) as f64;
    }

    /// Simulates a pass and records it.
    pub fn simulate(&mut self, next: Next) -> Result<PassOutcome, E> {
        let outcome = self.pass(next)?;
        self.simulated += 1;
        if let Some(pass) = next.number {
            let record = Record {
                pass,
                outcome: outcome.clone(),
                interpolated: false,
            };
            if self.request.wants(pass) {
                self.records.push(record);
            } else if self.may_show_more(pass) {
                self.others.push(record);
            }
        }
        Ok(outcome)
    }

    /// Whether `pass` may show more than the wanted ones: it follows a whole period of the vehicles that drive there.
    fn may_show_more(&self, pass: u64) -> bool {
        let Request {
            passes,
            one_by_one: (first, last),
            ..
        } = *self.request;
        let period = self.request.period();
        let follows_others =
            first > 0 && (first + 1..=first.div_ceil(period) * period + period).contains(&pass);
        period > 1 && pass + last <= passes && !follows_others
    }

    /// Records the passes within a jump, up to the period `last`.
    pub fn record(&mut self, jumped: &Jumped<'_>, last: u64) -> Result<(), E> {
        let Request {
            passes, looked_at, ..
        } = *self.request;
        let period = self.request.period();
        let first = jumped.begin * period;
        let last = last * period;
        let inside = self.request.recorded(first + 1..=last, &jumped.largest_places());
        let outcomes = jumped.outcomes(&mut self.cable, &inside).map_err(wrap)?;
        if first < passes && !self.over_days {
            let others = jumped.largest_passes(last.min(passes), APART);
            let of_others = jumped.outcomes(&mut self.cable, &others).map_err(wrap)?;
            for (pass, outcome) in others.into_iter().zip(of_others) {
                self.others.push(Record {
                    pass,
                    outcome,
                    interpolated: true,
                });
            }
        }
        for (pass, outcome) in inside.into_iter().zip(outcomes) {
            if looked_at.contains(&pass) {
                let before = if pass - 1 == first {
                    (jumped.from.clone(), jumped.offset)
                } else {
                    jumped.state(&mut self.cable, pass - 1).map_err(wrap)?
                };
                let now = (std::mem::replace(&mut self.state, before.0), self.offset);
                self.offset = before.1;
                let phase = jumped.place(pass).0;
                let number = Some(pass);
                self.pass(Next { phase, number })?;
                (self.state, self.offset) = now;
            }
            self.records.push(Record {
                pass,
                outcome,
                interpolated: true,
            });
        }
        Ok(())
    }

    /// Simulates a pass.
    pub fn pass(&mut self, next: Next) -> Result<PassOutcome, E> {
        Ok((self.pass)(next, &mut self.state)?.moved(self.offset))
    }

    /// Moves the cable by `advance` \[m\] and lets it come to rest.
    pub fn advance(&mut self, advance: &[f64]) -> Result<(), E> {
        let now = self.state.displacement().iter().zip(advance);
        let mut moved: Vec<f64> = now.map(|(u, y)| u + y).collect();
        self.offset += take_whole(&self.cable, &mut moved);
        self.place(moved)
    }

    /// Moves a cable that nothing holds as a whole \[m\].
    fn move_whole(&mut self, by: f64) -> Result<(), E> {
        if by == 0.0 {
            return Ok(());
        }
        let moved = self.state.displacement().iter().map(|u| u + by).collect();
        self.place(moved)
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

/// How fast the rounds of a stretch change less and less.
#[derive(Default)]
struct Settling {
    last: Option<Scale>,
    shown: usize,
}

impl Settling {
    /// Whether the rounds `left` change forces and movements by less than the share `allowed`, after one that changed them by `change`.
    fn is_settled(&mut self, change: Scale, left: usize, allowed: f64) -> bool {
        let to_come = |now: f64, last: f64| {
            let ratio = if last > 0.0 { now / last } else { 0.0 };
            now * (left as f64).min(SLOWLY / (1.0 - ratio).max(f64::MIN_POSITIVE))
        };
        let still = self.last.is_some_and(|last| {
            to_come(change.force, last.force) <= allowed && to_come(change.movement, last.movement) <= allowed
        });
        self.shown = if still { self.shown + 1 } else { 0 };
        self.last = Some(change);
        self.shown >= SHOWN
    }
}
