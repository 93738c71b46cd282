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
struct Stage {
    base: Vec<f64>,
    reach: f64,
    thermal_force: f64,
    defect: Vec<f64>,
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
        stages: [(f64, Vec<f64>); 2],
        advance: &[f64],
    ) -> Result<Vec<f64>, CableError> {
        let (mut base, mut v) = (u.to_vec(), advance.to_vec());
        // What of the advance is done after each stage.
        for ((thermal_force, defect), share) in stages.into_iter().zip([1.0 - GAMMA, GAMMA]) {
            let stage = Stage {
                base,
                reach: GAMMA * periods,
                thermal_force,
                defect,
            };
            v = self.solve(cable, &stage, v)?;
            base = moved(&stage.base, share * periods, &v);
        }
        Ok(base)
    }

    /// The advance that solves `stage`, sought from `v` on.
    fn solve(
        &mut self,
        cable: &mut RestingCable,
        stage: &Stage,
        mut v: Vec<f64>,
    ) -> Result<Vec<f64>, CableError> {
        let limit = cable.cable().friction().limit();
        let (mut residual, mut slope) = self.balance(cable, stage, &v);
        for _ in 0..MAX_STEPS {
            if largest(&residual) <= ACCURACY * limit {
                return Ok(v);
            }
            let mut step: Vec<f64> = residual.iter().zip(&slope).map(|(r, slope)| r / slope).collect();
            cable.diffuse(|i| stage.reach / slope[i], &mut step);
            self.sweeps += 1;
            let start = work(cable, &step, &residual).abs();
            let mut share = 1.0;
            loop {
                let trial = moved(&v, share, &step);
                (residual, slope) = self.balance(cable, stage, &trial);
                if work(cable, &step, &residual) >= -MAX_RISE * start || share < MIN_SHARE {
                    v = trial;
                    break;
                }
                share *= 0.5;
            }
        }
        Err(CableError::NoConvergence {
            vehicle_position: f64::INFINITY,
            violation: largest(&residual) / limit,
        })
    }

    /// What is out of balance at the advance `v` \[N/m\], and minus the slope of the law \[N/m²\].
    fn balance(&self, cable: &mut RestingCable, stage: &Stage, v: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (mut needed, mut residual) = (vec![0.0; v.len()], vec![0.0; v.len()]);
        let mut slope = vec![1.0; v.len()];
        cable.needed(
            &moved(&stage.base, stage.reach, v),
            stage.thermal_force,
            &mut needed,
        );
        let chain = cable.chain();
        for i in chain.free().nodes() {
            let limit = chain.nodes()[i].limit;
            let (found, steepness) = self.law.with_defect(v[i], stage.defect[i], limit);
            (residual[i], slope[i]) = (found - needed[i], steepness);
        }
        (residual, slope)
    }
}

/// u + share · v.
fn moved(u: &[f64], share: f64, v: &[f64]) -> Vec<f64> {
    u.iter().zip(v).map(|(u, v)| u + share * v).collect()
}

/// Minus the slope of the energy along a `step` where so much is out of balance.
fn work(cable: &RestingCable, step: &[f64], residual: &[f64]) -> f64 {
    let chain = cable.chain();
    let work = |i: usize| step[i] * residual[i] * chain.nodes()[i].tributary;
    chain.free().nodes().map(work).sum()
}
