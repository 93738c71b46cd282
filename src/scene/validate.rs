//! The ranges of a scene file, for a scene that a program made or changed.

use std::collections::HashSet;
use std::fmt::Display;

use cable_dem::Restraint;
use ground_field::{Base, Modulus};

use super::range::{
    self, APPROACH, AXIAL_STIFFNESS, COEFFICIENT, CONTACT_RADIUS, DEPTH, DUCT_LENGTH, Follows, LOAD,
    LOAD_FACTOR, MODULUS, OFFSET, PASSES, PEAK, POISSON, POSITIVE, Range, SHAPE_FACTOR, SPEED, STIFFNESS,
    THICKNESS, TOLERANCE, WEIGHT, allowed_whole, shown,
};
use super::{
    Dimension, Duct, End, FrictionLaw, Ground, Order, PeakScaling, Scene, SceneError, Solver, TrafficVehicle,
    ground, traffic,
};

/// How far the sum of all shares may be from 1.
const ROUNDING: f64 = 1e-9;

impl Scene {
    /// Checks everything that reading a scene file would check. What computes with a scene does so first.
    ///
    /// ```
    /// use creepage::Scene;
    ///
    /// let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    /// scene.validate()?;
    /// scene.duct.depth = -1.0;
    /// let error = scene.validate().unwrap_err().to_string();
    /// assert_eq!(error, "`duct.depth`: found -1 m; allowed: a length greater than 0, from 1 cm to 1 km");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SceneError::Value`] with the first key whose value is out of its range or contradicts another one.
    pub fn validate(&self) -> Result<(), SceneError> {
        duct(&self.duct)?;
        soil(&self.ground)?;
        let cable = &self.cable;
        quantity("cable.weight", cable.weight, Dimension::ForcePerLength, WEIGHT)?;
        let stiffness = cable.axial_stiffness;
        quantity(
            "cable.axial_stiffness",
            stiffness,
            Dimension::Force,
            AXIAL_STIFFNESS,
        )?;
        number("cable.normal_load_factor", cable.normal_load_factor, LOAD_FACTOR)?;
        friction(self)?;
        end("ends.upstream", self.ends.upstream)?;
        end("ends.downstream", self.ends.downstream)?;
        for (index, restraint) in self.restraints.iter().enumerate() {
            clamp(&format!("restraints.{index}"), restraint, self.duct.length)?;
        }
        vehicles(self)?;
        order(self)?;
        if !PASSES.contains(&self.traffic.passes) {
            return Err(refused(
                "traffic.passes",
                self.traffic.passes,
                allowed_whole(&PASSES),
            ));
        }
        solver(&self.solver, self.duct.length)
    }
}

fn refused(key: impl Display, found: impl Display, allowed: impl Into<String>) -> SceneError {
    SceneError::Value {
        key: key.to_string(),
        found: found.to_string(),
        allowed: allowed.into(),
    }
}

fn quantity(key: impl Display, value: f64, dimension: Dimension, range: Range) -> Result<(), SceneError> {
    if range.contains(value) {
        return Ok(());
    }
    let unit = dimension.units().next().unwrap_or_default();
    Err(refused(
        key,
        format!("{} {unit}", shown(value)),
        range.of(dimension),
    ))
}

fn number(key: impl Display, value: f64, range: Range) -> Result<(), SceneError> {
    if range.contains(value) {
        return Ok(());
    }
    Err(refused(key, shown(value), range.of_number()))
}

/// A length whose range follows from the duct's.
fn suiting(key: impl Display, value: f64, (range, allowed): Follows) -> Result<(), SceneError> {
    if range.contains(&value) {
        return Ok(());
    }
    Err(refused(key, format!("{} m", shown(value)), allowed))
}

fn duct(duct: &Duct) -> Result<(), SceneError> {
    quantity("duct.length", duct.length, Dimension::Length, DUCT_LENGTH)?;
    quantity("duct.depth", duct.depth, Dimension::Length, DEPTH)?;
    quantity(
        "duct.lateral_offset",
        duct.lateral_offset,
        Dimension::Length,
        OFFSET,
    )
}

fn soil(ground: &Ground) -> Result<(), SceneError> {
    let modulus = |index: usize, key: &str, modulus| {
        let key = format!("ground.layers.{index}.young_modulus{key}");
        quantity(key, modulus, Dimension::Pressure, MODULUS)
    };
    let poisson_ratio =
        |index: usize, ratio| number(format!("ground.layers.{index}.poisson_ratio"), ratio, POISSON);
    let layers = ground.profile.layers();
    for (index, layer) in layers.iter().enumerate() {
        let key = format!("ground.layers.{index}.thickness");
        quantity(key, layer.thickness(), Dimension::Length, THICKNESS)?;
        match layer.modulus() {
            Modulus::Uniform(uniform) => modulus(index, "", uniform)?,
            Modulus::Linear { top, bottom } => {
                modulus(index, ".top", top)?;
                modulus(index, ".bottom", bottom)?;
            }
        }
        poisson_ratio(index, layer.poisson_ratio())?;
    }
    if let Base::HalfSpace(soil) = ground.profile.base() {
        modulus(layers.len(), "", soil.young_modulus())?;
        poisson_ratio(layers.len(), soil.poisson_ratio())?;
    }
    if let Some(allowed) = ground::unfit(ground.model, &ground.profile) {
        let found = format!("\"{}\"", ground::name(ground.model));
        return Err(refused("ground.model", found, allowed));
    }
    match ground.scaling {
        None => Ok(()),
        Some(PeakScaling::Longitudinal(peak)) => {
            quantity("ground.longitudinal_peak", peak, Dimension::Length, PEAK)
        }
        Some(PeakScaling::Vertical(peak)) => quantity("ground.vertical_peak", peak, Dimension::Length, PEAK),
    }
}

fn friction(scene: &Scene) -> Result<(), SceneError> {
    let coefficient = scene.friction.dynamic_coefficient;
    number("friction.dynamic_coefficient", coefficient, COEFFICIENT)?;
    let law = scene.friction.law;
    if law == FrictionLaw::Coulomb {
        return Ok(());
    }
    let dimension = Dimension::InverseLength;
    quantity(
        "friction.shape_factor",
        law.shape_factor(),
        dimension,
        SHAPE_FACTOR,
    )
}

fn end(key: &str, end: End) -> Result<(), SceneError> {
    match end {
        End::Free | End::Fixed => Ok(()),
        End::Spring(stiffness) => quantity(
            format!("{key}.spring"),
            stiffness,
            Dimension::ForcePerLength,
            STIFFNESS,
        ),
    }
}

fn clamp(key: &str, restraint: &Restraint, length: f64) -> Result<(), SceneError> {
    let Restraint { position, stiffness } = *restraint;
    suiting(format!("{key}.position"), position, range::positions(length))?;
    quantity(
        format!("{key}.stiffness"),
        stiffness,
        Dimension::ForcePerLength,
        STIFFNESS,
    )
}

fn vehicles(scene: &Scene) -> Result<(), SceneError> {
    if scene.vehicles.is_empty() {
        return Err(refused("vehicles", "none", "one vehicle or more"));
    }
    let mut names = HashSet::new();
    for (index, TrafficVehicle { vehicle, share }) in scene.vehicles.iter().enumerate() {
        let key = |key: &str| format!("vehicles.{index}.{key}");
        if vehicle.name().trim().is_empty() || !names.insert(vehicle.name()) {
            let found = format!("\"{}\"", vehicle.name());
            return Err(refused(key("name"), found, "a name that no other vehicle has"));
        }
        quantity(key("speed"), vehicle.speed(), Dimension::Speed, SPEED)?;
        for (number, wheel) in vehicle.wheels().iter().enumerate() {
            let key = |name: &str| key(&format!("wheels.{number}.{name}"));
            quantity(key("x"), wheel.x, Dimension::Length, OFFSET)?;
            quantity(key("y"), wheel.y, Dimension::Length, OFFSET)?;
            quantity(key("load"), wheel.load.force(), Dimension::Force, LOAD)?;
            let radius = wheel.load.contact_radius();
            quantity(key("contact_radius"), radius, Dimension::Length, CONTACT_RADIUS)?;
        }
        if let Some(allowed) = traffic::unscalable(vehicle, index, scene.ground.scaling) {
            return Err(refused(key("load"), "a vehicle without load", allowed));
        }
        let sequence = matches!(scene.traffic.order, Order::Sequence(_));
        if !(0.0..=1.0).contains(share) || (*share == 0.0 && !sequence) {
            return Err(refused(
                key("share"),
                shown(*share),
                "a number greater than 0 and at most 1",
            ));
        }
    }
    let sum: f64 = scene.vehicles.iter().map(|vehicle| vehicle.share).sum();
    if (sum - 1.0).abs() > ROUNDING {
        let found = format!("shares that sum to {}", shown(sum));
        return Err(refused("vehicles", found, "shares that sum to 1"));
    }
    Ok(())
}

/// A sequence names vehicles that there are, each as often as its share says.
fn order(scene: &Scene) -> Result<(), SceneError> {
    const KEY: &str = "traffic.sequence";
    let Order::Sequence(sequence) = &scene.traffic.order else {
        return Ok(());
    };
    let mut counts = vec![0_u64; scene.vehicles.len()];
    for &index in sequence {
        let Some(count) = counts.get_mut(index) else {
            let allowed = format!("a vehicle's index, less than {}", scene.vehicles.len());
            return Err(refused(KEY, index, allowed));
        };
        *count += 1;
    }
    if sequence.is_empty() {
        return Err(refused(KEY, "an empty list", "one vehicle's index or more"));
    }
    for (index, (vehicle, count)) in scene.vehicles.iter().zip(counts).enumerate() {
        let share = count as f64 / sequence.len() as f64;
        if (vehicle.share - share).abs() > ROUNDING {
            let allowed = format!("{}, its share of the sequence", shown(share));
            let key = format!("vehicles.{index}.share");
            return Err(refused(key, shown(vehicle.share), allowed));
        }
    }
    Ok(())
}

fn solver(solver: &Solver, length: f64) -> Result<(), SceneError> {
    number("solver.tolerance", solver.tolerance, TOLERANCE)?;
    if let Some(spacing) = solver.node_spacing {
        suiting("solver.node_spacing", spacing, range::node_spacings(length))?;
    }
    if let Some(step) = solver.vehicle_step {
        suiting("solver.vehicle_step", step, range::vehicle_steps(length))?;
    }
    if let Some(step) = solver.time_step {
        quantity("solver.time_step", step, Dimension::Time, POSITIVE)?;
    }
    if let Some(approach) = solver.approach {
        quantity("solver.approach", approach, Dimension::Length, APPROACH)?;
    }
    Ok(())
}
