//! One day: real periods of the traffic at its knots, steps of many periods between them.

use cable_dem::{CableState, Mesh, PassOutcome, RestingCable};

use super::extremes::Extremes;
use super::heat::DailyHeat;
use super::rate::{Drive, RateStep};
use super::rows::{Row, Shape};
use crate::record::take_whole;
use crate::{JumpError, Next};

/// Periods that are simulated one by one on the first morning, and growth of the steps after them.
const MORNING: u64 = 8;
const MORNING_GROWTH: f64 = 1.5;
/// Knots beyond this share of all periods: every one is simulated.
const NEARLY_ALL: f64 = 0.5;
/// Periods after a corner of the temperature at which one is simulated: the cable turns within a few.
const AFTER_A_CORNER: [u64; 6] = [0, 1, 2, 4, 8, 16];

/// A day of traffic and heat.
#[derive(Debug, Clone)]
pub struct Day {
    /// Passes of a day, at least as many as a period has; evenly over the day, the first after half an interval. The last period of the day
    /// takes those along that are too few for another one.
    pub passes: u64,
    /// Vehicles after which the traffic repeats, every day anew.
    pub period: usize,
    /// Temperature over the day.
    pub heat: DailyHeat,
    /// Times of the day at which a period is simulated, evenly.
    pub knots: u64,
}

impl Day {
    /// Periods of a day.
    pub fn periods(&self) -> u64 {
        self.passes / self.period as u64
    }

    /// Time when `periods` of the day are done, as a number of periods: the last one is longer.
    fn time(&self, periods: u64) -> f64 {
        if periods == self.periods() {
            self.passes as f64 / self.period as f64
        } else {
            periods as f64
        }
    }

    /// Passes done when `periods` of the day are.
    fn passes_of(&self, periods: u64) -> u64 {
        if periods == self.periods() {
            self.passes
        } else {
            periods * self.period as u64
        }
    }

    /// Θ as the cable has it when `passes` of the day are done, `half` a pass later or earlier \[N\].
    fn thermal_force(&self, passes: f64) -> f64 {
        self.heat.at(passes / self.passes as f64)
    }

    /// Θ at the last pass before `periods` are done.
    fn before(&self, periods: f64) -> f64 {
        self.thermal_force((periods * self.period as f64 - 0.5).max(0.0))
    }

    /// Θ at the turns of the temperature between the pass `next` of the day and the one before.
    fn turns_before(&self, next: u64) -> Vec<f64> {
        let all = self.passes as f64;
        let (from, to) = ((next as f64 - 0.5) / all, (next as f64 + 0.5) / all);
        let between = |time: &f64| from < *time && *time < to.min(1.0);
        self.heat
            .turns()
            .into_iter()
            .filter(between)
            .map(|time| self.heat.at(time))
            .collect()
    }

    /// Whether every period of a day is simulated.
    pub fn is_simulated(&self) -> bool {
        self.knots as f64 >= NEARLY_ALL * self.periods() as f64
    }

    /// Periods of a day that are simulated, ascending; `first` of the first day.
    fn simulated(&self, first: bool) -> Vec<u64> {
        let all = self.periods();
        if self.is_simulated() {
            return (0..all).collect();
        }
        let mut knots: Vec<u64> = (0..self.knots)
            .map(|k| (k as f64 * all as f64 / self.knots as f64).round() as u64)
            .collect();
        for time in self.heat.turns() {
            let turn = (time * all as f64).round() as u64;
            let after: &[u64] = if self.heat.has_corners() {
                &AFTER_A_CORNER
            } else {
                &[0]
            };
            knots.extend(after.iter().map(|after| turn + after));
        }
        if self.heat.has_corners() {
            knots.extend(AFTER_A_CORNER);
        }
        if first {
            let mut step = 1.0;
            let mut next = 0.0;
            while step < all as f64 / self.knots as f64 {
                knots.push(next as u64);
                step = if next < MORNING as f64 {
                    1.0
                } else {
                    MORNING_GROWTH * step
                };
                next += step;
            }
        }
        knots.push(all - 1);
        knots.retain(|knot| *knot < all);
        knots.sort_unstable();
        knots.dedup();
        knots
    }
}

/// What real periods measured over a day: the friction that the law misses, by the time at which each ended \[periods\].
pub type Defects = Vec<(f64, Vec<f64>)>;

/// A day that was lived.
#[derive(Debug, Clone)]
pub struct Lived {
    /// In the order of time.
    pub rows: Vec<Row>,
    pub extremes: Extremes,
    /// The cable when it was hottest and coldest.
    pub hot: CableState,
    pub cold: CableState,
    /// After the last pass.
    pub last: CableState,
}

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

/// One day under way.
struct Diary {
    rows: Vec<Row>,
    extremes: Extremes,
    /// Θ, and the cable then.
    hot: Option<CableState>,
    cold: Option<CableState>,
}

impl Diary {
    fn note(&mut self, row: Row, state: &CableState) {
        self.extremes.see(&row.outcome);
        self.rows.push(row);
        let thermal = state.thermal_force();
        if self.hot.as_ref().is_none_or(|hot| thermal > hot.thermal_force()) {
            self.hot = Some(state.clone());
        }
        if self
            .cold
            .as_ref()
            .is_none_or(|cold| thermal < cold.thermal_force())
        {
            self.cold = Some(state.clone());
        }
    }

    fn close(self, last: CableState) -> Lived {
        Lived {
            rows: self.rows,
            extremes: self.extremes,
            hot: self.hot.unwrap_or_else(|| last.clone()),
            cold: self.cold.unwrap_or_else(|| last.clone()),
            last,
        }
    }
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
        let mut knots = day.simulated(self.defects.is_empty());
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
            self.period(knot, Some(after), passes, &mut diary)?;
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

    /// The last day of all, of which `passes` are lived after `after` others: its last period is real.
    pub fn last(&mut self, after: u64, passes: u64) -> Result<Lived, E> {
        let day = self.day;
        let last = passes.div_ceil(day.period as u64).min(day.periods()) - 1;
        let mut diary = self.open()?;
        self.replay_to(last, &mut diary)?;
        self.period(last, Some(after), passes, &mut diary)?;
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
        let mut diary = Diary {
            rows: Vec::new(),
            extremes: Extremes::none(),
            hot: None,
            cold: None,
        };
        self.warm(self.day.heat.at(0.0), 0.0, false, &mut diary)?;
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
            self.warm(thermal, passes as f64, false, diary)?;
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

    fn warm(&mut self, thermal_force: f64, passes: f64, simulated: bool, diary: &mut Diary) -> Result<(), E> {
        self.cable.warm(&mut self.state, thermal_force).map_err(wrap)?;
        self.note(passes, simulated, true, diary)
    }

    /// Notes the cable at rest.
    fn note(&mut self, passes: f64, simulated: bool, heat: bool, diary: &mut Diary) -> Result<(), E> {
        let mut outcome = PassOutcome::at_rest(self.cable.cable(), &self.state).map_err(wrap)?;
        outcome.upstream_displacement += self.offset;
        outcome.downstream_displacement += self.offset;
        diary.note(
            Row {
                passes,
                thermal_force: self.state.thermal_force(),
                outcome,
                simulated,
                heat,
            },
            &self.state,
        );
        Ok(())
    }

    /// Simulates the `period` of the day, up to the pass `most` of the day. Its passes follow `after` others where they have numbers.
    fn period(&mut self, period: u64, after: Option<u64>, most: u64, diary: &mut Diary) -> Result<(), E> {
        let day = self.day;
        let passes = period * day.period as u64..day.passes_of(period + 1).min(most);
        for pass in passes {
            let phase = (pass % day.period as u64) as usize;
            for thermal in day.turns_before(pass) {
                self.warm(thermal, pass as f64, true, diary)?;
            }
            self.warm(day.thermal_force(pass as f64 + 0.5), pass as f64, true, diary)?;
            let number = after.map(|after| after + pass + 1);
            let mut outcome = (self.pass)(Next { phase, number }, &mut self.state)?;
            self.simulated += 1;
            outcome.upstream_displacement += self.offset;
            outcome.downstream_displacement += self.offset;
            let passes = (pass + 1) as f64;
            diary.note(
                Row {
                    passes,
                    thermal_force: self.state.thermal_force(),
                    outcome,
                    simulated: true,
                    heat: false,
                },
                &self.state,
            );
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

    /// One step from the period `from` of the day to `to`; `today` has what was measured today.
    fn advance(&mut self, from: u64, to: u64, today: Option<&Defects>, diary: &mut Diary) -> Result<(), E> {
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
        self.note(passes as f64, false, false, diary)?;
        if passes < self.day.passes {
            let state = self.state.clone();
            let next = self.day.thermal_force(passes as f64 + 0.5);
            for thermal in self.day.turns_before(passes).into_iter().chain([next]) {
                self.warm(thermal, passes as f64, false, diary)?;
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

pub(super) fn wrap<E: From<JumpError>>(error: cable_dem::CableError) -> E {
    JumpError::from(error).into()
}
