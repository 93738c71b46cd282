//! The cable through the events of a day.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, PassOutcome, RestingCable};

use super::day::{Act, Day, Event};
use super::rate::RateStep;
use crate::error::wrap;
use crate::period::difference;
use crate::{JumpError, Next};

/// What the law misses goes on after a simulated period so fast, relative to its change from the one before. Of fifteen cables it takes the largest
/// error of a force from 1.5 to 1.1 %, where nothing goes on, and 0.64 to 0.17 % at best; with all of it, 1, one is 16 % off.
const GOES_ON: f64 = 0.5;

/// Does what happens; its pass is the caller's.
pub struct DailyCable<'a, P> {
    day: &'a Day,
    mesh: &'a Mesh,
    cable: RestingCable,
    pub rate: RateStep,
    pass: P,
    /// Displacement before the last simulated period \[m\].
    before: Vec<f64>,
    /// Whether no step has asked yet what it shows.
    is_due: bool,
    /// What simulated periods of the day have shown: the last, and the one before it.
    shown: [Option<Shown>; 2],
    /// The cable when it was hottest and coldest on the day under way.
    pub hot: Option<CableState>,
    pub cold: Option<CableState>,
    /// Passes simulated.
    pub simulated: u64,
}

/// What a simulated period has shown.
struct Shown {
    /// When it ended \[periods of the day\].
    time: f64,
    /// Advance of every node in it \[m\].
    advance: Vec<f64>,
    /// Friction that the law missed \[N/m\].
    missed: Vec<f64>,
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
        Ok(Self {
            day,
            mesh,
            cable: RestingCable::new(cable, mesh)?,
            rate,
            pass,
            before: vec![0.0; mesh.nodes()],
            is_due: false,
            shown: [None, None],
            hot: None,
            cold: None,
            simulated: 0,
        })
    }

    /// Begins another day.
    pub fn begin_day(&mut self) {
        self.shown = [None, None];
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
            self.before.copy_from_slice(state.displacement());
            self.is_due = true;
        }
        let outcome = match event.act {
            Act::Pass(phase) => {
                self.simulated += 1;
                (self.pass)(Next { phase, number }, state)?
            }
            Act::Warm => self.warm(event, state)?,
            // Nothing but heat moves the cable.
            Act::Step(..) if self.rate.law.is_still() => self.warm(event, state)?,
            Act::Step(from, to) => {
                self.step(event, from, to, state).map_err(wrap)?;
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

    /// Brings the cable to the temperature of the `event`.
    fn warm(&mut self, event: &Event, state: &mut CableState) -> Result<PassOutcome, E> {
        self.cable.warm(state, event.thermal_force).map_err(wrap)?;
        PassOutcome::at_rest(self.cable.cable(), state).map_err(wrap)
    }

    /// The periods from `from` to `to`, with the friction that the law misses as the simulated ones before them have shown it.
    fn step(&mut self, event: &Event, from: u64, to: u64, state: &mut CableState) -> Result<(), CableError> {
        if std::mem::take(&mut self.is_due) {
            let shown = self.show(from as f64, state);
            self.shown = [Some(shown), self.shown[0].take()];
        }
        let [Some(last), earlier] = &self.shown else {
            return Ok(());
        };
        let (begin, periods) = (from as f64, (to - from) as f64);
        let times = [RateStep::STAGE, 1.0].map(|share| begin + share * periods);
        let missed = times.map(|time| match earlier {
            Some(earlier) => {
                let ahead = GOES_ON * ((time - last.time) / (last.time - earlier.time)).min(1.0);
                let both = last.missed.iter().zip(&earlier.missed);
                both.map(|(last, earlier)| last + ahead * (last - earlier))
                    .collect()
            }
            None => last.missed.clone(),
        });
        let heat = times.map(|time| self.day.before(time));
        let mut u = state.displacement().to_vec();
        self.rate
            .advance(&mut self.cable, &mut u, periods, heat, &missed, &last.advance)?;
        let moved = CableState::from_parts(self.mesh, u, state.friction().to_vec())?;
        *state = moved.with_thermal_force(event.thermal_force)?;
        self.cable.settle(state)
    }

    /// What the period has shown that ended in `state` at this time.
    fn show(&mut self, time: f64, state: &CableState) -> Shown {
        let advance = difference(state.displacement(), &self.before);
        let mut missed = vec![0.0; advance.len()];
        self.cable
            .needed(state.displacement(), state.thermal_force(), &mut missed);
        for (missed, v) in missed.iter_mut().zip(&advance) {
            *missed -= self.rate.law.friction(*v);
        }
        Shown {
            time,
            advance,
            missed,
        }
    }
}
