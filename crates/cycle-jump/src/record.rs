//! The cable after listed passes: simulated ones, and those within a jump.

use cable_dem::{CableError, CableState, Mesh, PassOutcome, RestingCable};

use crate::flow::Flow;
use crate::period::{Phase, phase_of};

/// Periods within a jump are computed when they end at most so far apart, as a ratio of their times since the first. Forces change on the
/// scale of that time: between two such periods they differ from a straight line by (ln 1.03)²/8 = 1e-4 of themselves.
const APART: f64 = 1.03;

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

impl Beyond {
    /// From the records, and the passes of the last `period`.
    pub(crate) fn new(records: Vec<Record>, period: &[Phase]) -> Self {
        Self {
            records,
            period: period.iter().map(|phase| phase.outcome.clone()).collect(),
        }
    }

    /// Where forces no longer change: the passes `wanted` do what those of the last `period` did. (A cable that nothing holds moves on; its
    /// movement is not told.)
    pub(crate) fn unchanged(wanted: &[u64], period: &[Phase]) -> Self {
        let record = |&pass: &u64| Record {
            pass,
            outcome: period[phase_of(pass, period.len())].outcome.clone(),
            interpolated: true,
        };
        Self::new(wanted.iter().map(record).collect(), period)
    }
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
        let period = self.before.len();
        let into = pass as f64 / period as f64 - self.begin as f64;
        (phase_of(pass, period), into)
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

    /// What `pass` did.
    fn outcome(&self, cable: &mut RestingCable, pass: u64) -> Result<PassOutcome, CableError> {
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
