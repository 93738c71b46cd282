//! What holds between the values of a scene, each of which is in its own range.

use std::ops::RangeInclusive;

use cable_dem::{End, Restraint};
use ground_field::Modulus;

use crate::arrangement::CLOSEST;
use crate::cable::Law;
use crate::error::{Result, SceneError, did_you_mean};
use crate::ground::{GroundModel, Layer};
use crate::nearest::nearest;
use crate::range::{self, Quantity};
use crate::scene::{Scene, VEHICLES};
use crate::shown::{four_digits, listed, shown};
use crate::solver::SolverMethod;

/// Makes sure that the scene breaks no rule.
pub fn check(scene: &Scene) -> Result<()> {
    let all = [
        given, ground, lengths, clamps, route, slope, vehicles, sequence, heat,
    ];
    all.iter().try_for_each(|rules| rules(scene))
}

/// A rule, with the key at which it is broken if it does not hold.
fn rule(holds: bool, key: &str, found: impl AsRef<str>, allowed: impl Into<String>) -> Result<()> {
    let broken = || SceneError::value(key, found, allowed);
    holds.then_some(()).ok_or_else(broken)
}

/// A quantity must be given, or what else there is.
fn needed(is_given: bool, key: &str, quantity: Quantity, or: &str) -> Result<()> {
    let missing = || SceneError::missing(key, quantity.allowed() + or);
    is_given.then_some(()).ok_or_else(missing)
}

/// A length \[m\], if any, must be in the range that follows from the rest of the scene.
fn suits(length: Option<f64>, range: RangeInclusive<f64>, key: &str, allowed: String) -> Result<()> {
    let found = format!("\"{} m\"", length.unwrap_or_default());
    let fits = length.is_none_or(|length| range.contains(&length));
    rule(fits, key, found, allowed)
}

/// Keys that one of several ways to give a value needs.
#[rustfmt::skip]
fn given(scene: &Scene) -> Result<()> {
    let (cable, friction) = (&scene.cable, &scene.friction);
    let is_open = !cable.arrangement.is_of_three() || cable.normal_load_factor.is_some();
    let has_slope = friction.law == Law::Coulomb || friction.shape_factor.is_some();
    let missing = || SceneError::missing("vehicles", VEHICLES);
    needed(cable.axial_stiffness != 0.0, "cable.axial_stiffness", range::AXIAL_STIFFNESS, "")?;
    needed(is_open || scene.duct.inner_diameter.is_some(), "duct.inner_diameter", range::INNER_DIAMETER, "")?;
    needed(is_open || cable.diameter.is_some(), "cable.diameter", range::DIAMETER, "")?;
    needed(has_slope, "friction.shape_factor", range::SHAPE_FACTOR, "; law = \"coulomb\" needs none")?;
    needed(scene.traffic.passes > 0, "traffic.passes", range::PASSES, ", or `years` with `per_day`")?;
    scene.vehicles.first().map(|_| ()).ok_or_else(missing)
}

#[rustfmt::skip]
fn ground(scene: &Scene) -> Result<()> {
    let (ground, above) = (&scene.ground, scene.ground.upper_thickness());
    let is_graded = |layer: &Layer| matches!(layer.young_modulus, Modulus::Linear { .. });
    let Some((last, upper)) = ground.layers.split_last() else {
        return Ok(());
    };
    let key = |index: usize, name: &str| format!("ground.layers.{index}.{name}");
    for (index, layer) in upper.iter().enumerate() {
        needed(layer.thickness.is_some(), &key(index, "thickness"), range::THICKNESS, "")?;
    }
    let is_open = ground.rigid_base_depth.is_none();
    let below = above + range::THICKNESS.least..=above + range::THICKNESS.most;
    let is_uniform = !ground.layers.iter().any(is_graded);
    let fits_one = ground.model != GroundModel::Boussinesq || upper.is_empty() && is_open;
    let fits_uniform = ground.model != GroundModel::Burmister || is_uniform;
    let model = format!("these layers with `model` = \"{}\"", ground.model);
    let thickness = format!("{} m", shown(last.thickness.unwrap_or_default()));
    rule(last.thickness.is_none(), &key(upper.len(), "thickness"), thickness,
        "no thickness in the last layer: it extends down to ground.rigid_base_depth, or to infinite depth")?;
    rule(!is_open || !is_graded(last), &key(upper.len(), "young_modulus"), "a modulus that varies with depth",
        "one value in the last layer, which extends to infinite depth; or set ground.rigid_base_depth")?;
    suits(ground.rigid_base_depth, below, "ground.rigid_base_depth",
        format!("a depth below the upper layers, greater than {} m", shown(above)))?;
    rule(fits_one, "ground.model", &model,
        "\"boussinesq\" with one layer and no rigid base only; \"auto\", \"burmister\" or \"fem\" here")?;
    rule(fits_uniform, "ground.model", model, "\"auto\" or \"fem\" if a modulus varies with depth")
}

/// Lengths that the duct and its length limit.
#[rustfmt::skip]
fn lengths(scene: &Scene) -> Result<()> {
    let (length, solver, diameter) = (scene.duct.length, &scene.solver, scene.cable.diameter);
    let inner = scene.duct.inner_diameter.unwrap_or(f64::INFINITY);
    let [half, all, wide] = [length / 2.0, length, inner].map(shown);
    let is_of_three = scene.cable.arrangement.is_of_three();
    let most = if is_of_three { inner / CLOSEST } else { f64::INFINITY };
    suits(solver.node_spacing, length / 5e6..=length / 2.0, "solver.node_spacing",
        format!("at most half the duct's length, {half} m, and at least its five-millionth part"))?;
    suits(solver.vehicle_step, length / 1e7..=length, "solver.vehicle_step",
        format!("at most the duct's length, {all} m, and at least its ten-millionth part"))?;
    suits(diameter, 0.0..=inner.next_down(), "cable.diameter",
        format!("less than the duct's inner diameter, {wide} m"))?;
    suits(diameter, 0.0..=most, "cable.diameter",
        format!("at most {most:.4} m, so that three cables fit into the duct's {wide} m"))
}

/// The clamps of the scene and of its measures.
fn clamps(scene: &Scene) -> Result<()> {
    let has_friction = scene.friction.dynamic_coefficient > 0.0;
    clamps_of(scene, "restraints", &scene.restraints, has_friction)?;
    for (index, measure) in scene.measures.iter().enumerate() {
        let key = |name: &str| format!("measures.{index}.{name}");
        let (own, name) = (measure.restraints.as_deref(), &measure.name);
        let is_taken = scene.measures[..index].iter().any(|other| other.name == *name);
        let allowed = "a name in quotes that no other measure has";
        rule(!is_taken, &key("name"), format!("\"{name}\""), allowed)?;
        clamps_of(scene, &key("restraints"), own.unwrap_or_default(), true)?;
        clamps_of(scene, &key("added_restraints"), &measure.added_restraints, true)?;
    }
    Ok(())
}

#[rustfmt::skip]
fn clamps_of(scene: &Scene, list: &str, clamps: &[Restraint], may_slip: bool) -> Result<()> {
    let length = scene.duct.length;
    for (index, clamp) in clamps.iter().enumerate() {
        let key = |name: &str| format!("{list}.{index}.{name}");
        rule(may_slip || clamp.holds.is_none(), &key("holds"), "a clamp that slips, without friction",
            "only where the cable has friction")?;
        suits(Some(clamp.position), 0.0..=length, &key("position"),
            format!("a position in the duct, from 0 m to {} m", shown(length)))?;
    }
    Ok(())
}

/// Sections of the duct that the rest of the scene allows.
#[rustfmt::skip]
fn route(scene: &Scene) -> Result<()> {
    let (friction, depth) = (scene.friction.dynamic_coefficient, scene.duct.depth);
    let Some((last, others)) = scene.route.split_last() else {
        return Ok(());
    };
    rule(scene.duct.slope == 0.0, "duct.slope", "a slope with [[route]]", "the slopes of the sections in [[route]]")?;
    for (index, section) in scene.route.iter().enumerate() {
        let key = |name: &str| format!("route.{index}.{name}");
        let is_long = section.length.is_some() || index == others.len();
        let own = section.dynamic_coefficient.unwrap_or(friction);
        needed(is_long, &key("length"), range::SECTION_LENGTH, "; the last section needs none")?;
        suits(section.bend_radius, depth..=f64::INFINITY, &key("bend_radius"),
            format!("a bend no tighter than the duct is deep, at least {} m", shown(depth)))?;
        rule((own > 0.0) == (friction > 0.0), &key("dynamic_coefficient"), shown(own),
            "greater than 0 if that of [friction] is, and 0 if it is 0")?;
    }
    let sum: f64 = scene.route.iter().filter_map(|section| section.length).sum();
    let fits = last.length.is_some() && (sum / scene.duct.length - 1.0).abs() < 1e-9;
    let [sum, length] = [sum, scene.duct.length].map(shown);
    rule(fits, "route", format!("sections of {sum} m together"),
        format!("as long as the duct, {length} m; the last section may leave its length out"))
}

/// A cable that nothing else holds must not slide out of its duct.
#[rustfmt::skip]
fn slope(scene: &Scene) -> Result<()> {
    let clamps = scene.restraints.iter().map(|clamp| clamp.holds.unwrap_or(f64::INFINITY));
    let (mut drawn, mut limit) = (0.0, clamps.sum::<f64>());
    for section in scene.sections() {
        drawn += section.body_force * section.length;
        limit += section.limit * section.length;
    }
    let is_held = [scene.ends.upstream, scene.ends.downstream] != [End::Free; 2];
    let key = if scene.route.is_empty() { "duct.slope" } else { "route" };
    rule(is_held || drawn == 0.0 || drawn.abs() < limit, key,
        format!("slopes between free ends that draw the cable with {} N: it slides out", four_digits(drawn.abs())),
        format!("slopes that draw with less than friction and clamps hold, {} N, or an end that holds the cable",
            four_digits(limit)))
}

#[rustfmt::skip]
fn vehicles(scene: &Scene) -> Result<()> {
    let ground = &scene.ground;
    for (index, vehicle) in scene.vehicles.iter().enumerate() {
        let (name, key) = (&vehicle.name, format!("vehicles.{index}"));
        let is_taken = scene.vehicles[..index].iter().any(|other| other.name == *name);
        let is_loaded = vehicle.load.is_some() || !vehicle.wheels.is_empty();
        let is_scaled = ground.longitudinal_peak.is_some() || index == 0 && ground.vertical_peak.is_some();
        let load = vehicle.load.map_or("wheels", |_| "load");
        rule(!is_taken && !name.trim().is_empty(), &format!("{key}.name"), format!("\"{name}\""),
            "a name in quotes that no other vehicle has")?;
        rule(is_loaded, &key, "neither `load` nor `wheels`",
            "one of the two: load = \"20 tf\" or wheels = [ { load = \"50 kN\" } ]")?;
        rule(!is_scaled || vehicle.weight() > 0.0, &format!("{key}.{load}"), "a vehicle without load",
            "a load greater than 0, which `ground.longitudinal_peak` or `ground.vertical_peak` can scale")?;
    }
    Ok(())
}

fn sequence(scene: &Scene) -> Result<()> {
    let known = || scene.vehicles.iter().map(|vehicle| &*vehicle.name);
    for (index, name) in scene.traffic.sequence.iter().enumerate() {
        if !known().any(|known| known == name) {
            let found = format!("\"{name}\"{}", did_you_mean(nearest(name, known())));
            let key = format!("traffic.sequence.{index}");
            return Err(SceneError::value(&key, found, listed(known())));
        }
    }
    Ok(())
}

#[rustfmt::skip]
fn heat(scene: &Scene) -> Result<()> {
    let Some(heat) = &scene.heat else {
        return Ok(());
    };
    let (law, cold) = (scene.friction.law(), scene.warming().is_none());
    let is_explicit = scene.solver.method == SolverMethod::Explicit;
    let pairs = heat.profile.iter().flat_map(|points| points.windows(2));
    for (index, pair) in pairs.enumerate() {
        rule(pair[1].0 > pair[0].0, &format!("heat.profile.{}.0", index + 1), format!("\"{:?} s\"", pair[1].0),
            "a time after that of the point before")?;
    }
    rule(heat.daily_swing.is_some() || heat.profile.is_some(), "heat", "neither `daily_swing` nor `profile`",
        "one of the two: daily_swing = \"20 K\" or profile = [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]]")?;
    rule(scene.traffic.per_day.is_some(), "heat", "no `traffic.per_day`",
        "`per_day` in [traffic] with [heat]: how many vehicles meet each hour's temperature")?;
    rule(cold || law.has_memory(), "heat", format!("[heat] with `friction.law` = \"{}\"", law.name()),
        "\"coulomb\" or \"elastic-plastic\" with [heat]: temperature steps need a state of rest")?;
    rule(cold || scene.friction_limit() > 0.0, "heat", "[heat] without friction",
        "a `friction.dynamic_coefficient` greater than 0 with [heat]")?;
    rule(cold || !is_explicit, "heat", "[heat] with `solver.method` = \"explicit\"",
        "\"auto\", \"quasi-static\" or \"pass-law\" with [heat]: it is computed without inertia")
}
