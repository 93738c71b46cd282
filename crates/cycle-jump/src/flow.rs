//! The advance over many periods: y′ = c(t) + J y, y(0) = 0, with J = −g K/w.
//!
//! Stiff: neighbouring nodes settle within one period, the whole cable within thousands. Substeps
//! that grow geometrically and an L-stable method of second order (SDIRK2; R. Alexander, SIAM J.
//! Numer. Anal. 14 (1977) 1006) damp the former and follow the latter.

use cable_dem::RestingCable;

use crate::tuning::{SUBSTEP_GROWTH, SUBSTEPS};

/// γ = 1 − 1/√2 makes the method L-stable.
pub const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// A flow over a number of periods, as its substeps.
#[derive(Debug, Clone)]
pub struct Flow {
    rate: Vec<f64>,
    growth: Vec<f64>,
    slope: Vec<f64>,
    /// Where each substep begins \[periods\], and y there.
    begins: Vec<(f64, Vec<f64>)>,
    /// y at its end \[m\].
    pub end: Vec<f64>,
}

impl Flow {
    /// The flow over `periods` with the `slope` g \[m²/N\], where c begins with `rate` \[m per
    /// period\] and grows by `growth` \[m\] every period.
    pub fn new(
        cable: &mut RestingCable,
        rate: &[f64],
        growth: Vec<f64>,
        slope: &[f64],
        periods: f64,
    ) -> Self {
        let mut flow = Self {
            rate: rate.to_vec(),
            growth,
            slope: slope.to_vec(),
            begins: Vec::new(),
            end: vec![0.0; rate.len()],
        };
        let mut length = periods * (SUBSTEP_GROWTH - 1.0) / (SUBSTEP_GROWTH.powi(SUBSTEPS) - 1.0);
        let mut time = 0.0;
        for _ in 0..SUBSTEPS {
            let next = flow.substep(cable, &flow.end, time, length);
            flow.begins.push((time, std::mem::replace(&mut flow.end, next)));
            time += length;
            length *= SUBSTEP_GROWTH;
        }
        flow
    }

    /// y after `periods`, at most its own \[m\].
    pub fn after(&self, cable: &mut RestingCable, periods: f64) -> Vec<f64> {
        let next = self.begins.partition_point(|(time, _)| *time <= periods);
        let (begin, y) = &self.begins[next.max(1) - 1];
        self.substep(cable, y, *begin, periods - begin)
    }

    /// c + J y, with c at `time`.
    fn derivative(&self, cable: &RestingCable, y: &[f64], time: f64) -> Vec<f64> {
        let mut friction = vec![0.0; y.len()];
        cable.balance(y, &mut friction);
        (0..y.len())
            .map(|i| self.rate[i] + self.growth[i] * time - self.slope[i] * friction[i])
            .collect()
    }

    fn substep(&self, cable: &mut RestingCable, y: &[f64], time: f64, length: f64) -> Vec<f64> {
        let slope = |i: usize| GAMMA * length * self.slope[i];
        let mut first = self.derivative(cable, y, time + GAMMA * length);
        cable.diffuse(slope, &mut first);
        let first = y.iter().zip(&first).map(|(y, k)| y + (1.0 - GAMMA) * length * k);
        let mut sum: Vec<f64> = first.collect();
        let mut second = self.derivative(cable, &sum, time + length);
        cable.diffuse(slope, &mut second);
        for (sum, k) in sum.iter_mut().zip(&second) {
            *sum += GAMMA * length * k;
        }
        sum
    }
}
