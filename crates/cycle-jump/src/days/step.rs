//! Many periods in one step: the cable advances so that the friction it meets is what it needs,
//!
//! w (Φ(v) + r) + w p + θ − K (u + m v) = 0
//!
//! over m periods, with Φ the [`LockedLaw`] and r what it misses in force. As Φ falls this is the
//! gradient of a convex energy, and Newton's method with halved steps finds its one zero.

use cable_dem::{CableError, RestingCable};

use super::law::LockedLaw;
use crate::flow::GAMMA;
use crate::period::largest;

/// What may be left of the balance, as a share of q, and Newton steps at most until then.
const ACCURACY: f64 = 1e-6;
const MAX_STEPS: usize = 200;
/// A step that ends where the energy rises by this share of its fall at the beginning is halved.
const MAX_RISE: f64 = 0.1;
/// Steps are not halved any further.
const MIN_SHARE: f64 = 1e-9;

/// Times of the two stages of a step, as shares of it.
pub const STAGES: [f64; 2] = [GAMMA, 1.0];

/// What a stage solves: the advance v with w (Φ(v) + r) + w p + θ = K (base + reach v).
struct Stage<'a> {
    base: Vec<f64>,
    reach: f64,
    thermal_force: f64,
    defect: &'a [f64],
}

/// Takes steps of many periods.
#[derive(Debug)]
pub struct LongStep {
    pub law: LockedLaw,
    /// Linear solves so far.
    pub sweeps: u64,
}

impl LongStep {
    /// The displacements that `u` \[m\] become over `periods`, with the thermal force \[N\] and the
    /// defect r \[N/m\] at both [`STAGES`]; the advance is sought from that of another period on.
    pub fn take(
        &mut self,
        cable: &mut RestingCable,
        u: &[f64],
        periods: f64,
        stages: [(f64, &[f64]); 2],
        advance: &[f64],
    ) -> Result<Vec<f64>, CableError> {
        let after = |u: &[f64], share: f64, v: &[f64]| -> Vec<f64> {
            u.iter().zip(v).map(|(u, v)| u + share * periods * v).collect()
        };
        let stage = |base: Vec<f64>, (thermal_force, defect)| Stage {
            base,
            reach: GAMMA * periods,
            thermal_force,
            defect,
        };
        let first = self.solve(cable, &stage(u.to_vec(), stages[0]), advance.to_vec())?;
        let base = after(u, 1.0 - GAMMA, &first);
        let second = self.solve(cable, &stage(base.clone(), stages[1]), first)?;
        Ok(after(&base, GAMMA, &second))
    }

    /// The advance that solves `stage`, sought from `v` on.
    fn solve(
        &mut self,
        cable: &mut RestingCable,
        stage: &Stage<'_>,
        mut v: Vec<f64>,
    ) -> Result<Vec<f64>, CableError> {
        let limit = cable.cable().friction().limit();
        let mut balance = self.balance(cable, stage, &v);
        for _ in 0..MAX_STEPS {
            if largest(&balance.0) <= ACCURACY * limit {
                return Ok(v);
            }
            let (residual, slope) = &balance;
            let mut step: Vec<f64> = residual.iter().zip(slope).map(|(r, slope)| r / slope).collect();
            cable.diffuse(|i| stage.reach / slope[i], &mut step);
            self.sweeps += 1;
            // Minus the slope of the energy along the step.
            let fall = |cable: &RestingCable, residual: &[f64]| -> f64 {
                let chain = cable.chain();
                let work = |i: usize| step[i] * residual[i] * chain.nodes()[i].tributary;
                let works = chain.free().nodes().map(work);
                works.sum()
            };
            let start = fall(cable, residual).abs();
            let mut share = 1.0;
            loop {
                let trial: Vec<f64> = v.iter().zip(&step).map(|(v, step)| v + share * step).collect();
                balance = self.balance(cable, stage, &trial);
                if fall(cable, &balance.0) >= -MAX_RISE * start || share < MIN_SHARE {
                    v = trial;
                    break;
                }
                share *= 0.5;
            }
        }
        Err(CableError::NoConvergence {
            vehicle_position: f64::INFINITY,
            violation: largest(&balance.0) / limit,
        })
    }

    /// What is out of balance at the advance `v` \[N/m\], and minus the slope of the law \[N/m²\].
    fn balance(&self, cable: &mut RestingCable, stage: &Stage<'_>, v: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let place = stage.base.iter().zip(v).map(|(base, v)| base + stage.reach * v);
        let mut needed = vec![0.0; v.len()];
        cable.needed(&place.collect::<Vec<_>>(), stage.thermal_force, &mut needed);
        let (mut residual, mut slope) = (vec![0.0; v.len()], vec![1.0; v.len()]);
        let chain = cable.chain();
        for i in chain.free().nodes() {
            let limit = chain.nodes()[i].limit;
            let (found, steepness) = self.law.with_defect(v[i], stage.defect[i], limit);
            residual[i] = found - needed[i];
            slope[i] = steepness;
        }
        (residual, slope)
    }
}
