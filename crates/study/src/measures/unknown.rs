//! What is not known of a scene, and the combinations of it that are computed.

use serde::Serialize;

use crate::design::DesignError;
use creepage_plan::ground::Ground;
use creepage_scene::PeakScaling;
use creepage_scene::Scene;

/// Friction that is assumed where a scene does not say what is not known of it: from lubricated ducts to dry ones.
const FRICTION: [f64; 2] = [0.2, 0.5];
/// Factor of the ground's deflection to either side that is assumed then: that of moduli from tables.
const DEFLECTION: f64 = 2.0;
/// Places of friction in its interval: force against friction is a hill.
const PLACES: usize = 5;
/// Intervals that are wider have their middle at the geometric mean.
const WIDE: f64 = 3.0;
/// Combinations at most: friction and four other keys.
const MOST_COMBINATIONS: usize = 405;
/// The key whose values make a hill.
pub const FRICTION_KEY: &str = "friction.dynamic_coefficient";

/// A key whose value lies between two.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Unknown {
    /// The key: `ground.vertical_peak`.
    pub key: String,
    /// Its lowest value \[SI\].
    pub low: f64,
    /// Its highest value \[SI\].
    pub high: f64,
    /// Whether it is an assumption of this program, as the scene has no `[uncertain]`.
    pub assumed: bool,
}

impl Unknown {
    /// The middle of its interval \[SI\].
    pub fn middle(&self) -> f64 {
        if self.low > 0.0 && self.high > WIDE * self.low {
            return (self.low * self.high).sqrt();
        }
        0.5 * (self.low + self.high)
    }

    /// Its values, ascending: the middle one among them.
    pub(super) fn levels(&self) -> Vec<f64> {
        if self.key != FRICTION_KEY {
            return vec![self.low, self.middle(), self.high];
        }
        let part = |i: usize| i as f64 / (PLACES - 1) as f64;
        let halves = |i| match part(i) {
            part if part <= 0.5 => self.low + 2.0 * part * (self.middle() - self.low),
            part => self.high - 2.0 * (1.0 - part) * (self.high - self.middle()),
        };
        (0..PLACES).map(halves).collect()
    }
}

/// What `scene`, which moves as its `ground` does, leaves open, or what is assumed where it says nothing.
pub fn unknowns(scene: &Scene, ground: &Ground) -> Vec<Unknown> {
    let unknown = |assumed| {
        move |(key, low, high): (&str, f64, f64)| Unknown {
            key: key.to_owned(),
            low,
            high,
            assumed,
        }
    };
    if !scene.uncertain.is_empty() {
        let given = scene
            .uncertain
            .iter()
            .map(|known| (&*known.key, known.low, known.high));
        return given.map(unknown(false)).collect();
    }
    let friction = scene.friction.dynamic_coefficient;
    let [low, high] = FRICTION;
    let of_friction = (FRICTION_KEY, low.min(friction), high.max(friction));
    let (key, peak) = match scene.ground.scaling() {
        Some(PeakScaling::Longitudinal(peak)) => ("ground.longitudinal_peak", peak),
        _ => ("ground.vertical_peak", ground.motions[0].peak_vertical()),
    };
    let of_ground = (key, peak / DEFLECTION, DEFLECTION * peak);
    let both = [(friction, of_friction), (peak, of_ground)];
    let there = both.into_iter().filter(|(own, _)| *own > 0.0);
    there.map(|(_, interval)| unknown(true)(interval)).collect()
}

/// Every combination of the levels of all unknowns.
pub fn combinations(unknowns: &[Unknown]) -> Result<Vec<Vec<f64>>, DesignError> {
    let counts = unknowns.iter().map(|unknown| unknown.levels().len());
    let count = counts.fold(1, usize::saturating_mul);
    if count > MOST_COMBINATIONS {
        return Err(DesignError::Invalid {
            name: "number of combinations of what is uncertain",
            found: count as f64,
            allowed: "at most 405: friction at five places and four other keys at three",
        });
    }
    let extend = |all: Vec<Vec<f64>>, unknown: &Unknown| {
        let with = |at: &Vec<f64>| -> Vec<Vec<f64>> {
            let levels = unknown.levels().into_iter();
            levels.map(|level| [&at[..], &[level]].concat()).collect()
        };
        all.iter().flat_map(with).collect()
    };
    Ok(unknowns.iter().fold(vec![Vec::new()], extend))
}
