//! One simulated period of the traffic: how far it moved the cable, and what each pass did.

use cable_dem::{CableState, ClampState, PassOutcome, RestingCable};

/// A simulated period, which moved the cable from u_a to u_b.
#[derive(Debug, Clone, Default)]
pub struct Period {
    /// Advance v = u_b − u_a of every node \[m\].
    pub rate: Vec<f64>,
    /// The mean displacement (u_a + u_b)/2 during the period \[m\]. The advance belongs there, half a
    /// period before the end, so that a sum over periods agrees with an integral.
    pub middle: Vec<f64>,
    /// u_a \[m\].
    start: Vec<f64>,
    /// What each simulated pass did, in their order.
    phases: Vec<Phase>,
    /// For each pass of the period the simulated one that stands for it, and the movement as a
    /// whole since then \[m\].
    places: Vec<(usize, f64)>,
}

/// One simulated pass of a period.
#[derive(Debug, Clone)]
pub struct Phase {
    /// u after this pass less u_a \[m\].
    moved: Vec<f64>,
    /// Friction after it on both end nodes \[N/m\]: at a fixed end it does not follow from u.
    pub friction: [f64; 2],
    /// Its clamps then.
    pub clamps: Vec<ClampState>,
    /// Θ then \[N\].
    pub thermal_force: f64,
    /// What it did.
    pub outcome: PassOutcome,
}

/// Which pass of its period `pass` is, from 0, where a period has so many passes.
pub fn phase_of(pass: u64, period: usize) -> usize {
    ((pass - 1) % period as u64) as usize
}

impl Period {
    /// A period that begins with the displacements `start` \[m\].
    pub fn begin(start: &[f64]) -> Self {
        Self {
            start: start.to_vec(),
            ..Self::default()
        }
    }

    /// Adds a simulated pass that left the `cable` in `state`.
    pub fn push(&mut self, cable: &RestingCable, state: &CableState, outcome: PassOutcome) {
        let friction = state.friction();
        self.places.push((self.phases.len(), 0.0));
        self.phases.push(Phase {
            moved: difference(state.displacement(), &self.start),
            friction: [friction[0], friction[friction.len() - 1]],
            clamps: cable.clamps(state),
            thermal_force: state.thermal_force(),
            outcome,
        });
    }

    /// Adds a pass that does what the one `round` passes before it did, but for a movement as a
    /// `whole` \[m\].
    pub fn repeat(&mut self, round: usize, whole: f64) {
        let (phase, moved) = self.places[self.places.len() - round];
        self.places.push((phase, moved + whole));
    }

    /// Ends it with the displacements `end` \[m\].
    pub fn end(&mut self, end: &[f64]) {
        self.rate = difference(end, &self.start);
        let halfway = self.start.iter().zip(&self.rate).map(|(u, v)| u + 0.5 * v);
        self.middle = halfway.collect();
    }

    /// Number of its passes so far.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// The simulated pass that stands for the pass at `place`, from 0.
    pub fn phase(&self, place: usize) -> &Phase {
        &self.phases[self.places[place].0]
    }

    /// By how much u after the pass at `place` exceeds the straight line from u_a to u_b at `node`
    /// \[m\].
    pub fn shape(&self, place: usize, node: usize) -> f64 {
        let done = (place + 1) as f64 / self.len() as f64;
        self.phase(place).moved[node] + self.places[place].1 - done * self.rate[node]
    }

    /// What the pass at `place` did.
    pub fn outcome(&self, place: usize) -> PassOutcome {
        self.phase(place).outcome.clone().moved(self.places[place].1)
    }

    /// What each of its passes did.
    pub fn outcomes(&self) -> Vec<PassOutcome> {
        (0..self.len()).map(|place| self.outcome(place)).collect()
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

/// Removes the mean from displacements \[m\] of a cable that nothing holds, and returns it:
/// rounding of metres would hide micrometres. Zero where something holds the cable.
pub fn remove_mean(cable: &RestingCable, displacement: &mut [f64]) -> f64 {
    if cable.chain().is_held() {
        return 0.0;
    }
    let mean = displacement.iter().sum::<f64>() / displacement.len() as f64;
    for u in displacement.iter_mut() {
        *u -= mean;
    }
    mean
}
