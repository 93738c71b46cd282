//! The cable through the events of its days.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable, laid};

use super::calendar::Calendar;
use super::day::{Act, Event};
use super::law::LockedLaw;
use super::step::{LongStep, STAGES};
use crate::error::wrap;
use crate::period::difference;
use crate::tuning::DEFECT_GROWTH;
use crate::{JumpError, Next};

/// Does what happens; its pass is the caller's.
pub struct DailyCable<'a, P> {
    calendar: &'a Calendar<'a>,
    cable: RestingCable,
    pub step: LongStep,
    pass: P,
    /// The cable before the last simulated period, if no step has used that period yet.
    before: Option<CableState>,
    /// What the last two simulated periods before steps have shown on this day, the later one first.
    measured: [Option<Measured>; 2],
    /// The cable when it was hottest and coldest on the day under way, and after the last pass, or
    /// before there is any.
    pub hot: CableState,
    pub cold: CableState,
    pub end: CableState,
    /// Passes simulated.
    pub simulated: u64,
}

/// What a simulated period has shown.
struct Measured {
    /// When it ended \[periods of the day\].
    time: f64,
    /// Advance of every node in it \[m\].
    advance: Vec<f64>,
    /// Friction that the law missed \[N/m\].
    defect: Vec<f64>,
}

impl Measured {
    /// What the law misses at a later `time`, as the `earlier` period lets expect it \[N/m\].
    fn defect_at(&self, time: f64, earlier: Option<&Self>) -> Vec<f64> {
        let Some(earlier) = earlier else {
            return self.defect.clone();
        };
        let ahead = ((time - self.time) / (self.time - earlier.time)).min(1.0);
        let both = self.defect.iter().zip(&earlier.defect);
        both.map(|(last, earlier)| last + DEFECT_GROWTH * ahead * (last - earlier))
            .collect()
    }
}

impl<'a, E, P> DailyCable<'a, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    /// The `cable` at the temperature of midnight, as laid or as in `start`.
    pub fn new(
        cable: &DuctedCable,
        mesh: &Mesh,
        calendar: &'a Calendar<'a>,
        law: LockedLaw,
        start: Option<&CableState>,
        pass: P,
    ) -> Result<Self, CableError> {
        let mut state = start.cloned().map_or_else(|| laid(cable, mesh), Ok)?;
        let mut cable = RestingCable::new(cable, mesh)?;
        cable.warm(&mut state, calendar.day.heat_at_midnight())?;
        Ok(Self {
            calendar,
            cable,
            step: LongStep { law, sweeps: 0 },
            pass,
            before: None,
            measured: [None, None],
            hot: state.clone(),
            cold: state.clone(),
            end: state,
            simulated: 0,
        })
    }

    /// Lets the `next` event happen; one without a number only measures.
    pub fn happen(&mut self, next: Next, state: &mut CableState) -> Result<PassOutcome, E> {
        let event = self.calendar.events[next.phase];
        let begins_day = next.phase == 0;
        if begins_day {
            self.measured = [None, None];
        }
        if event.begins {
            self.before = Some(state.clone());
        }
        let outcome = match event.act {
            Act::Pass(phase) => {
                self.simulated += 1;
                let number = next.number.and_then(|number| self.calendar.pass(number));
                let outcome = (self.pass)(Next { phase, number }, state)?;
                if number == Some(self.calendar.passes) {
                    self.end.clone_from(state);
                }
                outcome
            }
            act => {
                let moved = match act {
                    Act::Step(from, to) if !self.step.law.is_still() => self.step(&event, from, to, state),
                    // Nothing but heat moves the cable.
                    _ => self.cable.warm(state, event.thermal_force),
                };
                moved.map_err(wrap)?;
                PassOutcome::at_rest(self.cable.cable(), state).map_err(wrap)?
            }
        };
        let force = state.thermal_force();
        if begins_day || force > self.hot.thermal_force() {
            self.hot.clone_from(state);
        }
        if begins_day || force < self.cold.thermal_force() {
            self.cold.clone_from(state);
        }
        Ok(outcome)
    }

    /// The periods from `from` to `to` in one step, with the friction that the law misses as the
    /// simulated ones before them have shown it.
    fn step(&mut self, event: &Event, from: u64, to: u64, state: &mut CableState) -> Result<(), CableError> {
        if let Some(before) = self.before.take() {
            self.cable.release(&before, state);
            let measured = self.measure(before.displacement(), from as f64, state);
            self.measured = [Some(measured), self.measured[0].take()];
        }
        let [Some(last), earlier] = &self.measured else {
            return Ok(());
        };
        let (periods, day) = ((to - from) as f64, self.calendar.day);
        let stages = STAGES.map(|share| {
            let time = from as f64 + share * periods;
            (day.heat_before(time), last.defect_at(time, earlier.as_ref()))
        });
        let (cable, u) = (&mut self.cable, state.displacement());
        let u = self.step.take(cable, u, periods, &stages, &last.advance)?;
        *state = cable.moved(state, u)?.with_thermal_force(event.thermal_force)?;
        self.cable.settle(state)
    }

    /// What the period has shown that began with the displacements `before` and ended in `state` at
    /// this time.
    fn measure(&mut self, before: &[f64], time: f64, state: &CableState) -> Measured {
        let advance = difference(state.displacement(), before);
        let mut defect = vec![0.0; advance.len()];
        let (u, thermal_force) = (state.displacement(), state.thermal_force());
        self.cable.needed(u, thermal_force, &mut defect);
        for (i, (defect, v)) in defect.iter_mut().zip(&advance).enumerate() {
            *defect -= self.step.law.friction(*v, self.cable.limit(i));
        }
        Measured {
            time,
            advance,
            defect,
        }
    }
}
