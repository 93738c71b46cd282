//! Forces beyond any that friction could make: overloads of an instrument, any one of which would outweigh all other readings.
//!
//! Friction along the whole duct, with the largest coefficient that is considered, and the weight along its slope bound the force in a cable
//! without heat: F ≤ (μ N′ + |p|) L.

use super::options::Series;
use super::unknown::Quantity;
use crate::Reading;
use crate::readings::{Measured, Readings};
use crate::scene::{Scene, four_digits};

/// Share of the forces beyond which they are no exceptions, but unit, sign or scene not what they seem; and the fewest forces of which that can
/// be said.
const FEW: f64 = 0.25;
const FEWEST: usize = 6;

/// Largest force that friction makes in the cable of `scene` \[N\].
fn largest_force(scene: &Scene) -> f64 {
    let (_, most) = Quantity::DynamicCoefficient.bounds();
    let most = most.max(scene.friction.dynamic_coefficient);
    (most * scene.normal_load() + scene.body_force().abs()) * scene.duct.length
}

/// The readings without those that are beyond reach, and words on these if there are any.
pub fn within_reach(one: &Series<'_>) -> (Readings, Option<String>) {
    let most = largest_force(one.scene);
    let is_force = |reading: &&Reading| matches!(reading.measured, Measured::Force(_));
    let is_beyond = |reading: &Reading| is_force(&reading) && reading.value.abs() > most;
    let list = one.readings.readings();
    let forces = list.iter().filter(is_force).count();
    let beyond: Vec<&Reading> = list.iter().filter(|reading| is_beyond(reading)).collect();
    let are_few = forces >= FEWEST && beyond.len() as f64 <= FEW * forces as f64;
    let kept = one.readings.keep(|reading| !is_beyond(reading));
    if beyond.is_empty() || !are_few || one.scene.heat.is_some() || kept.last_pass() == 0 {
        return (one.readings.clone(), None);
    }
    let passes = beyond
        .iter()
        .map(|reading| format!("pass {} (line {})", reading.pass, reading.line));
    let words = format!(
        "forces larger than friction makes in this duct, at most {} N, were left out: {}",
        four_digits(most),
        passes.collect::<Vec<_>>().join(", ")
    );
    (kept, Some(words))
}
