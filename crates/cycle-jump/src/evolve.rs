//! Any number of passes: simulated periods at the start, then jumps, each checked by a simulated
//! period and healed by another.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome};

use crate::JumpError;
use crate::error::wrap;
use crate::flow::Flow;
use crate::period::{Period, difference, phase_of, remove_mean};
use crate::record::{Beyond, Evolution, Record};
use crate::request::{Guide, Jumps, Next, Request};
use crate::slope::Slope;
use crate::tuning::{CAUTION, GROWTH_BETWEEN, NEGLIGIBLE, SHORTEST_JUMP, SLOPE_WIDTH, TOLERANCE_BEYOND};
use crate::walk::Walk;
use crate::within_jump::JumpInterval;

/// Simulated periods at the end of a jump: its check, and one that heals what the correction left
/// rough.
const CHECKED: u64 = 2;

/// Lets vehicles drive over `cable` on `mesh`, as laid: few of them simulated, each by a call of
/// `pass`.
///
/// # Errors
///
/// Those of `pass`; [`JumpError`] for `jumps` that begin with fewer than two periods, where they make
/// no progress, or if the cable finds no rest.
pub fn evolve<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    jumps: &Jumps,
    request: &Request<'_>,
    mut pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Evolution, E> {
    jumps.check()?;
    let mut walk = Walk::new(cable, mesh, jumps, request, &mut pass).map_err(wrap)?;
    let length = request.period();
    let all = request.passes / length;
    let width = SLOPE_WIDTH * jumps.length_scale / mesh.spacing();
    let mut known = walk.start(jumps, width as usize, all)?;
    if let Some(known) = &mut known {
        if !walk.until(known, all, jumps.most_passes)? {
            let (periods, wanted) = (walk.done, all);
            return Err(JumpError::Stuck { periods, wanted }.into());
        }
    }
    let whole = walk.state.clone();
    let left = (request.passes - all * length) as usize;
    walk.period(left, Some(all * length))?;
    let mut evolution = Evolution {
        records: walk.take_records(),
        state: std::mem::replace(&mut walk.state, whole),
        repeats: walk.repeats,
        simulated: 0,
        schedule: walk.schedule.clone(),
        beyond: None,
    };
    if let (Some(known), Some(&last)) = (known, request.beyond.iter().max()) {
        evolution.beyond = walk.follow(known, jumps, last / length)?;
    }
    evolution.simulated = walk.simulated;
    Ok(evolution)
}

/// What simulated periods have shown.
struct Known {
    /// The last period.
    period: Period,
    slope: Slope,
    /// Length of the next jump \[periods\].
    length: f64,
    /// Periods before which all that is left is not tried as one jump.
    not_before: u64,
}

impl<E: From<JumpError>> Walk<'_, E> {
    /// Simulates the first periods, of `all`; what they show, where more are left. Means of the
    /// slope run over `width` nodes.
    fn start(&mut self, jumps: &Jumps, width: usize, all: u64) -> Result<Option<Known>, E> {
        // Whole periods in which others than its vehicles drive.
        let before = self.request.first_passes / self.request.period();
        let first = before.saturating_add(jumps.first_periods);
        let (mut half, mut last) = (None, None);
        while self.done < first.min(all) {
            let period = self.next_period()?;
            if first < all && self.repeat(&period, all) {
                return Ok(None);
            }
            if self.done == before + (first - before) / 2 {
                half = Some(period.clone());
            }
            last = Some(period);
        }
        let (Some(half), Some(period), true) = (half, last, self.done == first) else {
            return Ok(None);
        };
        Ok(Some(Known {
            slope: Slope::new(&half, &period, width, &self.cable),
            period,
            length: (jumps.first_jump * (first - before) as f64).max(1.0),
            not_before: 0,
        }))
    }

    /// Goes on until `all` periods are done, without jumps beyond the first of the numbers of
    /// simulated passes `most`; false where the second is not enough.
    fn until(&mut self, known: &mut Known, all: u64, most: (u64, u64)) -> Result<bool, E> {
        while self.done < all {
            if self.simulated > most.1 {
                return Ok(false);
            }
            let (from, left) = (self.done, all - self.done);
            let longest = left.saturating_sub(CHECKED);
            let guided = self.guide.length(self.schedule.len());
            let settles = longest > 0 && self.is_settled(known, left);
            let to_end = settles && guided.is_none();
            if to_end {
                known.length = longest as f64;
                known.not_before = from.saturating_mul(2);
            }
            let length = guided.unwrap_or(known.length as u64).min(longest);
            if to_end || length >= SHORTEST_JUMP && self.simulated <= most.0 {
                self.jump(known, length)?;
            } else {
                self.go_on(known)?;
            }
            if !self.repeat(&known.period, all) && settles && self.done == all {
                let whole = remove_mean(&self.cable, &mut known.period.rate.clone());
                self.repeats = Some((from, whole));
            }
        }
        Ok(true)
    }

    /// Goes on to the period number `last`, to see where the forces lead, if they change any more.
    fn follow(&mut self, mut known: Known, jumps: &Jumps, last: u64) -> Result<Option<Beyond>, E> {
        self.is_over = true;
        let left = last.saturating_sub(self.done);
        let records = if left > 0 && self.is_settled(&known, left) {
            let record = |&pass: &u64| Record {
                pass,
                outcome: known.period.phases[phase_of(pass, known.period.phases.len())]
                    .outcome
                    .clone(),
                interpolated: true,
            };
            self.request.beyond.iter().map(record).collect()
        } else {
            self.tolerance *= TOLERANCE_BEYOND;
            let most = self.simulated + jumps.most_passes.0 / 3;
            if !self.until(&mut known, last, (most, most))? {
                return Ok(None);
            }
            let mut records = self.take_records();
            records.retain(|record| record.pass > self.request.passes);
            records
        };
        let period = known.period.outcomes().cloned().collect();
        Ok(Some(Beyond { records, period }))
    }

    /// Advance per period at the end of the last period.
    fn rate(&self, known: &Known) -> Vec<f64> {
        let mut rate = known.period.rate.clone();
        known.slope.spread(&self.cable, 0.5, &mut rate);
        rate
    }

    /// Whether forces will not change noticeably in the periods `left`.
    fn is_settled(&self, known: &Known, left: u64) -> bool {
        if self.done < known.not_before {
            return false;
        }
        let rate = self.rate(known);
        let none = vec![0.0; rate.len()];
        let flow = Flow::new(&self.cable, &rate, none, known.slope.values(), left as f64);
        self.shares(&flow.end).force < NEGLIGIBLE * self.tolerance
    }

    /// Simulates the next period, the last of a run or one between jumps, and learns from it.
    fn go_on(&mut self, known: &mut Known) -> Result<(), E> {
        let next = self.next_period()?;
        known.slope.learn(&known.period, &next, None, &self.cable);
        known.period = next;
        known.length = (GROWTH_BETWEEN * known.length).max(2.0);
        self.schedule.push(0);
        Ok(())
    }

    /// Jumps over `length` periods, simulates two more and chooses the length of the next jump; or
    /// goes back if the error is too large.
    ///
    /// The error of a jump grows as the square of its length: the next one is √(tolerance/error)
    /// times as long, and somewhat less for caution.
    fn jump(&mut self, known: &mut Known, length: u64) -> Result<(), E> {
        let (begin, from, offset) = (self.done, self.state.clone(), self.offset);
        let (flow, missed) = self.check(known, length)?;
        let error = self.shares(&missed).worse();
        let factor = CAUTION * (self.tolerance / error.max(f64::MIN_POSITIVE)).sqrt();
        if error > self.guide.max_error() * self.tolerance && length > CHECKED {
            (self.state, self.offset) = (from, offset);
            // From here on the other run is no guide.
            self.guide = Guide::Free;
            let shorter = factor * length as f64;
            known.length = shorter.min((begin as f64).max(SHORTEST_JUMP as f64));
            return Ok(());
        }
        self.advance(&missed)?;
        self.done += length + 1;
        let next = self.next_period()?;
        let jump = JumpInterval {
            begin,
            length: length + CHECKED,
            from: (&from, offset),
            to: (&self.state.clone(), self.offset),
            before: &known.period,
            after: &next,
            flow,
        };
        self.record_jump(&jump)?;
        known.period = next;
        known.length = factor * (length + CHECKED) as f64;
        self.schedule.push(length);
        Ok(())
    }

    /// Moves the cable over `length` periods, simulates one and learns from it: the flow as it is
    /// known then, up to the end of the jump, and what the first one had missed \[m\].
    fn check(&mut self, known: &mut Known, length: u64) -> Result<(Flow, Vec<f64>), E> {
        let rate = self.rate(known);
        let before = known.slope.clone();
        let none = vec![0.0; rate.len()];
        let at_end = (length + CHECKED) as f64;
        let flow = Flow::new(&self.cable, &rate, none, before.values(), at_end);
        self.advance(&flow.after(&self.cable, length as f64))?;
        let checked = self.period(self.request.order.len(), None)?;
        let cable = &self.cable;
        let predicted = before.predict(&known.period, &checked, cable);
        known
            .slope
            .learn(&known.period, &checked, Some(&predicted), cable);
        // The slope measured between both ends describes the jump best. The part of the advance
        // that it does not explain is taken to have grown evenly over the jump.
        let measured = (length + 1) as f64;
        let predicted = known.slope.predict(&known.period, &checked, cable);
        let defects = difference(&difference(&checked.rate, &known.period.rate), &predicted);
        let growth = defects.iter().map(|defect| defect / measured).collect();
        let corrected = Flow::new(cable, &rate, growth, known.slope.values(), at_end);
        let mut missed = difference(&corrected.after(cable, measured), &flow.after(cable, measured));
        before.spread(cable, 1.0, &mut missed);
        Ok((corrected, missed))
    }
}
