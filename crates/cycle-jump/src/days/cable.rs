//! The cable through the events of a day.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable};

use super::day::{Act, Day, Event};
use super::rate::RateStep;
use crate::JumpError;
use crate::Next;
use crate::error::wrap;
use crate::period::difference;

/// Does what happens; its pass is the caller's.
pub struct DailyCable<'a, P> {
    day: &'a Day,
    mesh: &'a Mesh,
    cable: RestingCable,
    pub rate: RateStep,
    pass: P,
    /// Displacement before the last simulated period \[m\].
    before: Vec<f64>,
    /// Advance in that period \[m\], and the friction that the law missed in it \[N/m\]: nothing if no step has asked for them yet.
    measured: Option<(Vec<f64>, Vec<f64>)>,
    /// Θ at the day's extremes, and the cable when it last was so hot and so cold.
    hottest: f64,
    coldest: f64,
    pub hot: CableState,
    pub cold: CableState,
    /// Passes simulated.
    pub simulated: u64,
}

impl<'a, E, P> DailyCable<'a, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    pub fn new(
        cable: &DuctedCable,
        mesh: &'a Mesh,
        day: &'a Day,
        rate: RateStep,
        pass: P,
    ) -> Result<Self, CableError> {
        let (hottest, coldest) = day.heat.extremes();
        let (hottest, coldest) = (day.heat.at(hottest), day.heat.at(coldest));
        let laid = CableState::at_rest(mesh);
        Ok(Self {
            day,
            mesh,
            cable: RestingCable::new(cable, mesh)?,
            rate,
            pass,
            before: vec![0.0; mesh.nodes()],
            measured: None,
            hottest,
            coldest,
            hot: laid.clone(),
            cold: laid,
            simulated: 0,
        })
    }

    /// Lets the `event` happen; a pass has this `number`, if it counts.
    pub fn happen(
        &mut self,
        event: &Event,
        number: Option<u64>,
        state: &mut CableState,
    ) -> Result<PassOutcome, E> {
        if event.begins {
            self.before.copy_from_slice(state.displacement());
            self.measured = None;
        }
        let outcome = match event.act {
            Act::Pass(phase) => {
                self.simulated += 1;
                (self.pass)(Next { phase, number }, state)?
            }
            Act::Warm => self.at_rest(event, state)?,
            // Nothing but heat moves the cable.
            Act::Step(..) if self.rate.law.is_still() => self.at_rest(event, state)?,
            Act::Step(from, to) => {
                self.step(event, from, to, state).map_err(wrap)?;
                PassOutcome::at_rest(self.cable.cable(), state).map_err(wrap)?
            }
        };
        if event.thermal_force >= self.hottest {
            self.hot.clone_from(state);
        }
        if event.thermal_force <= self.coldest {
            self.cold.clone_from(state);
        }
        Ok(outcome)
    }

    fn at_rest(&mut self, event: &Event, state: &mut CableState) -> Result<PassOutcome, E> {
        self.cable.warm(state, event.thermal_force).map_err(wrap)?;
        PassOutcome::at_rest(self.cable.cable(), state).map_err(wrap)
    }

    /// The periods from `from` to `to`, with the friction that the law missed in the simulated one before them.
    fn step(&mut self, event: &Event, from: u64, to: u64, state: &mut CableState) -> Result<(), CableError> {
        let mut u = state.displacement().to_vec();
        let (advance, missed) = match self.measured.take() {
            Some(measured) => measured,
            None => self.measure(state),
        };
        let (from, periods) = (from as f64, (to - from) as f64);
        let heat = [RateStep::STAGE, 1.0].map(|share| self.day.before(from + share * periods));
        self.rate
            .advance(&mut self.cable, &mut u, periods, heat, &missed, &advance)?;
        self.measured = Some((advance, missed));
        let moved = CableState::from_parts(self.mesh, u, state.friction().to_vec())?;
        *state = moved.with_thermal_force(event.thermal_force)?;
        self.cable.settle(state)
    }

    /// The advance in the period that ended in `state`, and what the law missed of the friction there.
    fn measure(&mut self, state: &CableState) -> (Vec<f64>, Vec<f64>) {
        let advance = difference(state.displacement(), &self.before);
        let mut missed = vec![0.0; advance.len()];
        self.cable
            .needed(state.displacement(), state.thermal_force(), &mut missed);
        for (missed, v) in missed.iter_mut().zip(&advance) {
            *missed -= self.rate.law.friction(*v);
        }
        (advance, missed)
    }
}
