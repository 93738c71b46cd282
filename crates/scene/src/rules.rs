//! What holds between the values of a scene, each of which is in its own range.

use std::ops::RangeInclusive;

use cable_dem::End;
use ground_field::Modulus;

use crate::arrangement::CLOSEST;
use crate::cable::Law;
use crate::error::{SceneError, WrongKind, did_you_mean};
use crate::ground::{Ground, GroundModel};
use crate::key::listed;
use crate::nearest::nearest;
use crate::range::{
    AXIAL_STIFFNESS, DIAMETER, INNER_DIAMETER, PASSES, Quantity, SHAPE_FACTOR, THICKNESS, shown,
};
use crate::scene::{Scene, VEHICLES};
use crate::shown::four_digits;
use crate::solver::SolverMethod;

type Checked = Result<(), SceneError>;

/// The first rule that the scene breaks.
pub fn check(scene: &Scene) -> Checked {
    ground(&scene.ground)?;
    given(scene)?;
    lengths(scene)?;
    slope(scene)?;
    vehicles(scene)?;
    sequence(scene)?;
    heat(scene)
}

/// Refuses what was `found` at `key` unless it `holds`.
fn hold(holds: bool, key: &str, found: &str, allowed: &str) -> Checked {
    let error = (!holds).then(|| SceneError::value(key, found, allowed));
    error.map_or(Ok(()), Err)
}

/// Refuses a quantity that is left out, and says what else there is.
fn need(is_given: bool, key: &str, quantity: Quantity, or: &str) -> Checked {
    let error = (!is_given).then(|| SceneError::missing(key, quantity.allowed() + or));
    error.map_or(Ok(()), Err)
}

/// Refuses a length outside the range that follows from the rest of the scene.
fn suits(key: &str, value: f64, range: RangeInclusive<f64>, allowed: &str) -> Checked {
    if range.contains(&value) {
        return Ok(());
    }
    let found = format!("\"{value:?} m\"");
    Err(SceneError::wrong(WrongKind::OutOfRange, key, found, allowed))
}

/// Keys that one of several ways to give a value needs.
fn given(scene: &Scene) -> Checked {
    let (cable, friction, traffic) = (&scene.cable, &scene.friction, &scene.traffic);
    let follows = cable.arrangement.is_of_three() && cable.normal_load_factor.is_none();
    let diameter = !follows || cable.diameter.is_some();
    let inner = !follows || scene.duct.inner_diameter.is_some();
    let stiffness = cable.axial_stiffness != 0.0;
    let shape = friction.law == Law::Coulomb || friction.shape_factor.is_some();
    let (no_shape, years) = ("; law = \"coulomb\" needs none", ", or `years` with `per_day`");
    need(stiffness, "cable.axial_stiffness", AXIAL_STIFFNESS, "")?;
    need(inner, "duct.inner_diameter", INNER_DIAMETER, "")?;
    need(diameter, "cable.diameter", DIAMETER, "")?;
    need(shape, "friction.shape_factor", SHAPE_FACTOR, no_shape)?;
    need(traffic.passes > 0, "traffic.passes", PASSES, years)?;
    if scene.vehicles.is_empty() {
        return Err(SceneError::missing("vehicles", VEHICLES));
    }
    Ok(())
}

fn ground(ground: &Ground) -> Checked {
    let graded = |modulus| matches!(modulus, Modulus::Linear { .. });
    let (above, last) = (ground.upper_thickness(), ground.layers.len().saturating_sub(1));
    for (index, layer) in ground.layers.iter().enumerate() {
        let key = |name: &str| format!("ground.layers.{index}.{name}");
        if index < last {
            need(layer.thickness.is_some(), &key("thickness"), THICKNESS, "")?;
            continue;
        }
        let found = format!("{} m", shown(layer.thickness.unwrap_or_default()));
        let allowed = "no thickness in the last layer: it extends down to ground.rigid_base_depth, or to infinite depth";
        hold(layer.thickness.is_none(), &key("thickness"), &found, allowed)?;
        let ends = ground.rigid_base_depth.is_some() || !graded(layer.young_modulus);
        let found = "a modulus that varies with depth";
        let allowed =
            "one value in the last layer, which extends to infinite depth; or set ground.rigid_base_depth";
        hold(ends, &key("young_modulus"), found, allowed)?;
    }
    if let Some(depth) = ground.rigid_base_depth {
        let allowed = format!("a depth below the upper layers, greater than {} m", shown(above));
        let range = above + THICKNESS.least..=above + THICKNESS.most;
        suits("ground.rigid_base_depth", depth, range, &allowed)?;
    }
    let (fits, allowed) = match ground.model {
        GroundModel::Boussinesq => (
            last == 0 && ground.rigid_base_depth.is_none(),
            "\"boussinesq\" with one layer and no rigid base only; \"auto\", \"burmister\" or \"fem\" here",
        ),
        GroundModel::Burmister => (
            !ground.layers.iter().any(|layer| graded(layer.young_modulus)),
            "\"auto\" or \"fem\" if a modulus varies with depth",
        ),
        _ => return Ok(()),
    };
    let found = format!("these layers with `model` = \"{}\"", ground.model);
    hold(fits, "ground.model", &found, allowed)
}

/// Lengths that the duct and its length limit.
fn lengths(scene: &Scene) -> Checked {
    let (length, solver) = (scene.duct.length, &scene.solver);
    let [half, all] = [length / 2.0, length].map(shown);
    if let Some(spacing) = solver.node_spacing {
        let words = format!("at most half the duct's length, {half} m, and at least its five-millionth part");
        let range = length / 5e6..=length / 2.0;
        suits("solver.node_spacing", spacing, range, &words)?;
    }
    if let Some(step) = solver.vehicle_step {
        let words = format!("at most the duct's length, {all} m, and at least its ten-millionth part");
        suits("solver.vehicle_step", step, length / 1e7..=length, &words)?;
    }
    for (index, clamp) in scene.restraints.iter().enumerate() {
        let key = format!("restraints.{index}.position");
        let words = format!("a position in the duct, from 0 m to {all} m");
        suits(&key, clamp.position, 0.0..=length, &words)?;
    }
    let (Some(inner), Some(diameter)) = (scene.duct.inner_diameter, scene.cable.diameter) else {
        return Ok(());
    };
    let (mut most, wide) = (inner.next_down(), shown(inner));
    let mut words = format!("less than the duct's inner diameter, {wide} m");
    if scene.cable.arrangement.is_of_three() {
        most = inner / CLOSEST;
        words = format!("at most {most:.4} m, so that three cables fit into the duct's {wide} m");
    }
    suits("cable.diameter", diameter, 0.0..=most, &words)
}

/// A cable that nothing else holds must not slide out of its duct.
fn slope(scene: &Scene) -> Checked {
    let ends = [scene.ends.upstream, scene.ends.downstream];
    let is_held = !scene.restraints.is_empty() || ends != [End::Free; 2];
    let (drawn, limit) = (scene.body_force().abs(), scene.friction_limit());
    let slope = four_digits(100.0 * scene.duct.slope);
    let steepest = shown(limit / (scene.cable.weight * scene.duct.cosine()));
    let found = format!("{slope} % between free ends, where the cable slides out of the duct");
    let friction = format!("a slope less than what friction holds, {steepest}");
    let allowed = friction + ", or an end or a clamp that holds the cable";
    let rests = is_held || drawn == 0.0 || drawn < limit;
    hold(rests, "duct.slope", &found, &allowed)
}

fn vehicles(scene: &Scene) -> Checked {
    for (index, vehicle) in scene.vehicles.iter().enumerate() {
        let (name, key) = (&vehicle.name, |name: &str| format!("vehicles.{index}{name}"));
        let is_taken = scene.vehicles[..index].iter().any(|other| other.name == *name);
        let is_own = !is_taken && !name.trim().is_empty();
        let allowed = "a name in quotes that no other vehicle has";
        hold(is_own, &key(".name"), &format!("\"{name}\""), allowed)?;
        let is_loaded = vehicle.load.is_some() || !vehicle.wheels.is_empty();
        let allowed = "one of the two: load = \"20 tf\" or wheels = [ { load = \"50 kN\" } ]";
        hold(is_loaded, &key(""), "neither `load` nor `wheels`", allowed)?;
        let scaled = match scene.ground.longitudinal_peak {
            Some(_) => "ground.longitudinal_peak",
            None if index == 0 && scene.ground.vertical_peak.is_some() => "ground.vertical_peak",
            None => continue,
        };
        let load = key(vehicle.load.map_or(".wheels", |_| ".load"));
        let allowed = format!("a load greater than 0, which `{scaled}` can scale");
        let weighs = vehicle.weight() > 0.0;
        hold(weighs, &load, "a vehicle without load", &allowed)?;
    }
    Ok(())
}

fn sequence(scene: &Scene) -> Checked {
    let known = || scene.vehicles.iter().map(|vehicle| &*vehicle.name);
    let mut names = scene.traffic.sequence.iter().enumerate();
    let unknown = names.find(|(_, name)| !known().any(|known| known == *name));
    let Some((index, name)) = unknown else {
        return Ok(());
    };
    let found = format!("\"{name}\"{}", did_you_mean(nearest(name, known())));
    let key = format!("traffic.sequence.{index}");
    Err(SceneError::value(&key, found, listed(known())))
}

fn heat(scene: &Scene) -> Checked {
    let Some(heat) = &scene.heat else {
        return Ok(());
    };
    let pairs = heat.profile.iter().flat_map(|points| points.windows(2));
    for (index, pair) in pairs.enumerate() {
        let key = format!("heat.profile.{}.0", index + 1);
        let found = format!("\"{:?} s\"", pair[1].0);
        let ascends = pair[1].0 > pair[0].0;
        hold(ascends, &key, &found, "a time after that of the point before")?;
    }
    let (law, cold) = (scene.friction.law(), scene.warming().is_none());
    let of_law = format!("[heat] with `friction.law` = \"{}\"", law.name());
    let is_explicit = scene.solver.method == SolverMethod::Explicit;
    #[rustfmt::skip]
    let rules = [
        (heat.daily_swing.is_some() || heat.profile.is_some(), "neither `daily_swing` nor `profile`",
            "one of the two: daily_swing = \"20 K\" or profile = [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]]"),
        (scene.traffic.per_day.is_some(), "no `traffic.per_day`",
            "`per_day` in [traffic] beside [heat]: how many vehicles meet each hour's temperature"),
        (cold || law.has_memory(), &of_law,
            "\"coulomb\" or \"elastic-plastic\" beside [heat]: temperature steps need a state of rest"),
        (cold || scene.friction_limit() > 0.0, "[heat] without friction",
            "a `friction.dynamic_coefficient` greater than 0 beside [heat]"),
        (cold || !is_explicit, "[heat] with `solver.method` = \"explicit\"",
            "\"auto\", \"quasi-static\" or \"pass-law\" beside [heat]: it is computed without inertia"),
    ];
    let mut rules = rules.into_iter();
    rules.try_for_each(|(holds, found, allowed)| hold(holds, "heat", found, allowed))
}
