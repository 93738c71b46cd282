//! What is not known of a scene, and the combinations of it that are computed.

use std::collections::BTreeMap;

use crate::design::DesignError;
use creepage_plan::ground::{Ground, road};
use creepage_run::Error;
use creepage_scene::{Scene, Uncertain};

/// Friction that is assumed where a scene does not say what is not known of it: from lubricated ducts to dry ones.
const FRICTION: [f64; 2] = [0.2, 0.5];
/// Factor of the ground's deflection to either side that is assumed then: that of moduli from tables.
const DEFLECTION: f64 = 2.0;
/// Combinations at most: friction and four other keys.
pub const MAX_COMBINATIONS: usize = 405;
/// The key whose values make a hill.
pub const FRICTION_KEY: &str = "friction.dynamic_coefficient";

/// A value of each key that is not known \[SI\].
pub type Combination = BTreeMap<String, f64>;

/// What `scene` leaves open; and whether that is assumed, as it says nothing.
pub fn unknowns(scene: &Scene) -> Result<(Vec<Uncertain>, bool), Error> {
    if !scene.uncertain.is_empty() {
        return Ok((scene.uncertain.clone(), false));
    }
    let friction = scene.friction.dynamic_coefficient;
    let (key, peak) = if let Some(peak) = scene.ground.longitudinal_peak {
        ("ground.longitudinal_peak", peak)
    } else {
        let ground = Ground::new(scene, None, road::reach(scene))?;
        ("ground.vertical_peak", ground.motions[0].peak_vertical())
    };
    let [low, high] = FRICTION;
    let assumed = [
        (FRICTION_KEY, friction, low.min(friction), high.max(friction)),
        (key, peak, peak / DEFLECTION, DEFLECTION * peak),
    ];
    let present = assumed.into_iter().filter(|(_, own, ..)| *own > 0.0);
    let unknown = |(key, _, low, high): (&str, f64, f64, f64)| Uncertain::new(key, low, high);
    Ok((present.map(unknown).collect(), true))
}

/// The values of an unknown, the middle one among them.
fn levels(unknown: &Uncertain) -> Vec<f64> {
    let (low, middle, high) = (unknown.low, unknown.middle(), unknown.high);
    match &*unknown.key {
        FRICTION_KEY => vec![low, 0.5 * (low + middle), middle, 0.5 * (middle + high), high],
        _ => vec![low, middle, high],
    }
}

/// Every combination of the levels of all unknowns.
pub fn combinations(unknowns: &[Uncertain]) -> Result<Vec<Combination>, DesignError> {
    let counts = unknowns.iter().map(|unknown| levels(unknown).len());
    let count = counts.fold(1, usize::saturating_mul);
    if count > MAX_COMBINATIONS {
        return Err(DesignError::Invalid {
            name: "number of combinations of what is uncertain",
            found: count as f64,
            allowed: "at most 405: friction at five places and four other keys at three",
        });
    }
    let mut all = vec![Combination::new()];
    for unknown in unknowns {
        let at_level = |level| all.iter().cloned().map(move |at| with(at, &unknown.key, level));
        all = levels(unknown).into_iter().flat_map(at_level).collect();
    }
    Ok(all)
}

/// The combination with another value of one key.
pub fn with(mut at: Combination, key: &str, value: f64) -> Combination {
    at.insert(key.to_owned(), value);
    at
}

/// The combination of all middles.
pub fn middle(unknowns: &[Uncertain]) -> Combination {
    let middles = unknowns
        .iter()
        .map(|unknown| (unknown.key.clone(), unknown.middle()));
    middles.collect()
}
