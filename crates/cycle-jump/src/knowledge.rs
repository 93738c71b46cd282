//! What simulated periods have shown: the advance, and how it answers to friction.

use cable_dem::RestingCable;

use crate::period::{Period, difference, largest};
use crate::slope::{Change, Slope};

/// Advance of a period as a share of the duct's motion below which the cable rests for good.
const AT_REST: f64 = 1e-8;

/// What is known after a simulated period.
pub struct Knowledge {
    /// The period.
    pub period: Period,
    /// g, learned from it and those before.
    pub slope: Slope,
    /// Length of the next jump \[periods\].
    pub length: f64,
    /// Periods before which the rest is not tried in one jump.
    pub not_before: u64,
}

impl Knowledge {
    /// Whether the cable no longer moves, in a duct that moves by `motion` \[m\].
    pub fn rests(&self, motion: f64) -> bool {
        largest(&self.period.rate) < AT_REST * motion
    }

    /// Advance per period at the end of the last period.
    pub fn rate(&self, cable: &mut RestingCable) -> Vec<f64> {
        let mut rate = self.period.rate.clone();
        self.spread(cable, &mut rate);
        rate
    }

    /// What the slope says of how the advance of the period `next` differs from that of the last.
    pub fn predict(&self, next: &Period, cable: &mut RestingCable) -> Vec<f64> {
        let mut change = next.friction_from(&self.period.middle, cable);
        for (f, g) in change.iter_mut().zip(self.slope.values()) {
            *f *= -g;
        }
        self.spread(cable, &mut change);
        change
    }

    /// Spreads `values` along the cable as half a period does.
    pub fn spread(&self, cable: &mut RestingCable, values: &mut [f64]) {
        let slope = self.slope.values();
        cable.diffuse(|i| 0.5 * slope[i], values);
    }

    /// Learns from the period `next`, of whose advance the slope had `predicted` the change where there was a jump.
    pub fn learn(&mut self, next: &Period, predicted: Option<&[f64]>, cable: &RestingCable) {
        let rate = difference(&next.rate, &self.period.rate);
        let friction = next.friction_from(&self.period.middle, cable);
        self.slope.learn(Change {
            rate: &rate,
            friction: &friction,
            predicted,
        });
    }
}
