//! The cable after listed passes: simulated ones, and those within a jump.

use cable_dem::{CableError, CableState, Mesh, PassOutcome, RestingCable};

use crate::flow::Flow;
use crate::period::Phase;

/// The cable after one pass.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Number of the pass, from 1.
    pub pass: u64,
    /// What it did.
    pub outcome: PassOutcome,
    /// Whether it lies within a jump.
    pub interpolated: bool,
}

/// The cable over all passes.
#[derive(Debug, Clone)]
pub struct Evolution {
    /// The passes that were wanted.
    pub records: Vec<Record>,
    /// The cable after the last pass.
    pub state: CableState,
    /// Passes simulated.
    pub simulated: u64,
    /// Lengths of the jumps \[periods\] in their order, 0 for a simulated period between.
    pub schedule: Vec<u64>,
    /// Where it leads; `None` where nothing beyond the last pass was wanted, or it does not become steady.
    pub beyond: Option<Beyond>,
}

/// Where the forces lead.
#[derive(Debug, Clone)]
pub struct Beyond {
    /// The passes that were wanted.
    pub records: Vec<Record>,
    /// What each pass of a period does once the forces no longer change from period to period.
    pub period: Vec<PassOutcome>,
}

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
    pub before: &'a [Phase],
    pub after: &'a [Phase],
    pub flow: Flow<'a>,
}

impl Jumped<'_> {
    /// Where `pass` stands in its period, and how many periods after the jump's beginning it ends.
    pub fn place(&self, pass: u64) -> (usize, f64) {
        let period = self.before.len() as u64;
        let phase = ((pass - 1) % period) as usize;
        (phase, pass as f64 / period as f64 - self.begin as f64)
    }

    /// The cable at rest after `pass`, and what it has moved as a whole \[m\].
    pub fn state(&self, cable: &mut RestingCable, pass: u64) -> Result<(CableState, f64), CableError> {
        let (phase, into) = self.place(pass);
        let share = into / self.length as f64;
        let between = |before: f64, after: f64| (1.0 - share) * before + share * after;
        let (before, after) = (&self.before[phase], &self.after[phase]);
        let advance = self.flow.after(cable, into);
        let mut displacement = Vec::with_capacity(advance.len());
        let mut friction = Vec::with_capacity(advance.len());
        for (i, y) in advance.iter().enumerate() {
            let (from, to) = (
                self.from.displacement()[i],
                self.moved + self.to.displacement()[i],
            );
            // What the flow misses at its end grows from nothing.
            let missed = to - from - self.flow.end()[i];
            let shape = between(before.shape[i], after.shape[i]);
            displacement.push(from + y + share * share * missed + shape);
            friction.push(between(before.friction[i], after.friction[i]));
        }
        let whole = take_whole(cable, &mut displacement);
        let mut state = CableState::from_parts(self.mesh, displacement, friction)?;
        cable.settle(&mut state)?;
        Ok((state, self.offset + whole))
    }

    /// What `pass` did.
    pub fn outcome(&self, cable: &mut RestingCable, pass: u64) -> Result<PassOutcome, CableError> {
        let (state, offset) = self.state(cable, pass)?;
        let mut outcome = PassOutcome::at_rest(cable.cable(), &state)?;
        outcome.upstream_displacement += offset;
        outcome.downstream_displacement += offset;
        let (phase, into) = self.place(pass);
        let share = into / self.length as f64;
        let (before, after) = (&self.before[phase].outcome, &self.after[phase].outcome);
        let between = |of: fn(&PassOutcome) -> f64| (1.0 - share) * of(before) + share * of(after);
        outcome.peak.upstream += between(|o| o.peak.upstream - o.force.upstream);
        outcome.peak.downstream += between(|o| o.peak.downstream - o.force.downstream);
        outcome.lowest.upstream += between(|o| o.lowest.upstream - o.force.upstream);
        outcome.lowest.downstream += between(|o| o.lowest.downstream - o.force.downstream);
        outcome.dissipated = between(|o| o.dissipated);
        Ok(outcome)
    }
}

/// Takes away what displacements \[m\] of a cable that nothing holds have in common, and returns it: rounding of metres would hide what
/// micrometres do. Zero where something holds the cable.
pub fn take_whole(cable: &RestingCable, displacement: &mut [f64]) -> f64 {
    if cable.is_held() {
        return 0.0;
    }
    let mean = displacement.iter().sum::<f64>() / displacement.len() as f64;
    for u in displacement.iter_mut() {
        *u -= mean;
    }
    mean
}
