//! One period of the traffic, simulated: what it did to the cable.

use cable_dem::{CableState, PassOutcome, RestingCable};

/// A measured period, from u_a to u_b.
#[derive(Debug, Clone)]
pub struct Period {
    /// Advance v = u_b − u_a of every node \[m\].
    pub rate: Vec<f64>,
    /// (u_a + u_b)/2: where the cable lay when it advanced so. Half a period back, it is between sums and integrals.
    pub middle: Vec<f64>,
    /// What each of its passes did.
    pub phases: Vec<Phase>,
}

/// One pass of a period.
#[derive(Debug, Clone)]
pub struct Phase {
    /// What u after this pass is beside the straight line from u_a to u_b \[m\].
    pub shape: Vec<f64>,
    /// Friction after it \[N/m\]: that on the node of a fixed end does not follow from u.
    pub friction: Vec<f64>,
    /// What it did.
    pub outcome: PassOutcome,
}

/// Which pass of its period `pass` is, where a period has so many passes.
pub fn phase_of(pass: u64, period: usize) -> usize {
    ((pass - 1) % period as u64) as usize
}

impl Period {
    /// The period that began with the displacements `start` \[m\], from the cable after each of its passes and what they did.
    pub fn new(start: &[f64], passes: &[(CableState, PassOutcome)]) -> Self {
        let count = passes.len() as f64;
        let end = passes.last().map_or(start, |(state, _)| state.displacement());
        let rate = difference(end, start);
        let phase = |(done, (state, outcome)): (f64, &(CableState, PassOutcome))| {
            let moved = state.displacement().iter().zip(start).zip(&rate);
            Phase {
                shape: moved
                    .map(|((u, start), v)| u - start - done / count * v)
                    .collect(),
                friction: state.friction().to_vec(),
                outcome: outcome.clone(),
            }
        };
        Self {
            phases: passes
                .iter()
                .enumerate()
                .map(|(before, pass)| phase((before as f64 + 1.0, pass)))
                .collect(),
            middle: start.iter().zip(&rate).map(|(u, v)| u + 0.5 * v).collect(),
            rate,
        }
    }

    /// Friction K Δu/w \[N/m\] by which the middle of this period differs from `displacement`.
    pub fn friction_from(&self, displacement: &[f64], cable: &RestingCable) -> Vec<f64> {
        let moved = difference(&self.middle, displacement);
        let mut friction = vec![0.0; moved.len()];
        cable.balance(&moved, &mut friction);
        friction
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
