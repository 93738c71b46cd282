//! Whether a scene can be computed: every value is in its range, and none contradicts another.

use ground_field::{Base, Modulus, Wheel};

use super::arrangement::CLOSEST;
use super::cable_end::CableEnd;
use super::data::{
    Cable, Duct, End, FrictionLaw, Ground, GroundModel, Order, PeakScaling, Scene, Solver, SolverMethod,
    Warming,
};
use super::error::{Wrong, WrongKind};
use super::keys::joined;
use super::range::{
    APPROACH, AXIAL_STIFFNESS, CLAMP, COEFFICIENT, CONTACT_RADIUS, DEPTH, DIAMETER, DUCT_LENGTH, EXPANSION,
    Follows, INNER_DIAMETER, LANE, LATERAL_OFFSET, LOAD, LOAD_FACTOR, LONGITUDINAL_PEAK, MODULUS,
    MODULUS_AT_AN_END, OFFSET, PASSES, PER_DAY, POISSON, POSITION, Quantity, RIGID_BASE_DEPTH, SHAPE_FACTOR,
    SLOPE, SPEED, SPRING, STEP, SWING, TEMPERATURE, THICKNESS, TIME_OF_DAY, TIME_STEP, TOLERANCE,
    VERTICAL_PEAK, WEIGHT, WHEEL_LOAD, WHEEL_X, WHEEL_Y, allowed_whole, diameters, node_spacings, positions,
    shown, vehicle_steps,
};
use super::units::Dimension;
use crate::shown::four_digits;

/// How far a share, or a factor relative to itself, may be from what it has to be.
const ROUNDING: f64 = 1e-9;

type Checked = Result<(), Box<Wrong>>;

/// The first value of `scene` that is wrong, without the place where it stands.
pub fn check(scene: &Scene) -> Checked {
    duct(&scene.duct)?;
    ground(&scene.ground)?;
    cable(&scene.cable, &scene.duct)?;
    supports(scene)?;
    vehicles(scene)?;
    traffic(scene)?;
    heat(scene)?;
    solver(&scene.solver, scene.duct.length)
}

fn duct(duct: &Duct) -> Checked {
    let section = Section::new("duct");
    section.within("length", duct.length, DUCT_LENGTH)?;
    section.within("depth", duct.depth, DEPTH)?;
    section.within("lateral_offset", duct.lateral_offset, LATERAL_OFFSET)?;
    section.within("inner_diameter", duct.inner_diameter, INNER_DIAMETER)?;
    section.within("slope", duct.slope, SLOPE)
}

fn ground(ground: &Ground) -> Checked {
    let (section, profile) = (Section::new("ground"), &ground.profile);
    match ground.scaling {
        Some(PeakScaling::Longitudinal(peak)) => {
            section.within("longitudinal_peak", peak, LONGITUDINAL_PEAK)?;
        }
        Some(PeakScaling::Vertical(peak)) => section.within("vertical_peak", peak, VERTICAL_PEAK)?,
        None => {}
    }
    let base = match profile.base() {
        Base::HalfSpace(soil) => Some((None, Modulus::Uniform(soil.young_modulus()), soil.poisson_ratio())),
        Base::Rigid => {
            section.within("rigid_base_depth", profile.base_depth(), RIGID_BASE_DEPTH)?;
            None
        }
    };
    let layers = profile.layers().iter();
    let layers = layers.map(|layer| (Some(layer.thickness()), layer.modulus(), layer.poisson_ratio()));
    for (index, (thickness, modulus, poisson_ratio)) in layers.chain(base).enumerate() {
        let layer = Section::new(format!("ground.layers.{index}"));
        layer.within("thickness", thickness, THICKNESS)?;
        match modulus {
            Modulus::Uniform(modulus) => layer.within("young_modulus", modulus, MODULUS)?,
            Modulus::Linear { top, bottom } => {
                layer.within("young_modulus.top", top, MODULUS_AT_AN_END)?;
                layer.within("young_modulus.bottom", bottom, MODULUS_AT_AN_END)?;
            }
        }
        layer.within("poisson_ratio", poisson_ratio, POISSON)?;
    }
    let graded = profile.layers().iter().any(|layer| layer.soil().is_none());
    let (fits, allowed) = match ground.model {
        GroundModel::Boussinesq => (
            profile.homogeneous().is_some(),
            "\"boussinesq\" with one layer and no rigid base only; \"auto\", \"burmister\" or \"fem\" here",
        ),
        GroundModel::Burmister => (!graded, "\"auto\" or \"fem\" where a modulus varies with depth"),
        _ => return Ok(()),
    };
    let kind = WrongKind::UnknownWord { suggestion: None };
    section.hold(fits, kind, "model", format!("\"{}\"", ground.model), allowed)
}

fn cable(cable: &Cable, duct: &Duct) -> Checked {
    let (section, arrangement) = (Section::new("cable"), cable.arrangement);
    section.within("weight", cable.weight, WEIGHT)?;
    section.within("axial_stiffness", cable.axial_stiffness, AXIAL_STIFFNESS)?;
    section.within("diameter", cable.diameter, DIAMETER)?;
    let of_three = arrangement.is_of_three();
    let has = |value: Option<f64>| value.is_some() || !of_three;
    let missing = || WrongKind::MissingKey;
    section.hold(has(cable.diameter), missing(), "diameter", "", DIAMETER.allowed())?;
    let inner = duct.inner_diameter;
    Section::new("duct").hold(
        has(inner),
        missing(),
        "inner_diameter",
        "",
        INNER_DIAMETER.allowed(),
    )?;
    let follows = match (cable.diameter, inner) {
        (Some(diameter), Some(inner)) => {
            let room = diameters(inner, of_three.then_some(CLOSEST));
            section.suits("diameter", diameter, DIAMETER, room)?;
            arrangement.normal_load_factor(inner, diameter)
        }
        (Some(_), None) => 1.0,
        (None, _) => return section.within("normal_load_factor", cable.normal_load_factor, LOAD_FACTOR),
    };
    let allowed = format!(
        "{}, which follows from the arrangement and the diameters",
        shown(follows)
    );
    let right = follows * (1.0 - ROUNDING)..=follows * (1.0 + ROUNDING);
    section.suits(
        "normal_load_factor",
        cable.normal_load_factor,
        LOAD_FACTOR,
        (right, allowed),
    )
}

/// Friction, ends and clamps: what holds the cable.
fn supports(scene: &Scene) -> Checked {
    let (section, friction) = (Section::new("friction"), &scene.friction);
    section.within("dynamic_coefficient", friction.dynamic_coefficient, COEFFICIENT)?;
    let shape_factor = Some(friction.law.shape_factor()).filter(|_| friction.law != FrictionLaw::Coulomb);
    section.within("shape_factor", shape_factor, SHAPE_FACTOR)?;
    let mut free = scene.restraints.is_empty();
    for end in CableEnd::ALL {
        let held = end.held_in(scene);
        if let End::Spring(stiffness) = held {
            Section::new(format!("ends.{}", end.name())).within("spring", stiffness, SPRING)?;
        }
        free &= held == End::Free;
    }
    for (index, clamp) in scene.restraints.iter().enumerate() {
        let section = Section::new(format!("restraints.{index}"));
        section.suits("position", clamp.position, POSITION, positions(scene.duct.length))?;
        section.within("stiffness", clamp.stiffness, CLAMP)?;
    }
    let (drawn, limit, slope) = (
        scene.body_force().abs(),
        scene.friction_limit(),
        four_digits(100.0 * scene.duct.slope),
    );
    let steepest = shown(limit / (scene.cable.weight * scene.duct.cosine()));
    let found = format!("{slope} % between free ends, where the cable slides out of the duct");
    let allowed = format!(
        "a slope less than what friction holds, {steepest}, or an end or a clamp that holds the cable"
    );
    let slides = free && drawn > 0.0 && drawn >= limit;
    Section::new("duct").hold(!slides, WrongKind::Value, "slope", found, allowed)
}

fn vehicles(scene: &Scene) -> Checked {
    let (all, vehicles) = (Section::new("vehicles"), &scene.vehicles);
    let allowed = "one [[vehicles]] or more, or traffic.histogram";
    all.hold(!vehicles.is_empty(), WrongKind::Value, "", "none", allowed)?;
    for (index, traffic) in vehicles.iter().enumerate() {
        let (section, vehicle) = (Section::new(format!("vehicles.{index}")), &traffic.vehicle);
        let name = vehicle.name();
        let taken = vehicles[..index].iter().any(|other| other.vehicle.name() == name);
        let (own, found) = (!taken && !name.trim().is_empty(), format!("\"{name}\""));
        let allowed = "a name in quotes that no other vehicle has";
        section.hold(own, WrongKind::Value, "name", found, allowed)?;
        section.within("speed", vehicle.speed(), SPEED)?;
        section.within("lateral_offset", traffic.lateral_offset, LANE)?;
        let at_axis = |wheel: &Wheel| (wheel.x, wheel.y, wheel.load.contact_radius()) == (0.0, 0.0, 0.0);
        let load = match vehicle.wheels() {
            [wheel] if at_axis(wheel) => {
                section.within("load", wheel.load.force(), LOAD)?;
                "load"
            }
            wheels => {
                for (number, Wheel { x, y, load }) in wheels.iter().enumerate() {
                    let wheel = Section::new(format!("vehicles.{index}.wheels.{number}"));
                    wheel.within("x", *x, WHEEL_X)?;
                    wheel.within("y", *y, WHEEL_Y)?;
                    wheel.within("load", load.force(), WHEEL_LOAD)?;
                    wheel.within("contact_radius", load.contact_radius(), CONTACT_RADIUS)?;
                }
                "wheels"
            }
        };
        let scaled = match scene.ground.scaling {
            Some(PeakScaling::Longitudinal(_)) => "ground.longitudinal_peak",
            Some(PeakScaling::Vertical(_)) if index == 0 => "ground.vertical_peak",
            _ => continue,
        };
        let allowed = format!("a load greater than 0, which `{scaled}` can scale");
        let loaded = vehicle.weight() > 0.0;
        section.hold(loaded, WrongKind::Value, load, "a vehicle without load", allowed)?;
    }
    Ok(())
}

fn traffic(scene: &Scene) -> Checked {
    let Scene {
        vehicles, traffic, ..
    } = scene;
    let (section, passes) = (Section::new("traffic"), traffic.passes.to_string());
    let (possible, allowed) = (PASSES.contains(&traffic.passes), allowed_whole(&PASSES));
    section.hold(possible, WrongKind::OutOfRange, "passes", passes, allowed)?;
    section.within("per_day", traffic.per_day, PER_DAY)?;
    let count = vehicles.len();
    let shares: Vec<f64> = match &traffic.order {
        Order::Sequence(sequence) => {
            let beyond = sequence.iter().find(|&&index| index >= count);
            let known = beyond.is_none() && !sequence.is_empty();
            let found = beyond.map_or("an empty list".to_owned(), usize::to_string);
            let allowed = format!("a vehicle's index, less than {count}");
            section.hold(known, WrongKind::Value, "sequence", found, allowed)?;
            let times = |vehicle| sequence.iter().filter(|&&index| index == vehicle).count();
            (0..count).map(|vehicle| times(vehicle) as f64).collect()
        }
        _ => vehicles.iter().map(|traffic| traffic.share).collect(),
    };
    let sum: f64 = shares.iter().sum();
    for (index, (traffic, share)) in vehicles.iter().zip(shares).enumerate() {
        let section = Section::new(format!("vehicles.{index}"));
        let right = share / sum;
        let allowed = format!(
            "{}, with which all shares sum to 1 and suit a sequence",
            shown(right)
        );
        // A sequence may leave a vehicle out.
        let drives = share > 0.0 || matches!(scene.traffic.order, Order::Sequence(_));
        let suits = drives && (traffic.share - right).abs() <= ROUNDING;
        section.hold(
            suits,
            WrongKind::OutOfRange,
            "share",
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
    let section = Section::new("heat");
    section.within("expansion", heat.expansion, EXPANSION)?;
    section.within("offset", heat.offset, OFFSET)?;
    match &heat.warming {
        Warming::Swing(swing) => section.within("daily_swing", *swing, SWING)?,
        Warming::Profile(points) => {
            let allowed = "two points of the day or more, their times ascending";
            section.hold(
                points.len() > 1,
                WrongKind::Value,
                "profile",
                "one point",
                allowed,
            )?;
            let mut earliest = 0.0;
            for (index, (time, kelvin)) in points.iter().enumerate() {
                let point = Section::new(format!("heat.profile.{index}"));
                let later = (
                    earliest..=f64::INFINITY,
                    "a time after that of the point before".to_owned(),
                );
                point.suits("0", *time, TIME_OF_DAY, later)?;
                point.within("1", *kelvin, TEMPERATURE)?;
                earliest = time.next_up();
            }
        }
    }
    let (law, method, cold) = (scene.friction.law, scene.solver.method, scene.warming().is_none());
    let hold = |holds, found: &str, allowed| section.hold(holds, WrongKind::Value, "", found, allowed);
    hold(
        scene.traffic.per_day.is_some(),
        "no `traffic.per_day`",
        "`per_day` in [traffic] beside [heat]: how many vehicles meet each hour's temperature",
    )?;
    hold(
        cold || law.has_memory(),
        &format!("[heat] with `friction.law` = \"{}\"", law.name()),
        "\"coulomb\" or \"elastic-plastic\" beside [heat]: temperature steps need a state of rest",
    )?;
    hold(
        cold || scene.friction_limit() > 0.0,
        "[heat] without friction",
        "a `friction.dynamic_coefficient` greater than 0 beside [heat]",
    )?;
    hold(
        cold || method != SolverMethod::Explicit,
        "[heat] with `solver.method` = \"explicit\"",
        "\"auto\", \"quasi-static\" or \"pass-law\" beside [heat]: it is computed without inertia",
    )
}

fn solver(solver: &Solver, length: f64) -> Checked {
    let section = Section::new("solver");
    section.within("tolerance", solver.tolerance, TOLERANCE)?;
    section.suits("node_spacing", solver.node_spacing, STEP, node_spacings(length))?;
    section.suits("vehicle_step", solver.vehicle_step, STEP, vehicle_steps(length))?;
    let time_step = solver.time_step.filter(|_| solver.method.has_time_steps());
    section.within("time_step", time_step, TIME_STEP)?;
    section.within("approach", solver.approach, APPROACH)
}

/// A part of a scene, by its key.
struct Section(String);

impl Section {
    fn new(key: impl Into<String>) -> Self {
        Self(key.into())
    }

    /// Refuses a value outside the range of its quantity.
    fn within(&self, name: &str, value: impl Into<Option<f64>>, quantity: Quantity) -> Checked {
        let value = value.into().filter(|value| !quantity.range.contains(*value));
        value.map_or(Ok(()), |value| {
            self.out_of_range(name, value, quantity, quantity.allowed())
        })
    }

    /// The same where the range follows from the rest of the scene too.
    fn suits(
        &self,
        name: &str,
        value: impl Into<Option<f64>>,
        quantity: Quantity,
        (range, allowed): Follows,
    ) -> Checked {
        let value = value.into();
        self.within(name, value, quantity)?;
        let value = value.filter(|value| !range.contains(value));
        value.map_or(Ok(()), |value| self.out_of_range(name, value, quantity, allowed))
    }

    fn out_of_range(&self, name: &str, value: f64, quantity: Quantity, allowed: String) -> Checked {
        let unit = quantity.dimension.and_then(Dimension::si);
        let found = unit.map_or_else(|| shown(value), |unit| format!("\"{value:?} {unit}\""));
        self.hold(false, WrongKind::OutOfRange, name, found, allowed)
    }

    /// Refuses what was `found` at `name`, or in the section where that is empty, unless it `holds`.
    fn hold(
        &self,
        holds: bool,
        kind: WrongKind,
        name: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Checked {
        if holds {
            return Ok(());
        }
        Err(Box::new(Wrong {
            kind,
            key: if name.is_empty() {
                self.0.clone()
            } else {
                joined(&self.0, name)
            },
            found: found.into(),
            allowed: allowed.into(),
            location: None,
        }))
    }
}
