//! The walk along the passes: simulated periods at the start, then jumps, each held to two simulated periods.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome};

use crate::JumpError;
use crate::drive::Drive;
use crate::error::wrap;
use crate::flow::Flow;
use crate::jumped::Jumped;
use crate::knowledge::Knowledge;
use crate::period::{Period, difference, phase_of, take_whole};
use crate::record::{Beyond, Evolution};
use crate::request::{Guide, Jumps, Next, Request};
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
/// And so many passes but for those of one jump.
const MOST_PASSES_BEYOND: u64 = 2400;
/// A run under way.
struct Walk<'a, P> {
    drive: Drive<'a, P>,
    jumps: &'a Jumps,
    guide: Guide<'a>,
    tolerance: f64,
    /// Periods done.
    done: u64,
    schedule: Vec<u64>,
    /// Periods after which each is like the one before but for this movement as a whole \[m\], if that was found.
    repeats: Option<(u64, f64)>,
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
        drive: Drive::new(cable, mesh, request, jumps, pass).map_err(wrap)?,
        jumps,
        guide: request.guide,
        tolerance: jumps.tolerance,
        done: 0,
        schedule: Vec::new(),
        repeats: None,
    };
    walk.run()
}

impl<E, P> Walk<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    fn run(mut self) -> Result<Evolution, E> {
        let request = self.drive.request;
        let (passes, period) = (request.passes, request.period());
        let all = passes.saturating_sub(request.one_by_one.1) / period;
        let mut known = self.start(all)?;
        if let Some(known) = &mut known {
            if !self.until(all, known, self.jumps.most_passes)? {
                let (periods, simulated) = (self.done, self.drive.simulated);
                if self.jumps.of_days {
                    return Err(JumpError::NeverPeriodic { days: periods }.into());
                }
                return Err(JumpError::Stuck {
                    periods,
                    wanted: all,
                    simulated,
                }
                .into());
            }
        }
        let whole = self.drive.state.clone();
        let mut from = all * period;
        if let (Some(known), 1..) = (&known, request.one_by_one.1) {
            // Other vehicles drive at the end: what is left over before them, less than a period, goes on as the last one.
            let left = passes - request.one_by_one.1 - from;
            let rate = known.rate(&mut self.drive.cable);
            let share = left as f64 / period as f64;
            let advance: Vec<f64> = rate.iter().map(|v| share * v).collect();
            self.drive.advance(&advance)?;
            from += left;
        }
        for number in from + 1..=passes {
            let phase = phase_of(number, period as usize);
            self.drive.simulate(Next {
                phase,
                number: Some(number),
            })?;
        }
        let records = std::mem::take(&mut self.drive.records);
        let mut evolution = Evolution {
            others: std::mem::take(&mut self.drive.others),
            records,
            period: known
                .iter()
                .flat_map(|known| known.period.outcomes())
                .cloned()
                .collect(),
            state: std::mem::replace(&mut self.drive.state, whole),
            simulated: self.drive.simulated,
            schedule: self.schedule.clone(),
            beyond: None,
            offset: self.drive.offset,
            repeats: self.repeats,
        };
        if let (Some(known), Some(&last)) = (known, request.beyond.last()) {
            evolution.beyond = self.follow(known, last / period)?;
            evolution.simulated = self.drive.simulated;
        }
        Ok(evolution)
    }

    /// Goes on to the period number `last`, to see where the forces lead, unless they no longer change.
    fn follow(&mut self, mut known: Knowledge, last: u64) -> Result<Option<Beyond>, E> {
        let Request { passes, beyond, .. } = *self.drive.request;
        let rate = known.rate(&mut self.drive.cable);
        let left = last.saturating_sub(self.done);
        if left > 0 && self.is_settled(&known, &rate, left) {
            return Ok(Some(Beyond::unchanged(beyond, &known.period)));
        }
        self.tolerance *= TOLERANCE_BEYOND;
        // The traffic is done: its passes are not let drive once more under their numbers.
        self.drive.numbered_from = passes + 1;
        let length = known.period.len() as u64;
        let most = (MOST_BEYOND * length).min(MOST_PASSES_BEYOND + CHECKED * length);
        let most = self.drive.simulated + most;
        let leads = self.until(last, &mut known, (most, most))?;
        let later = self.drive.records.partition_point(|record| record.pass <= passes);
        let records = self.drive.records.split_off(later);
        Ok(leads.then(|| Beyond::new(records, &known.period)))
    }

    /// Simulates the first periods, of `all`; what they say, where more are left.
    fn start(&mut self, all: u64) -> Result<Option<Knowledge>, E> {
        // Whole periods in which others than its vehicles drive.
        let before = self.drive.request.one_by_one.0 / self.drive.request.period();
        while self.done < before.min(all) {
            self.next_period()?;
        }
        let first = before + self.jumps.first_periods;
        let mut half = None;
        let mut last = None;
        while self.done < first.min(all) {
            let period = self.next_period()?;
            if self.done == before + (first - before) / 2 {
                half = Some(period.clone());
            }
            if self.repeat(&period, all) {
                return Ok(None);
            }
            last = Some(period);
        }
        let (Some(half), Some(period), true) = (half, last, self.done == first) else {
            return Ok(None);
        };
        let width = (WIDTH * self.jumps.length_scale / self.drive.mesh.spacing()) as usize;
        let rate = difference(&period.rate, &half.rate);
        let friction = period.friction_from(&half.middle, &self.drive.cable);
        let change = Change {
            rate: &rate,
            friction: &friction,
            predicted: None,
        };
        Ok(Some(Knowledge {
            slope: Slope::new(change, width, self.drive.cable.cable().friction().limit()),
            period,
            length: (self.jumps.first_jump * (first - before) as f64).max(1.0),
            not_before: 0,
        }))
    }

    /// Goes on until `all` periods are done, without jumps beyond the first of the numbers of simulated passes `most`; false where
    /// the second is not enough.
    fn until(&mut self, all: u64, known: &mut Knowledge, most: (u64, u64)) -> Result<bool, E> {
        while self.done < all {
            if self.drive.simulated > most.1 {
                return Ok(false);
            }
            let left = all - self.done;
            let rate = known.rate(&mut self.drive.cable);
            let guided = self.guide.length(self.schedule.len());
            let asked = guided.is_none() || self.jumps.of_days;
            let settles = asked && left > CHECKED && self.is_settled(known, &rate, left);
            let whole = settles && guided.is_none();
            if whole {
                known.length = (left - CHECKED) as f64;
                known.not_before = 2 * self.done;
            }
            let length = guided
                .unwrap_or(known.length as u64)
                .min(left.saturating_sub(CHECKED));
            let patient = self.drive.simulated <= most.0;
            if !whole && (length < SHORTEST || !patient) {
                let next = self.next_period()?;
                known.learn(&next, None, &self.drive.cable);
                known.period = next;
                self.repeat(&known.period, all);
                known.length = (GROWTH_BETWEEN * known.length).max(2.0);
                self.schedule.push(0);
            } else {
                let share = if length + CHECKED == left { AT_END } else { 1.0 };
                let from = self.done;
                let taken = self.jump(known, &rate, length, share * self.tolerance)?;
                if whole && !taken {
                    known.length = known.length.min((self.done as f64).max(SHORTEST as f64));
                }
                let to_end = taken && self.done == all;
                let repeats = taken && self.repeat(&known.period, all);
                if !repeats && settles && to_end && self.jumps.of_days {
                    let moved = take_whole(&self.drive.cable, &mut known.period.rate.clone());
                    self.repeats = Some((from, moved));
                }
            }
        }
        Ok(true)
    }

    /// Takes the days left of `all` to be like the last one, the `period`, but for a movement as a whole: if its advance, gone on unchanged,
    /// would change no force and no movement by more than the tolerance lets it.
    fn repeat(&mut self, period: &Period, all: u64) -> bool {
        let left = all - self.done;
        if !self.jumps.of_days || left == 0 {
            return false;
        }
        let mut change = period.rate.clone();
        let whole = take_whole(&self.drive.cable, &mut change);
        let shares = self.drive.scale.shares(&self.drive.cable, &change);
        let (force, movement) = (left as f64 * shares.force, left as f64 * shares.movement);
        if force > STEADY * self.tolerance || movement > STEADY * self.tolerance {
            return false;
        }
        self.drive.repeat(period, self.done, all, whole);
        (self.repeats, self.done) = (Some((self.done, whole)), all);
        true
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
            &mut self.drive.cable,
            rate,
            known.slope.values(),
            left as f64,
            SUBSTEPS_AHEAD,
        );
        self.drive.scale.shares(&self.drive.cable, ahead.end()).force < STEADY * self.tolerance
    }

    /// Jumps over `length` periods, simulates two more and chooses the next length; false where the error is so large beside the
    /// `tolerance` that the jump is taken back.
    fn jump(&mut self, known: &mut Knowledge, rate: &[f64], length: u64, tolerance: f64) -> Result<bool, E> {
        let (from, offset) = (self.drive.state.clone(), self.drive.offset);
        let slope = known.slope.values().to_vec();
        let at_end = length + CHECKED;
        let flow = Flow::new(&mut self.drive.cable, rate, &slope, at_end as f64, SUBSTEPS);
        if !known.rests(self.jumps.motion) {
            let jump = flow.after(&mut self.drive.cable, length as f64);
            self.drive.advance(&jump)?;
        }
        let checked = self.drive.period(None, self.tolerance)?;
        let predicted = known.predict(&checked, &mut self.drive.cable);
        known.learn(&checked, Some(&predicted), &self.drive.cable);
        // The slope between both ends says best how the cable went from one to the other; what that leaves of the advance grew evenly.
        let measured = (length + 1) as f64;
        let growth = difference(&checked.rate, &known.period.rate)
            .iter()
            .zip(known.predict(&checked, &mut self.drive.cable))
            .map(|(seen, said)| (seen - said) / measured)
            .collect();
        let between = known.slope.values().to_vec();
        let bent = Flow::growing(
            &mut self.drive.cable,
            rate,
            growth,
            &between,
            at_end as f64,
            SUBSTEPS,
        );
        let mut missed = difference(
            &bent.after(&mut self.drive.cable, measured),
            &flow.after(&mut self.drive.cable, measured),
        );
        self.drive.cable.diffuse(|i| slope[i], &mut missed);
        let shares = self.drive.scale.shares(&self.drive.cable, &missed);
        let error = shares.force.max(shares.movement);
        let factor = (CAUTION * (tolerance / error.max(f64::MIN_POSITIVE)).sqrt()).clamp(GROWTH.0, GROWTH.1);
        let allowed = match self.guide {
            Guide::Free => REJECTED * tolerance,
            Guide::Follow(_) => REJECTED_AS_GUIDED * tolerance,
            Guide::Obey(_) => f64::INFINITY,
        };
        if error > allowed && length > CHECKED {
            (self.drive.state, self.drive.offset) = (from, offset);
            // From here on the other run is no guide.
            self.guide = Guide::Free;
            known.length = factor * length as f64;
            return Ok(false);
        }
        self.drive.advance(&missed)?;
        let begin = self.done;
        self.done += length + 1;
        let recorded = self.drive.records.len();
        let next = self.next_period()?;
        // What lies within the jump is recorded before the period at its end.
        let simulated = self.drive.records.split_off(recorded);
        let to = self.drive.state.clone();
        let jumped = Jumped {
            mesh: self.drive.mesh,
            begin,
            length: at_end,
            from: &from,
            to: &to,
            offset,
            moved: self.drive.offset - offset,
            before: &known.period,
            after: &next,
            flow: bent,
        };
        self.drive.record(&jumped, self.done - 1)?;
        self.drive.records.extend(simulated);
        known.period = next;
        known.length = factor * at_end as f64;
        self.schedule.push(length);
        Ok(true)
    }

    /// Simulates the next period.
    fn next_period(&mut self) -> Result<Period, E> {
        let after = self.done * self.drive.request.period();
        let period = self.drive.period(Some(after), self.tolerance)?;
        self.done += 1;
        Ok(period)
    }
}
