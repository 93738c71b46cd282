//! What is valid and yet hardly meant: values that no ground, cable or road has.
//!
//! A range refuses what the models cannot represent. Between it and what is built lie slips of a unit or a digit, which are
//! warnings.

use std::ops::RangeInclusive;

use ground_field::{Base, Modulus, SoilProfile, Wheel};

use super::arrangement::may_jam;
use super::counted::with_count;
use super::data::{End, FrictionLaw, Ground, PeakScaling, Scene, TrafficVehicle};
use crate::shown::four_digits;

/// Moduli \[Pa\] between which soils and pavements lie: peat and granite.
const SOFTEST: f64 = 1e6;
const STIFFEST: f64 = 1e11;
/// A bare modulus \[Pa\] up to this may be one in MPa.
const MEGAPASCALS: f64 = 1e5;
/// How many times stiffer a layer is than the soil below it, and the ground below than a pavement, where that is hardly meant.
const CONTRAST: f64 = 100.0;
const INVERTED: f64 = 20.0;
/// A first layer as thin as this \[m\] is a pavement's.
const PAVEMENT: f64 = 0.5;
/// Where it is farther than this number of depths from the vehicle's axis to the duct's axis, a duct hardly moves.
const FARTHEST: f64 = 10.0;

/// Vehicles heavier than this \[N\] do not drive, and no road is older \[years\].
const HEAVIEST: f64 = 5e6;
const OLDEST: f64 = 200.0;

/// Units in which values are shown: their size in SI and their name.
type Size = (f64, &'static str);
const METRE: Size = (1.0, " m");
const PLAIN: Size = (1.0, "");

/// What follows a value outside its usual range.
const CABLES: &str = ", but that of power cables is from";
const HOLDS_NOTHING: &str = ", which holds nothing: springs and clamps are from 0.1 to 1000 MN/m";

/// A warning for every value that is unusual.
pub(crate) fn unusual(scene: &Scene) -> Vec<String> {
    let mut warnings = moduli(&scene.ground.profile);
    warnings.extend(rock(scene));
    warnings.extend(contrast(&scene.ground));
    warnings.extend(may_jam(scene));
    warnings.extend(outside_usual_ranges(scene));
    warnings.extend(exchanged(scene));
    warnings.extend(too_much(scene));
    warnings.extend(far(scene));
    warnings.extend(lanes_scaled_alike(scene));
    warnings.iter().map(|warning| with_count(warning)).collect()
}

/// Values outside the ranges of what is built: key, value, usual range, unit, and what is usual.
fn outside_usual_ranges(scene: &Scene) -> Vec<String> {
    let mut warnings = Vec::new();
    let mut check = |key: &str, value: f64, usual: RangeInclusive<f64>, (size, unit): Size, is: &str| {
        if !usual.contains(&value) {
            warnings.push(format!("`{key}` is {}{unit}{is}", four_digits(value / size)));
        }
    };
    let Scene {
        duct,
        cable,
        friction,
        ends,
        ..
    } = scene;
    let depths = ", but ducts lie below roads at depths from 0.2 to 20 m";
    check("duct.depth", duct.depth, 0.2..=20.0, METRE, depths);
    let weights = format!("{CABLES} 5 to 600 N/m");
    check("cable.weight", cable.weight, 5.0..=600.0, (1.0, " N/m"), &weights);
    let stiffnesses = format!("{CABLES} 0.5 to 1000 MN");
    let (own, meganewtons) = (cable.axial_stiffness, (1e6, " MN"));
    check("cable.axial_stiffness", own, 5e5..=1e9, meganewtons, &stiffnesses);
    let rough = ": that of cables in ducts is below 1";
    let (key, coefficient) = ("friction.dynamic_coefficient", friction.dynamic_coefficient);
    check(key, coefficient, 0.0..=1.5, PLAIN, rough);
    if let FrictionLaw::ElasticPlastic { shape_factor } = friction.law {
        let slow = format!(
            ": friction builds up over {} mm, more than traffic moves a cable to and fro",
            four_digits(2e3 / shape_factor)
        );
        let (key, size) = ("friction.shape_factor", (1.0, " 1/m"));
        check(key, shape_factor, 1e4..=f64::INFINITY, size, &slow);
    }
    let mut holds = |key: &str, stiffness: f64| {
        let meant = format!(
            "{HOLDS_NOTHING}; did you mean \"{} MN/m\"?",
            four_digits(stiffness)
        );
        check(key, stiffness, 1e3..=f64::INFINITY, (1.0, " N/m"), &meant);
    };
    for (name, end) in [("upstream", ends.upstream), ("downstream", ends.downstream)] {
        if let End::Spring(stiffness) = end {
            holds(&format!("ends.{name}.spring"), stiffness);
        }
    }
    for (index, clamp) in scene.restraints.iter().enumerate() {
        holds(&format!("restraints.{index}.stiffness"), clamp.stiffness);
    }
    for (index, TrafficVehicle { vehicle, .. }) in scene.vehicles.iter().enumerate() {
        let speeds = ", but trucks drive at 20 to 100 km/h";
        let key = format!("vehicles.{index}.speed");
        check(
            &key,
            vehicle.speed(),
            0.0..=200.0 / 3.6,
            (1.0 / 3.6, " km/h"),
            speeds,
        );
        // Of wheels the first is named that is unusual.
        let first = |of: fn(&Wheel) -> f64, most: f64| {
            let mut values = vehicle.wheels().iter().map(of).enumerate();
            values.find(|(_, value)| *value > most)
        };
        let key = |wheel: usize, name: &str| format!("vehicles.{index}.wheels.{wheel}.{name}");
        if let Some((wheel, load)) =
            first(|wheel| wheel.load.force(), 5e5).filter(|_| vehicle.wheels().len() > 1)
        {
            let carries = ", but a wheel on a road carries from 1 to 200 kN";
            check(&key(wheel, "load"), load, 0.0..=5e5, (1e3, " kN"), carries);
        }
        if let Some((wheel, radius)) = first(|wheel| wheel.load.contact_radius(), 0.6) {
            let tyres = ": that of tyres is from 0.1 to 0.3 m";
            check(&key(wheel, "contact_radius"), radius, 0.0..=0.6, METRE, tyres);
        }
    }
    if let Some(per_day) = scene.traffic.per_day {
        let busy = ": no road has more than 200000 vehicles a day";
        check("traffic.per_day", per_day, 0.0..=2e5, PLAIN, busy);
    }
    warnings
}

/// A duct that lies deeper than it is long.
fn exchanged(scene: &Scene) -> Option<String> {
    let (depth, length) = (scene.duct.depth, scene.duct.length);
    (depth > length).then(|| {
        format!(
            "`duct.depth` is {} m, more than the duct is long, {} m: were they exchanged?",
            four_digits(depth),
            four_digits(length)
        )
    })
}

/// Vehicles too heavy for any road, and traffic for too long.
fn too_much(scene: &Scene) -> Vec<String> {
    let weights = scene.vehicles.iter().map(|traffic| traffic.vehicle.weight());
    let heavy = weights.enumerate().filter(|(_, weight)| *weight > HEAVIEST);
    let heavy = heavy.map(|(index, weight)| {
        let tonnes = weight / 9806.65;
        format!("`vehicles.{index}` weighs {tonnes:.0} t, more than any vehicle on a road")
    });
    let years = scene.traffic.years_after(scene.traffic.passes);
    let old = years.filter(|&years| years > OLDEST).map(|years| {
        format!("`traffic` lasts {years:.0} years: `traffic.years` is a number of years, not a date")
    });
    heavy.chain(old).collect()
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
    let ([top, _], [_, above]) = (ends(first.modulus()), ends(last.modulus()));
    let (base, index) = match ground.profile.base() {
        Base::HalfSpace(base) => (base.young_modulus(), layers.len()),
        Base::Rigid => (above, layers.len() - 1),
    };
    if above > CONTRAST * base {
        return Some(format!(
            "`ground.layers.{index}.young_modulus` is {:.0} times less than that of the layer on it",
            above / base
        ));
    }
    (first.thickness() <= PAVEMENT && base > INVERTED * top).then(|| {
        format!(
            "`ground.layers.0.young_modulus` is {:.0} times less than that of the last layer, {} MPa: layers stand from the top \
             down, and the last one is rarely as stiff as rock",
            base / top,
            four_digits(base / 1e6)
        )
    })
}
