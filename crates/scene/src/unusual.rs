//! What is valid and yet hardly meant: values that no ground, cable or road has, and numbers that were meant in another unit.
//!
//! A range refuses what the models cannot represent. Between it and what is built lie slips of a unit or a digit, which are warnings.

use ground_field::{Base, Modulus};

use crate::arrangement::JAMMING;
use crate::cable::Law;
use crate::content::{Content, Node, without_numbers};
use crate::histogram::AXLE_GROUP;
use crate::location::counted;
use crate::range::WEIGHT;
use crate::scene::Scene;
use crate::shown::four_digits;
use crate::stored::Stored;
use crate::vehicle::TrafficVehicle;

/// A key, the usual range of its values \[SI\], the unit in which they are shown with its size, and what follows.
type Usual = (&'static str, f64, f64, f64, &'static str, fn(f64) -> String);

const INFINITY: f64 = f64::INFINITY;

#[rustfmt::skip]
const USUAL: &[Usual] = &[
    ("duct.depth", 0.2, 20.0, 1.0, " m", |_| ", but ducts lie below roads at depths from 0.2 to 20 m".into()),
    ("ground.layers.young_modulus", 1e6, INFINITY, 1e6, " MPa", softer_than_peat),
    ("ground.layers.young_modulus", 0.0, 1e11, 1e9, " GPa", |_| ", stiffer than granite".into()),
    ("cable.weight", 5.0, 600.0, 1.0, " N/m", |_| ", but that of power cables is from 5 to 600 N/m".into()),
    ("cable.axial_stiffness", 5e5, 1e9, 1e6, " MN", |_| ", but that of power cables is from 0.5 to 1000 MN".into()),
    ("friction.dynamic_coefficient", 0.0, 1.5, 1.0, "", |_| ": that of cables in ducts is below 1".into()),
    ("friction.shape_factor", 1e4, INFINITY, 1.0, " 1/m", slow),
    ("ends.upstream.spring", 1e3, INFINITY, 1.0, " N/m", holds_nothing),
    ("ends.downstream.spring", 1e3, INFINITY, 1.0, " N/m", holds_nothing),
    ("restraints.stiffness", 1e3, INFINITY, 1.0, " N/m", holds_nothing),
    ("vehicles.speed", 0.0, 200.0 / 3.6, 1.0 / 3.6, " km/h", |_| ", but trucks drive at 20 to 100 km/h".into()),
    ("vehicles.wheels.load", 0.0, 5e5, 1e3, " kN", |_| ", but a wheel on a road carries from 1 to 200 kN".into()),
    ("vehicles.wheels.contact_radius", 0.0, 0.6, 1.0, " m", |_| ": that of tyres is from 0.1 to 0.3 m".into()),
    ("traffic.per_day", 0.0, 2e5, 1.0, "", |_| ": no road has more than 200000 vehicles a day".into()),
    ("heat.daily_swing", 0.0, 100.0, 1.0, " K", |_| ", but a cable's temperature changes by less than 100 K a day".into()),
];

fn softer_than_peat(modulus: f64) -> String {
    // A bare modulus up to this [Pa] may be one in MPa.
    const MEGAPASCALS: f64 = 1e5;
    let meant = format!("; a bare number is in Pa: did you mean \"{modulus} MPa\"?");
    let meant = if modulus <= MEGAPASCALS { &meant } else { "" };
    format!(", softer than peat{meant}")
}

fn slow(shape_factor: f64) -> String {
    let length = four_digits(2e3 / shape_factor);
    format!(": friction builds up over {length} mm, more than traffic moves a cable to and fro")
}

fn holds_nothing(stiffness: f64) -> String {
    let meant = four_digits(stiffness);
    format!(
        ", which holds nothing: springs and clamps are from 0.1 to 1000 MN/m; did you mean \"{meant} MN/m\"?"
    )
}

/// A warning for every value that is unusual, and for values that are so together.
pub fn unusual(scene: &Scene) -> Vec<String> {
    let mut warnings = Vec::new();
    let mut named: Vec<&str> = Vec::new();
    Node::from(scene.write()).each_value("", &mut |key, node| {
        let Some(value) = node.content.as_number() else {
            return;
        };
        let name = without_numbers(key);
        let name = name.trim_end_matches(".top").trim_end_matches(".bottom");
        // Friction that forgets may build up slowly.
        let forgets = name == "friction.shape_factor" && scene.friction.law != Law::ElasticPlastic;
        for (key_of, least, most, size, unit, words) in USUAL.iter().filter(|usual| usual.0 == name) {
            // Of the wheels the first is named that is unusual.
            let again = named.contains(key_of) && key.contains(".wheels.");
            if !(*least..=*most).contains(&value) && !forgets && !again {
                named.push(key_of);
                let in_unit = four_digits(value / size);
                warnings.push(of(key, &format!(" is {in_unit}{unit}{}", words(value))));
            }
        }
    });
    #[rustfmt::skip]
    let pairs = [exchanged, far, between_tracks, lanes_scaled_alike, rock, contrast, may_jam, too_heavy, too_long, grouped];
    warnings.extend(pairs.iter().filter_map(|pair| pair(scene)));
    warnings
}

/// A warning of a key, with the items that it names counted from 1.
fn of(key: &str, words: &str) -> String {
    format!("`{key}`{}{words}", counted(key))
}

/// A duct that lies deeper than it is long.
fn exchanged(scene: &Scene) -> Option<String> {
    let (depth, length) = (scene.duct.depth, scene.duct.length);
    let [deep, long] = [depth, length].map(four_digits);
    let words =
        format!("`duct.depth` is {deep} m, more than the duct is long, {long} m: were they exchanged?");
    (depth > length).then_some(words)
}

/// Three cables that may wedge themselves.
fn may_jam(scene: &Scene) -> Option<String> {
    let ratio = scene.duct.inner_diameter? / scene.cable.diameter?;
    let jams = scene.cable.arrangement.is_of_three() && JAMMING.contains(&ratio);
    let (from, to) = (JAMMING.start(), JAMMING.end());
    jams.then(|| {
        format!(
            "`duct.inner_diameter` is {ratio:.2} times `cable.diameter`: from {from} to {to} times three cables may jam as they are pulled in"
        )
    })
}

/// A vehicle too heavy for any road.
fn too_heavy(scene: &Scene) -> Option<String> {
    const HEAVIEST: f64 = 5e6;
    let weights = scene.vehicles.iter().map(TrafficVehicle::weight);
    let (index, weight) = weights.enumerate().find(|(_, weight)| *weight > HEAVIEST)?;
    let words = format!(
        " weighs {:.0} t, more than any vehicle on a road",
        weight / 9806.65
    );
    Some(of(&format!("vehicles.{index}"), &words))
}

/// A table of axles that were weighed in groups.
fn grouped(scene: &Scene) -> Option<String> {
    let mut names = scene.vehicles.iter().map(|vehicle| &vehicle.name);
    names.any(|name| name.starts_with(AXLE_GROUP)).then(|| {
        "`traffic.histogram` has a column of groups of axles: each row is computed as one axle, which moves the cable more than a tandem or a \
         tridem of the same weight; divide their loads and multiply their numbers"
            .into()
    })
}

/// Traffic for longer than any road is old.
fn too_long(scene: &Scene) -> Option<String> {
    const OLDEST: f64 = 200.0;
    let years = scene.traffic.years_after(scene.traffic.passes)?;
    let words = format!("`traffic` lasts {years:.0} years: `traffic.years` is a number of years, not a date");
    (years > OLDEST).then_some(words)
}

/// A lane so far away that its vehicles hardly move the duct.
fn far(scene: &Scene) -> Option<String> {
    // Depths between the vehicle's axis and the duct's, beyond which a duct hardly moves.
    const FARTHEST: f64 = 10.0;
    let offset = |vehicle: &TrafficVehicle| scene.offset_from(vehicle).abs();
    let is_far = |vehicle: &&TrafficVehicle| offset(vehicle) > FARTHEST * scene.duct.depth;
    let vehicle = scene.vehicles.iter().find(is_far)?;
    let (name, offset) = (&vehicle.name, offset(vehicle));
    let subject = match vehicle.lateral_offset {
        0.0 => format!("`duct.lateral_offset` is {offset} m"),
        _ => format!("the lane of \"{name}\" is {offset} m from the duct"),
    };
    Some(format!(
        "{subject}, more than {FARTHEST} times the depth: the duct hardly moves there"
    ))
}

/// A shallow duct between the wheels of a vehicle: beside a load the ground near the surface moves toward it, not away.
fn between_tracks(scene: &Scene) -> Option<String> {
    let depth = scene.duct.depth;
    let vehicle = scene.vehicles.iter().find(|vehicle| {
        let offset = scene.offset_from(vehicle);
        let aside: Vec<f64> = vehicle.wheels().iter().map(|wheel| wheel.y - offset).collect();
        let (left, right) = (
            aside.iter().any(|y| *y > depth),
            aside.iter().any(|y| *y < -depth),
        );
        left && right && aside.iter().all(|y| y.abs() > depth)
    })?;
    Some(format!(
        "`duct.depth` is {} m between the wheels of \"{}\", which are farther to either side: so shallow, the ground moves toward a wheel \
         and not away from it, and the cable may creep backward",
        four_digits(depth),
        vehicle.name
    ))
}

/// Lanes move a duct by different amounts, but a longitudinal peak is that of each vehicle.
fn lanes_scaled_alike(scene: &Scene) -> Option<String> {
    scene.ground.longitudinal_peak?;
    let lanes = || scene.vehicles.iter().map(|vehicle| vehicle.lateral_offset);
    let words = "`ground.longitudinal_peak` is the peak under every vehicle, in whatever lane: one in a lane farther away moves the duct \
                 as far; `ground.vertical_peak` keeps the lanes apart";
    lanes()
        .any(|lane| Some(lane) != lanes().next())
        .then(|| words.to_owned())
}

/// Rock does not move, and so nothing in it does.
fn rock(scene: &Scene) -> Option<String> {
    let (base, depth) = (scene.ground.rigid_base_depth?, scene.duct.depth);
    (base <= depth).then(|| {
        format!(
            "`ground.rigid_base_depth` is {base} m and the duct lies at {depth} m, within the rock: it does not move, and no force arises"
        )
    })
}

/// Layers that may have been written in the wrong order.
fn contrast(scene: &Scene) -> Option<String> {
    // How many times stiffer a layer is than the soil below it, and the ground below than a pavement, if that is hardly meant;
    // and the thickest first layer that is a pavement's [m].
    const CONTRAST: f64 = 100.0;
    const INVERTED: f64 = 20.0;
    const PAVEMENT: f64 = 0.5;
    let profile = scene.ground.profile().ok()?;
    let layers = profile.layers();
    let ends = |modulus: Modulus| match modulus {
        Modulus::Uniform(modulus) => (modulus, modulus),
        Modulus::Linear { top, bottom } => (top, bottom),
    };
    let (first, last) = (layers.first()?, layers.last()?);
    let ((top, _), (_, above)) = (ends(first.modulus()), ends(last.modulus()));
    let (base, index) = match profile.base() {
        Base::HalfSpace(base) => (base.young_modulus(), layers.len()),
        Base::Rigid => (above, layers.len() - 1),
    };
    let key = |index: usize| format!("ground.layers.{index}.young_modulus");
    if above > CONTRAST * base {
        let words = format!(" is {:.0} times less than that of the layer on it", above / base);
        return Some(of(&key(index), &words));
    }
    let (times, last) = (base / top, four_digits(base / 1e6));
    (first.thickness() <= PAVEMENT && base > INVERTED * top).then(|| {
        let words = format!(
            " is {times:.0} times less than that of the last layer, {last} MPa: layers stand from the top down, and the last one is rarely \
             as stiff as rock"
        );
        of(&key(0), &words)
    })
}

/// The warning for a number without a unit that was meant in another one than SI, `load = 20` in tonnes or `speed = 40` in km/h, for decimals
/// that may be thousands, `passes = 292.000`, and for a mass that stands for a weight.
pub fn slip(key: &str, node: &Node) -> Option<String> {
    let words = meant(key.rsplit('.').next()?, &node.content, &node.written)?;
    Some(of(key, &format!(": {words}")))
}

fn meant(key: &str, content: &Content, found: &str) -> Option<String> {
    // Lighter than any vehicle [N], faster than any truck [m/s], and a weight per length that may be a mass [N/m].
    const LIGHT: f64 = 1e3;
    const FAST: f64 = 130.0 / 3.6;
    const LIGHT_CABLE: f64 = 20.0;
    if let (Some(text), "weight") = (content.as_text(), key) {
        let is_mass = text.to_lowercase().replace("kgf", "").contains("kg");
        let weight = four_digits(WEIGHT.dimension?.parse(text).ok()?);
        return is_mass.then(|| format!("{found} is a mass per length: times g it weighs {weight} N/m"));
    }
    let value = content.as_number()?;
    let is_thousands = |(_, digits): (&str, &str)| digits.len() == 3 && digits.parse::<u16>().is_ok();
    let (value, meant) = match key {
        "load" if value > 0.0 && value < LIGHT => (
            format!("{value} N, less than 1 kN"),
            format!("\"{found} tf\" or \"{found} kN\""),
        ),
        "speed" if value > FAST => (
            format!("{value} m/s, {:.0} km/h", 3.6 * value),
            format!("\"{found} km/h\""),
        ),
        "weight" if value < LIGHT_CABLE => (format!("{value} N/m"), format!("\"{found} kg/m\"")),
        "passes" if found.split_once('.').is_some_and(is_thousands) => (
            format!("{value} passes, since decimals follow a point"),
            found.replace('.', ""),
        ),
        _ => return None,
    };
    Some(format!(
        "{found} without a unit is {value}: did you mean {meant}?"
    ))
}
