//! The cable within a jump.

use cable_dem::{CableError, CableState, PassOutcome, RestingCable};

use crate::flow::Flow;
use crate::period::{Period, difference, phase_of, remove_mean};

/// Passes of a vehicle within a jump are computed so far apart, as a ratio of their numbers. Forces
/// change on the scale of that number: between two such passes they differ from a straight line by
/// (ln 1.03)²/8 = 1e-4 of themselves. Three thousand rows take two thirds of the time.
const ROW_RATIO: f64 = 1.03;
/// If a jump changes less of the forces than such rows miss, as a share of the largest, outcomes lie
/// on a straight line between both periods. Three random mixes of a hundred vehicles with a million
/// passes take 0.74 to 0.88 of the time.
pub const STEADY: f64 = 1e-4;

/// A jump that was taken, from one simulated period to another.
pub struct JumpInterval<'a> {
    /// Periods before it, and its length with the two simulated periods at its end.
    pub begin: u64,
    pub length: u64,
    /// The cable at both ends, and its movement as a whole there \[m\].
    pub from: (&'a CableState, f64),
    pub to: (&'a CableState, f64),
    /// The period before it and the one at its end.
    pub before: &'a Period,
    pub after: &'a Period,
    pub flow: Flow,
}

impl JumpInterval<'_> {
    /// Periods from the beginning to the end of `pass`.
    fn time(&self, pass: u64) -> f64 {
        pass as f64 / self.before.len() as f64 - self.begin as f64
    }

    /// The cable at rest after `pass`, and its movement as a whole \[m\].
    pub fn state(&self, cable: &mut RestingCable, pass: u64) -> Result<(CableState, f64), CableError> {
        let (phase, time) = (phase_of(pass, self.before.len()), self.time(pass));
        let share = time / self.length as f64;
        let between = |before: f64, after: f64| (1.0 - share) * before + share * after;
        let mut displacement = self.flow.after(cable, time);
        for (i, y) in displacement.iter_mut().enumerate() {
            let [from, to] = [self.from, self.to].map(|(state, whole)| whole + state.displacement()[i]);
            // What the flow misses at its end grows from nothing.
            let missed = to - from - self.flow.end[i];
            let shape = between(self.before.shape(phase, i), self.after.shape(phase, i));
            *y += from - self.from.1 + share * share * missed + shape;
        }
        let whole = self.from.1 + remove_mean(cable, &mut displacement);
        let [before, after] = [self.before, self.after].map(|period| period.phase(phase));
        // Everywhere else friction follows from the displacements.
        let ends = [0, 1].map(|end| between(before.friction[end], after.friction[end]));
        let mut moved = cable.moved(self.from.0, displacement)?.with_end_friction(ends);
        cable.clamp_between(&mut moved, [&before.clamps, &after.clamps], share);
        let mut state = moved.with_thermal_force(before.thermal_force)?;
        cable.settle(&mut state)?;
        Ok((state, whole))
    }

    /// Its change of the displacements \[m\].
    pub fn change(&self) -> Vec<f64> {
        difference(self.to.0.displacement(), self.from.0.displacement())
    }

    /// What `pass` did, on a straight line from the period before to the one at the end.
    pub fn on_line(&self, pass: u64) -> PassOutcome {
        let phase = phase_of(pass, self.before.len());
        let periods = (pass - 1) / self.before.len() as u64 + 1 - self.begin;
        let share = periods as f64 / self.length as f64;
        let [before, after] = [self.before, self.after].map(|period| period.outcome(phase));
        PassOutcome::combined(&[(1.0 - share, &before), (share, &after)])
    }

    /// Outcomes of `passes`, in ascending order. Passes far enough apart follow from the state after
    /// them; those between are interpolated from the two nearest of the same vehicle.
    pub fn outcomes(&self, cable: &mut RestingCable, passes: &[u64]) -> Result<Vec<PassOutcome>, CableError> {
        let mut outcomes = vec![PassOutcome::default(); passes.len()];
        for phase in 0..self.before.len() {
            let is_of_phase = |row: &usize| phase_of(passes[*row], self.before.len()) == phase;
            let rows: Vec<usize> = (0..passes.len()).filter(is_of_phase).collect();
            let mut last = 0;
            for (k, &row) in rows.iter().enumerate() {
                let is_near = |next: &usize| passes[*next] as f64 <= ROW_RATIO * passes[rows[last]] as f64;
                if k > 0 && rows.get(k + 1).is_some_and(is_near) {
                    continue;
                }
                outcomes[row] = self.outcome(cable, passes[row])?;
                let (from, to) = (outcomes[rows[last]].clone(), outcomes[row].clone());
                for &between in rows.get(last + 1..k).unwrap_or(&[]) {
                    let [begin, pass, end] = [rows[last], between, row].map(|row| passes[row] as f64);
                    let share = (pass - begin) / (end - begin);
                    outcomes[between] = PassOutcome::combined(&[(1.0 - share, &from), (share, &to)]);
                }
                last = k;
            }
        }
        Ok(outcomes)
    }

    /// What `pass` did: the cable at rest after it, with peaks and heat between those of the same
    /// pass of both periods.
    fn outcome(&self, cable: &mut RestingCable, pass: u64) -> Result<PassOutcome, CableError> {
        let (state, whole) = self.state(cable, pass)?;
        let mut outcome = PassOutcome::at_rest(cable.cable(), &state)?.moved(whole);
        let phase = phase_of(pass, self.before.len());
        let share = self.time(pass) / self.length as f64;
        let [before, after] = [self.before, self.after].map(|period| &period.phase(phase).outcome);
        let between = |of: fn(&PassOutcome) -> f64| (1.0 - share) * of(before) + share * of(after);
        outcome.peak.upstream += between(|o| o.peak.upstream - o.force.upstream);
        outcome.peak.downstream += between(|o| o.peak.downstream - o.force.downstream);
        outcome.lowest.upstream += between(|o| o.lowest.upstream - o.force.upstream);
        outcome.lowest.downstream += between(|o| o.lowest.downstream - o.force.downstream);
        for (clamp, range) in outcome.restraint_ranges.iter_mut().enumerate() {
            for (side, force) in range.iter_mut().enumerate() {
                let beyond = |o: &PassOutcome| o.restraint_ranges[clamp][side] - o.restraints[clamp];
                *force += (1.0 - share) * beyond(before) + share * beyond(after);
            }
        }
        outcome.dissipated = between(|o| o.dissipated);
        Ok(outcome)
    }
}
