//! What holds between the values of a scene, each of which is in its own range.

use cable_dem::End;
use ground_field::Modulus;

use crate::arrangement::CLOSEST;
use crate::cable::Law;
use crate::error::{Result, SceneError, did_you_mean};
use crate::ground::{GroundModel, Layer};
use crate::nearest::nearest;
use crate::range::{
    AXIAL_STIFFNESS, DIAMETER, INNER_DIAMETER, PASSES, Quantity, SECTION_LENGTH, SHAPE_FACTOR, THICKNESS,
};
use crate::scene::{Scene, VEHICLES};
use crate::shown::{four_digits, listed, shown};
use crate::solver::SolverMethod;

/// Whether a rule holds, the key at which it is broken, what was found there (nothing of a key that is missing), what is allowed.
type Rule = (bool, String, String, String);
type Range = std::ops::RangeInclusive<f64>;

/// The first rule that the scene breaks.
pub fn check(scene: &Scene) -> Result<()> {
    let groups = [ground, given, lengths, route, slope, vehicles, sequence, heat];
    let mut rules = groups.iter().flat_map(|rules| rules(scene));
    match rules.find(|(holds, ..)| !holds) {
        None => Ok(()),
        Some((_, key, found, allowed)) if found.is_empty() => Err(SceneError::missing(&key, allowed)),
        Some((_, key, found, allowed)) => Err(SceneError::value(&key, found, allowed)),
    }
}

fn rule(holds: bool, key: impl Into<String>, found: impl Into<String>, allowed: impl Into<String>) -> Rule {
    (holds, key.into(), found.into(), allowed.into())
}

/// A quantity must be given, or what else there is.
fn needed(is_given: bool, key: impl Into<String>, quantity: Quantity, or: &str) -> Rule {
    rule(is_given, key, "", quantity.allowed() + or)
}

/// A length \[m\], if any, must be in the range that follows from the rest of the scene.
fn suits(length: Option<f64>, range: Range, key: impl Into<String>, allowed: String) -> Rule {
    let length = length.filter(|length| !range.contains(length));
    let found = format!("\"{} m\"", length.unwrap_or_default());
    rule(length.is_none(), key, found, allowed)
}

/// Keys that one of several ways to give a value needs.
fn given(scene: &Scene) -> Vec<Rule> {
    let (cable, friction, passes) = (&scene.cable, &scene.friction, scene.traffic.passes);
    let is_open = !cable.arrangement.is_of_three() || cable.normal_load_factor.is_some();
    let has_slope = friction.law == Law::Coulomb || friction.shape_factor.is_some();
    let has_inner = is_open || scene.duct.inner_diameter.is_some();
    #[rustfmt::skip]
    let rules = vec![
        needed(cable.axial_stiffness != 0.0, "cable.axial_stiffness", AXIAL_STIFFNESS, ""),
        needed(has_inner, "duct.inner_diameter", INNER_DIAMETER, ""),
        needed(is_open || cable.diameter.is_some(), "cable.diameter", DIAMETER, ""),
        needed(has_slope, "friction.shape_factor", SHAPE_FACTOR, "; law = \"coulomb\" needs none"),
        needed(passes > 0, "traffic.passes", PASSES, ", or `years` with `per_day`"),
        rule(!scene.vehicles.is_empty(), "vehicles", "", VEHICLES),
    ];
    rules
}

fn ground(scene: &Scene) -> Vec<Rule> {
    let (ground, above) = (&scene.ground, scene.ground.upper_thickness());
    let is_graded = |layer: &Layer| matches!(layer.young_modulus, Modulus::Linear { .. });
    let Some((last, upper)) = ground.layers.split_last() else {
        return Vec::new();
    };
    let key = |index: usize, name: &str| format!("ground.layers.{index}.{name}");
    let thickness = |(index, layer): (usize, &Layer)| {
        needed(layer.thickness.is_some(), key(index, "thickness"), THICKNESS, "")
    };
    let mut rules: Vec<Rule> = upper.iter().enumerate().map(thickness).collect();
    let is_open = ground.rigid_base_depth.is_none();
    let below = above + THICKNESS.least..=above + THICKNESS.most;
    let is_uniform = !ground.layers.iter().any(is_graded);
    let fits_one = ground.model != GroundModel::Boussinesq || upper.is_empty() && is_open;
    let fits_uniform = ground.model != GroundModel::Burmister || is_uniform;
    let model = format!("these layers with `model` = \"{}\"", ground.model);
    #[rustfmt::skip]
    rules.extend([
        rule(last.thickness.is_none(), key(upper.len(), "thickness"), format!("{} m", shown(last.thickness.unwrap_or_default())),
            "no thickness in the last layer: it extends down to ground.rigid_base_depth, or to infinite depth"),
        rule(!is_open || !is_graded(last), key(upper.len(), "young_modulus"), "a modulus that varies with depth",
            "one value in the last layer, which extends to infinite depth; or set ground.rigid_base_depth"),
        suits(ground.rigid_base_depth, below, "ground.rigid_base_depth",
            format!("a depth below the upper layers, greater than {} m", shown(above))),
        rule(fits_one, "ground.model", &*model,
            "\"boussinesq\" with one layer and no rigid base only; \"auto\", \"burmister\" or \"fem\" here"),
        rule(fits_uniform, "ground.model", model, "\"auto\" or \"fem\" if a modulus varies with depth"),
    ]);
    rules
}

/// Lengths that the duct and its length limit.
fn lengths(scene: &Scene) -> Vec<Rule> {
    let (duct, solver) = (&scene.duct, &scene.solver);
    let (length, inner) = (duct.length, duct.inner_diameter.unwrap_or(f64::INFINITY));
    let [half, all, wide] = [length / 2.0, length, inner].map(shown);
    let three = Some(inner / CLOSEST).filter(|_| scene.cable.arrangement.is_of_three());
    let most = three.unwrap_or(f64::INFINITY);
    #[rustfmt::skip]
    let mut rules = vec![
        suits(solver.node_spacing, length / 5e6..=length / 2.0, "solver.node_spacing",
            format!("at most half the duct's length, {half} m, and at least its five-millionth part")),
        suits(solver.vehicle_step, length / 1e7..=length, "solver.vehicle_step",
            format!("at most the duct's length, {all} m, and at least its ten-millionth part")),
        suits(scene.cable.diameter, 0.0..=inner.next_down(), "cable.diameter",
            format!("less than the duct's inner diameter, {wide} m")),
        suits(scene.cable.diameter, 0.0..=most, "cable.diameter",
            format!("at most {most:.4} m, so that three cables fit into the duct's {wide} m")),
    ];
    let has_friction = scene.friction.dynamic_coefficient > 0.0;
    let mut lists = vec![("restraints".to_owned(), &scene.restraints[..])];
    for (index, measure) in scene.measures.iter().enumerate() {
        let key = |name: &str| format!("measures.{index}.{name}");
        lists.push((
            key("restraints"),
            measure.restraints.as_deref().unwrap_or_default(),
        ));
        lists.push((key("added_restraints"), &measure.added_restraints));
        let is_new = scene.measures[..index]
            .iter()
            .all(|other| other.name != measure.name);
        #[rustfmt::skip]
        rules.push(rule(is_new, key("name"), format!("\"{}\"", measure.name), "a name in quotes that no other measure has"));
    }
    let every = lists.iter().flat_map(|(list, clamps)| {
        let clamps = clamps.iter().enumerate();
        clamps.map(move |(index, clamp)| (format!("{list}.{index}"), clamp))
    });
    for (at, clamp) in every {
        let key = |name: &str| format!("{at}.{name}");
        #[rustfmt::skip]
        rules.extend([
            rule(clamp.holds.is_none() || has_friction || at.starts_with("measures"), key("holds"), "a clamp that slips, without friction",
                "only where the cable has friction"),
            suits(Some(clamp.position), 0.0..=length, key("position"), format!("a position in the duct, from 0 m to {all} m")),
        ]);
    }
    rules
}

/// Sections of the duct that the rest of the scene allows.
fn route(scene: &Scene) -> Vec<Rule> {
    let friction = scene.friction.dynamic_coefficient;
    let Some((last, others)) = scene.route.split_last() else {
        return Vec::new();
    };
    let allowed = "the slopes of the sections in [[route]]";
    let mut rules = vec![rule(
        scene.duct.slope == 0.0,
        "duct.slope",
        "a slope beside [[route]]",
        allowed,
    )];
    for (index, section) in scene.route.iter().enumerate() {
        let key = |name: &str| format!("route.{index}.{name}");
        let is_long = section.length.is_some() || index == others.len();
        let own = section.dynamic_coefficient.unwrap_or(friction);
        #[rustfmt::skip]
        rules.extend([
            needed(is_long, key("length"), SECTION_LENGTH, "; the last section needs none"),
            suits(section.bend_radius, scene.duct.depth..=f64::INFINITY, key("bend_radius"),
                format!("a bend no tighter than the duct is deep, at least {} m", shown(scene.duct.depth))),
            rule((own > 0.0) == (friction > 0.0), key("dynamic_coefficient"), shown(own),
                "greater than 0 if that of [friction] is, and 0 if it is 0"),
        ]);
    }
    let sum: f64 = scene.route.iter().filter_map(|section| section.length).sum();
    let fits = last.length.is_some() && (sum / scene.duct.length - 1.0).abs() < 1e-9;
    let [sum, length] = [sum, scene.duct.length].map(shown);
    let allowed = format!("as long as the duct, {length} m; the last section may leave its length out");
    rules.push(rule(
        fits,
        "route",
        format!("sections of {sum} m together"),
        allowed,
    ));
    rules
}

/// A cable that nothing else holds must not slide out of its duct.
fn slope(scene: &Scene) -> Vec<Rule> {
    let clamps = scene.restraints.iter();
    let clamps = clamps.map(|clamp| clamp.holds.unwrap_or(f64::INFINITY));
    let (mut drawn, mut limit) = (0.0, clamps.sum::<f64>());
    for section in scene.sections() {
        drawn += section.body_force * section.length;
        limit += section.limit * section.length;
    }
    let is_held = [scene.ends.upstream, scene.ends.downstream] != [End::Free; 2];
    let rests = is_held || drawn == 0.0 || drawn.abs() < limit;
    let [drawn, limit] = [drawn.abs(), limit].map(four_digits);
    let found = format!("slopes between free ends that draw the cable with {drawn} N: it slides out");
    let allowed = format!(
        "slopes that draw with less than friction and clamps hold, {limit} N, or an end that holds the cable"
    );
    let key = if scene.route.is_empty() {
        "duct.slope"
    } else {
        "route"
    };
    vec![rule(rests, key, found, allowed)]
}

fn vehicles(scene: &Scene) -> Vec<Rule> {
    let (ground, mut rules) = (&scene.ground, Vec::new());
    for (index, vehicle) in scene.vehicles.iter().enumerate() {
        let (name, key) = (&vehicle.name, format!("vehicles.{index}"));
        let is_taken = scene.vehicles[..index].iter().any(|other| other.name == *name);
        let is_named = !is_taken && !name.trim().is_empty();
        let is_loaded = vehicle.load.is_some() || !vehicle.wheels.is_empty();
        let is_scaled = ground.longitudinal_peak.is_some() || index == 0 && ground.vertical_peak.is_some();
        let load = vehicle.load.map_or("wheels", |_| "load");
        #[rustfmt::skip]
        rules.extend([
            rule(is_named, format!("{key}.name"), format!("\"{name}\""), "a name in quotes that no other vehicle has"),
            rule(is_loaded, &*key, "neither `load` nor `wheels`",
                "one of the two: load = \"20 tf\" or wheels = [ { load = \"50 kN\" } ]"),
            rule(!is_scaled || vehicle.weight() > 0.0, format!("{key}.{load}"), "a vehicle without load",
                "a load greater than 0, which `ground.longitudinal_peak` or `ground.vertical_peak` can scale"),
        ]);
    }
    rules
}

fn sequence(scene: &Scene) -> Vec<Rule> {
    let known = || scene.vehicles.iter().map(|vehicle| &*vehicle.name);
    let mut names = scene.traffic.sequence.iter().enumerate();
    let unknown = names.find(|(_, name)| !known().any(|known| known == *name));
    let broken = unknown.map(|(index, name)| {
        let found = format!("\"{name}\"{}", did_you_mean(nearest(name, known())));
        rule(false, format!("traffic.sequence.{index}"), found, listed(known()))
    });
    broken.into_iter().collect()
}

fn heat(scene: &Scene) -> Vec<Rule> {
    let Some(heat) = &scene.heat else {
        return Vec::new();
    };
    let (law, cold) = (scene.friction.law(), scene.warming().is_none());
    let of_law = format!("[heat] with `friction.law` = \"{}\"", law.name());
    let is_explicit = scene.solver.method == SolverMethod::Explicit;
    let pairs = heat.profile.iter().flat_map(|points| points.windows(2));
    let ascending = pairs.enumerate().map(|(index, pair)| {
        let (key, found) = (
            format!("heat.profile.{}.0", index + 1),
            format!("\"{:?} s\"", pair[1].0),
        );
        rule(
            pair[1].0 > pair[0].0,
            key,
            found,
            "a time after that of the point before",
        )
    });
    #[rustfmt::skip]
    let rules = [
        rule(heat.daily_swing.is_some() || heat.profile.is_some(), "heat", "neither `daily_swing` nor `profile`",
            "one of the two: daily_swing = \"20 K\" or profile = [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]]"),
        rule(scene.traffic.per_day.is_some(), "heat", "no `traffic.per_day`",
            "`per_day` in [traffic] beside [heat]: how many vehicles meet each hour's temperature"),
        rule(cold || law.has_memory(), "heat", of_law,
            "\"coulomb\" or \"elastic-plastic\" beside [heat]: temperature steps need a state of rest"),
        rule(cold || scene.friction_limit() > 0.0, "heat", "[heat] without friction",
            "a `friction.dynamic_coefficient` greater than 0 beside [heat]"),
        rule(cold || !is_explicit, "heat", "[heat] with `solver.method` = \"explicit\"",
            "\"auto\", \"quasi-static\" or \"pass-law\" beside [heat]: it is computed without inertia"),
    ];
    ascending.chain(rules).collect()
}
