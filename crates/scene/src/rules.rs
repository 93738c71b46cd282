//! What holds between the values of a scene, each of which is in its own range.

use cable_dem::End;
use ground_field::Modulus;

use crate::arrangement::CLOSEST;
use crate::cable_end::CableEnd;
use crate::content::joined;
use crate::error::{SceneError, WrongKind, did_you_mean};
use crate::friction::Law;
use crate::ground::{Ground, GroundModel, PeakScaling};
use crate::key::listed;
use crate::nearest::nearest;
use crate::range::{
    AXIAL_STIFFNESS, DIAMETER, Follows, INNER_DIAMETER, PASSES, SHAPE_FACTOR, THICKNESS, diameters,
    node_spacings, shown, vehicle_steps,
};
use crate::scene::{Scene, VEHICLES};
use crate::shown::four_digits;
use crate::solver::SolverMethod;

type Checked = Result<(), SceneError>;

/// The first rule that the scene breaks.
pub fn check(scene: &Scene) -> Checked {
    let (length, solver) = (scene.duct.length, &scene.solver);
    ground(&scene.ground)?;
    given(scene)?;
    cable(scene)?;
    supports(scene)?;
    vehicles(scene)?;
    sequence(scene)?;
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
    Err(SceneError::value(key, found, allowed))
}

/// Refuses a length outside the range that follows from the rest of the scene.
fn suits(key: impl Into<String>, value: Option<f64>, (range, allowed): Follows) -> Checked {
    let Some(value) = value.filter(|value| !range.contains(value)) else {
        return Ok(());
    };
    let found = format!("\"{value:?} m\"");
    Err(SceneError::wrong(WrongKind::OutOfRange, key, found, allowed))
}

/// Keys that one of several ways to give a value needs.
fn given(scene: &Scene) -> Checked {
    let (cable, friction) = (&scene.cable, &scene.friction);
    let of_three = cable.arrangement.is_of_three() && cable.normal_load_factor.is_none();
    let no_factor = friction.law != Law::Coulomb && friction.shape_factor.is_none();
    let inner = scene.duct.inner_diameter;
    for (is_missing, key, allowed) in [
        (
            cable.axial_stiffness == 0.0,
            "cable.axial_stiffness",
            AXIAL_STIFFNESS.allowed(),
        ),
        (
            of_three && cable.diameter.is_none(),
            "cable.diameter",
            DIAMETER.allowed(),
        ),
        (
            of_three && inner.is_none(),
            "duct.inner_diameter",
            INNER_DIAMETER.allowed(),
        ),
        (
            no_factor,
            "friction.shape_factor",
            SHAPE_FACTOR.allowed() + "; law = \"coulomb\" needs none",
        ),
        (scene.vehicles.is_empty(), "vehicles", VEHICLES.to_owned()),
        (
            scene.traffic.passes == 0,
            "traffic.passes",
            PASSES.allowed() + ", or `years` with `per_day`",
        ),
    ] {
        if is_missing {
            return Err(SceneError::missing(key, allowed));
        }
    }
    Ok(())
}

fn ground(ground: &Ground) -> Checked {
    let Some((last, upper)) = ground.layers.split_last() else {
        return Ok(());
    };
    if let Some(index) = upper.iter().position(|layer| layer.thickness.is_none()) {
        return Err(SceneError::missing(
            format!("ground.layers.{index}.thickness"),
            THICKNESS.allowed(),
        ));
    }
    let key = |name: &str| format!("ground.layers.{}.{name}", upper.len());
    if let Some(thickness) = last.thickness {
        let allowed = "no thickness in the last layer: it extends down to ground.rigid_base_depth, or to infinite depth";
        return hold(
            false,
            key("thickness"),
            format!("{} m", shown(thickness)),
            allowed,
        );
    }
    let above = ground.upper_thickness();
    let graded = |modulus| matches!(modulus, Modulus::Linear { .. });
    match ground.rigid_base_depth {
        Some(depth) if !THICKNESS.contains(depth - above) => {
            let allowed = format!("a depth below the upper layers, greater than {} m", shown(above));
            let (key, found) = ("ground.rigid_base_depth", shown(depth));
            return Err(SceneError::wrong(WrongKind::OutOfRange, key, found, allowed));
        }
        None if graded(last.young_modulus) => {
            let found = "a modulus that varies with depth";
            let allowed = "one value in the last layer, which extends to infinite depth; or set ground.rigid_base_depth";
            return hold(false, key("young_modulus"), found, allowed);
        }
        _ => {}
    }
    let (fits, allowed) = match ground.model {
        GroundModel::Boussinesq => (
            ground
                .profile()
                .is_ok_and(|profile| profile.homogeneous().is_some()),
            "\"boussinesq\" with one layer and no rigid base only; \"auto\", \"burmister\" or \"fem\" here",
        ),
        GroundModel::Burmister => (
            !ground.layers.iter().any(|layer| graded(layer.young_modulus)),
            "\"auto\" or \"fem\" if a modulus varies with depth",
        ),
        _ => return Ok(()),
    };
    hold(
        fits,
        "ground.model",
        format!("these layers with `model` = \"{}\"", ground.model),
        allowed,
    )
}

fn cable(scene: &Scene) -> Checked {
    let (Some(_), Some(inner)) = (scene.cable.diameter, scene.duct.inner_diameter) else {
        return Ok(());
    };
    let closest = scene.cable.arrangement.is_of_three().then_some(CLOSEST);
    suits("cable.diameter", scene.cable.diameter, diameters(inner, closest))
}

/// Friction, ends and clamps: what holds the cable.
fn supports(scene: &Scene) -> Checked {
    let length = scene.duct.length;
    for (index, clamp) in scene.restraints.iter().enumerate() {
        let words = format!("a position in the duct, from 0 m to {} m", shown(length));
        let key = format!("restraints.{index}.position");
        suits(key, Some(clamp.position), (0.0..=length, words))?;
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
    let slides = free && drawn > 0.0 && drawn >= limit;
    hold(!slides, "duct.slope", found, allowed)
}

fn vehicles(scene: &Scene) -> Checked {
    for (index, vehicle) in scene.vehicles.iter().enumerate() {
        let (name, key) = (&vehicle.name, format!("vehicles.{index}"));
        let taken = scene.vehicles[..index].iter().any(|other| other.name == *name);
        let own = !taken && !name.trim().is_empty();
        let allowed = "a name in quotes that no other vehicle has";
        hold(own, joined(&key, "name"), format!("\"{name}\""), allowed)?;
        let load = vehicle.load.map_or("wheels", |_| "load");
        let loaded = vehicle.load.is_some() || !vehicle.wheels.is_empty();
        let allowed = "one of the two: load = \"20 tf\" or wheels = [ { load = \"50 kN\" } ]";
        hold(loaded, &*key, "neither `load` nor `wheels`", allowed)?;
        let scaled = match scene.ground.scaling() {
            Some(PeakScaling::Longitudinal(_)) => "ground.longitudinal_peak",
            Some(PeakScaling::Vertical(_)) if index == 0 => "ground.vertical_peak",
            _ => continue,
        };
        let allowed = format!("a load greater than 0, which `{scaled}` can scale");
        hold(
            vehicle.weight() > 0.0,
            joined(&key, load),
            "a vehicle without load",
            allowed,
        )?;
    }
    Ok(())
}

fn sequence(scene: &Scene) -> Checked {
    let known = || scene.vehicles.iter().map(|vehicle| &*vehicle.name);
    for (index, name) in scene.traffic.sequence.iter().enumerate() {
        let near = did_you_mean(nearest(name, known()));
        let key = format!("traffic.sequence.{index}");
        hold(
            known().any(|known| known == name),
            key,
            format!("\"{name}\"{near}"),
            listed(known()),
        )?;
    }
    Ok(())
}

fn heat(scene: &Scene) -> Checked {
    let Some(heat) = &scene.heat else {
        return Ok(());
    };
    for (index, pair) in heat
        .profile
        .iter()
        .flat_map(|points| points.windows(2))
        .enumerate()
    {
        let key = format!("heat.profile.{}.0", index + 1);
        let found = format!("\"{:?} s\"", pair[1].0);
        let ascends = pair[1].0 > pair[0].0;
        hold(ascends, key, found, "a time after that of the point before")?;
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
    rules
        .into_iter()
        .try_for_each(|(holds, found, allowed)| hold(holds, "heat", found, allowed))
}
