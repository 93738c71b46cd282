//! The cable through a day: real periods of the traffic at its knots, steps of many periods between them.

use cable_dem::{CableState, Mesh, PassOutcome, RestingCable};

use super::day::Day;
use super::diary::{Diary, Lived};
use super::extremes::Extremes;
use super::rate::{Drive, RateStep};
use super::rows::{Row, Shape};
use crate::error::wrap;
use crate::period::take_whole;
use crate::{JumpError, Next};

/// Share of the first day whose defects are those of a cable as just laid: a hundred passes, and two knots at least.
const VIRGIN: f64 = 0.125;

/// What real periods measured over a day: the friction that the law misses, by the time at which each ended \[periods\].
pub type Defects = Vec<(f64, Vec<f64>)>;

/// The cable from day to day.
pub struct Living<'a, P> {
    pub day: &'a Day,
    pub mesh: &'a Mesh,
    pub cable: RestingCable,
    pub rate: RateStep,
    pub pass: P,
    pub state: CableState,
    /// What a cable that nothing holds has moved as a whole \[m\].
    pub offset: f64,
    pub simulated: u64,
    /// Those of the last day with real periods.
    pub defects: Defects,
    pub shapes: Vec<Shape>,
    /// Weight of what a real period says of the defect until the next one, beside the day before.
    pub own: f64,
    /// Advance of each period where all are simulated, from which the next day's is sought.
    advances: Vec<Vec<f64>>,
}

impl<'a, E, P> Living<'a, P>
where
    E: From<JumpError>,
    P: FnMut(Next, &mut CableState) -> Result<PassOutcome, E>,
{
    pub fn new(
        day: &'a Day,
        mesh: &'a Mesh,
        cable: RestingCable,
        rate: RateStep,
        pass: P,
        laid: CableState,
    ) -> Self {
        Self {
            day,
            mesh,
            cable,
            rate,
            pass,
            state: laid,
            offset: 0.0,
            simulated: 0,
            defects: Vec::new(),
            shapes: Vec::new(),
            own: 1.0,
            advances: Vec::new(),
        }
    }

    /// A day with real periods, of which the first `passes` are lived; the passes before it are `after`. Where no other day follows,
    /// its last period is real.
    pub fn corrected(&mut self, after: u64, passes: u64, is_last: bool) -> Result<Lived, E> {
        let day = self.day;
        let mut diary = self.open()?;
        let whole = passes.div_ceil(day.period as u64).min(day.periods());
        let is_first = self.defects.is_empty();
        let mut knots = day.simulated(is_first);
        if is_last {
            knots.retain(|knot| *knot + 1 < whole);
            knots.push(whole - 1);
        }
        let mut measured: Defects = Vec::new();
        let mut shapes = Vec::new();
        let mut advances = Vec::new();
        for (k, &knot) in knots.iter().enumerate() {
            let end = knots.get(k + 1).copied().unwrap_or(whole);
            let from = self.state.displacement().to_vec();
            let noted = diary.rows.len();
            self.period(knot, after, passes, &mut diary)?;
            shapes.push(Shape::of(&diary.rows, noted));
            // Per period, also where the day's last one is longer.
            let per_period = 1.0 / (day.time(knot + 1) - day.time(knot));
            let moved = self.state.displacement().iter().zip(&from);
            let advance: Vec<f64> = moved.map(|(u, from)| per_period * (u - from)).collect();
            let defect = self.defect(&advance);
            self.rate.expect(&advance);
            let done = knot + 1;
            measured.push((day.time(done), defect));
            if day.is_simulated() {
                advances.push(advance);
            } else if end > done {
                self.advance(done, end, Some(&measured), &mut diary)?;
            }
        }
        let last = self.state.clone();
        if passes == day.passes {
            self.end(&mut diary)?;
        }
        if is_first && !day.is_simulated() {
            // No other morning is like that of a cable as just laid: the next one is between the evening and noon.
            let morning = VIRGIN * day.time(day.periods());
            measured.retain(|(ended, _)| *ended > morning);
        }
        (self.defects, self.shapes, self.advances) = (measured, shapes, advances);
        Ok(diary.close(last))
    }

    /// A day as the defects of the last corrected one say, without a real pass.
    pub fn frozen(&mut self) -> Result<Lived, E> {
        let mut diary = self.open()?;
        self.replay_to(self.day.periods(), &mut diary)?;
        let last = self.state.clone();
        self.end(&mut diary)?;
        Ok(diary.close(last))
    }

    /// The last day of all, of which `passes` are lived after `after` others: its last period is real, the others lack what real ones show
    /// `beside` them.
    pub fn last(&mut self, after: u64, passes: u64, beside: &Extremes) -> Result<Lived, E> {
        let day = self.day;
        let last = passes.div_ceil(day.period as u64).min(day.periods()) - 1;
        let mut diary = self.open()?;
        self.replay_to(last, &mut diary)?;
        diary.add(beside);
        self.period(last, after, passes, &mut diary)?;
        let state = self.state.clone();
        if passes == day.passes {
            self.end(&mut diary)?;
        }
        Ok(diary.close(state))
    }

    /// Goes through the day up to `periods`, as the defects say.
    fn replay_to(&mut self, periods: u64, diary: &mut Diary) -> Result<(), E> {
        if self.day.is_simulated() {
            return (0..periods).try_for_each(|period| self.replay(period, diary));
        }
        let mut knots = self.day.simulated(false);
        knots.retain(|knot| *knot < periods);
        for (k, &knot) in knots.iter().enumerate() {
            let end = knots.get(k + 1).copied().unwrap_or(periods);
            self.advance(knot, end, None, diary)?;
        }
        Ok(())
    }

    fn open(&mut self) -> Result<Diary, E> {
        let mut displacement = self.state.displacement().to_vec();
        self.offset += take_whole(&self.cable, &mut displacement);
        self.place(displacement, self.state.thermal_force())?;
        let mut diary = Diary::new();
        self.warm(self.day.heat.at(0.0), 0, false, &mut diary)?;
        Ok(diary)
    }

    /// The day's end: the temperature of its beginning.
    fn end(&mut self, diary: &mut Diary) -> Result<(), E> {
        let passes = self.day.passes;
        for thermal in self
            .day
            .turns_before(passes)
            .into_iter()
            .chain([self.day.heat.at(1.0)])
        {
            self.warm(thermal, passes, false, diary)?;
        }
        Ok(())
    }

    /// How far the cable has moved as a whole, where nothing holds it \[m\].
    pub fn whole(&self) -> f64 {
        if self.cable.is_held() {
            return 0.0;
        }
        let displacement = self.state.displacement();
        self.offset + displacement.iter().sum::<f64>() / displacement.len() as f64
    }

    /// The cable at rest with its nodes displaced by `displacement`.
    fn place(&mut self, displacement: Vec<f64>, thermal_force: f64) -> Result<(), E> {
        let friction = self.state.friction().to_vec();
        let placed = CableState::from_parts(self.mesh, displacement, friction)
            .and_then(|state| state.with_thermal_force(thermal_force));
        self.state = placed.map_err(wrap)?;
        self.cable.settle(&mut self.state).map_err(wrap)
    }

    fn warm(&mut self, thermal_force: f64, passes: u64, simulated: bool, diary: &mut Diary) -> Result<(), E> {
        self.cable.warm(&mut self.state, thermal_force).map_err(wrap)?;
        self.note(passes, simulated, true, diary)
    }

    /// Notes the cable at rest.
    fn note(&mut self, passes: u64, simulated: bool, heat: bool, diary: &mut Diary) -> Result<(), E> {
        let outcome = PassOutcome::at_rest(self.cable.cable(), &self.state).map_err(wrap)?;
        diary.note(self.row(passes, outcome, simulated, heat), &self.state);
        Ok(())
    }

    /// What the cable does when `passes` of the day are done, with what it has moved as a whole.
    fn row(&self, passes: u64, mut outcome: PassOutcome, simulated: bool, heat: bool) -> Row {
        outcome.upstream_displacement += self.offset;
        outcome.downstream_displacement += self.offset;
        Row {
            passes,
            thermal_force: self.state.thermal_force(),
            outcome,
            simulated,
            heat,
        }
    }

    /// Simulates the `period` of the day, up to the pass `most` of the day. The day follows `after` passes.
    fn period(&mut self, period: u64, after: u64, most: u64, diary: &mut Diary) -> Result<(), E> {
        let day = self.day;
        let passes = period * day.period as u64..day.passes_of(period + 1).min(most);
        for pass in passes {
            let phase = (pass % day.period as u64) as usize;
            for thermal in day.turns_before(pass) {
                self.warm(thermal, pass, true, diary)?;
            }
            self.warm(day.thermal_force(pass as f64 + 0.5), pass, true, diary)?;
            let number = Some(after + pass + 1);
            let outcome = (self.pass)(Next { phase, number }, &mut self.state)?;
            self.simulated += 1;
            diary.note(self.row(pass + 1, outcome, true, false), &self.state);
        }
        Ok(())
    }

    /// What the law misses of the friction after a period with this `advance`.
    fn defect(&mut self, advance: &[f64]) -> Vec<f64> {
        let mut defect = vec![0.0; advance.len()];
        self.cable
            .needed(self.state.displacement(), self.state.thermal_force(), &mut defect);
        for (defect, v) in defect.iter_mut().zip(advance) {
            *defect -= self.rate.law.friction(*v);
        }
        defect
    }

    /// From the period `from` of the day to `to`, without real ones; `today` has what was measured today.
    fn advance(&mut self, from: u64, to: u64, today: Option<&Defects>, diary: &mut Diary) -> Result<(), E> {
        // Two steps, so that passes between knots are known well too.
        let middle = from + (to - from) / 2;
        for (from, to) in [(from, middle), (middle, to)] {
            if from < to {
                self.step(from, to, today, diary)?;
            }
        }
        Ok(())
    }

    fn step(&mut self, from: u64, to: u64, today: Option<&Defects>, diary: &mut Diary) -> Result<(), E> {
        if self.rate.law.is_still() {
            // Nothing but heat moves the cable.
            let turns = (self.day.passes_of(from)..self.day.passes_of(to))
                .flat_map(|pass| self.day.turns_before(pass));
            for thermal in turns.collect::<Vec<_>>() {
                self.warm(thermal, self.day.passes_of(from), false, diary)?;
            }
            let thermal = self.day.before(self.day.time(to));
            self.cable.warm(&mut self.state, thermal).map_err(wrap)?;
            return self.look(to, diary);
        }
        let (begin, end) = (self.day.time(from), self.day.time(to));
        let stage = begin + RateStep::STAGE * (end - begin);
        let drives = [stage, end].map(|time| Drive {
            thermal_force: self.day.before(time),
            defect: self.expected(time, today),
        });
        let mut u = self.state.displacement().to_vec();
        let moved = self
            .rate
            .second_order(&mut self.cable, &mut u, end - begin, [&drives[0], &drives[1]]);
        moved.map_err(wrap)?;
        self.place(u, drives[1].thermal_force)?;
        self.look(to, diary)
    }

    /// The `period` of the day as it was when it was simulated.
    fn replay(&mut self, period: u64, diary: &mut Diary) -> Result<(), E> {
        let index = period as usize;
        let drive = Drive {
            thermal_force: self.day.before(self.day.time(period + 1)),
            defect: self.defects[index].1.clone(),
        };
        let periods = self.day.time(period + 1) - self.day.time(period);
        let mut u = self.state.displacement().to_vec();
        self.rate.expect(&self.advances[index]);
        let advance = self
            .rate
            .first_order(&mut self.cable, &mut u, periods, &drive)
            .map_err(wrap)?;
        self.advances[index].copy_from_slice(advance);
        self.place(u, drive.thermal_force)?;
        self.look(period + 1, diary)
    }

    /// Notes the cable when `periods` of the day are done, and as the temperature changes before the next pass.
    fn look(&mut self, periods: u64, diary: &mut Diary) -> Result<(), E> {
        let passes = self.day.passes_of(periods);
        self.note(passes, false, false, diary)?;
        if passes < self.day.passes {
            let state = self.state.clone();
            let next = self.day.thermal_force(passes as f64 + 0.5);
            for thermal in self.day.turns_before(passes).into_iter().chain([next]) {
                self.warm(thermal, passes, false, diary)?;
            }
            self.state = state;
        }
        Ok(())
    }

    /// The defect at `time` of the day: between those of the day before, led by what was measured `today`.
    fn expected(&self, time: f64, today: Option<&Defects>) -> Vec<f64> {
        let own = today.and_then(|today| today.last());
        if self.defects.is_empty() {
            return own.map_or_else(Vec::new, |(_, defect)| defect.clone());
        }
        // Tonight's end is this morning's beginning.
        let morning = today.and_then(|today| today.first()).unwrap_or(&self.defects[0]);
        let mut expected = self.between(time, morning);
        if let Some((measured, defect)) = own {
            let before = self.between(*measured, morning);
            for ((expected, defect), before) in expected.iter_mut().zip(defect).zip(before) {
                *expected += self.own * (defect - before);
            }
        }
        expected
    }

    /// The defect of the day before at `time`, with the next `morning` after its end.
    fn between(&self, time: f64, morning: &(f64, Vec<f64>)) -> Vec<f64> {
        let all = self.day.time(self.day.periods());
        let next = self.defects.partition_point(|(ended, _)| *ended <= time);
        let last = self.defects.len() - 1;
        let (from, before) = if next == 0 {
            (self.defects[last].0 - all, &self.defects[last].1)
        } else {
            (self.defects[next - 1].0, &self.defects[next - 1].1)
        };
        let (to, after) = self
            .defects
            .get(next)
            .map_or((morning.0 + all, &morning.1), |(to, after)| (*to, after));
        let share = (time - from) / (to - from);
        before
            .iter()
            .zip(after)
            .map(|(a, b)| a + share * (b - a))
            .collect()
    }
}
