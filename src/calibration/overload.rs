//! Readings beyond anything that friction could do: overloads of an instrument, any one of which would outweigh all others.
//!
//! Friction along the whole duct, with the largest coefficient that a fit considers, and the weight along its slope bound the force of a cable
//! without heat: F ≤ (μ N′ + |p|) L. No end moves farther than the duct is long.

use super::cell::Observed;
use super::options::Series;
use super::unknown::Quantity;
use crate::readings::Readings;
use crate::scene::{Scene, four_digits};

/// Of the readings, the share beyond which they are no exceptions: then unit, sign or scene are not what they seem.
const FEW: f64 = 0.25;

/// Largest force that friction makes in the cable of `scene` \[N\].
fn largest_force(scene: &Scene) -> f64 {
    let (_, most) = Quantity::DynamicCoefficient.bounds();
    (most * scene.cable.normal_load() + scene.body_force().abs()) * scene.duct.length
}

/// The readings without those that are out of reach, and words on these if there are any.
pub fn within_reach(one: &Series<'_>) -> (Readings, Option<String>) {
    let (scene, force) = (one.scene, largest_force(one.scene));
    let reach = |measured| match Observed::of(scene, measured) {
        Ok(Observed::Force(_) | Observed::ForceAt(_)) => force,
        Ok(Observed::StrainAt(_)) => force / scene.cable.axial_stiffness,
        Ok(Observed::Movement(_)) => scene.duct.length,
        _ => f64::INFINITY,
    };
    let readings = one.readings.readings();
    let beyond = readings
        .iter()
        .filter(|reading| reading.value.abs() > reach(reading.measured));
    let passes: Vec<String> = beyond
        .map(|reading| format!("pass {} (line {})", reading.pass, reading.line))
        .collect();
    if passes.is_empty() || scene.heat.is_some() || passes.len() as f64 > FEW * readings.len() as f64 {
        return (one.readings.clone(), None);
    }
    let kept = one
        .readings
        .keep(|reading| reading.value.abs() <= reach(reading.measured));
    let words = format!(
        "readings larger than friction could make them in this duct, where no force is above {} N, were left out: {}",
        four_digits(force),
        passes.join(", ")
    );
    (kept, Some(words))
}
