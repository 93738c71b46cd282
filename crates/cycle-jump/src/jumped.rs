//! The cable within a jump.

use cable_dem::{CableError, CableState, Mesh, PassOutcome, RestingCable};

use crate::flow::Flow;
use crate::peaks::largest_places;
use crate::period::{Period, phase_of, take_whole};

/// Periods within a jump are computed when they end at most so far apart, as a ratio of their times since the first. Forces change on the
/// scale of that time: between two such periods they differ from a straight line by (ln 1.03)²/8 = 1e-4 of themselves.
const APART: f64 = 1.03;

/// A jump that was taken, from one measured period to another.
pub struct Jumped<'a> {
    pub mesh: &'a Mesh,
    /// Periods before it, and its length with the two measured periods at its end.
    pub begin: u64,
    pub length: u64,
    /// Displacements at both ends.
    pub from: &'a CableState,
    pub to: &'a CableState,
    /// What a cable that nothing holds has moved as a whole at its beginning, and since then to its end \[m\].
    pub offset: f64,
    pub moved: f64,
    /// The period before it and the one at its end.
    pub before: &'a Period,
    pub after: &'a Period,
    pub flow: Flow<'a>,
}

impl Jumped<'_> {
    /// Where `pass` stands in its period, and how many periods after the jump's beginning it ends.
    pub fn place(&self, pass: u64) -> (usize, f64) {
        let period = self.before.len();
        let into = pass as f64 / period as f64 - self.begin as f64;
        (phase_of(pass, period), into)
    }

    /// The cable at rest after `pass`, and what it has moved as a whole \[m\].
    pub fn state(&self, cable: &mut RestingCable, pass: u64) -> Result<(CableState, f64), CableError> {
        let (phase, into) = self.place(pass);
        let share = into / self.length as f64;
        let between = |before: f64, after: f64| (1.0 - share) * before + share * after;
        let advance = self.flow.after(cable, into);
        let mut displacement = Vec::with_capacity(advance.len());
        for (i, y) in advance.iter().enumerate() {
            let (from, to) = (
                self.from.displacement()[i],
                self.moved + self.to.displacement()[i],
            );
            // What the flow misses at its end grows from nothing.
            let missed = to - from - self.flow.end()[i];
            let shape = between(self.before.shape(phase, i), self.after.shape(phase, i));
            displacement.push(from + y + share * share * missed + shape);
        }
        let whole = take_whole(cable, &mut displacement);
        let [before, after] = [self.before, self.after].map(|period| period.phase(phase));
        // Everywhere else friction follows from how the cable lies.
        let mut friction = vec![0.0; displacement.len()];
        for (node, end) in [0, friction.len() - 1].into_iter().zip(0..) {
            friction[node] = between(before.friction[end], after.friction[end]);
        }
        let state = CableState::from_parts(self.mesh, displacement, friction)?;
        let mut state = state.with_thermal_force(before.thermal_force)?;
        cable.settle(&mut state)?;
        Ok((state, self.offset + whole))
    }

    /// What each of `passes`, ascending, did: the few that [`computed`] names from the state after them, those between as a mean of the two
    /// of the same vehicle on either side.
    pub fn outcomes(&self, cable: &mut RestingCable, passes: &[u64]) -> Result<Vec<PassOutcome>, CableError> {
        let mut outcomes = vec![PassOutcome::default(); passes.len()];
        for phase in 0..self.before.len() {
            let (of_phase, ends): (Vec<usize>, Vec<f64>) = (0..passes.len())
                .map(|row| (row, self.place(passes[row])))
                .filter(|(_, place)| place.0 == phase)
                .map(|(row, (_, into))| (row, self.begin as f64 + into))
                .unzip();
            let computed = computed(&ends);
            for &k in &computed {
                let row = of_phase[k];
                outcomes[row] = self.outcome(cable, passes[row])?;
            }
            for pair in computed.windows(2) {
                let (from, to) = (pair[0], pair[1]);
                for k in from + 1..to {
                    let share = (ends[k] - ends[from]) / (ends[to] - ends[from]);
                    let (before, after) = (&outcomes[of_phase[from]], &outcomes[of_phase[to]]);
                    outcomes[of_phase[k]] = PassOutcome::combined(&[(1.0 - share, before), (share, after)]);
                }
            }
        }
        Ok(outcomes)
    }

    /// Passes within it, up to the pass `last`, of the vehicles that show the largest of some force or movement, about `apart` from each other
    /// as a ratio; none where all vehicles are alike.
    pub fn largest_passes(&self, last: u64, apart: f64) -> Vec<u64> {
        let length = self.before.len() as u64;
        if length == 1 {
            return Vec::new();
        }
        let places = self.largest_places();
        let mut passes = Vec::new();
        let mut period = self.begin;
        while period * length < last {
            let of_period = places.iter().map(|&place| period * length + place as u64 + 1);
            passes.extend(of_period.filter(|pass| *pass <= last));
            period = (period + 1).max((apart * period as f64) as u64);
        }
        passes
    }

    /// The places of a period whose passes show the largest of some force or movement before it or after it.
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
        let (phase, into) = self.place(pass);
        let share = into / self.length as f64;
        let (before, after) = (
            &self.before.phase(phase).outcome,
            &self.after.phase(phase).outcome,
        );
        let between = |of: fn(&PassOutcome) -> f64| (1.0 - share) * of(before) + share * of(after);
        outcome.peak.upstream += between(|o| o.peak.upstream - o.force.upstream);
        outcome.peak.downstream += between(|o| o.peak.downstream - o.force.downstream);
        outcome.lowest.upstream += between(|o| o.lowest.upstream - o.force.upstream);
        outcome.lowest.downstream += between(|o| o.lowest.downstream - o.force.downstream);
        outcome.dissipated = between(|o| o.dissipated);
        Ok(outcome)
    }
}

/// Which of the periods that end at the ascending times `ends` are computed: the first, the last, and others about [`APART`] apart.
fn computed(ends: &[f64]) -> Vec<usize> {
    let mut computed: Vec<usize> = Vec::new();
    for k in 0..ends.len() {
        let next = ends.get(k + 1);
        let is_due = |&last: &usize| next.is_none_or(|next| *next > APART * ends[last]);
        if computed.last().is_none_or(is_due) {
            computed.push(k);
        }
    }
    computed
}
