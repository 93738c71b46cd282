//! The walk along the passes: simulated periods at the start, then jumps, each held to two simulated periods.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome, RestingCable, laid};

use crate::JumpError;
use crate::error::wrap;
use crate::flow::Flow;
use crate::knowledge::Knowledge;
use crate::period::{Period, difference};
use crate::record::{Beyond, Evolution, Jumped, Record, take_whole};
use crate::request::{Guide, Jumps, Next, Request};
use crate::scale::Scale;
use crate::slope::{Change, Slope};

/// Substeps of a jump, and of the look ahead over all that is left. Where a flow ends depends on its last and longest substeps; more than these
/// only show its beginning better.
const SUBSTEPS: i32 = 8;
const SUBSTEPS_AHEAD: i32 = 12;
/// Length of the slope's sliding mean \[length scales of the duct's motion\].
const WIDTH: f64 = 2.5;
/// A jump shorter than this is not worth its check: a period is simulated.
const SHORTEST: u64 = 4;
/// Growth of the next jump's length after a simulated period.
const GROWTH_BETWEEN: f64 = 1.3;
/// Least and largest growth from one jump to the next; share of the length that the error would allow.
const GROWTH: (f64, f64) = (0.2, 3.0);
const CAUTION: f64 = 0.85;
/// Error of a jump beside the tolerance above which it is taken back, and of one that another run took on another mesh.
const REJECTED: f64 = 2.0;
const REJECTED_AS_GUIDED: f64 = 4.0;
/// Tolerance of a jump to the end beside that of others: no passes after it mend what it leaves.
const AT_END: f64 = 0.125;
/// Change of all forces still to come, beside the tolerance, below which all that is left is one jump.
const STEADY: f64 = 0.1;
/// Simulated periods at the end of a jump: its check, and one that heals what the correction left rough.
const CHECKED: u64 = 2;
/// Periods simulated at most to see where the forces lead; the error of a jump there beside that before: where they lead hardly
/// depends on the way, but near shakedown.
const MOST_BEYOND: u64 = 200;
const TOLERANCE_BEYOND: f64 = 4.0;

/// A run under way.
struct Walk<'a, P> {
    jumps: &'a Jumps,
    request: &'a Request<'a>,
    mesh: &'a Mesh,
    cable: RestingCable,
    pass: P,
    guide: Guide<'a>,
    tolerance: f64,
    state: CableState,
    /// What a cable that nothing holds has moved as a whole \[m\].
    offset: f64,
    /// Periods done.
    done: u64,
    scale: Scale,
    simulated: u64,
    records: Vec<Record>,
    schedule: Vec<u64>,
}

/// Lets vehicles drive over `cable` on `mesh`, as laid: few of them simulated, each by a call of `pass`.
///
/// # Errors
///
/// Those of `pass`; [`JumpError`] where jumps do not get on, or the cable finds no rest.
pub fn evolve<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    jumps: &Jumps,
    request: &Request<'_>,
    pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Evolution, E> {
    let walk = Walk {
        jumps,
        request,
        mesh,
        cable: RestingCable::new(cable, mesh).map_err(wrap)?,
        pass,
        guide: request.guide,
        tolerance: jumps.tolerance,
        state: laid(cable, mesh).map_err(wrap)?,
        offset: 0.0,
        done: 0,
        scale: Scale {
            force: jumps.least.0,
            movement: jumps.least.1,
        },
        simulated: 0,
        records: Vec::with_capacity(request.wanted.len()),
        schedule: Vec::new(),
    };
    walk.run()
}

impl<E, P> Walk<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    fn run(mut self) -> Result<Evolution, E> {
        let Request { passes, period, .. } = *self.request;
        let all = passes / period as u64;
        let mut known = self.start(all)?;
        if let Some(known) = &mut known {
            if !self.until(all, known, self.jumps.most_passes)? {
                let (periods, simulated) = (self.done, self.simulated);
                return Err(JumpError::Stuck {
                    periods,
                    wanted: all,
                    simulated,
                }
                .into());
            }
        }
        let whole = self.state.clone();
        let rest = all * period as u64 + 1..=passes;
        for (phase, number) in rest.enumerate() {
            let number = Some(number);
            self.simulate(Next { phase, number })?;
        }
        let mut evolution = Evolution {
            records: std::mem::take(&mut self.records),
            state: std::mem::replace(&mut self.state, whole),
            simulated: self.simulated,
            schedule: self.schedule.clone(),
            beyond: None,
        };
        if let (Some(known), Some(&last)) = (known, self.request.beyond.last()) {
            evolution.beyond = self.follow(known, last / period as u64)?;
            evolution.simulated = self.simulated;
        }
        Ok(evolution)
    }

    /// Goes on to the period number `last`, to see where the forces lead, unless they no longer change.
    fn follow(&mut self, mut known: Knowledge, last: u64) -> Result<Option<Beyond>, E> {
        let Request { passes, beyond, .. } = *self.request;
        let rate = known.rate(&mut self.cable);
        let left = last.saturating_sub(self.done);
        if left > 0 && self.is_settled(&known, &rate, left) {
            let later = beyond.partition_point(|&pass| pass <= passes);
            return Ok(Some(Beyond::unchanged(&beyond[later..], &known.period.phases)));
        }
        self.tolerance *= TOLERANCE_BEYOND;
        let most = self.simulated + MOST_BEYOND * known.period.phases.len() as u64;
        let leads = self.until(last, &mut known, (most, most))?;
        let later = self.records.partition_point(|record| record.pass <= passes);
        let records = self.records.split_off(later);
        Ok(leads.then(|| Beyond::new(records, &known.period.phases)))
    }

    /// Simulates the first periods, of `all`; what they say, where more are left.
    fn start(&mut self, all: u64) -> Result<Option<Knowledge>, E> {
        let first = self.jumps.first_periods.max(4);
        let mut half = None;
        let mut last = None;
        while self.done < first.min(all) {
            let period = self.next_period()?;
            if self.done == first / 2 {
                half = Some(period.clone());
            }
            last = Some(period);
        }
        let (Some(half), Some(period), true) = (half, last, self.done == first) else {
            return Ok(None);
        };
        let width = (WIDTH * self.jumps.length_scale / self.mesh.spacing()) as usize;
        let rate = difference(&period.rate, &half.rate);
        let friction = period.friction_from(&half.middle, &self.cable);
        let change = Change {
            rate: &rate,
            friction: &friction,
            predicted: None,
        };
        Ok(Some(Knowledge {
            slope: Slope::new(change, width, self.cable.cable().friction().limit()),
            period,
            length: (self.jumps.first_jump * first as f64).max(1.0),
            not_before: 0,
        }))
    }

    /// Goes on until `all` periods are done, without jumps beyond the first of the numbers of simulated passes `most`; false where
    /// the second is not enough.
    fn until(&mut self, all: u64, known: &mut Knowledge, most: (u64, u64)) -> Result<bool, E> {
        while self.done < all {
            if self.simulated > most.1 {
                return Ok(false);
            }
            let left = all - self.done;
            let rate = known.rate(&mut self.cable);
            let guided = self.guide.length(self.schedule.len());
            let whole = guided.is_none() && left > CHECKED && self.is_settled(known, &rate, left);
            if whole {
                known.length = (left - CHECKED) as f64;
                known.not_before = 2 * self.done;
            }
            let length = guided
                .unwrap_or(known.length as u64)
                .min(left.saturating_sub(CHECKED));
            let patient = self.simulated <= most.0;
            if !whole && (length < SHORTEST || !patient) {
                let next = self.next_period()?;
                known.learn(&next, None, &self.cable);
                known.period = next;
                known.length = (GROWTH_BETWEEN * known.length).max(2.0);
                self.schedule.push(0);
            } else {
                let share = if length + CHECKED == left { AT_END } else { 1.0 };
                if !self.jump(known, &rate, length, share * self.tolerance)? && whole {
                    known.length = known.length.min((self.done as f64).max(SHORTEST as f64));
                }
            }
        }
        Ok(true)
    }

    /// Whether the cable rests, or forces will change no more than a small part of the tolerance in the periods `left`.
    fn is_settled(&mut self, known: &Knowledge, rate: &[f64], left: u64) -> bool {
        if known.rests(self.jumps.motion) {
            return true;
        }
        if self.done < known.not_before {
            return false;
        }
        let ahead = Flow::new(
            &mut self.cable,
            rate,
            known.slope.values(),
            left as f64,
            SUBSTEPS_AHEAD,
        );
        self.scale.shares(&self.cable, ahead.end()).force < STEADY * self.tolerance
    }

    /// Jumps over `length` periods, simulates two more and chooses the next length; false where the error is so large beside the
    /// `tolerance` that the jump is taken back.
    fn jump(&mut self, known: &mut Knowledge, rate: &[f64], length: u64, tolerance: f64) -> Result<bool, E> {
        let (from, offset) = (self.state.clone(), self.offset);
        let slope = known.slope.values().to_vec();
        let at_end = length + CHECKED;
        let flow = Flow::new(&mut self.cable, rate, &slope, at_end as f64, SUBSTEPS);
        if !known.rests(self.jumps.motion) {
            let jump = flow.after(&mut self.cable, length as f64);
            self.advance(&jump)?;
        }
        let checked = self.period(None)?;
        let predicted = known.predict(&checked, &mut self.cable);
        known.learn(&checked, Some(&predicted), &self.cable);
        // The slope between both ends says best how the cable went from one to the other; what that leaves of the advance grew evenly.
        let measured = (length + 1) as f64;
        let growth = difference(&checked.rate, &known.period.rate)
            .iter()
            .zip(known.predict(&checked, &mut self.cable))
            .map(|(seen, said)| (seen - said) / measured)
            .collect();
        let between = known.slope.values().to_vec();
        let bent = Flow::growing(&mut self.cable, rate, growth, &between, at_end as f64, SUBSTEPS);
        let mut missed = difference(
            &bent.after(&mut self.cable, measured),
            &flow.after(&mut self.cable, measured),
        );
        self.cable.diffuse(|i| slope[i], &mut missed);
        let shares = self.scale.shares(&self.cable, &missed);
        let error = shares.force.max(shares.movement);
        let factor = (CAUTION * (tolerance / error.max(f64::MIN_POSITIVE)).sqrt()).clamp(GROWTH.0, GROWTH.1);
        let allowed = match self.guide {
            Guide::Free => REJECTED * tolerance,
            Guide::Follow(_) => REJECTED_AS_GUIDED * tolerance,
            Guide::Obey(_) => f64::INFINITY,
        };
        if error > allowed && length > CHECKED {
            (self.state, self.offset) = (from, offset);
            // From here on the other run is no guide.
            self.guide = Guide::Free;
            known.length = factor * length as f64;
            return Ok(false);
        }
        self.advance(&missed)?;
        let begin = self.done;
        self.done += length + 1;
        let recorded = self.records.len();
        let next = self.next_period()?;
        // What lies within the jump is recorded before the period at its end.
        let simulated = self.records.split_off(recorded);
        let to = self.state.clone();
        let jumped = Jumped {
            mesh: self.mesh,
            begin,
            length: at_end,
            from: &from,
            to: &to,
            offset,
            moved: self.offset - offset,
            before: &known.period.phases,
            after: &next.phases,
            flow: bent,
        };
        self.record(&jumped)?;
        self.records.extend(simulated);
        known.period = next;
        known.length = factor * at_end as f64;
        self.schedule.push(length);
        Ok(true)
    }

    /// Records the passes within a jump.
    fn record(&mut self, jumped: &Jumped<'_>) -> Result<(), E> {
        let Request {
            period,
            wanted,
            looked_at,
            beyond,
            ..
        } = *self.request;
        let first = jumped.begin * period as u64;
        let last = (self.done - 1) * period as u64;
        let inside = |pass: &&u64| (first + 1..=last).contains(*pass);
        let inside: Vec<u64> = wanted.iter().chain(beyond).filter(inside).copied().collect();
        let outcomes = jumped.outcomes(&mut self.cable, &inside).map_err(wrap)?;
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

    /// Moves the cable by `advance` \[m\] and lets it come to rest.
    fn advance(&mut self, advance: &[f64]) -> Result<(), E> {
        let now = self.state.displacement().iter().zip(advance);
        let mut moved: Vec<f64> = now.map(|(u, y)| u + y).collect();
        self.offset += take_whole(&self.cable, &mut moved);
        let friction = self.state.friction().to_vec();
        self.state = CableState::from_parts(self.mesh, moved, friction).map_err(wrap)?;
        self.cable.settle(&mut self.state).map_err(wrap)
    }

    /// Simulates the next period.
    fn next_period(&mut self) -> Result<Period, E> {
        let period = self.period(Some(self.done * self.request.period as u64))?;
        self.done += 1;
        Ok(period)
    }

    /// Simulates one period, whose passes follow the pass `after` where they have numbers.
    fn period(&mut self, after: Option<u64>) -> Result<Period, E> {
        let start = self.state.displacement().to_vec();
        let mut passes = Vec::with_capacity(self.request.period);
        for phase in 0..self.request.period {
            let number = after.map(|after| after + 1 + phase as u64);
            let outcome = self.simulate(Next { phase, number })?;
            passes.push((self.state.clone(), outcome));
        }
        self.scale
            .see(&self.cable, &self.state, self.offset)
            .map_err(wrap)?;
        Ok(Period::new(&start, &passes))
    }

    fn simulate(&mut self, next: Next) -> Result<PassOutcome, E> {
        let outcome = self.pass(next)?;
        self.simulated += 1;
        let Request { wanted, beyond, .. } = self.request;
        let is_wanted = |pass: &u64| wanted.binary_search(pass).is_ok() || beyond.binary_search(pass).is_ok();
        if let Some(pass) = next.number.filter(is_wanted) {
            self.records.push(Record {
                pass,
                outcome: outcome.clone(),
                interpolated: false,
            });
        }
        Ok(outcome)
    }

    /// Simulates a pass.
    fn pass(&mut self, next: Next) -> Result<PassOutcome, E> {
        let mut outcome = (self.pass)(next, &mut self.state)?;
        outcome.upstream_displacement += self.offset;
        outcome.downstream_displacement += self.offset;
        Ok(outcome)
    }
}
