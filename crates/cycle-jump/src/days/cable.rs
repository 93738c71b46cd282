//! The cable through the events of its days.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable, laid};

use super::calendar::Calendar;
use super::day::{Act, Event};
use super::law::LockedLaw;
use super::step::{LongStep, STAGES};
use crate::error::wrap;
use crate::period::difference;
use crate::{JumpError, Next};

/// Does what happens; its pass is the caller's.
pub struct DailyCable<'a, P> {
    calendar: &'a Calendar<'a>,
    cable: RestingCable,
    pub step: LongStep,
    pass: P,
    /// The cable before the last simulated period, if no step has used that period yet.
    before: Option<CableState>,
    /// What the last simulated period before a step has shown: the advance of every node \[m\], and
    /// the friction that the law missed \[N/m\].
    measured: Option<(Vec<f64>, Vec<f64>)>,
    /// The cable when it was hottest and coldest on the day under way, and after the last pass, or
    /// before there is any.
    pub hot: CableState,
    pub cold: CableState,
    pub end: CableState,
    /// Passes simulated.
    pub simulated: u64,
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
            measured: None,
            hot: state.clone(),
            cold: state.clone(),
            end: state,
            simulated: 0,
        })
    }

    /// Lets the `next` event happen; one without a number only measures.
    pub fn happen(&mut self, next: Next, state: &mut CableState) -> Result<PassOutcome, E> {
        let event = self.calendar.events[next.phase];
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
        let begins_day = next.phase == 0;
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
    /// simulated one before them has shown it.
    fn step(&mut self, event: &Event, from: u64, to: u64, state: &mut CableState) -> Result<(), CableError> {
        if let Some(before) = self.before.take() {
            self.cable.release(&before, state);
            self.measured = Some(self.measure(before.displacement(), state));
        }
        let Some(measured) = &self.measured else {
            return Ok(());
        };
        let periods = (to - from) as f64;
        let day = self.calendar.day;
        let heat = STAGES.map(|share| day.heat_before(from as f64 + share * periods));
        let (cable, u) = (&mut self.cable, state.displacement());
        let u = self.step.take(cable, u, periods, heat, measured)?;
        *state = cable.moved(state, u)?.with_thermal_force(event.thermal_force)?;
        self.cable.settle(state)
    }

    /// What the period has shown that began with the displacements `before` and ended in `state`.
    fn measure(&mut self, before: &[f64], state: &CableState) -> (Vec<f64>, Vec<f64>) {
        let advance = difference(state.displacement(), before);
        let mut defect = vec![0.0; advance.len()];
        let (u, thermal_force) = (state.displacement(), state.thermal_force());
        self.cable.needed(u, thermal_force, &mut defect);
        for (i, (defect, v)) in defect.iter_mut().zip(&advance).enumerate() {
            *defect -= self.step.law.friction(*v, self.cable.limit(i));
        }
        (advance, defect)
    }
}
