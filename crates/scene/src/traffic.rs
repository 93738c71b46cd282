//! `[traffic]`: how much traffic, and in which order.

use crate::error::{Result, SceneError};
use crate::histogram::{HISTOGRAM, Histogram};
use crate::key::Form::{List, Number, Text};
use crate::range::{ANY_WHOLE, PASSES, PER_DAY, SPEED, YEARS};
use crate::section::{file_words, keys};
use crate::shown::shown;

keys! {
    /// How many vehicles drive, in which order; in SI.
    pub struct Traffic {
        /// Number of passes, all vehicles together.
        passes: u64 = Number(PASSES), "`years` instead";
        /// Years of traffic, of 365.25 days; needs `per_day`.
        years: Option<f64> = Number(YEARS), "`passes` instead";
        /// Vehicles a day, or axles of a histogram.
        per_day: Option<f64> = Number(PER_DAY), "passes have no time";
        /// Axles as weigh-in-motion counts them, in place of vehicles; from the folder of the scene on.
        histogram: Option<Histogram> = HISTOGRAM, "[[vehicles]] instead";
        /// Speed of the axles of a histogram.
        speed: Option<f64> = Number(SPEED), "40 km/h";
        /// How vehicles follow each other; the axles of a histogram come at random.
        order: Following = Following::FORM, "\"interleaved\"";
        /// Seed of a random order.
        seed: u64 = Number(ANY_WHOLE), "1" => 1;
        /// Vehicles in this order, over and over; shares do not count.
        sequence: Vec<String> = List(&[Text("a vehicle's name")], 1, NAMES), "none";
    }
}

const NAMES: &str = "a list of the vehicles' names, such as [\"truck\", \"van\"]";

/// How vehicles follow each other if no sequence is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Following {
    /// As evenly as their shares allow.
    #[default]
    Interleaved,
    /// Drawn at random by their shares.
    Random,
}

file_words!(Following: Interleaved "interleaved", Random "random");

/// Days of a year, on average.
pub const DAYS_PER_YEAR: f64 = 365.25;

impl Traffic {
    /// The time after this pass \[years of 365.25 days\], where the vehicles a day are known.
    pub fn years_after(&self, pass: u64) -> Option<f64> {
        let per_day = self.per_day?;
        Some(pass as f64 / (DAYS_PER_YEAR * per_day))
    }

    /// Puts whole passes in place of years.
    pub(crate) fn resolve(&mut self) -> Result<()> {
        let Some(years) = self.years.take() else {
            return Ok(());
        };
        let allowed = || format!("vehicles a day with `years`, {}", PER_DAY.allowed());
        let missing = || SceneError::missing("traffic.per_day", allowed());
        let per_day = self.per_day.ok_or_else(missing)?;
        let passes = (years * DAYS_PER_YEAR * per_day).round();
        if PASSES.contains(passes) {
            self.passes = passes as u64;
            return Ok(());
        }
        let [years, per_day, passes] = [years, per_day, passes].map(shown);
        let found = format!("{years} years of {per_day} vehicles a day, {passes} passes");
        let allowed = format!("so many that there are {} passes", PASSES.words);
        Err(SceneError::value("traffic.years", found, allowed))
    }
}
