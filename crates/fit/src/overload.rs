//! Forces beyond any that friction could make: overloads of an instrument, any one of which would
//! outweigh all other readings.
//!
//! Friction along the whole duct, with the largest coefficient that is considered, and the weight
//! along its slope bound the force in a cable without heat: F ≤ (μ N′ + |p|) L.

use crate::instrument::located;
use crate::options::Series;
use crate::readings::{Measured, Reading, Readings};
use crate::unknown::Quantity;
use creepage_scene::{Scene, four_digits};

/// Share of an instrument's forces beyond which they are no exceptions, but unit, sign or scene not
/// what they seem; and the fewest forces of which that can be said.
const FEW: f64 = 0.25;
const MIN_READINGS: usize = 6;

/// Largest force that friction makes in the cable of `scene` \[N\].
fn largest_force(scene: &Scene) -> f64 {
    let (_, most) = Quantity::DynamicCoefficient.bounds();
    let most = most.max(scene.friction.dynamic_coefficient);
    (most * scene.normal_load() + scene.body_force().abs()) * scene.duct.length
}

/// The readings without those that are beyond reach, and words on these if there are any.
pub fn within_reach(one: &Series<'_>) -> (Readings, Option<String>) {
    let (scene, most) = (one.scene, largest_force(one.scene));
    let instrument = |reading: &Reading| {
        let located = located(scene, reading.measured).ok();
        located.filter(|measured| matches!(measured, Measured::Force(_)))
    };
    let is_large = |reading: &Reading| reading.value.abs() > most;
    let list = || one.readings.list.iter();
    // Among the forces of its instrument it is an exception.
    let is_exception = |reading: &Reading| {
        let cell = instrument(reading);
        let all: Vec<&Reading> = list().filter(|other| instrument(other) == cell).collect();
        let large = all.iter().filter(|other| is_large(other)).count();
        cell.is_some() && all.len() >= MIN_READINGS && large as f64 <= FEW * all.len() as f64
    };
    let is_beyond = |reading: &Reading| is_large(reading) && is_exception(reading);
    let mut kept = one.readings.clone();
    kept.list.retain(|reading| !is_beyond(reading));
    let beyond = list().filter(|reading| is_beyond(reading));
    let beyond = beyond.map(|reading| format!("pass {} (line {})", reading.pass, reading.line));
    let beyond: Vec<String> = beyond.collect();
    if beyond.is_empty() || scene.heat.is_some() || kept.last_pass() == 0 {
        return (one.readings.clone(), None);
    }
    let (most, passes) = (four_digits(most), beyond.join(", "));
    let words =
        format!("forces larger than friction makes in this duct, at most {most} N, were left out: {passes}");
    (kept, Some(words))
}
