//! The cable through the events of a day.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable};

use super::day::{Act, Day, Event};
use super::law::LockedLaw;
use super::step::{LongStep, STAGES};
use crate::error::wrap;
use crate::period::difference;
use crate::tuning::DEFECT_GROWTH;
use crate::{JumpError, Next};

/// Does what happens; its pass is the caller's.
pub struct DailyCable<'a, P> {
    day: &'a Day,
    cable: RestingCable,
    pub step: LongStep,
    pass: P,
    /// The cable before the last simulated period, if no step has used that period yet.
    before: Option<CableState>,
    /// What the last two simulated periods before steps have shown, the later one first.
    measured: [Option<Measured>; 2],
    /// The cable when it was hottest and coldest on the day under way.
    pub hot: Option<CableState>,
    pub cold: Option<CableState>,
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

impl<'a, E, P> DailyCable<'a, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    pub fn new(
        cable: &DuctedCable,
        mesh: &Mesh,
        day: &'a Day,
        law: LockedLaw,
        pass: P,
    ) -> Result<Self, CableError> {
        Ok(Self {
            day,
            cable: RestingCable::new(cable, mesh)?,
            step: LongStep { law, sweeps: 0 },
            pass,
            before: None,
            measured: [None, None],
            hot: None,
            cold: None,
            simulated: 0,
        })
    }

    /// Begins another day.
    pub fn begin_day(&mut self) {
        self.measured = [None, None];
        (self.hot, self.cold) = (None, None);
    }

    /// Lets the `event` happen; a pass has this `number`, if it counts.
    pub fn happen(
        &mut self,
        event: &Event,
        number: Option<u64>,
        state: &mut CableState,
    ) -> Result<PassOutcome, E> {
        if event.begins {
            self.before = Some(state.clone());
        }
        let outcome = match event.act {
            Act::Pass(phase) => {
                self.simulated += 1;
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
        let force = state.thermal_force();
        if self.hot.as_ref().is_none_or(|hot| force > hot.thermal_force()) {
            self.hot = Some(state.clone());
        }
        if self.cold.as_ref().is_none_or(|cold| force < cold.thermal_force()) {
            self.cold = Some(state.clone());
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
        let periods = (to - from) as f64;
        let times = STAGES.map(|share| from as f64 + share * periods);
        let defects = times.map(|time| match earlier {
            Some(earlier) => {
                let ahead = ((time - last.time) / (last.time - earlier.time)).min(1.0);
                let both = last.defect.iter().zip(&earlier.defect);
                both.map(|(last, earlier)| last + DEFECT_GROWTH * ahead * (last - earlier))
                    .collect()
            }
            None => last.defect.clone(),
        });
        let [first, second] = times.map(|time| self.day.heat_before(time));
        let stages = [(first, &defects[0][..]), (second, &defects[1][..])];
        let (cable, u) = (&mut self.cable, state.displacement());
        let u = self.step.take(cable, u, periods, stages, &last.advance)?;
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
            *defect -= self.step.law.friction(*v, self.cable.chain().nodes()[i].limit);
        }
        Measured {
            time,
            advance,
            defect,
        }
    }
}
