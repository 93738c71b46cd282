//! The advance over many periods: y′ = c + J y, y(0) = 0, with J = −g K/w.
//!
//! Stiff: neighbouring nodes settle within one period, the whole cable within thousands. Substeps that grow geometrically and an
//! L-stable method of second order (SDIRK2; R. Alexander, SIAM J. Numer. Anal. 14 (1977) 1006) damp the former and follow the latter.

use cable_dem::RestingCable;

/// γ = 1 − 1/√2 makes the method L-stable.
pub(crate) const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Length of each substep beside the one before.
const GROWTH: f64 = 1.5;

/// A flow over a number of periods, as its substeps.
#[derive(Debug, Clone)]
pub struct Flow<'a> {
    rate: &'a [f64],
    /// What the rate grows by per period.
    growth: Vec<f64>,
    slope: &'a [f64],
    /// Where each substep begins \[periods\], and y there; the end of the last is beyond them.
    begins: Vec<(f64, Vec<f64>)>,
    end: Vec<f64>,
}

impl<'a> Flow<'a> {
    /// The flow over `periods` in `substeps`, from a state whose advance is `rate` c \[m per period\] with the `slope` g \[m²/N\].
    pub fn new(
        cable: &mut RestingCable,
        rate: &'a [f64],
        slope: &'a [f64],
        periods: f64,
        substeps: i32,
    ) -> Self {
        let growth = vec![0.0; rate.len()];
        Self::growing(cable, rate, growth, slope, periods, substeps)
    }

    /// The same with a rate that grows by `growth` \[m\] every period.
    pub fn growing(
        cable: &mut RestingCable,
        rate: &'a [f64],
        growth: Vec<f64>,
        slope: &'a [f64],
        periods: f64,
        substeps: i32,
    ) -> Self {
        let mut flow = Self {
            rate,
            growth,
            slope,
            begins: Vec::with_capacity(substeps as usize),
            end: vec![0.0; rate.len()],
        };
        let mut length = periods * (GROWTH - 1.0) / (GROWTH.powi(substeps) - 1.0);
        let mut time = 0.0;
        for _ in 0..substeps {
            let next = flow.substep(cable, &flow.end, time, length);
            flow.begins.push((time, std::mem::replace(&mut flow.end, next)));
            time += length;
            length *= GROWTH;
        }
        flow
    }

    /// y at its end \[m\].
    pub fn end(&self) -> &[f64] {
        &self.end
    }

    /// y after `periods`, at most its own \[m\].
    pub fn after(&self, cable: &mut RestingCable, periods: f64) -> Vec<f64> {
        let next = self.begins.partition_point(|(time, _)| *time <= periods);
        let (begin, y) = &self.begins[next.max(1) - 1];
        self.substep(cable, y, *begin, periods - begin)
    }

    /// c + J y, with c at `time`.
    fn derivative(&self, cable: &RestingCable, y: &[f64], time: f64) -> Vec<f64> {
        let mut k = vec![0.0; y.len()];
        cable.balance(y, &mut k);
        let rate = self
            .rate
            .iter()
            .zip(&self.growth)
            .map(|(c, growth)| c + growth * time);
        for ((k, c), g) in k.iter_mut().zip(rate).zip(self.slope) {
            *k = c - g * *k;
        }
        k
    }

    fn substep(&self, cable: &mut RestingCable, y: &[f64], time: f64, length: f64) -> Vec<f64> {
        let mut first = self.derivative(cable, y, time + GAMMA * length);
        let slope = |i: usize| GAMMA * length * self.slope[i];
        cable.diffuse(slope, &mut first);
        let mut sum: Vec<f64> = y
            .iter()
            .zip(&first)
            .map(|(y, k)| y + (1.0 - GAMMA) * length * k)
            .collect();
        let mut second = self.derivative(cable, &sum, time + length);
        cable.diffuse(slope, &mut second);
        for (sum, k) in sum.iter_mut().zip(&second) {
            *sum += GAMMA * length * k;
        }
        sum
    }
}
