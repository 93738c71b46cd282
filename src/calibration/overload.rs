//! Forces beyond any that friction could make: overloads of an instrument, any one of which would outweigh all other readings.
//!
//! Friction along the whole duct, with the largest coefficient that is considered, and the weight along its slope bound the force in a cable
//! without heat: F ≤ (μ N′ + |p|) L.

use super::cell::Observed;
use super::options::Series;
use super::unknown::Quantity;
use crate::readings::Readings;
use crate::scene::{Scene, four_digits};

/// Share of an instrument's readings beyond which they are no exceptions, but unit, sign or scene not what they seem; and the fewest readings
/// of which that can be said.
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
    let (scene, most) = (one.scene, largest_force(one.scene));
    let list = one.readings.readings();
    let mut cells: Vec<(Observed, usize, usize)> = Vec::new();
    let cell_of = |measured| match Observed::of(scene, measured) {
        Ok(cell @ (Observed::Force(_) | Observed::ForceAt(_))) => Some(cell),
        _ => None,
    };
    for reading in list {
        let Some(cell) = cell_of(reading.measured) else {
            continue;
        };
        let place = cells
            .iter()
            .position(|(other, ..)| *other == cell)
            .unwrap_or(cells.len());
        if place == cells.len() {
            cells.push((cell, 0, 0));
        }
        cells[place].1 += 1;
        cells[place].2 += usize::from(reading.value.abs() > most);
    }
    cells.retain(|&(_, all, beyond)| all >= FEWEST && beyond > 0 && beyond as f64 <= FEW * all as f64);
    let is_beyond = |reading: &crate::Reading| {
        let of = |cell| cells.iter().any(|(other, ..)| *other == cell);
        reading.value.abs() > most && cell_of(reading.measured).is_some_and(of)
    };
    let kept = one.readings.keep(|reading| !is_beyond(reading));
    if cells.is_empty() || scene.heat.is_some() || kept.last_pass() == 0 {
        return (one.readings.clone(), None);
    }
    let beyond = list.iter().filter(|reading| is_beyond(reading));
    let passes = beyond.map(|reading| format!("pass {} (line {})", reading.pass, reading.line));
    let words = format!(
        "forces larger than friction makes in this duct, at most {} N, were left out: {}",
        four_digits(most),
        passes.collect::<Vec<_>>().join(", ")
    );
    (kept, Some(words))
}
