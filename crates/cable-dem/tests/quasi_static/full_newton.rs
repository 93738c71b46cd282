//! An independent solver to hold the crate's against: plain, slow, and sharing none of its ideas.
//!
//! The whole chain at every step, displacements as they are (no moving frame, no windows), reverse traffic as reverse
//! traffic (no mirror), elastic-plastic friction, damped Newton on the step's convex energy. A pass begins and ends with
//! the ground at rest. Where the vehicle stops on its way is given: by steps that are all the same ([`even_positions`]).

use cable_dem::{DuctedCable, End, EndForces, Mesh};
use ground_field::Direction;

use super::scenes::clamp_springs;

/// Newton steps after which the oracle counts as lost.
const MAX_STEPS: usize = 500;

pub struct FullChain {
    spacing: f64,
    stiffness: f64,
    tributary: Vec<f64>,
    /// Springs to the ground \[N/m\].
    springs: Vec<f64>,
    held: Vec<bool>,
    ends: [End; 2],
    limit: f64,
    /// q b/2 \[N/m²\].
    slope: f64,
    pub displacement: Vec<f64>,
    pub friction: Vec<f64>,
}

/// A trial state of one step.
struct Trial {
    /// Force that does not balance, per node \[N\]: minus the gradient of the energy.
    unbalanced: Vec<f64>,
    friction: Vec<f64>,
    elastic: Vec<bool>,
}

impl FullChain {
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let last = mesh.elements();
        let h = cable.length() / last as f64;
        let mut springs = vec![0.0; last + 1];
        let ends = [cable.upstream(), cable.downstream()];
        let of_end = |end: usize| ([0, last][end], ends[end].stiffness().unwrap_or(0.0));
        let of_clamps = clamp_springs(cable, mesh).into_iter();
        for (node, stiffness) in of_clamps.chain([of_end(0), of_end(1)]) {
            springs[node] += stiffness;
        }
        let mut held = vec![false; last + 1];
        (held[0], held[last]) = (ends[0] == End::Fixed, ends[1] == End::Fixed);
        let friction = cable.friction();
        let mut tributary = vec![h; last + 1];
        (tributary[0], tributary[last]) = (0.5 * h, 0.5 * h);
        Self {
            spacing: h,
            stiffness: cable.axial_stiffness() / h,
            tributary,
            springs,
            held,
            ends,
            limit: friction.limit(),
            slope: 0.5 * friction.limit() * friction.law().shape_factor(),
            displacement: vec![0.0; last + 1],
            friction: vec![0.0; last + 1],
        }
    }

    /// Drives a vehicle over the duct, from one of `positions` to the next; `duct`(ξ) is its displacement along x at
    /// ξ = x − x_v, whichever way it drives. Before and after that the duct stands at 0.
    pub fn pass(&mut self, positions: &[f64], duct: impl Fn(f64) -> f64) {
        let rest = vec![0.0; self.displacement.len()];
        let mut before = rest.clone();
        let paths = positions.iter().map(|position| {
            let displacement = |i: usize| duct(i as f64 * self.spacing - position);
            (0..rest.len()).map(displacement).collect()
        });
        let paths: Vec<Vec<f64>> = paths.chain([rest.clone()]).collect();
        for path in paths {
            let advance: Vec<f64> = path.iter().zip(&before).map(|(new, old)| new - old).collect();
            self.step(&advance);
            before = path;
        }
    }

    /// One implicit step in which the duct moves by `advance`.
    fn step(&mut self, advance: &[f64]) {
        let mut u = self.displacement.clone();
        let size = |u: &[f64]| u.iter().chain(advance).fold(0.0, |m: f64, v| m.max(v.abs()));
        for _ in 0..MAX_STEPS {
            let trial = self.trial(&u, advance);
            let worst = trial.unbalanced.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let rounding =
                16.0 * f64::EPSILON * (4.0 * self.stiffness + self.slope * self.spacing) * size(&u);
            if worst <= 1e-9 * self.limit * self.spacing + rounding {
                (self.displacement, self.friction) = (u, trial.friction);
                return;
            }
            let direction = self.newton_direction(&trial);
            // −dE/da along the direction, which falls with a as E is convex: its zero is the minimum.
            let descent = |a: f64| -> f64 {
                let moved: Vec<f64> = u.iter().zip(&direction).map(|(u, d)| u + a * d).collect();
                let unbalanced = self.trial(&moved, advance).unbalanced;
                unbalanced.iter().zip(&direction).map(|(r, d)| r * d).sum()
            };
            let start = descent(0.0);
            let mut share = 1.0;
            if descent(1.0) < -0.1 * start {
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..60 {
                    share = 0.5 * (low + high);
                    let here = descent(share);
                    if here.abs() <= 0.1 * start {
                        break;
                    }
                    if here > 0.0 { low = share } else { high = share }
                }
            }
            for (u, d) in u.iter_mut().zip(&direction) {
                *u += share * d;
            }
        }
        panic!("the oracle itself found no equilibrium");
    }

    fn trial(&self, u: &[f64], advance: &[f64]) -> Trial {
        let nodes = u.len();
        let mut trial = Trial {
            unbalanced: vec![0.0; nodes],
            friction: vec![0.0; nodes],
            elastic: vec![false; nodes],
        };
        for i in 0..nodes {
            let slip = advance[i] - (u[i] - self.displacement[i]);
            let sheared = self.friction[i] + self.slope * slip;
            trial.elastic[i] = sheared.abs() < self.limit;
            trial.friction[i] = sheared.clamp(-self.limit, self.limit);
            trial.unbalanced[i] += self.tributary[i] * trial.friction[i] - self.springs[i] * u[i];
            if i + 1 < nodes {
                let tension = self.stiffness * (u[i + 1] - u[i]);
                trial.unbalanced[i] += tension;
                trial.unbalanced[i + 1] -= tension;
            }
        }
        for (unbalanced, &held) in trial.unbalanced.iter_mut().zip(&self.held) {
            if held {
                *unbalanced = 0.0;
            }
        }
        trial
    }

    /// Thomas's algorithm on the tangent stiffness.
    fn newton_direction(&self, trial: &Trial) -> Vec<f64> {
        let nodes = trial.unbalanced.len();
        let nothing_holds = !trial.elastic.contains(&true)
            && !self.held.contains(&true)
            && self.springs.iter().all(|&s| s == 0.0);
        let mut upper = vec![0.0; nodes];
        let mut right = vec![0.0; nodes];
        for i in 0..nodes {
            if self.held[i] {
                continue;
            }
            let neighbours = if i == 0 || i + 1 == nodes { 1.0 } else { 2.0 };
            let mut pivot = neighbours * self.stiffness + self.springs[i];
            if trial.elastic[i] {
                pivot += self.slope * self.tributary[i];
            }
            if nothing_holds && i == 0 {
                pivot += self.stiffness;
            }
            let before = i.checked_sub(1);
            pivot -= self.stiffness * before.map_or(0.0, |i| upper[i]);
            upper[i] = self.stiffness / pivot;
            let carried = before.map_or(0.0, |i| right[i]);
            right[i] = (trial.unbalanced[i] + self.stiffness * carried) / pivot;
        }
        for i in (0..nodes - 1).rev() {
            right[i] += upper[i] * right[i + 1];
        }
        right
    }

    /// Compression along the cable \[N\]: at its upstream end, in its elements, at its downstream end.
    pub fn forces(&self) -> Vec<f64> {
        let (ends, u) = (self.end_forces(), &self.displacement);
        let inner = u.windows(2).map(|pair| self.stiffness * (pair[0] - pair[1]));
        let upstream = std::iter::once(ends.upstream);
        upstream.chain(inner).chain([ends.downstream]).collect()
    }

    /// Compression on the ends \[N\], from what holds them.
    pub fn end_forces(&self) -> EndForces {
        let (u, f) = (&self.displacement, &self.friction);
        let last = u.len() - 1;
        let on_end = |end: End, node: usize, inner: usize, outward: f64| match end {
            End::Free => 0.0,
            End::Spring(stiffness) => outward * stiffness * u[node],
            End::Fixed => outward * (self.stiffness * (u[inner] - u[node]) + self.tributary[node] * f[node]),
        };
        EndForces {
            upstream: on_end(self.ends[0], 0, 1, -1.0),
            downstream: on_end(self.ends[1], last, last - 1, 1.0),
        }
    }
}

/// Positions of a vehicle that comes from and leaves to `approach` beyond the duct in the mesh's vehicle steps, all the way.
pub fn even_positions(mesh: &Mesh, direction: Direction, approach: f64) -> Vec<f64> {
    let step = mesh.vehicle_step();
    let length = mesh.spacing() * mesh.elements() as f64;
    let outside = (approach / step).ceil() as i64;
    let over = (length / step * (1.0 - 1e-9)).ceil() as i64;
    let travelled = (-outside..=over + outside).map(|n| n as f64 * step);
    match direction {
        Direction::Forward => travelled.collect(),
        Direction::Reverse => travelled.map(|travelled| length - travelled).collect(),
    }
}
