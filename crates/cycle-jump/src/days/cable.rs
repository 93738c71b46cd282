//! The cable through the events of a day.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable};

use super::calendar::Calendar;
use super::day::{Act, Event};
use super::law::LockedLaw;
use super::step::{LongStep, STAGES};
use crate::error::wrap;
use crate::period::difference;
use crate::tuning::DEFECT_GROWTH;
use crate::walk::Pass;
use crate::{JumpError, Next};

/// Does what happens; its pass is the caller's.
pub struct DailyCable<'a, E> {
    calendar: &'a Calendar<'a>,
    cable: RestingCable,
    pub step: LongStep,
    pass: Pass<'a, E>,
    /// The cable before the last simulated period, if no step has used that period yet.
    before: Option<CableState>,
    measured: Option<Measured>,
    /// The cable when it was hottest and coldest on the day under way, and after its last pass.
    pub hot: CableState,
    pub cold: CableState,
    pub last: CableState,
    /// Passes simulated.
    pub simulated: u64,
}

/// What the last simulated period before a step has shown.
struct Measured {
    /// When it ended, and how long after the one before \[periods\].
    time: f64,
    since: f64,
    /// Advance of every node in it \[m\].
    advance: Vec<f64>,
    /// Friction that the law missed \[N/m\], and by how much more it will in as many periods again.
    defect: Vec<f64>,
    growth: Vec<f64>,
}

impl<'a, E: From<JumpError>> DailyCable<'a, E> {
    pub fn new(
        cable: &DuctedCable,
        mesh: &Mesh,
        calendar: &'a Calendar<'a>,
        law: LockedLaw,
        pass: Pass<'a, E>,
    ) -> Result<Self, CableError> {
        let state = CableState::at_rest(mesh);
        Ok(Self {
            calendar,
            cable: RestingCable::new(cable, mesh)?,
            step: LongStep { law, sweeps: 0 },
            pass,
            before: None,
            measured: None,
            hot: state.clone(),
            cold: state.clone(),
            last: state,
            simulated: 0,
        })
    }

    /// Lets the event `next` happen.
    pub fn happen(&mut self, next: Next, state: &mut CableState) -> Result<PassOutcome, E> {
        let event = &self.calendar.events[next.phase];
        if event.begins {
            self.before = Some(state.clone());
        }
        let outcome = match event.act {
            Act::Pass(phase) => {
                self.simulated += 1;
                let number = next.number.and_then(|number| self.calendar.pass(number));
                (self.pass)(Next { phase, number }, state)?
            }
            act => {
                let moved = match act {
                    Act::Step(from, to) if !self.step.law.is_still() => self.step(event, from, to, state),
                    // Nothing but heat moves the cable.
                    _ => self.cable.warm(state, event.thermal_force),
                };
                moved.map_err(wrap)?;
                PassOutcome::at_rest(self.cable.cable(), state).map_err(wrap)?
            }
        };
        let (force, is_first) = (state.thermal_force(), next.phase == 0);
        if is_first {
            self.measured = None;
        }
        if is_first || force > self.hot.thermal_force() {
            self.hot.clone_from(state);
        }
        if is_first || force < self.cold.thermal_force() {
            self.cold.clone_from(state);
        }
        if next.phase == self.calendar.last {
            self.last.clone_from(state);
        }
        Ok(outcome)
    }

    /// The periods from `from` to `to` in one step, with the friction that the law misses as the
    /// simulated ones before them have shown it.
    fn step(&mut self, event: &Event, from: u64, to: u64, state: &mut CableState) -> Result<(), CableError> {
        if let Some(before) = self.before.take() {
            self.cable.release(&before, state);
            self.measured = Some(self.measure(before.displacement(), from as f64, state));
        }
        let Some(measured) = &self.measured else {
            return Ok(());
        };
        let periods = (to - from) as f64;
        let stages = STAGES.map(|share| {
            let time = from as f64 + share * periods;
            let ahead = ((time - measured.time) / measured.since).min(1.0);
            let defect = measured.defect.iter().zip(&measured.growth);
            let defect = defect.map(|(defect, growth)| defect + ahead * growth);
            (self.calendar.day.heat_before(time), defect.collect())
        });
        let (cable, u) = (&mut self.cable, state.displacement());
        let u = self.step.take(cable, u, periods, stages, &measured.advance)?;
        *state = cable.moved(state, u)?.with_thermal_force(event.thermal_force)?;
        self.cable.settle(state)
    }

    /// What the period has shown that began with the displacements `before` and ended in `state` at
    /// this time.
    fn measure(&mut self, before: &[f64], time: f64, state: &CableState) -> Measured {
        let advance = difference(state.displacement(), before);
        let mut defect = vec![0.0; advance.len()];
        self.cable
            .needed(state.displacement(), state.thermal_force(), &mut defect);
        let nodes = self.cable.chain().nodes();
        for ((defect, v), node) in defect.iter_mut().zip(&advance).zip(nodes) {
            *defect -= self.step.law.friction(*v, node.limit);
        }
        let (since, growth) = match &self.measured {
            Some(last) => (time - last.time, difference(&defect, &last.defect)),
            None => (1.0, vec![0.0; defect.len()]),
        };
        Measured {
            time,
            since,
            advance,
            defect,
            growth: growth.iter().map(|growth| DEFECT_GROWTH * growth).collect(),
        }
    }
}
