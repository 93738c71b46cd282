//! What is valid and yet hardly meant: values that no ground, cable or road has.
//!
//! A range refuses what the models cannot represent. Between it and what is built lie slips of a unit or a digit, which are
//! warnings.

use ground_field::{Base, Modulus, SoilProfile};

use super::arrangement::may_jam;
use super::data::{Ground, PeakScaling, Scene, TrafficVehicle};

/// Moduli \[Pa\] between which soils and pavements lie: peat and granite.
const SOFTEST: f64 = 1e6;
const STIFFEST: f64 = 1e11;
/// A bare modulus \[Pa\] up to this may be one in MPa.
const MEGAPASCALS: f64 = 1e5;
/// How many times stiffer one layer is than another where a layer on soil, or under a pavement, is hardly meant.
const CONTRAST: f64 = 100.0;
/// A first layer as thin as this \[m\] is a pavement's.
const PAVEMENT: f64 = 0.5;
/// Friction coefficients of cables in ducts are below 1.
const ROUGHEST: f64 = 1.5;
/// Where it is farther than this number of depths from the vehicle's axis to the duct's axis, a duct hardly moves.
const FARTHEST: f64 = 10.0;

/// A warning for every value that is unusual.
pub(crate) fn unusual(scene: &Scene) -> Vec<String> {
    let mut warnings = moduli(&scene.ground.profile);
    warnings.extend(rock(scene));
    warnings.extend(contrast(&scene.ground));
    warnings.extend(may_jam(scene));
    let coefficient = scene.friction.dynamic_coefficient;
    if coefficient > ROUGHEST {
        warnings.push(format!(
            "`friction.dynamic_coefficient` is {coefficient}: that of cables in ducts is below 1"
        ));
    }
    warnings.extend(far(scene));
    warnings.extend(lanes_scaled_alike(scene));
    warnings
}

/// A lane so far away that its vehicles hardly move the duct.
fn far(scene: &Scene) -> Option<String> {
    let is_far = |traffic: &&TrafficVehicle| scene.offset_from(traffic).abs() > FARTHEST * scene.duct.depth;
    let traffic = scene.vehicles.iter().find(is_far)?;
    let (name, offset) = (traffic.vehicle.name(), scene.offset_from(traffic).abs());
    let subject = if traffic.lateral_offset == 0.0 {
        format!("`duct.lateral_offset` is {offset} m")
    } else {
        format!("the lane of \"{name}\" is {offset} m from the duct")
    };
    Some(format!(
        "{subject}, more than {FARTHEST} times the depth: the duct hardly moves there"
    ))
}

/// Lanes move a duct by different amounts, but a longitudinal peak is that of each vehicle.
fn lanes_scaled_alike(scene: &Scene) -> Option<String> {
    let Some(PeakScaling::Longitudinal(_)) = scene.ground.scaling else {
        return None;
    };
    let differs = |traffic: &TrafficVehicle| traffic.lateral_offset != scene.vehicles[0].lateral_offset;
    scene.vehicles.iter().any(differs).then(|| {
        "`ground.longitudinal_peak` is the peak under every vehicle, in whatever lane: one in a lane farther away moves the duct as far; \
         `ground.vertical_peak` keeps the lanes apart"
            .to_owned()
    })
}

/// Rock does not move, and so nothing in it does.
fn rock(scene: &Scene) -> Option<String> {
    let (profile, depth) = (&scene.ground.profile, scene.duct.depth);
    // A sum of thicknesses, as it would be written.
    let base = (1e6 * profile.base_depth()).round() / 1e6;
    (profile.base() == Base::Rigid && base <= depth).then(|| {
        format!(
            "`ground.rigid_base_depth` is {base} m and the duct lies at {depth} m, within the rock: it does not move, and no force arises"
        )
    })
}

/// The modulus at the top and at the bottom of a layer.
fn ends(modulus: Modulus) -> [f64; 2] {
    match modulus {
        Modulus::Uniform(modulus) => [modulus; 2],
        Modulus::Linear { top, bottom } => [top, bottom],
    }
}

fn moduli(profile: &SoilProfile) -> Vec<String> {
    let base = match profile.base() {
        Base::HalfSpace(soil) => Some([soil.young_modulus(); 2]),
        Base::Rigid => None,
    };
    let layers = profile.layers().iter().map(|layer| ends(layer.modulus()));
    let mut warnings = Vec::new();
    for (index, [top, bottom]) in layers.chain(base).enumerate() {
        let (least, most) = (top.min(bottom), top.max(bottom));
        let key = format!("`ground.layers.{index}.young_modulus`");
        if least < SOFTEST {
            let meant = format!("; a bare number is in Pa: did you mean \"{least} MPa\"?");
            let meant = if least <= MEGAPASCALS { meant.as_str() } else { "" };
            warnings.push(format!("{key} is {} MPa, softer than peat{meant}", least / 1e6));
        }
        if most > STIFFEST {
            warnings.push(format!("{key} is {} GPa, stiffer than granite", most / 1e9));
        }
    }
    warnings
}

/// Layers that may have been written in the wrong order.
fn contrast(ground: &Ground) -> Option<String> {
    let layers = ground.profile.layers();
    let (first, last) = (layers.first()?, layers.last()?);
    let Base::HalfSpace(base) = ground.profile.base() else {
        return None;
    };
    let ([top, _], [_, above]) = (ends(first.modulus()), ends(last.modulus()));
    let (base, index) = (base.young_modulus(), layers.len());
    if above > CONTRAST * base {
        return Some(format!(
            "`ground.layers.{index}.young_modulus` is {:.0} times less than that of the layer on it",
            above / base
        ));
    }
    (first.thickness() <= PAVEMENT && base > CONTRAST * top).then(|| {
        format!(
            "`ground.layers.0.young_modulus` is {:.0} times less than that of the ground below the pavement: layers stand from the top down",
            base / top
        )
    })
}
