//! Many periods in one step: the cable advances so that the friction it meets is what it needs.
//!
//! w (Φ(v) + r) + w p + θ − K (u + m v) = 0
//!
//! over m periods, with Φ the [`LockedLaw`] and r what it misses in force. As Φ falls this is the gradient of a convex energy, and
//! Newton's method with a line search finds its one zero.

use cable_dem::{CableError, RestingCable};

use super::law::LockedLaw;
use crate::flow::GAMMA;

/// Newton steps and line searches at most; what may be left of the balance, as a share of q.
const MOST_STEPS: usize = 200;
const MOST_TRIALS: usize = 40;
const ACCURACY: f64 = 1e-6;
/// A line search has arrived where the slope is this share of that at its start.
const FLAT: f64 = 1e-2;

/// Takes steps; allocated once.
#[derive(Debug)]
pub struct RateStep {
    pub law: LockedLaw,
    /// Linear solves so far.
    pub sweeps: u64,
    limit: f64,
    /// The last advance, from which the next is sought.
    advance: Vec<f64>,
    place: Vec<f64>,
    friction: Vec<f64>,
    residual: Vec<f64>,
    slope: Vec<f64>,
    step: Vec<f64>,
}

impl RateStep {
    pub fn new(law: LockedLaw, limit: f64, nodes: usize) -> Self {
        let zeros = || vec![0.0; nodes];
        Self {
            law,
            sweeps: 0,
            limit,
            advance: zeros(),
            place: zeros(),
            friction: zeros(),
            residual: zeros(),
            slope: zeros(),
            step: zeros(),
        }
    }

    /// Time of the first stage, as a share of a step.
    pub const STAGE: f64 = GAMMA;

    /// Moves `u` over `periods`, by two stages at which heat has these forces \[N\] and every node these defects r \[N/m\]. The advance is sought
    /// from that of the last period on.
    pub fn advance(
        &mut self,
        cable: &mut RestingCable,
        u: &mut [f64],
        periods: f64,
        heat: [f64; 2],
        defects: &[Vec<f64>; 2],
        last: &[f64],
    ) -> Result<(), CableError> {
        self.advance.copy_from_slice(last);
        let mut base = u.to_vec();
        self.solve(cable, &base, GAMMA * periods, heat[0], &defects[0])?;
        let first = self.advance.clone();
        for (base, v) in base.iter_mut().zip(&first) {
            *base += (1.0 - GAMMA) * periods * v;
        }
        self.solve(cable, &base, GAMMA * periods, heat[1], &defects[1])?;
        for ((u, first), second) in u.iter_mut().zip(&first).zip(&self.advance) {
            *u += periods * ((1.0 - GAMMA) * first + GAMMA * second);
        }
        Ok(())
    }

    /// Finds the advance v with w (Φ(v) + r) + w p + θ = K (base + reach v).
    fn solve(
        &mut self,
        cable: &mut RestingCable,
        base: &[f64],
        reach: f64,
        thermal_force: f64,
        defect: &[f64],
    ) -> Result<(), CableError> {
        let free = cable.free();
        let mut left = self.balance(cable, base, reach, thermal_force, defect, 0.0);
        for _ in 0..MOST_STEPS {
            if left <= ACCURACY * self.limit {
                return Ok(());
            }
            for i in free.clone() {
                self.step[i] = self.residual[i] / self.slope[i];
            }
            let slope = &self.slope;
            cable.diffuse(|i| reach / slope[i], &mut self.step);
            self.sweeps += 1;
            let start = self.along(cable);
            let mut share = 1.0;
            left = self.balance(cable, base, reach, thermal_force, defect, share);
            let mut end = self.along(cable);
            if end < -1e-9 * start.abs() {
                // Too far: the energy rises again. Find where it is lowest.
                let (mut low, mut high) = ((0.0, start), (1.0, end));
                for _ in 0..MOST_TRIALS {
                    share = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
                    let inside = 0.05 * (high.0 - low.0);
                    share = share.clamp(low.0 + inside, high.0 - inside);
                    left = self.balance(cable, base, reach, thermal_force, defect, share);
                    end = self.along(cable);
                    if end.abs() < FLAT * start.abs() {
                        break;
                    }
                    if end > 0.0 {
                        low = (share, end);
                    } else {
                        high = (share, end);
                    }
                }
            }
            for (v, step) in self.advance.iter_mut().zip(&self.step) {
                *v += share * step;
            }
        }
        Err(CableError::NoConvergence {
            vehicle_position: f64::INFINITY,
            violation: left / self.limit,
        })
    }

    /// What is out of balance \[N/m\] after `share` of the step, and the law's slope there; the largest.
    fn balance(
        &mut self,
        cable: &mut RestingCable,
        base: &[f64],
        reach: f64,
        thermal_force: f64,
        defect: &[f64],
        share: f64,
    ) -> f64 {
        let Self {
            law,
            advance,
            place,
            friction,
            residual,
            slope,
            step,
            ..
        } = self;
        let moved = advance.iter().zip(&*step).map(|(v, step)| v + share * step);
        for ((place, base), v) in place.iter_mut().zip(base).zip(moved) {
            *place = base + reach * v;
        }
        cable.needed(place, thermal_force, friction);
        let mut largest = 0.0_f64;
        for i in cable.free() {
            let (found, steepness) = law.with_defect(advance[i] + share * step[i], defect[i]);
            residual[i] = found - friction[i];
            slope[i] = steepness;
            largest = largest.max(residual[i].abs());
        }
        largest
    }

    /// Minus the energy's slope along the step.
    fn along(&self, cable: &RestingCable) -> f64 {
        cable
            .free()
            .map(|i| self.step[i] * self.residual[i] * cable.tributary(i))
            .sum()
    }
}
