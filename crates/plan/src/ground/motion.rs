//! Motion of the duct under each of a scene's vehicles.

use ground_field::{DuctLine, DuctMotion, GroundField};

use crate::error::Error;
use crate::tuning::ground::SMOOTHER;
use creepage_scene::{Scene, TrafficVehicle, Wheel};

/// Points at which two motions are compared, this far on either side of the vehicle \[depths\].
const COMPARED: (usize, f64) = (241, 12.0);

/// Loads in the same ratio to this share are so but for rounding.
const SAME: f64 = 1e-12;

/// The motion under every vehicle for |ξ| up to `reach` \[m\], to `accuracy` as a share of its
/// peak; scaled to a measured peak where the scene has one.
pub fn motions(
    scene: &Scene,
    field: &dyn GroundField,
    accuracy: f64,
    reach: f64,
) -> Result<Vec<DuctMotion>, Error> {
    let mut motions: Vec<DuctMotion> = Vec::with_capacity(scene.vehicles.len());
    for (index, traffic) in scene.vehicles.iter().enumerate() {
        // The ground is elastic: vehicles that differ by their load alone share one motion, scaled.
        let mut before = scene.vehicles[..index].iter().enumerate();
        let alike = before.find_map(|(base, other)| Some((base, load_ratio(traffic, other)?)));
        motions.push(if let Some((base, ratio)) = alike {
            motions[base].clone().scaled(ratio)?
        } else {
            let line = DuctLine::new(scene.duct.depth, scene.offset_from(traffic))?;
            DuctMotion::new(field, &traffic.vehicle()?, line, reach, accuracy)?
        });
    }
    scale(scene, motions)
}

/// How many times as heavy a vehicle is as one that is like it but for its load; `None` if they
/// differ in more.
pub fn load_ratio(vehicle: &TrafficVehicle, base: &TrafficVehicle) -> Option<f64> {
    let drives = |vehicle: &TrafficVehicle| (vehicle.lateral_offset, vehicle.speed, vehicle.direction);
    let (wheels, others) = (vehicle.wheels(), base.wheels());
    let ratio = vehicle.weight() / base.weight();
    let is_alike = |(a, b): (&Wheel, &Wheel)| {
        let place = |wheel: &Wheel| (wheel.x, wheel.y, wheel.contact_radius);
        place(a) == place(b) && (a.load - ratio * b.load).abs() <= SAME * a.load
    };
    let drive_alike = drives(vehicle) == drives(base) && wheels.len() == others.len();
    let alike = drive_alike && ratio.is_finite() && wheels.iter().zip(&others).all(is_alike);
    alike.then_some(ratio)
}

/// max |D_l| under any vehicle \[m\].
pub fn peak(motions: &[DuctMotion]) -> f64 {
    let peaks = motions.iter().map(DuctMotion::peak_longitudinal);
    peaks.fold(0.0, f64::max)
}

/// Length over which a duct at `depth` moves differently under the vehicle that moves it most
/// sharply \[m\]: its depth, or more where that is worth a mesh of its own.
pub fn length_scale(motions: &[DuctMotion], depth: f64) -> f64 {
    let scales = motions.iter().map(DuctMotion::length_scale);
    let least = scales.fold(f64::INFINITY, f64::min);
    if least > SMOOTHER * depth { least } else { depth }
}

/// The motions with the measured peak, if the scene has one.
fn scale(scene: &Scene, motions: Vec<DuctMotion>) -> Result<Vec<DuctMotion>, Error> {
    let first = motions.first().map_or(0.0, DuctMotion::peak_vertical);
    let wanted = (scene.ground.longitudinal_peak, scene.ground.vertical_peak);
    let scaled = |motion: DuctMotion| {
        let (factor, key) = match wanted {
            (Some(wanted), _) => (wanted / motion.peak_longitudinal(), "ground.longitudinal_peak"),
            (None, Some(wanted)) => (wanted / first, "ground.vertical_peak"),
            (None, None) => return Ok(motion),
        };
        if factor.is_finite() {
            return Ok(motion.scaled(factor)?);
        }
        let reason = "the vehicle does not move the duct, so there is nothing to scale";
        Err(Error::unfit(key, "a peak", reason))
    };
    motions.into_iter().map(scaled).collect()
}

/// Largest |ΔD_l| of any vehicle, as a share of the peak of its `exact` D_l.
pub fn difference(motions: &[DuctMotion], exact: &[DuctMotion], depth: f64) -> f64 {
    let (count, depths) = COMPARED;
    let mut largest = 0.0_f64;
    for (motion, exact) in motions.iter().zip(exact) {
        let wanted = exact.half_length() + depths * depth;
        // Beyond its reach a motion has no accuracy.
        let half = wanted.min(motion.reach()).min(exact.reach());
        for k in 0..count {
            let xi = half * (2.0 * k as f64 / (count - 1) as f64 - 1.0);
            let off = (motion.longitudinal(xi) - exact.longitudinal(xi)).abs();
            if off > 0.0 {
                largest = largest.max(off / exact.peak_longitudinal());
            }
        }
    }
    largest
}
