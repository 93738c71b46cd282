//! What lies outside the model's range, whatever is chosen.

use cable_dem::Order;
use ground_field::{Base, DuctMotion};

use crate::error::Error;
use crate::error_source::ErrorSource;
use crate::occurrence::{Occurrence, TOP};
use crate::period::coming;
use crate::shown::{exact_percent, percent};
use creepage_scene::{Scene, unusual};

/// Density of soil \[kg/m³\] for the speed of its shear waves: moist sand and clay have 1700 to
/// 2000.
const SOIL_DENSITY: f64 = 1800.0;
/// Mach number of a vehicle in the ground above which the ground's own inertia is no longer small.
const FAST: f64 = 0.3;

/// Deflection of a duct that is hardly meant \[m\]: more than twice the 90 to 140 µm that Kashiro et al. measured at 1.2 m.
const DEEP: f64 = 300e-6;
/// Friction counts as above the top of the hill if Q is so many times that of the top: below, the force is within a tenth of it.
const BEYOND: f64 = 1.5;

/// What the user should know before trusting any answer, which leaves out so much `inertia`.
pub fn warnings(scene: &Scene, inertia: f64, motions: &[DuctMotion]) -> Result<Vec<String>, Error> {
    let mut warnings = unusual(scene);
    warnings.extend(fast(scene));
    warnings.extend(deep(scene, motions));
    warnings.extend(falling(scene, motions));
    if scene.warming().is_some() {
        warnings.extend(warm(scene));
    }
    if scene.route.iter().any(|section| section.bend_radius.is_some()) {
        warnings.push(
            "friction in a bend grows with the force in the cable: the state that traffic leads to may depend on what came first"
                .to_owned(),
        );
    }
    let (coming, passes) = (coming(scene)?, scene.traffic.passes);
    let absent = (0..scene.vehicles.len()).filter(|vehicle| !coming.contains(vehicle));
    let absent = absent.map(|vehicle| format!("\"{}\"", scene.vehicles[vehicle].name));
    let absent: Vec<String> = absent.collect();
    if !absent.is_empty() {
        let absent = absent.join(", ");
        warnings.push(format!("no pass among the {passes} is one of {absent}"));
    }
    if inertia > scene.solver.tolerance {
        let remedy = match scene.warming() {
            None => ErrorSource::Inertia.remedy(),
            Some(_) => "days of heat are computed without it",
        };
        let (tolerance, most) = (exact_percent(scene.solver.tolerance), percent(inertia));
        warnings.push(format!(
            "leaving the cable's inertia out changes the force by up to {most}, more than the tolerance of {tolerance}: {remedy}"
        ));
    }
    Ok(warnings)
}

/// What forces of heat leave out, and what a day's traffic is taken to be.
fn warm(scene: &Scene) -> Vec<String> {
    let bound = "forces of heat are upper bounds: a cable snakes in its duct as it expands, its stiffness falls as it warms, and its \
                 insulation relaxes";
    let mut warnings = vec![bound.to_owned()];
    let per_day = scene.traffic.per_day.unwrap_or(1.0);
    if per_day.fract() != 0.0 {
        let whole = per_day.round().max(1.0);
        warnings.push(format!(
            "`traffic.per_day` is {per_day}: a day of heat has whole passes, {whole}"
        ));
    }
    if scene.order() != Order::Interleaved {
        let order =
            "every day of heat has its vehicles in the same order, as evenly mixed as their shares allow";
        warnings.push(order.to_owned());
    }
    warnings
}

/// A ground that gives way more than roads do.
fn deep(scene: &Scene, motions: &[DuctMotion]) -> Option<String> {
    let deflections = motions.iter().map(DuctMotion::peak_vertical);
    let deepest = deflections.fold(0.0, f64::max);
    let measured = scene.ground.longitudinal_peak.or(scene.ground.vertical_peak);
    let key = match measured {
        None => {
            "a modulus from CBR or from a settlement test is several times too small for traffic, and the force may be double; measure \
                 the deflection and give `ground.vertical_peak`"
        }
        Some(_) => "is the unit right?",
    };
    (deepest > DEEP).then(|| {
        let micrometres = 1e6 * deepest;
        format!("the duct goes down by {micrometres:.0} µm, far above what is measured under roads, 90 to 140 µm: {key}")
    })
}

/// Friction above that of the largest force.
fn falling(scene: &Scene, motions: &[DuctMotion]) -> Option<String> {
    let occurrence = Occurrence::new(scene, motions)?;
    let beyond = occurrence.q_number / TOP;
    let friction = scene.friction.dynamic_coefficient;
    (beyond > BEYOND && occurrence.creeps()).then(|| {
        format!(
            "`friction.dynamic_coefficient` is {friction}, on the falling side of a hill: with less friction the force grows at first, to its \
             largest at about {:.2}; `creepage measures` looks for the worst within an interval",
            friction / beyond
        )
    })
}

fn fast(scene: &Scene) -> Option<String> {
    let profile = scene.ground.profile().ok()?;
    let base = match profile.base() {
        Base::HalfSpace(soil) => soil.shear_modulus(),
        Base::Rigid => f64::INFINITY,
    };
    let softest = profile.layers().iter().fold(base, |least, layer| {
        let ends = [0.0, layer.thickness()].map(|depth| layer.young_modulus_at(depth));
        least.min(ends[0].min(ends[1]) / (2.0 * (1.0 + layer.poisson_ratio())))
    });
    let wave = (softest / SOIL_DENSITY).sqrt();
    let speeds = scene.vehicles.iter().map(|traffic| traffic.speed);
    let mach = speeds.fold(0.0, f64::max) / wave;
    (mach > FAST).then(|| {
        format!(
            "a vehicle drives at {mach:.2} of the speed of shear waves in the softest soil ({wave:.0} m/s at {SOIL_DENSITY} kg/m³): \
             the ground is computed without its inertia, which matters above {FAST} of that speed"
        )
    })
}
