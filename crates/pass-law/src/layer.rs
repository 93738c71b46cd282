//! What the ends add: the layers of a few depths in which friction differs from the slowly varying one.
//!
//! Near an end the locked friction f departs from its value f̄ farther inside, because vehicles come onto the cable or
//! leave it there, and because a held end lets the duct slip past it. Seen from the slow law, an end's layer adds
//!
//! S = ∫ (f − f̄) dx  \[N\]  to the force, and  v = −(1/EA) ∫ (f − f̄) s ds  \[m\]  to the end's displacement,
//!
//! s the distance from the end. Both come from runs of the cable solver on a short piece:
//!
//! - **moving end** (free, or on a spring): a piece with a dead load at each end, so that it carries the mean friction f̄
//!   and advances as a whole, until its friction no longer changes. It gives S(f̄), v(f̄) of both ends.
//! - **held end** (fixed, or a spring at saturation): a piece that is free at its other end, from the uniform friction f*,
//!   until its end force no longer changes. It gives S and v at f*, which rules at a fixed end from the first few passes on.
//!
//! A spring has the moving end's S(f̄), shifted to its own value at f*.

use cable_dem::{CableState, DuctedCable, End, Mesh, Order, Passage, QuasiStatic, Traffic};
use ground_field::DuctMotion;

use crate::cell::dead_load;
use crate::table::Table;
use crate::{LawError, MixedLaw, Resolution};

/// Length of a piece in fading lengths, beside the longest vehicle.
const PIECE_LENGTHS: f64 = 24.0;
/// Distance in depths from which vehicles come.
const APPROACH_DEPTHS: f64 = 40.0;
/// A piece is steady when S changes by less than this share of q × depth a pass.
const STEADY: f64 = 1e-3;
/// A piece that still changes by this share of q × depth a pass after [`MOST_PASSES`] is an error.
const UNSTEADY: f64 = 2e-2;
const MOST_PASSES: usize = 240;
/// Most passes over which mixed traffic is averaged.
const LONGEST_PERIOD: usize = 12;

/// Which end of the cable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Upstream,
    Downstream,
}

/// One end's layer.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layer {
    /// S \[N\] against f̄ \[N/m\].
    pub force: Table,
    /// v \[m\] against f̄ \[N/m\].
    pub displacement: Table,
    /// Largest and least force during a pass less the mean force after passes \[N\].
    pub transient: (f64, f64),
    /// Force after each pass of a period of interleaved traffic less its mean \[N\]; empty where traffic has no short period.
    pub swing: Vec<f64>,
}

impl Layer {
    /// No layer at all.
    pub fn none() -> Self {
        let zero = || Table::new(vec![[-1.0, 0.0], [1.0, 0.0]]);
        Self {
            force: zero(),
            displacement: zero(),
            transient: (0.0, 0.0),
            swing: Vec::new(),
        }
    }

    /// A moving end's layer, shifted so that it is `held`'s at the friction `at`.
    pub fn shifted_to(&self, held: &Self, at: f64) -> Self {
        let shifted = |table: &Table, target: &Table| {
            let shift = target.at(at).0 - table.at(at).0;
            Table::new(
                table
                    .nodes()
                    .iter()
                    .map(|node| [node[0], node[1] + shift])
                    .collect(),
            )
        };
        Self {
            force: shifted(&self.force, &held.force),
            displacement: shifted(&self.displacement, &held.displacement),
            transient: held.transient,
            swing: held.swing.clone(),
        }
    }

    fn constant(reading: Reading, forces: &Forces) -> Self {
        let mean = forces.after.iter().sum::<f64>() / forces.after.len() as f64;
        let level = |value: f64| Table::new(vec![[-1.0, value], [1.0, value]]);
        Self {
            force: level(reading.force),
            displacement: level(reading.displacement),
            transient: (forces.greatest - mean, forces.least - mean),
            swing: if forces.repeats {
                forces.after.iter().map(|force| force - mean).collect()
            } else {
                Vec::new()
            },
        }
    }
}

/// Forces on one end in the last period of a run \[N\].
#[derive(Debug, Clone)]
struct Forces {
    after: Vec<f64>,
    greatest: f64,
    least: f64,
    /// Whether the period is one.
    repeats: bool,
}

impl Forces {
    fn new(repeats: bool) -> Self {
        Self {
            after: Vec::new(),
            greatest: f64::NEG_INFINITY,
            least: f64::INFINITY,
            repeats,
        }
    }

    fn push(&mut self, after: f64, greatest: f64, least: f64) {
        self.after.push(after);
        self.greatest = self.greatest.max(greatest);
        self.least = self.least.min(least);
    }
}

/// S and v of one end at one f̄.
#[derive(Debug, Clone, Copy, Default)]
struct Reading {
    friction: f64,
    force: f64,
    displacement: f64,
}

/// The short piece and its traffic.
#[derive(Debug, Clone)]
pub(crate) struct Piece<'a> {
    stiffness: f64,
    cable: DuctedCable,
    mesh: Mesh,
    streams: &'a [(DuctMotion, f64)],
    approach: f64,
    peak: f64,
    depth: f64,
    /// Passes made.
    pub passes: usize,
}

impl<'a> Piece<'a> {
    pub fn new(
        cable: &DuctedCable,
        streams: &'a [(DuctMotion, f64)],
        resolution: Resolution,
    ) -> Result<Self, LawError> {
        let half = streams
            .iter()
            .map(|(motion, _)| motion.half_length())
            .fold(0.0, f64::max);
        let peak = streams
            .iter()
            .map(|(motion, _)| motion.peak_longitudinal())
            .fold(0.0, f64::max);
        let length = PIECE_LENGTHS * resolution.fading_length(cable, peak) + 2.0 * half;
        let mesh = Mesh::new(length, resolution.node_spacing(), resolution.vehicle_step())?;
        let approach = APPROACH_DEPTHS * resolution.depth() + half;
        Ok(Self {
            stiffness: cable.axial_stiffness(),
            cable: DuctedCable::new(length, cable.axial_stiffness(), cable.friction())?,
            mesh,
            streams,
            approach,
            peak,
            depth: resolution.depth(),
            passes: 0,
        })
    }

    /// The layers of both ends where nothing, or a spring, holds them, for `law`'s locked friction from 0 to f*.
    pub fn moving(&mut self, law: &MixedLaw) -> Result<[Layer; 2], LawError> {
        let mut readings = Vec::new();
        for share in [0.0, 0.5, 1.0] {
            readings.push(self.run_moving(share * law.saturation())?);
            if law.saturation() == 0.0 {
                break;
            }
        }
        if law.saturation() < 0.0 {
            readings.reverse();
        }
        Ok([0, 1].map(|side| {
            let column = |value: fn(Reading) -> f64| {
                let mut nodes: Vec<[f64; 2]> = readings
                    .iter()
                    .map(|r| [r[side].friction, value(r[side])])
                    .collect();
                if nodes.len() == 1 {
                    nodes.push([nodes[0][0] + 1.0, nodes[0][1]]);
                }
                Table::new(nodes)
            };
            Layer {
                force: column(|r| r.force),
                displacement: column(|r| r.displacement),
                transient: (0.0, 0.0),
                swing: Vec::new(),
            }
        }))
    }

    fn run_moving(&mut self, friction: f64) -> Result<[Reading; 2], LawError> {
        let length = self.cable.length();
        let (spring, stretch) = dead_load(0.5 * friction * length, self.peak);
        let cable = self
            .cable
            .clone()
            .with_ends(End::Spring(spring), End::Spring(spring))?;
        let bend = 0.5 * friction / self.stiffness;
        let start = self.state(friction, |x| stretch + bend * x * (length - x))?;
        let (readings, _) = self.run(cable, start, true)?;
        Ok(readings)
    }

    /// The layer of an end that holds the cable, at f*.
    pub fn held(&mut self, law: &MixedLaw, side: Side, end: End) -> Result<Layer, LawError> {
        let (length, friction) = (self.cable.length(), law.saturation());
        let bend = 0.5 * friction / self.stiffness;
        let give = match end.stiffness() {
            Some(stiffness) if stiffness > 0.0 => friction * length / stiffness,
            _ => 0.0,
        };
        let (ends, distance): (_, fn(f64, f64) -> f64) = match side {
            Side::Upstream => ((end, End::Free), |x, length| length - x),
            Side::Downstream => ((End::Free, end), |x, _| x),
        };
        let cable = self.cable.clone().with_ends(ends.0, ends.1)?;
        let start = self.state(friction, |x| {
            give + bend * (length * length - distance(x, length).powi(2))
        })?;
        let (readings, forces) = self.run(cable, start, false)?;
        let index = match side {
            Side::Upstream => 0,
            Side::Downstream => 1,
        };
        Ok(Layer::constant(readings[index], &forces[index]))
    }

    fn state(&self, friction: f64, displacement: impl Fn(f64) -> f64) -> Result<CableState, LawError> {
        let nodes = self.mesh.nodes();
        let displacement = (0..nodes)
            .map(|i| displacement(self.mesh.spacing() * i as f64))
            .collect();
        Ok(CableState::from_parts(
            &self.mesh,
            displacement,
            vec![friction; nodes],
        )?)
    }

    /// Lets the traffic pass until S of both ends is steady; a moving piece is set back after every period.
    fn run(
        &mut self,
        cable: DuctedCable,
        mut state: CableState,
        moving: bool,
    ) -> Result<([Reading; 2], [Forces; 2]), LawError> {
        let passages = self
            .streams
            .iter()
            .map(|(motion, _)| Passage::new(&cable, &self.mesh, motion, self.approach))
            .collect::<Result<Vec<_>, _>>()?;
        let shares: Vec<f64> = self.streams.iter().map(|stream| stream.1).collect();
        let mut traffic = Traffic::new(&shares, Order::Interleaved)?;
        let (period, repeats) = period(&shares);
        let scale = cable.friction().limit() * self.depth;
        let mut solver = QuasiStatic::new(cable, self.mesh)?;
        let mut last = [Reading::default(); 2];
        let mut passes = 0;
        loop {
            let before = state.displacement()[self.mesh.elements() / 2];
            let mut mean = [Reading::default(); 2];
            let mut forces = [Forces::new(repeats), Forces::new(repeats)];
            for _ in 0..period {
                let vehicle = traffic.next().unwrap_or(0);
                let outcome = solver.pass(&passages[vehicle], &mut state)?;
                let (after, peak, lowest) = (outcome.force, outcome.peak, outcome.lowest);
                forces[0].push(after.upstream, peak.upstream, lowest.upstream);
                forces[1].push(after.downstream, peak.downstream, lowest.downstream);
                let readings = self.read(&state);
                for (sum, reading) in mean.iter_mut().zip(readings) {
                    sum.friction += reading.friction / period as f64;
                    sum.force += reading.force / period as f64;
                    sum.displacement += reading.displacement / period as f64;
                }
            }
            passes += period;
            self.passes += period;
            let change = (0..2)
                .map(|side| (mean[side].force - last[side].force).abs())
                .fold(0.0, f64::max)
                / period as f64;
            last = mean;
            let most = if passes < MOST_PASSES { STEADY } else { UNSTEADY };
            if passes > 2 * period && change <= most * scale {
                return Ok((last, forces));
            }
            if passes >= MOST_PASSES {
                return Err(LawError::EndUnsettled { change, passes });
            }
            if moving {
                let advance = state.displacement()[self.mesh.elements() / 2] - before;
                let back = state.displacement().iter().map(|u| u - advance).collect();
                state = CableState::from_parts(&self.mesh, back, state.friction().to_vec())?;
            }
        }
    }

    /// S and v of both ends, against the mean friction of the middle third.
    fn read(&self, state: &CableState) -> [Reading; 2] {
        let n = self.mesh.elements();
        let f = state.friction();
        let middle = &f[n / 3..=n - n / 3];
        let friction = middle.iter().sum::<f64>() / middle.len() as f64;
        let mut readings = [Reading {
            friction,
            ..Reading::default()
        }; 2];
        for (i, f) in f.iter().enumerate() {
            // The node in the middle belongs to the second half.
            let side = usize::from(2 * i >= n);
            let weight = self.mesh.tributary_length(i) * (f - friction);
            let distance = self.mesh.spacing() * i.min(n - i) as f64;
            readings[side].force += weight;
            readings[side].displacement -= weight * distance / self.stiffness;
        }
        readings
    }
}

/// Least number of passes after which interleaved traffic with these shares repeats, and true; or, where that is long, a number
/// over which to average, and false.
fn period(shares: &[f64]) -> (usize, bool) {
    let total: f64 = shares.iter().sum();
    let whole = |n: &usize| {
        shares.iter().all(|share| {
            let count = share / total * *n as f64;
            (count - count.round()).abs() < 1e-6
        })
    };
    (1..=LONGEST_PERIOD)
        .find(whole)
        .map_or((LONGEST_PERIOD, false), |period| (period, true))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn traffic_repeats_after_its_period() {
        assert_eq!(period(&[1.0]), (1, true));
        assert_eq!(period(&[2.0, 1.0]), (3, true));
        assert_eq!(period(&[0.25, 0.75]), (4, true));
        assert_eq!(period(&[1.0, std::f64::consts::PI]), (LONGEST_PERIOD, false));
    }
}
