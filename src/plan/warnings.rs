//! What lies outside the model's range, whatever is chosen.

use cable_dem::Order;
use ground_field::Base;

use super::method::PassMethod;
use super::period::Period;
use crate::scene::{Scene, unusual};

/// Density of soil \[kg/m³\] for the speed of its shear waves: moist sand and clay have 1700 to 2000.
const SOIL_DENSITY: f64 = 1800.0;
/// Mach number of a vehicle in the ground above which the ground's own inertia is no longer small.
const FAST: f64 = 0.3;

/// What the user should know before trusting any answer.
pub fn warnings(scene: &Scene) -> Vec<String> {
    let mut warnings = unusual(scene);
    warnings.extend(fast(scene));
    warnings.extend(warm(scene));
    warnings
}

/// What forces of heat leave out, and what a day's traffic is taken to be.
fn warm(scene: &Scene) -> Vec<String> {
    if scene.warming().is_none() {
        return Vec::new();
    }
    let mut warnings = vec![
        "forces of heat are upper bounds: a cable snakes in its duct as it expands, its stiffness falls as it warms, and its insulation \
         relaxes"
            .to_owned(),
    ];
    let per_day = scene.traffic.per_day.unwrap_or(1.0);
    if per_day.fract() != 0.0 {
        let whole = per_day.round().max(1.0);
        warnings.push(format!(
            "`traffic.per_day` is {per_day}: a day of heat has whole passes, {whole}"
        ));
    }
    if scene.traffic.order != Order::Interleaved {
        warnings.push(
            "every day of heat has its vehicles in the same order, as evenly mixed as their shares allow"
                .to_owned(),
        );
    }
    warnings
}

/// A sequence of which only the mix is computed.
pub fn of_mix(scene: &Scene, method: PassMethod, period: &Period) -> Option<String> {
    let Order::Sequence(sequence) = &scene.traffic.order else {
        return None;
    };
    let is_mixed = period.reordered && matches!(method, PassMethod::Jumps(_));
    is_mixed.then(|| {
        format!(
            "a sequence of {} vehicles is too long to repeat itself often enough in {} passes: a period of {} vehicles stands in for it, \
             in nearly its shares and as evenly mixed as possible",
            sequence.len(),
            scene.traffic.passes,
            period.len()
        )
    })
}

fn fast(scene: &Scene) -> Option<String> {
    let profile = &scene.ground.profile;
    let base = match profile.base() {
        Base::HalfSpace(soil) => Some(soil.shear_modulus()),
        Base::Rigid => None,
    };
    let layers = profile.layers().iter().map(|layer| {
        let ends = [0.0, layer.thickness()].map(|depth| layer.young_modulus_at(depth));
        ends[0].min(ends[1]) / (2.0 * (1.0 + layer.poisson_ratio()))
    });
    let softest = layers.chain(base).fold(f64::INFINITY, f64::min);
    let wave = (softest / SOIL_DENSITY).sqrt();
    let speeds = scene.vehicles.iter().map(|traffic| traffic.vehicle.speed());
    let mach = speeds.fold(0.0, f64::max) / wave;
    (mach > FAST).then(|| {
        format!(
            "a vehicle drives at {mach:.2} of the speed of shear waves in the softest soil ({wave:.0} m/s at {SOIL_DENSITY} kg/m³): \
             the ground is computed without its inertia, which matters above {FAST} of that speed"
        )
    })
}
