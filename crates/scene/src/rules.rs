//! What holds between the values of a scene, each of which is in its own range.

use cable_dem::{End, Order};

use crate::arrangement::CLOSEST;
use crate::cable_end::CableEnd;
use crate::data::{Ground, GroundModel, PeakScaling, Scene, SolverMethod};
use crate::document::joined;
use crate::error::{Wrong, WrongKind};
use crate::range::{DIAMETER, Follows, INNER_DIAMETER, diameters, node_spacings, shown, vehicle_steps};
use crate::shown::four_digits;
use crate::traffic::concentrated;

/// How far a share, or a factor relative to itself, may be from what it has to be.
const ROUNDING: f64 = 1e-9;

type Checked = Result<(), Box<Wrong>>;

/// The first rule that the scene breaks.
pub fn check(scene: &Scene) -> Checked {
    let (length, solver) = (scene.duct.length, &scene.solver);
    ground(&scene.ground)?;
    cable(scene)?;
    supports(scene)?;
    vehicles(scene)?;
    shares(scene)?;
    heat(scene)?;
    suits("solver.node_spacing", solver.node_spacing, node_spacings(length))?;
    suits("solver.vehicle_step", solver.vehicle_step, vehicle_steps(length))
}

/// Refuses what was `found` at `key` unless it `holds`.
fn hold(
    holds: bool,
    key: impl Into<String>,
    found: impl Into<String>,
    allowed: impl Into<String>,
) -> Checked {
    if holds {
        return Ok(());
    }
    Err(Wrong::value(key, found, allowed))
}

/// Refuses a length outside the range that follows from the rest of the scene.
fn suits(key: impl Into<String>, value: Option<f64>, (range, allowed): Follows) -> Checked {
    let Some(value) = value.filter(|value| !range.contains(value)) else {
        return Ok(());
    };
    let found = format!("\"{value:?} m\"");
    Err(Wrong::at(WrongKind::OutOfRange, key, found, allowed))
}

fn ground(ground: &Ground) -> Checked {
    let graded = ground.profile.layers().iter().any(|layer| layer.soil().is_none());
    let (fits, allowed) = match ground.model {
        GroundModel::Boussinesq => (
            ground.profile.homogeneous().is_some(),
            "\"boussinesq\" with one layer and no rigid base only; \"auto\", \"burmister\" or \"fem\" here",
        ),
        GroundModel::Burmister => (!graded, "\"auto\" or \"fem\" if a modulus varies with depth"),
        _ => return Ok(()),
    };
    let found = format!("these layers with `model` = \"{}\"", ground.model);
    hold(fits, "ground.model", found, allowed)
}

fn cable(scene: &Scene) -> Checked {
    let (cable, inner) = (&scene.cable, scene.duct.inner_diameter);
    let of_three = cable.arrangement.is_of_three();
    for (key, value, quantity) in [
        ("cable.diameter", cable.diameter, DIAMETER),
        ("duct.inner_diameter", inner, INNER_DIAMETER),
    ] {
        if of_three && value.is_none() {
            return Err(Wrong::missing(key, quantity.allowed()));
        }
    }
    let follows = match (cable.diameter, inner) {
        (Some(diameter), Some(inner)) => {
            suits(
                "cable.diameter",
                Some(diameter),
                diameters(inner, of_three.then_some(CLOSEST)),
            )?;
            cable.arrangement.normal_load_factor(inner, diameter)
        }
        (Some(_), None) => 1.0,
        (None, _) => return Ok(()),
    };
    let factor = cable.normal_load_factor;
    let allowed = format!(
        "{}, which follows from the arrangement and the diameters",
        shown(follows)
    );
    let right = (factor - follows).abs() <= follows * ROUNDING;
    hold(right, "cable.normal_load_factor", shown(factor), allowed)
}

/// Friction, ends and clamps: what holds the cable.
fn supports(scene: &Scene) -> Checked {
    let length = scene.duct.length;
    for (index, clamp) in scene.restraints.iter().enumerate() {
        let words = format!("a position in the duct, from 0 m to {} m", shown(length));
        suits(
            format!("restraints.{index}.position"),
            Some(clamp.position),
            (0.0..=length, words),
        )?;
    }
    let held = |end: CableEnd| end.held_in(scene) != End::Free;
    let free = scene.restraints.is_empty() && !CableEnd::ALL.into_iter().any(held);
    let (drawn, limit) = (scene.body_force().abs(), scene.friction_limit());
    let slope = four_digits(100.0 * scene.duct.slope);
    let steepest = shown(limit / (scene.cable.weight * scene.duct.cosine()));
    let found = format!("{slope} % between free ends, where the cable slides out of the duct");
    let allowed = format!(
        "a slope less than what friction holds, {steepest}, or an end or a clamp that holds the cable"
    );
    hold(
        !(free && drawn > 0.0 && drawn >= limit),
        "duct.slope",
        found,
        allowed,
    )
}

fn vehicles(scene: &Scene) -> Checked {
    let vehicles = &scene.vehicles;
    hold(!vehicles.is_empty(), "vehicles", "none", crate::keys::VEHICLES)?;
    for (index, traffic) in vehicles.iter().enumerate() {
        let vehicle = &traffic.vehicle;
        let (name, key) = (vehicle.name(), format!("vehicles.{index}"));
        let taken = vehicles[..index].iter().any(|other| other.vehicle.name() == name);
        let own = !taken && !name.trim().is_empty();
        let allowed = "a name in quotes that no other vehicle has";
        hold(own, joined(&key, "name"), format!("\"{name}\""), allowed)?;
        let scaled = match scene.ground.scaling {
            Some(PeakScaling::Longitudinal(_)) => "ground.longitudinal_peak",
            Some(PeakScaling::Vertical(_)) if index == 0 => "ground.vertical_peak",
            _ => continue,
        };
        let load = concentrated(vehicle).map_or("wheels", |_| "load");
        let load = joined(&key, load);
        let allowed = format!("a load greater than 0, which `{scaled}` can scale");
        hold(vehicle.weight() > 0.0, load, "a vehicle without load", allowed)?;
    }
    Ok(())
}

fn shares(scene: &Scene) -> Checked {
    let count = scene.vehicles.len();
    let sequence = match &scene.traffic.order {
        Order::Sequence(sequence) => Some(sequence),
        _ => None,
    };
    if let Some(sequence) = sequence {
        let beyond = sequence.iter().find(|&&index| index >= count);
        let known = beyond.is_none() && !sequence.is_empty();
        let found = beyond.map_or("an empty list".to_owned(), usize::to_string);
        hold(
            known,
            "traffic.sequence",
            found,
            format!("a vehicle's index, less than {count}"),
        )?;
    }
    let share = |(index, traffic): (usize, &crate::TrafficVehicle)| match sequence {
        Some(sequence) => sequence.iter().filter(|&&other| other == index).count() as f64,
        None => traffic.share,
    };
    let shares: Vec<f64> = scene.vehicles.iter().enumerate().map(share).collect();
    let sum: f64 = shares.iter().sum();
    for (index, (traffic, share)) in scene.vehicles.iter().zip(shares).enumerate() {
        let right = share / sum;
        let allowed = format!(
            "{}, with which all shares sum to 1 and suit a sequence",
            shown(right)
        );
        // A sequence may leave a vehicle out.
        let drives = share > 0.0 || sequence.is_some();
        let suits = drives && (traffic.share - right).abs() <= ROUNDING;
        hold(
            suits,
            format!("vehicles.{index}.share"),
            shown(traffic.share),
            allowed,
        )?;
    }
    Ok(())
}

fn heat(scene: &Scene) -> Checked {
    let Some(heat) = &scene.heat else {
        return Ok(());
    };
    if heat.daily_swing.is_some() == heat.profile.is_some() {
        let found = [
            "both `daily_swing` and `profile`",
            "neither `daily_swing` nor `profile`",
        ][usize::from(heat.profile.is_none())];
        let allowed =
            "one of the two: daily_swing = \"20 K\" or profile = [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]]";
        return hold(false, "heat", found, allowed);
    }
    if let Some(points) = &heat.profile {
        hold(
            points.len() > 1,
            "heat.profile",
            "one point",
            "two points of the day or more, their times ascending",
        )?;
        for (index, pair) in points.windows(2).enumerate() {
            let key = format!("heat.profile.{}.0", index + 1);
            let found = format!("\"{:?} s\"", pair[1].0);
            hold(
                pair[1].0 > pair[0].0,
                key,
                found,
                "a time after that of the point before",
            )?;
        }
    }
    let (law, cold) = (scene.friction.law, scene.warming().is_none());
    let of_law = format!("[heat] with `friction.law` = \"{}\"", law.name());
    let is_explicit = scene.solver.method == SolverMethod::Explicit;
    #[rustfmt::skip]
    let rules = [
        (scene.traffic.per_day.is_some(), "no `traffic.per_day`",
            "`per_day` in [traffic] beside [heat]: how many vehicles meet each hour's temperature"),
        (cold || law.has_memory(), &of_law,
            "\"coulomb\" or \"elastic-plastic\" beside [heat]: temperature steps need a state of rest"),
        (cold || scene.friction_limit() > 0.0, "[heat] without friction",
            "a `friction.dynamic_coefficient` greater than 0 beside [heat]"),
        (cold || !is_explicit, "[heat] with `solver.method` = \"explicit\"",
            "\"auto\", \"quasi-static\" or \"pass-law\" beside [heat]: it is computed without inertia"),
    ];
    rules
        .into_iter()
        .try_for_each(|(holds, found, allowed)| hold(holds, "heat", found, allowed))
}
