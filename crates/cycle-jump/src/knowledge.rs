//! What simulated periods have shown: the advance, and how it answers to friction.

use cable_dem::{CableState, RestingCable};

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

    /// Advance per period in `state`, from that of the last period.
    pub fn rate(&self, state: &CableState, cable: &RestingCable) -> Vec<f64> {
        // −K (u − ū)/w, with u after and ū in the middle of the period.
        let mut rate = self.period.friction_from(state.displacement(), cable);
        for ((f, v), g) in rate.iter_mut().zip(&self.period.rate).zip(self.slope.values()) {
            *f = v + g * *f;
        }
        rate
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
