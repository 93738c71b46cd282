//! What is valid and yet hardly meant: values that no ground, cable or road has.
//!
//! A range refuses what the models cannot represent. Between it and what is built lie slips of a unit or a digit, which are
//! warnings.

use ground_field::{Base, Modulus, SoilProfile};

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
/// Friction coefficients of cables in ducts are below 1.
const ROUGHEST: f64 = 1.5;
/// Where it is farther than this number of depths from the vehicle's axis to the duct's axis, a duct hardly moves.
const FARTHEST: f64 = 10.0;

/// Depths \[m\] between which ducts lie below roads, weights \[N/m\] and axial stiffnesses \[N\] between which power cables lie.
const DEPTHS: (f64, f64) = (0.2, 20.0);
const WEIGHTS: (f64, f64) = (5.0, 600.0);
const AXIAL_STIFFNESSES: (f64, f64) = (5e5, 1e9);
/// Springs and clamps softer than this \[N/m\] hold nothing.
const SLACK: f64 = 1e3;
/// Friction that builds up more slowly than with this shape factor \[1/m\] needs movements that no traffic makes.
const SLOW: f64 = 1e4;
/// Radii \[m\] of what a wheel presses on are a quarter of this.
const LARGEST_RADIUS: f64 = 0.6;
/// Vehicles heavier than this \[N\] do not drive, nor any with such a wheel \[N\] or so fast \[m/s\], on a road with more than so many a day
/// and for so many years.
const HEAVIEST: f64 = 5e6;
const HEAVIEST_WHEEL: f64 = 5e5;
const FASTEST: f64 = 200.0 / 3.6;
const BUSIEST: f64 = 2e5;
const OLDEST: f64 = 200.0;

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
    warnings.extend(sizes(scene));
    warnings.extend(springs(scene));
    warnings.extend(traffic(scene));
    warnings.extend(far(scene));
    warnings.extend(lanes_scaled_alike(scene));
    warnings.iter().map(|warning| with_count(warning)).collect()
}

/// Sizes of the duct and its cable.
fn sizes(scene: &Scene) -> impl Iterator<Item = String> {
    let Scene {
        duct,
        cable,
        friction,
        ..
    } = scene;
    let within = |key, value: f64, (least, most), (size, unit), of| {
        let outside = !(least..=most).contains(&value);
        let shown = |value: f64| four_digits(value / size);
        outside.then(|| {
            format!(
                "`{key}` is {} {unit}, but {of} from {} to {} {unit}",
                shown(value),
                shown(least),
                shown(most)
            )
        })
    };
    let metres = (1.0, "m");
    let depth = within(
        "duct.depth",
        duct.depth,
        DEPTHS,
        metres,
        "ducts lie below roads at depths",
    );
    let cables = "that of power cables is";
    let short = (duct.depth > duct.length).then(|| {
        format!(
            "`duct.depth` is {} m, more than the duct is long, {} m: were they exchanged?",
            four_digits(duct.depth),
            four_digits(duct.length)
        )
    });
    let weight = within("cable.weight", cable.weight, WEIGHTS, (1.0, "N/m"), cables);
    let (stiffness, meganewtons) = (cable.axial_stiffness, (1e6, "MN"));
    let stiffness = within(
        "cable.axial_stiffness",
        stiffness,
        AXIAL_STIFFNESSES,
        meganewtons,
        cables,
    );
    let slow = match friction.law {
        FrictionLaw::ElasticPlastic { shape_factor } if shape_factor < SLOW => Some(format!(
            "`friction.shape_factor` is {shape_factor} 1/m: friction builds up over {} mm, more than traffic moves a cable to and fro",
            four_digits(2e3 / shape_factor)
        )),
        _ => None,
    };
    [depth, short, weight, stiffness, slow].into_iter().flatten()
}

/// Springs and clamps that hold nothing.
fn springs(scene: &Scene) -> impl Iterator<Item = String> {
    let of_end = |end| match end {
        End::Spring(stiffness) => Some(stiffness),
        _ => None,
    };
    let ends = [
        ("upstream", scene.ends.upstream),
        ("downstream", scene.ends.downstream),
    ];
    let ends = ends
        .into_iter()
        .filter_map(move |(name, end)| Some((format!("ends.{name}.spring"), of_end(end)?)));
    let clamps = scene.restraints.iter().enumerate();
    let clamps = clamps.map(|(index, clamp)| (format!("restraints.{index}.stiffness"), clamp.stiffness));
    let slack = ends.chain(clamps).filter(|(_, stiffness)| *stiffness < SLACK);
    slack.map(|(key, stiffness)| {
        let stiffness = four_digits(stiffness);
        format!(
            "`{key}` is {stiffness} N/m, which holds nothing: springs and clamps are from 0.1 to 1000 MN/m; did you mean \"{stiffness} MN/m\"?"
        )
    })
}

/// What drives, and how much of it.
fn traffic(scene: &Scene) -> Vec<String> {
    let mut warnings = Vec::new();
    for (index, vehicle) in scene.vehicles.iter().map(|traffic| &traffic.vehicle).enumerate() {
        let tonnes = vehicle.weight() / 9806.65;
        if vehicle.weight() > HEAVIEST {
            warnings.push(format!(
                "`vehicles.{index}` weighs {tonnes:.0} t, more than any vehicle on a road"
            ));
        }
        let wheels = vehicle.wheels();
        let forces = wheels.iter().map(|wheel| wheel.load.force());
        if let Some((wheel, force)) = forces.enumerate().find(|(_, force)| *force > HEAVIEST_WHEEL)
            && wheels.len() > 1
        {
            warnings.push(format!(
                "`vehicles.{index}.wheels.{wheel}.load` is {} kN, but a wheel on a road carries from 1 to 200 kN",
                four_digits(force / 1e3)
            ));
        }
        let speed = vehicle.speed();
        if speed > FASTEST {
            warnings.push(format!(
                "`vehicles.{index}.speed` is {} km/h, but trucks drive at 20 to 100 km/h",
                four_digits(3.6 * speed)
            ));
        }
        let radii = wheels.iter().map(|wheel| wheel.load.contact_radius());
        if let Some((wheel, radius)) = radii.enumerate().find(|(_, radius)| *radius > LARGEST_RADIUS) {
            warnings.push(format!(
                "`vehicles.{index}.wheels.{wheel}.contact_radius` is {radius} m: that of tyres is from 0.1 to 0.3 m"
            ));
        }
    }
    let per_day = scene.traffic.per_day;
    if let Some(per_day) = per_day.filter(|&per_day| per_day > BUSIEST) {
        warnings.push(format!(
            "`traffic.per_day` is {per_day}: no road has more than {BUSIEST} vehicles a day"
        ));
    }
    if let Some(years) = scene
        .traffic
        .years_after(scene.traffic.passes)
        .filter(|&years| years > OLDEST)
    {
        warnings.push(format!(
            "`traffic` lasts {years:.0} years: `traffic.years` is a number of years, not a date"
        ));
    }
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
