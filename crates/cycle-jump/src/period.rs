//! One period of the traffic, simulated: what it did to the cable.

use cable_dem::{CableState, PassOutcome, RestingCable};

/// A measured period, from u_a to u_b.
#[derive(Debug, Clone)]
pub struct Period {
    /// Advance v = u_b − u_a of every node \[m\].
    pub rate: Vec<f64>,
    /// (u_a + u_b)/2: where the cable lay when it advanced so. Half a period back, it is between sums and integrals.
    pub middle: Vec<f64>,
    /// What each simulated pass did, in their order.
    phases: Vec<Phase>,
    /// Which of them stands for each pass of the period, and what a cable that nothing holds has moved as a whole since then \[m\].
    places: Vec<(usize, f64)>,
}

/// One simulated pass of a period.
#[derive(Debug, Clone)]
pub struct Phase {
    /// u after this pass less u_a \[m\].
    pub moved: Vec<f64>,
    /// Friction after it on both end nodes \[N/m\]: where an end is fixed it does not follow from u.
    pub friction: [f64; 2],
    /// Θ then \[N\].
    pub thermal_force: f64,
    /// What it did.
    pub outcome: PassOutcome,
}

/// Which pass of its period `pass` is, where a period has so many passes.
pub fn phase_of(pass: u64, period: usize) -> usize {
    ((pass - 1) % period as u64) as usize
}

impl Period {
    /// The period that began with the displacements `start` \[m\] and ended in the state `end`, from its simulated passes and which of
    /// them stands for each pass, with the movement as a whole since then \[m\].
    pub fn new(start: &[f64], end: &CableState, phases: Vec<Phase>, places: Vec<(usize, f64)>) -> Self {
        let rate = difference(end.displacement(), start);
        Self {
            middle: start.iter().zip(&rate).map(|(u, v)| u + 0.5 * v).collect(),
            rate,
            phases,
            places,
        }
    }

    /// Number of its passes.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// The simulated pass that shows the pass at `place` of the period, from 0.
    pub fn phase(&self, place: usize) -> &Phase {
        &self.phases[self.places[place].0]
    }

    /// What u after the pass at `place` is beside the straight line from u_a to u_b at one node \[m\].
    pub fn shape(&self, place: usize, node: usize) -> f64 {
        let done = (place + 1) as f64 / self.len() as f64;
        self.phase(place).moved[node] + self.places[place].1 - done * self.rate[node]
    }

    /// What each of its passes did.
    pub fn outcomes(&self) -> impl Iterator<Item = &PassOutcome> {
        self.places.iter().map(|&(phase, _)| &self.phases[phase].outcome)
    }

    /// Friction K Δu/w \[N/m\] by which the middle of this period differs from `displacement`.
    pub fn friction_from(&self, displacement: &[f64], cable: &RestingCable) -> Vec<f64> {
        let moved = difference(&self.middle, displacement);
        let mut friction = vec![0.0; moved.len()];
        cable.balance(&moved, &mut friction);
        friction
    }
}

impl Phase {
    /// Of a pass that left `state` in a period that began with the displacements `start` \[m\].
    pub fn new(start: &[f64], state: &CableState, outcome: PassOutcome) -> Self {
        let friction = state.friction();
        Self {
            moved: difference(state.displacement(), start),
            friction: [friction[0], friction[friction.len() - 1]],
            thermal_force: state.thermal_force(),
            outcome,
        }
    }
}

/// a − b.
pub fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// The largest |value|.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, v| largest.max(v.abs()))
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
