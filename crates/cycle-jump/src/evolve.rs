//! Any number of passes: simulated periods at the start, then jumps, each checked by a simulated
//! period and healed by another.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome};

use crate::JumpError;
use crate::error::wrap;
use crate::flow::Flow;
use crate::period::{Period, difference, phase_of, remove_mean};
use crate::record::{Beyond, Evolution, Record};
use crate::request::{Guide, Jumps, Next, Request};
use crate::simulation::Simulation;
use crate::slope::Slope;
use crate::tuning::{CAUTION, GROWTH_BETWEEN, NEGLIGIBLE, SHORTEST_JUMP, SLOPE_WIDTH, TOLERANCE_BEYOND};
use crate::within_jump::JumpInterval;

/// Simulated periods at the end of a jump: its check, and one that heals what the correction left
/// rough.
const CHECKED: u64 = 2;

/// Lets vehicles drive over `cable` on `mesh`, as laid: few of them simulated, each by a call of
/// `pass`.
///
/// # Errors
///
/// Those of `pass`; [`JumpError`] if jumps make no progress, or the cable finds no rest.
pub fn evolve<E: From<JumpError>>(
    cable: &DuctedCable,
    mesh: &Mesh,
    jumps: &Jumps,
    request: &Request<'_>,
    pass: impl FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
) -> Result<Evolution, E> {
    let mut walk = Walk {
        simulation: Simulation::new(cable, mesh, request, jumps, pass).map_err(wrap)?,
        jumps,
        guide: request.guide,
        done: 0,
        schedule: Vec::new(),
        has_rejected: false,
        missed: 0.0,
        changed: 0.0,
        repeats: None,
    };
    let length = request.period();
    let all = request.passes / length;
    let mut known = walk.start(all)?;
    if let Some(known) = &mut known {
        if !walk.until(all, known, jumps.max_passes)? {
            return Err(walk.no_progress(all).into());
        }
    }
    let whole = walk.simulation.state.clone();
    let left = (request.passes - all * length) as usize;
    walk.simulation.period(left, Some(all * length))?;
    let simulation = &mut walk.simulation;
    let mut evolution = Evolution {
        records: simulation.take_records(),
        period: known.iter().flat_map(|known| known.period.outcomes()).collect(),
        state: std::mem::replace(&mut simulation.state, whole),
        offset: simulation.offset,
        repeats: walk.repeats,
        simulated: 0,
        schedule: walk.schedule.clone(),
        has_rejected: walk.has_rejected,
        missed: walk.missed,
        changed: walk.changed,
        beyond: None,
    };
    if let (Some(known), Some(&last)) = (known, request.beyond.iter().max()) {
        evolution.beyond = walk.follow(known, last / length)?;
    }
    evolution.simulated = walk.simulation.simulated;
    Ok(evolution)
}

/// A run under way.
struct Walk<'a, P> {
    simulation: Simulation<'a, P>,
    jumps: &'a Jumps,
    guide: Guide<'a>,
    /// Periods done.
    done: u64,
    schedule: Vec<u64>,
    has_rejected: bool,
    missed: f64,
    changed: f64,
    repeats: Option<(u64, f64)>,
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

impl<E, P> Walk<'_, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    /// Simulates the first periods, of `all`; what they show, where more are left.
    fn start(&mut self, all: u64) -> Result<Option<Known>, E> {
        let request = self.simulation.request;
        // Whole periods in which others than its vehicles drive.
        let before = request.first_passes / request.period();
        let first = before.saturating_add(self.jumps.first_periods);
        let (mut half, mut last) = (None, None);
        while self.done < first.min(all) {
            let period = self.next_period()?;
            if self.repeat(&period, all) {
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
        let width = SLOPE_WIDTH * self.jumps.length_scale / self.simulation.mesh.spacing();
        Ok(Some(Known {
            slope: Slope::new(&half, &period, width as usize, &self.simulation.cable),
            period,
            length: (self.jumps.first_jump * (first - before) as f64).max(1.0),
            not_before: 0,
        }))
    }

    /// Goes on until `all` periods are done, without jumps beyond the first of the numbers of
    /// simulated passes `most`; false where the second is not enough.
    fn until(&mut self, all: u64, known: &mut Known, most: (u64, u64)) -> Result<bool, E> {
        while self.done < all {
            if self.simulation.simulated > most.1 {
                return Ok(false);
            }
            let left = all - self.done;
            let longest = left.saturating_sub(CHECKED);
            let guided = self.guide.length(self.schedule.len());
            let settles = longest > 0 && self.is_settled(known, left);
            let to_end = settles && guided.is_none();
            if to_end {
                known.length = longest as f64;
                known.not_before = self.done.saturating_mul(2);
            }
            let length = guided.unwrap_or(known.length as u64).min(longest);
            let is_patient = self.simulation.simulated <= most.0;
            let from = self.done;
            if to_end || length >= SHORTEST_JUMP && is_patient {
                self.jump(known, length)?;
            } else {
                self.simulate(known)?;
            }
            if !self.repeat(&known.period, all) && settles && from < all && self.done == all {
                let whole = remove_mean(&self.simulation.cable, &mut known.period.rate.clone());
                self.repeats = Some((from, whole));
            }
        }
        Ok(true)
    }

    fn no_progress(&self, wanted: u64) -> JumpError {
        let (periods, simulated) = (self.done, self.simulation.simulated);
        match self.simulation.request.days {
            Some(_) => JumpError::NeverPeriodic { days: periods },
            None => JumpError::Stuck {
                periods,
                wanted,
                simulated,
            },
        }
    }

    /// Goes on to the period number `last`, to see where the forces lead, if they change any more.
    fn follow(&mut self, mut known: Known, last: u64) -> Result<Option<Beyond>, E> {
        let request = self.simulation.request;
        self.simulation.is_over = true;
        let left = last.saturating_sub(self.done);
        if left > 0 && self.is_settled(&known, left) {
            let record = |&pass: &u64| Record {
                pass,
                outcome: known.period.outcome(phase_of(pass, known.period.len())),
                interpolated: true,
            };
            let records = request.beyond.iter().map(record).collect();
            let period = known.period.outcomes();
            return Ok(Some(Beyond { records, period }));
        }
        self.simulation.tolerance *= TOLERANCE_BEYOND;
        let most = self.simulation.simulated + self.jumps.max_passes.0 / 3;
        let leads = self.until(last, &mut known, (most, most))?;
        let mut records = self.simulation.take_records();
        records.retain(|record| record.pass > request.passes);
        let period = known.period.outcomes();
        Ok(leads.then_some(Beyond { records, period }))
    }

    /// Takes the days left of `all` to repeat the last one, the `period`, but for a movement as a
    /// whole: if its advance, gone on unchanged, would change no force and no movement noticeably.
    fn repeat(&mut self, period: &Period, all: u64) -> bool {
        let left = all - self.done;
        let mut change = period.rate.clone();
        let whole = remove_mean(&self.simulation.cable, &mut change);
        let change = left as f64 * self.simulation.shares(&change).worse();
        let is_over_days = self.simulation.request.days.is_some();
        if !is_over_days || left == 0 || change > NEGLIGIBLE * self.simulation.tolerance {
            return false;
        }
        self.simulation.repeat(period, self.done, all, whole);
        (self.repeats, self.done) = (Some((self.done, whole)), all);
        true
    }

    /// Advance per period at the end of the last period.
    fn rate(&mut self, known: &Known) -> Vec<f64> {
        let mut rate = known.period.rate.clone();
        known.slope.spread(&mut self.simulation.cable, 0.5, &mut rate);
        rate
    }

    /// Whether forces will not change noticeably in the periods `left`.
    fn is_settled(&mut self, known: &Known, left: u64) -> bool {
        if self.done < known.not_before {
            return false;
        }
        let rate = self.rate(known);
        let none = vec![0.0; rate.len()];
        let cable = &mut self.simulation.cable;
        let flow = Flow::new(cable, &rate, none, known.slope.values(), left as f64);
        self.simulation.shares(&flow.end).force < NEGLIGIBLE * self.simulation.tolerance
    }

    /// Simulates the next period, the last of a run or one between jumps, and learns from it.
    fn simulate(&mut self, known: &mut Known) -> Result<(), E> {
        let next = self.next_period()?;
        known
            .slope
            .learn(&known.period, &next, None, &self.simulation.cable);
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
        let tolerance = self.simulation.tolerance;
        let (from, offset) = (self.simulation.state.clone(), self.simulation.offset);
        let (flow, missed) = self.check(known, length)?;
        let error = self.simulation.shares(&missed).worse();
        let factor = CAUTION * (tolerance / error.max(f64::MIN_POSITIVE)).sqrt();
        if error > self.guide.max_error() * tolerance && length > CHECKED {
            (self.simulation.state, self.simulation.offset) = (from, offset);
            // From here on the other run is no guide.
            self.guide = Guide::Free;
            self.has_rejected = true;
            let shorter = factor * length as f64;
            known.length = shorter.min((self.done as f64).max(SHORTEST_JUMP as f64));
            return Ok(());
        }
        self.missed = self.missed.max(error);
        self.simulation.advance(&missed)?;
        let begin = self.done;
        self.done += length + 1;
        let next = self.next_period()?;
        let jump = JumpInterval {
            begin,
            length: length + CHECKED,
            from: (&from, offset),
            to: (&self.simulation.state.clone(), self.simulation.offset),
            before: &known.period,
            after: &next,
            flow,
        };
        self.changed = self.changed.max(self.simulation.record_jump(&jump)?);
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
        let flow = Flow::new(&mut self.simulation.cable, &rate, none, before.values(), at_end);
        let jump = flow.after(&mut self.simulation.cable, length as f64);
        self.simulation.advance(&jump)?;
        let period = self.simulation.request.order.len();
        let checked = self.simulation.period(period, None)?;
        let cable = &mut self.simulation.cable;
        let predicted = before.predict(&known.period, &checked, cable);
        known
            .slope
            .learn(&known.period, &checked, Some(&predicted), cable);
        // The slope measured between both ends describes the jump best. The part of the advance
        // that it does not explain is taken to have grown evenly over the jump.
        let measured = (length + 1) as f64;
        let predicted = known.slope.predict(&known.period, &checked, cable);
        let growth = difference(&difference(&checked.rate, &known.period.rate), &predicted)
            .iter()
            .map(|defect| defect / measured)
            .collect();
        let corrected = Flow::new(cable, &rate, growth, known.slope.values(), at_end);
        let mut missed = difference(&corrected.after(cable, measured), &flow.after(cable, measured));
        before.spread(cable, 1.0, &mut missed);
        Ok((corrected, missed))
    }

    /// Simulates the next period.
    fn next_period(&mut self) -> Result<Period, E> {
        let length = self.simulation.request.order.len();
        let after = self.done * length as u64;
        let period = self.simulation.period(length, Some(after))?;
        self.done += 1;
        Ok(period)
    }
}
