//! From pass to pass in growing steps.
//!
//! The slow problem is stiff: fronts smooth out at first within a pass, at last over ten million. An L-stable, singly
//! diagonally implicit Runge–Kutta method of second order (R. Alexander, SIAM J. Numer. Anal. 14 (1977) 1006–1021,
//! γ = 1 − 1/√2) takes it in steps that its embedded first-order answer controls. Each stage is one nonlinear banded
//! system. The number of steps grows with the logarithm of the number of passes.

use cable_dem::End;

use crate::slow::{SlowEnd, SlowProblem, greatest};
use crate::tridiagonal::Tridiagonal;
use crate::{LawError, PassLaw};

/// Error of a step as a share of the largest displacement.
const STEP_ACCURACY: f64 = 1e-3;
/// Error of a stage as a share of the largest displacement.
const STAGE_ACCURACY: f64 = 1e-9;
/// γ of the Runge–Kutta method.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Smallest step \[passes\].
const SMALLEST: f64 = 1e-9;
/// In the first passes the friction near a held end is still sharp \[passes\].
const SETTLED: f64 = 10.0;
/// The most passes that [`PassLaw::run`] takes: more than any road sees.
pub const MOST_PASSES: u64 = 1_000_000_000_000;

/// The cable after a number of passes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PassRecord {
    /// Passes so far.
    pub pass: u64,
    /// Force on the upstream end \[N\], compression positive.
    pub upstream_force: f64,
    /// Force on the downstream end \[N\], compression positive.
    pub downstream_force: f64,
    /// The part of [`PassRecord::upstream_force`] \[N\] that only the vehicle that passed last has left there, vehicles coming
    /// interleaved by their shares; 0 for a single vehicle, and for shares without a short period.
    pub upstream_swing: f64,
    /// As [`PassRecord::upstream_swing`], downstream \[N\].
    pub downstream_swing: f64,
    /// Estimated largest force on the upstream end during a pass \[N\]: the mean force after passes and the transient of the run
    /// at that end, which is that of the saturated cable.
    pub upstream_peak: f64,
    /// As [`PassRecord::upstream_peak`], downstream \[N\].
    pub downstream_peak: f64,
    /// Largest compression along the cable \[N\].
    pub max_compression: f64,
    /// Displacement at x = 0 \[m\].
    pub upstream_displacement: f64,
    /// Displacement at x = length \[m\].
    pub downstream_displacement: f64,
}

/// Counts of work that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EvolutionStatistics {
    /// Accepted steps.
    pub steps: usize,
    /// Steps that were repeated with a smaller size.
    pub rejected: usize,
    /// Newton iterations: tridiagonal systems solved.
    pub newton_iterations: usize,
}

/// The cable after the listed passes.
#[derive(Debug, Clone, PartialEq)]
pub struct Evolution {
    /// One record a listed pass, in order.
    pub records: Vec<PassRecord>,
    /// Points along the duct \[m\].
    pub positions: Vec<f64>,
    /// Displacement at these points after the last listed pass \[m\].
    pub displacement: Vec<f64>,
    /// Locked friction there \[N/m\].
    pub friction: Vec<f64>,
    /// Whether the locked friction was outside the table of the advance (see [`crate::MixedLaw::domain`]) after any listed
    /// pass from the tenth on.
    pub left_table: bool,
    /// What it cost.
    pub statistics: EvolutionStatistics,
}

impl PassLaw {
    /// The cable, laid without force, after each of `passes`, which ascend.
    ///
    /// # Errors
    ///
    /// [`LawError::InvalidParameter`] unless the passes ascend and are at most [`MOST_PASSES`]; [`LawError::NoConvergence`] where a step
    /// found no answer.
    pub fn run(&self, passes: &[u64]) -> Result<Evolution, LawError> {
        let mut last = 0;
        for &pass in passes {
            crate::error::checked("pass", pass as f64, "ascending and at most 1e12", |_| {
                pass >= last && pass <= MOST_PASSES
            })?;
            last = pass;
        }
        let problem = self.problem();
        let mut march = March::new(&problem, self.law.peak_longitudinal());
        let records = passes
            .iter()
            .map(|&pass| {
                march.advance_to(pass as f64)?;
                march.watch();
                Ok(self.record(&problem, pass, &march.u))
            })
            .collect::<Result<Vec<_>, LawError>>()?;
        Ok(Evolution {
            records,
            friction: problem.friction(&march.u),
            displacement: march.u,
            left_table: march.left_table,
            statistics: march.statistics,
            positions: problem.points,
        })
    }

    fn record(&self, problem: &SlowProblem, pass: u64, u: &[f64]) -> PassRecord {
        if pass == 0 {
            return PassRecord::default();
        }
        let n = u.len() - 1;
        let friction = problem.friction(u);
        let stiffness = problem.axial_stiffness;
        let end = |end: &SlowEnd, kind: End, node: usize, outward: f64, inside: f64| {
            let f = friction[node];
            let (force, v) = (end.layer.force.at(f).0, end.layer.displacement.at(f).0);
            match kind {
                End::Free => (0.0, u[node] + v),
                End::Spring(spring) => {
                    let held = end.layer.displacement.at(problem.law.saturation()).0;
                    let series = if spring > 0.0 {
                        1.0 / (1.0 / spring + end.inset / stiffness)
                    } else {
                        0.0
                    };
                    let pull = series * (u[node] + held);
                    (
                        outward * pull,
                        if spring > 0.0 { pull / spring } else { u[node] + v },
                    )
                }
                // The slow force at the end, and what its layer adds.
                End::Fixed => (inside + outward * (problem.weights[node] * f + force), 0.0),
            }
        };
        let (upstream, left) = end(
            &problem.upstream,
            self.cable.upstream(),
            0,
            -1.0,
            problem.force(u, 0),
        );
        let (downstream, right) = end(
            &problem.downstream,
            self.cable.downstream(),
            n,
            1.0,
            problem.force(u, n - 1),
        );
        let swing = |end: &SlowEnd| {
            let swing = &end.layer.swing;
            let phase = (pass - 1).checked_rem(swing.len() as u64).unwrap_or(0);
            swing.get(phase as usize).copied().unwrap_or(0.0)
        };
        let (upstream_swing, downstream_swing) = (swing(&problem.upstream), swing(&problem.downstream));
        let max_compression = (0..n)
            .map(|piece| problem.force(u, piece))
            .chain([upstream + upstream_swing, downstream + downstream_swing])
            .fold(f64::NEG_INFINITY, f64::max);
        PassRecord {
            pass,
            upstream_force: upstream + upstream_swing,
            downstream_force: downstream + downstream_swing,
            upstream_swing,
            downstream_swing,
            upstream_peak: upstream + problem.upstream.layer.transient.0,
            downstream_peak: downstream + problem.downstream.layer.transient.0,
            max_compression,
            upstream_displacement: left,
            downstream_displacement: right,
        }
    }
}

/// The march through the passes.
struct March<'a> {
    problem: &'a SlowProblem,
    peak: f64,
    pass: f64,
    step: f64,
    u: Vec<f64>,
    left_table: bool,
    statistics: EvolutionStatistics,
    system: Tridiagonal,
    base: Vec<f64>,
    stages: [Vec<f64>; 2],
}

impl<'a> March<'a> {
    fn new(problem: &'a SlowProblem, peak: f64) -> Self {
        let n = problem.points.len();
        let mut u = vec![0.0; n];
        for (end, node) in [(&problem.upstream, 0), (&problem.downstream, n - 1)] {
            if end.stiffness.is_none() {
                u[node] = problem.held(end);
            }
        }
        Self {
            problem,
            peak,
            pass: 0.0,
            step: 0.01,
            u,
            left_table: false,
            statistics: EvolutionStatistics::default(),
            system: Tridiagonal::new(n),
            base: vec![0.0; n],
            stages: [vec![0.0; n], vec![0.0; n]],
        }
    }

    fn advance_to(&mut self, pass: f64) -> Result<(), LawError> {
        while self.pass < pass {
            let left = pass - self.pass;
            // A listed pass shortens a step, but not those after it.
            let (step, whole) = if left <= self.step {
                (left, true)
            } else {
                (self.step, false)
            };
            match self.attempt(step) {
                Ok(error) if error <= 1.0 => {
                    self.u.copy_from_slice(&self.stages[1]);
                    self.pass = if whole { pass } else { self.pass + step };
                    self.statistics.steps += 1;
                    let growth = (0.9 / error.max(1e-6).sqrt()).min(2.5);
                    self.step = if whole {
                        self.step.max(step * growth)
                    } else {
                        step * growth.max(0.5)
                    };
                }
                outcome => {
                    // No answer, or not accurate enough: a shorter step.
                    self.statistics.rejected += 1;
                    let found = outcome.ok().filter(|error| error.is_finite());
                    let shrink = found.map_or(0.25, |error| (0.9 / error.sqrt()).clamp(0.1, 0.7));
                    self.step = step * shrink;
                    if self.step < SMALLEST {
                        return Err(LawError::NoConvergence {
                            pass: self.pass,
                            step: self.step,
                        });
                    }
                }
            }
        }
        Ok(())
    }

    /// Tries one step; the answer is in the second stage, the error relative to what is allowed is returned.
    fn attempt(&mut self, step: f64) -> Result<f64, LawError> {
        let implicit = GAMMA * step;
        let largest = self.u.iter().fold(self.peak, |m, u| m.max(u.abs()));
        let memory = self.problem.memory(&self.u);
        let [first, second] = &mut self.stages;
        first.copy_from_slice(&self.u);
        let accuracy = STAGE_ACCURACY * largest;
        self.statistics.newton_iterations +=
            self.problem
                .implicit(&memory, &self.u, implicit, accuracy, first, &mut self.system)?;
        // k1 = (first − u)/(γ step).
        for ((base, u), first) in self.base.iter_mut().zip(&self.u).zip(&*first) {
            *base = u + (1.0 - GAMMA) / GAMMA * (first - u);
        }
        second.copy_from_slice(first);
        self.statistics.newton_iterations +=
            self.problem
                .implicit(&memory, &self.base, implicit, accuracy, second, &mut self.system)?;
        let slow = first.iter().zip(&self.u).map(|(stage, u)| stage - u);
        let fast = second.iter().zip(&self.base).map(|(stage, base)| stage - base);
        let error = greatest(fast.zip(slow).map(|(fast, slow)| (fast - slow).abs()));
        let largest = second.iter().fold(self.peak, |m, u| m.max(u.abs()));
        Ok(error / (STEP_ACCURACY * largest))
    }

    fn watch(&mut self) {
        let (low, high) = self.problem.law.domain();
        let outside = |f: &f64| *f < low || *f > high;
        let friction = self.problem.friction(&self.u);
        let inner = &friction[1..friction.len() - 1];
        self.left_table |= self.pass >= SETTLED && inner.iter().any(outside);
    }
}
