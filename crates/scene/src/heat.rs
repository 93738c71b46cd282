//! `[heat]`: how warm the cable gets every day.

use crate::key::Form::{List, Number};
use crate::range::{EXPANSION, OFFSET, SWING, TEMPERATURE, TIME_OF_DAY};
use crate::section::keys;

keys! {
    /// Heat of the cable: how much it expands, and how warm it is over a day that repeats; in SI. It has a swing or a profile.
    pub struct Heat {
        /// Thermal expansion of the cable per length and degree.
        expansion: f64 = Number(EXPANSION);
        /// From the day's lowest to its highest mean temperature of the cable, a cosine over the day.
        daily_swing: Option<f64> = Number(SWING), "`profile` instead";
        /// The day's lowest temperature above that at laying; added to a profile.
        offset: f64 = Number(OFFSET), "0 K";
        /// Temperatures at times of the day, joined by straight lines, every day the same.
        profile: Option<Vec<(f64, f64)>> = List(&[List(&[Number(TIME_OF_DAY), Number(TEMPERATURE)], 2, POINT)], 2, POINTS), "`daily_swing` instead";
    }
}

const POINT: &str = "a point of the day: [\"15 h\", \"20 K\"]";
const POINTS: &str = "two points of the day or more, such as [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]], their times ascending";

impl Heat {
    /// Whether it makes any force: the cable expands, and is not always as warm as it was laid.
    pub fn makes_force(&self) -> bool {
        let mut points = self.profile.iter().flatten();
        let is_flat = self.daily_swing.unwrap_or(0.0) == 0.0 && points.all(|(_, kelvin)| *kelvin == 0.0);
        self.expansion != 0.0 && !(is_flat && self.offset == 0.0)
    }
}
