//! What is allowed and yet hardly meant: values that no ground, cable or road has, and numbers that were meant in another unit.
//!
//! A range refuses what the models cannot represent. Between it and what is built lie slips of a unit or a digit, which are warnings.

use ground_field::Modulus;

use crate::arrangement::JAMMING;
use crate::cable::Law;
use crate::content::{Node, without_numbers};
use crate::ground::Layer;
use crate::histogram::AXLE_GROUP;
use crate::location::counted;
use crate::names::si_unit;
use crate::scene::Scene;
use crate::shown::four_digits;
use crate::units::Dimension;
use crate::vehicle::TrafficVehicle;

/// A key, the usual range of its values \[SI\], the unit in which they are shown with its size, and what is to be said beyond.
type Usual = (&'static str, f64, f64, f64, &'static str, &'static str);

const INFINITY: f64 = f64::INFINITY;
const HOLDS_NOTHING: &str = ", which holds nothing: springs and clamps are from 0.1 to 1000 MN/m";

#[rustfmt::skip]
const USUAL: &[Usual] = &[
    ("duct.depth", 0.2, 20.0, 1.0, " m", ", but ducts lie below roads at depths from 0.2 to 20 m"),
    ("ground.layers.young_modulus", 1e6, INFINITY, 1e6, " MPa", ", softer than peat"),
    ("ground.layers.young_modulus", 0.0, 1e11, 1e9, " GPa", ", stiffer than granite"),
    ("cable.weight", 5.0, 600.0, 1.0, " N/m", ", but that of power cables is from 5 to 600 N/m"),
    ("cable.axial_stiffness", 5e5, 1e9, 1e6, " MN", ", but that of power cables is from 0.5 to 1000 MN"),
    ("friction.dynamic_coefficient", 0.0, 1.5, 1.0, "", ": that of cables in ducts is below 1"),
    ("friction.shape_factor", 1e4, INFINITY, 1.0, " 1/m", ": friction builds up over more than traffic moves a cable to and fro"),
    ("ends.upstream.spring", 1e3, INFINITY, 1.0, " N/m", HOLDS_NOTHING),
    ("ends.downstream.spring", 1e3, INFINITY, 1.0, " N/m", HOLDS_NOTHING),
    ("restraints.stiffness", 1e3, INFINITY, 1.0, " N/m", HOLDS_NOTHING),
    ("vehicles.speed", 0.0, 200.0 / 3.6, 1.0 / 3.6, " km/h", ", but trucks drive at 20 to 100 km/h"),
    ("vehicles.load", 0.0, 5e6, 1e3, " kN", ", more than any vehicle on a road weighs"),
    ("vehicles.wheels.load", 0.0, 5e5, 1e3, " kN", ", but a wheel on a road carries from 1 to 200 kN"),
    ("vehicles.wheels.contact_radius", 0.0, 0.6, 1.0, " m", ": that of tyres is from 0.1 to 0.3 m"),
    ("traffic.per_day", 0.0, 2e5, 1.0, "", ": no road has more than 200000 vehicles a day"),
    ("heat.daily_swing", 0.0, 100.0, 1.0, " K", ", but a cable's temperature changes by less than 100 K a day"),
];

/// The last word of a key, the range in which a bare number \[SI\] is hardly meant in SI, and the units in which it may be.
type Bare = (&'static str, f64, f64, &'static str);

const BARE: &[Bare] = &[
    ("load", f64::MIN_POSITIVE, 999.9, "tf or kN"),
    ("speed", 130.0 / 3.6, INFINITY, "km/h"),
    ("weight", 0.0, 20.0, "kg/m"),
    ("young_modulus", 0.0, 1e5, "MPa"),
    ("spring", 0.0, 1e3, "MN/m"),
    ("stiffness", 0.0, 1e3, "MN/m"),
];

/// A warning for every value that is unusual, and for values that are so together.
pub fn unusual(scene: &Scene) -> Vec<String> {
    let mut warnings: Vec<String> = Vec::new();
    // Friction that forgets may build up slowly.
    let forgets = scene.friction.law != Law::ElasticPlastic;
    for (key, node) in scene.node().values("") {
        let quantity = |text: &str| text.split_once(' ')?.0.parse().ok();
        let text = node.content.as_text();
        let Some(value) = text.map_or(node.content.as_number(), quantity) else {
            continue;
        };
        let name = without_numbers(&key);
        let name = name.trim_end_matches(".top").trim_end_matches(".bottom");
        for (_, least, most, size, unit, words) in USUAL.iter().filter(|usual| usual.0 == name) {
            // Of the wheels the first is named that is unusual.
            let again = key.contains(".wheels.") && warnings.iter().any(|warning| warning.ends_with(words));
            let is_usual = (*least..=*most).contains(&value) || name == "friction.shape_factor" && forgets;
            if !is_usual && !again {
                let value = four_digits(value / size);
                warnings.push(of(&key, &format!(" is {value}{unit}{words}")));
            }
        }
    }
    warnings.extend(together(scene));
    warnings.extend(contrast(scene));
    warnings
}

/// A warning of a key, with the items that it names counted from 1.
fn of(key: &str, words: &str) -> String {
    format!("`{key}`{}{words}", counted(key))
}

/// What is to be said of values that are unusual together.
#[rustfmt::skip]
fn together(scene: &Scene) -> Vec<String> {
    // Depths between the vehicle's axis and the duct's beyond which a duct hardly moves; years that no road is old.
    const FARTHEST: f64 = 10.0;
    const OLDEST: f64 = 200.0;
    // Weight of a vehicle on many wheels [N] that is more than any road bears.
    const HEAVIEST: f64 = 5e6;
    let (duct, ground, vehicles) = (&scene.duct, &scene.ground, &scene.vehicles);
    let [depth, length] = [duct.depth, duct.length].map(four_digits);
    let mut said = Vec::new();
    if duct.depth > duct.length {
        said.push(format!("`duct.depth` is {depth} m, more than the duct is long, {length} m: were they exchanged?"));
    }
    let distance = |vehicle: &TrafficVehicle| scene.offset_from(vehicle).abs();
    if let Some(far) = vehicles.iter().find(|vehicle| distance(vehicle) > FARTHEST * duct.depth) {
        said.push(format!("`duct.lateral_offset`: the lane of \"{}\" is {} m from the duct, more than {FARTHEST} times the depth: the duct \
            hardly moves there", far.name, distance(far)));
    }
    let is_heavy = |vehicle: &&TrafficVehicle| vehicle.weight() > HEAVIEST && !vehicle.wheels.is_empty();
    if let Some(heavy) = vehicles.iter().find(is_heavy) {
        said.push(format!("`vehicles`: \"{}\" weighs {:.0} t on all its wheels, more than any vehicle on a road", heavy.name,
            heavy.weight() / 9806.65));
    }
    if let Some(between) = vehicles.iter().find(|vehicle| is_between_wheels(scene, vehicle)) {
        said.push(format!("`duct.depth` is {depth} m between the wheels of \"{}\", which are farther to either side: so shallow, the ground \
            moves toward a wheel and not away from it, and the cable may creep backward", between.name));
    }
    let mut lanes = vehicles.windows(2).map(|pair| pair[0].lateral_offset != pair[1].lateral_offset);
    if ground.longitudinal_peak.is_some() && lanes.any(|is_other| is_other) {
        said.push("`ground.longitudinal_peak` is the peak under every vehicle, in whatever lane: one in a lane farther away moves the duct \
            as far; `ground.vertical_peak` keeps the lanes apart".into());
    }
    if let Some(rock) = ground.rigid_base_depth.filter(|rock| *rock <= duct.depth) {
        said.push(format!("`ground.rigid_base_depth` is {rock} m and the duct lies at {depth} m, within the rock: it does not move, and no \
            force arises"));
    }
    let ratio = duct.inner_diameter.zip(scene.cable.diameter).map(|(inner, outer)| inner / outer);
    if let Some(ratio) = ratio.filter(|ratio| scene.cable.arrangement.is_of_three() && JAMMING.contains(ratio)) {
        said.push(format!("`duct.inner_diameter` is {ratio:.2} times `cable.diameter`: from {} to {} times three cables may jam as they are \
            pulled in", JAMMING.start(), JAMMING.end()));
    }
    let years = scene.traffic.years_after(scene.traffic.passes);
    if let Some(years) = years.filter(|years| *years > OLDEST) {
        said.push(format!("`traffic` lasts {years:.0} years: `traffic.years` is a number of years, not a date"));
    }
    if vehicles.iter().any(|vehicle| vehicle.name.starts_with(AXLE_GROUP)) {
        said.push("`traffic.histogram` has a column of groups of axles: each row is computed as one axle, which moves the cable more than a \
            tandem or a tridem of the same weight; divide their loads and multiply their numbers".into());
    }
    said
}

/// Whether a shallow duct lies between the wheels of a vehicle: beside a load the ground near the surface moves toward it, not away.
fn is_between_wheels(scene: &Scene, vehicle: &TrafficVehicle) -> bool {
    let wheels = vehicle.wheels();
    let aside = || wheels.iter().map(|wheel| wheel.y - scene.offset_from(vehicle));
    aside().any(|y| y > 0.0) && aside().any(|y| y < 0.0) && aside().all(|y| y.abs() > scene.duct.depth)
}

/// Layers that may have been written in the wrong order.
fn contrast(scene: &Scene) -> Option<String> {
    // How many times stiffer a layer is than the soil below it, and the ground below than a pavement, if that is hardly meant;
    // and the thickest first layer that is a pavement's [m].
    const CONTRAST: f64 = 100.0;
    const INVERTED: f64 = 20.0;
    const PAVEMENT: f64 = 0.5;
    let top_and_bottom = |layer: &Layer| match layer.young_modulus {
        Modulus::Uniform(modulus) => [modulus, modulus],
        Modulus::Linear { top, bottom } => [top, bottom],
    };
    let (last, upper) = scene.ground.layers.split_last()?;
    let (first, below) = (upper.first()?, upper.len());
    let ([top, _], [_, above]) = (top_and_bottom(first), top_and_bottom(upper.last()?));
    let [base, _] = top_and_bottom(last);
    if above > CONTRAST * base {
        let words = format!(" is {:.0} times less than that of the layer on it", above / base);
        return Some(of(&format!("ground.layers.{below}.young_modulus"), &words));
    }
    let is_pavement = first.thickness.is_some_and(|thickness| thickness <= PAVEMENT);
    let (times, last) = (base / top, four_digits(base / 1e6));
    let words = format!(
        " is {times:.0} times less than that of the last layer, {last} MPa: layers stand from the top down, and the last one is rarely as \
         stiff as rock"
    );
    (is_pavement && base > INVERTED * top).then(|| of("ground.layers.0.young_modulus", &words))
}

/// The warning for a number without a unit that was meant in another one than SI, `load = 20` in tonnes or `speed = 40` in km/h, and for
/// decimals that may be thousands, `passes = 292.000`, and for a mass that stands for a weight.
pub fn slip(key: &str, node: &Node) -> Option<String> {
    let (name, found) = (key.rsplit('.').next()?, &node.written());
    if let (Some(text), "weight") = (node.content.as_text(), name) {
        let is_mass = text.to_lowercase().replace("kgf", "").contains("kg");
        let weight = four_digits(Dimension::Weight.parse(text).ok()?);
        let words = format!(": {found} is a mass per length: times g it weighs {weight} N/m");
        return is_mass.then(|| of(key, &words));
    }
    let value = node.content.as_number()?;
    let is_meant = |bare: &&Bare| bare.0 == name && (bare.1..=bare.2).contains(&value);
    if let Some((.., units)) = BARE.iter().find(is_meant) {
        let unit = si_unit(key)?;
        let words = format!(": {found} without a unit is {value} {unit}: did you mean {units}?");
        return Some(of(key, &words));
    }
    // Three digits behind a point may be thousands.
    let (_, digits) = found.split_once('.').filter(|_| name == "passes")?;
    let is_thousands = digits.len() == 3 && digits.parse::<u16>().is_ok();
    let meant = found.replace('.', "");
    let words = format!(": {found} is {value}, as decimals follow a point: did you mean {meant}?");
    is_thousands.then(|| of(key, &words))
}
