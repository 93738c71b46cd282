//! The cable within a jump.

use cable_dem::{CableError, CableState, Mesh, PassOutcome, RestingCable};

use crate::flow::Flow;
use crate::peaks::largest_places;
use crate::period::{Period, phase_of, remove_mean};
use crate::tuning::ROW_RATIO;

/// A jump that was taken, from one simulated period to another.
pub struct JumpInterval<'a> {
    pub mesh: &'a Mesh,
    /// Periods before it, and its length with the two simulated periods at its end.
    pub begin: u64,
    pub length: u64,
    /// The cable at both ends.
    pub from: &'a CableState,
    pub to: &'a CableState,
    /// Movement of a cable that nothing holds as a whole at the beginning, and from there to the end
    /// \[m\].
    pub offset: f64,
    pub moved: f64,
    /// The period before it and the one at its end.
    pub before: &'a Period,
    pub after: &'a Period,
    pub flow: Flow,
}

impl JumpInterval<'_> {
    /// How many periods after the beginning `pass` ends.
    fn time(&self, pass: u64) -> f64 {
        pass as f64 / self.before.len() as f64 - self.begin as f64
    }

    /// The cable before `pass`.
    pub fn state_before(&self, cable: &mut RestingCable, pass: u64) -> Result<CableState, CableError> {
        if pass - 1 == self.begin * self.before.len() as u64 {
            return Ok(self.from.clone());
        }
        Ok(self.state(cable, pass - 1)?.0)
    }

    /// The cable at rest after `pass`, and its movement as a whole \[m\].
    fn state(&self, cable: &mut RestingCable, pass: u64) -> Result<(CableState, f64), CableError> {
        let (phase, time) = (phase_of(pass, self.before.len()), self.time(pass));
        let share = time / self.length as f64;
        let between = |before: f64, after: f64| (1.0 - share) * before + share * after;
        let mut displacement = self.flow.after(cable, time);
        for (i, y) in displacement.iter_mut().enumerate() {
            let from = self.from.displacement()[i];
            // What the flow misses at its end grows from nothing.
            let missed = self.moved + self.to.displacement()[i] - from - self.flow.end()[i];
            let shape = between(self.before.shape(phase, i), self.after.shape(phase, i));
            *y = from + *y + share * share * missed + shape;
        }
        let whole = remove_mean(cable, &mut displacement);
        let [before, after] = [self.before, self.after].map(|period| period.phase(phase));
        // Everywhere else friction follows from the displacements.
        let mut friction = vec![0.0; displacement.len()];
        let last = friction.len() - 1;
        friction[0] = between(before.friction[0], after.friction[0]);
        friction[last] = between(before.friction[1], after.friction[1]);
        let state = CableState::from_parts(self.mesh, displacement, friction)?;
        let mut state = state.with_thermal_force(before.thermal_force)?;
        cable.settle(&mut state)?;
        Ok((state, self.offset + whole))
    }

    /// What each of `passes`, ascending, did: some from the state after them, those between as a mean
    /// of the two of the same vehicle on either side.
    pub fn outcomes(&self, cable: &mut RestingCable, passes: &[u64]) -> Result<Vec<PassOutcome>, CableError> {
        let mut outcomes = vec![PassOutcome::default(); passes.len()];
        for phase in 0..self.before.len() {
            let is_of_phase = |row: &usize| phase_of(passes[*row], self.before.len()) == phase;
            let rows: Vec<usize> = (0..passes.len()).filter(is_of_phase).collect();
            let mut computed: Option<usize> = None;
            for (k, &row) in rows.iter().enumerate() {
                if let (Some(from), Some(&next)) = (computed, rows.get(k + 1)) {
                    if passes[next] as f64 <= ROW_RATIO * passes[rows[from]] as f64 {
                        continue;
                    }
                }
                outcomes[row] = self.outcome(cable, passes[row])?;
                if let Some(from) = computed.replace(k) {
                    let (before, after) = (&outcomes[rows[from]].clone(), &outcomes[row].clone());
                    let (begin, end) = (passes[rows[from]], passes[row]);
                    for &between in &rows[from + 1..k] {
                        let share = (passes[between] - begin) as f64 / (end - begin) as f64;
                        outcomes[between] = PassOutcome::combined(&[(1.0 - share, before), (share, after)]);
                    }
                }
            }
        }
        Ok(outcomes)
    }

    /// The places of a period whose passes show the largest of some force or movement at either end.
    pub fn largest_places(&self) -> Vec<usize> {
        let mut places = [largest_places(self.before), largest_places(self.after)].concat();
        places.sort_unstable();
        places.dedup();
        places
    }

    /// What `pass` did.
    fn outcome(&self, cable: &mut RestingCable, pass: u64) -> Result<PassOutcome, CableError> {
        let (state, offset) = self.state(cable, pass)?;
        let mut outcome = PassOutcome::at_rest(cable.cable(), &state)?.moved(offset);
        let phase = phase_of(pass, self.before.len());
        let share = self.time(pass) / self.length as f64;
        let [before, after] = [self.before, self.after].map(|period| &period.phase(phase).outcome);
        let between = |of: fn(&PassOutcome) -> f64| (1.0 - share) * of(before) + share * of(after);
        outcome.peak.upstream += between(|o| o.peak.upstream - o.force.upstream);
        outcome.peak.downstream += between(|o| o.peak.downstream - o.force.downstream);
        outcome.lowest.upstream += between(|o| o.lowest.upstream - o.force.upstream);
        outcome.lowest.downstream += between(|o| o.lowest.downstream - o.force.downstream);
        outcome.dissipated = between(|o| o.dissipated);
        Ok(outcome)
    }
}
