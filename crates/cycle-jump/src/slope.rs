//! How the advance per period answers to the locked friction: g = −∂v/∂f̄, learned from the passes
//! themselves.
//!
//! Two simulated periods differ in their advance by dv and in the friction between their middles by
//! df. A least-squares slope of the one over the other, over some length of cable, is all the law
//! there is. Too small a slope makes a jump overshoot, too large a one only makes it cautious; so
//! it rises at once and falls slowly.

use cable_dem::RestingCable;

use crate::period::{Period, difference, remove_mean};
use crate::tuning::{OVERSHOOT, REGULARISATION, SLOPE_FALL};

/// Growth of the slope at most where a jump overshot: any bound does, against a prediction of
/// nothing.
const MAX_GROWTH: f64 = 3.0;
/// Slope before anything is known \[m²/N\].
const UNKNOWN: f64 = 1e-9;

/// The slope at every node \[m²/N per period\].
#[derive(Debug, Clone)]
pub struct Slope {
    values: Vec<f64>,
    /// Nodes in the sliding mean.
    width: usize,
}

impl Slope {
    /// As the change between two periods shows it; means run over `width` nodes.
    pub fn new(from: &Period, to: &Period, width: usize, cable: &RestingCable) -> Self {
        let (rate, friction) = changes(from, to, cable);
        let secant = -dot(&rate, &friction) / dot(&friction, &friction).max(f64::MIN_POSITIVE);
        let mut slope = Self {
            values: vec![if secant > 0.0 { secant } else { UNKNOWN }; rate.len()],
            width: width.max(3) | 1,
        };
        slope.learn(from, to, None, cable);
        slope
    }

    /// The slope at every node.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Spreads `values` along the cable as so many `periods` do.
    pub fn spread(&self, cable: &mut RestingCable, periods: f64, values: &mut [f64]) {
        cable.diffuse(|i| periods * self.values[i], values);
    }

    /// By how much the advance of one period differs from that of an earlier one \[m\].
    pub fn predict(&self, from: &Period, to: &Period, cable: &mut RestingCable) -> Vec<f64> {
        let (_, mut change) = changes(from, to, cable);
        for (f, g) in change.iter_mut().zip(&self.values) {
            *f *= -g;
        }
        self.spread(cable, 0.5, &mut change);
        change
    }

    /// Learns from two periods, between which it had `predicted` the change of the advance where
    /// there was a jump.
    pub fn learn(&mut self, from: &Period, to: &Period, predicted: Option<&[f64]>, cable: &RestingCable) {
        let (rate, friction) = changes(from, to, cable);
        let largest = friction.iter().fold(0.0_f64, |a, f| a.max(f * f));
        let products = rate.iter().zip(&friction).map(|(v, f)| -v * f);
        let mut values = sliding_mean(products, self.width);
        let squares = sliding_mean(friction.iter().map(|f| f * f), self.width);
        let weight = REGULARISATION * largest.max(f64::MIN_POSITIVE);
        let overshoot = predicted.map_or(0.0, |predicted| {
            dot(&rate, predicted) / dot(predicted, predicted).max(f64::MIN_POSITIVE)
        });
        for ((value, last), square) in values.iter_mut().zip(&self.values).zip(squares) {
            *value = (*value + weight * last) / (square + weight);
            if overshoot > OVERSHOOT {
                *value = value.max(last * overshoot.min(MAX_GROWTH));
            }
            *value = value.max(SLOPE_FALL * last);
        }
        self.values = sliding_mean(values.into_iter(), self.width);
    }
}

/// By how much one period differs from an earlier one: its advance \[m\] without the movement as a
/// whole of a cable that nothing holds, and the friction K Δu/w in its middle \[N/m\]. Such a
/// movement leaves friction as it is; a slope from it would be a division by rounding.
fn changes(from: &Period, to: &Period, cable: &RestingCable) -> (Vec<f64>, Vec<f64>) {
    let mut rate = difference(&to.rate, &from.rate);
    remove_mean(cable, &mut rate);
    let mut friction = vec![0.0; rate.len()];
    cable.balance(&difference(&to.middle, &from.middle), &mut friction);
    (rate, friction)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Mean over `width` neighbours, the first and the last value repeated beyond the ends.
fn sliding_mean(values: impl Iterator<Item = f64>, width: usize) -> Vec<f64> {
    let values: Vec<f64> = values.collect();
    let (last, half) = (values.len() as isize - 1, (width / 2) as isize);
    let at = |i: isize| values[i.clamp(0, last) as usize];
    let mut sum: f64 = (-half..=half).map(at).sum();
    let mut means = Vec::with_capacity(values.len());
    for i in 0..=last {
        means.push(sum / (2 * half + 1) as f64);
        sum += at(i + half + 1) - at(i - half);
    }
    means
}
