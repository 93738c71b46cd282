//! A scene as a file.

use std::fmt::{Display, Write};

use ground_field::{Base, Modulus, SoilLayer, Wheel};

use super::data::{
    End, Ends, FrictionLaw, Ground, Heat, Order, PeakScaling, Scene, Solver, TrafficVehicle, Warming,
};

impl Scene {
    /// The scene as a TOML file, all quantities in SI: [`Scene::from_toml`] reads the same scene from it.
    ///
    /// A time step that the method does not use is left out. The last layer on a rigid base is written as the depth of the base, so the
    /// thickness that is read may differ in its last digit if a program chose it.
    ///
    /// ```
    /// use creepage::Scene;
    ///
    /// let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    /// scene.duct.depth = 1.5;
    /// let text = scene.to_toml();
    /// assert!(text.contains("depth = \"1.5 m\""));
    /// assert_eq!(Scene::from_toml("deeper.toml", &text)?, scene);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn to_toml(&self) -> String {
        let mut out = Text::default();
        out.word("title", &self.title);
        out.section("[duct]");
        out.quantity("length", self.duct.length, "m");
        out.quantity("depth", self.duct.depth, "m");
        out.quantity("lateral_offset", self.duct.lateral_offset, "m");
        out.optional("inner_diameter", self.duct.inner_diameter, "m");
        if self.duct.slope != 0.0 {
            out.number("slope", self.duct.slope);
        }
        out.ground(&self.ground);
        out.section("[cable]");
        out.quantity("weight", self.cable.weight, "N/m");
        out.quantity("axial_stiffness", self.cable.axial_stiffness, "N");
        // Of several cables the factor follows from what is known of them.
        if self.cable.arrangement.is_of_three() {
            out.word("arrangement", &self.cable.arrangement.to_string());
        } else if self.cable.diameter.is_none() {
            out.number("normal_load_factor", self.cable.normal_load_factor);
        }
        out.optional("diameter", self.cable.diameter, "m");
        out.section("[friction]");
        out.word("law", self.friction.law.name());
        out.number("dynamic_coefficient", self.friction.dynamic_coefficient);
        if self.friction.law != FrictionLaw::Coulomb {
            out.quantity("shape_factor", self.friction.law.shape_factor(), "1/m");
        }
        out.ends(self.ends);
        for restraint in &self.restraints {
            out.section("[[restraints]]");
            out.quantity("position", restraint.position, "m");
            out.quantity("stiffness", restraint.stiffness, "N/m");
        }
        let in_sequence = matches!(self.traffic.order, Order::Sequence(_));
        for vehicle in &self.vehicles {
            out.vehicle(vehicle);
            if !in_sequence {
                out.number("share", vehicle.share);
            }
        }
        out.traffic(self);
        if let Some(heat) = &self.heat {
            out.heat(heat);
        }
        out.solver(&self.solver);
        out.0
    }
}

#[derive(Default)]
struct Text(String);

impl Text {
    /// Writes `key = value`; writing to a text does not fail.
    fn line(&mut self, key: &str, value: impl Display) {
        let _ = writeln!(self.0, "{key} = {value}");
    }

    fn section(&mut self, heading: &str) {
        let _ = writeln!(self.0, "\n{heading}");
    }

    fn word(&mut self, key: &str, word: &str) {
        self.line(key, quoted(word));
    }

    fn number(&mut self, key: &str, value: f64) {
        // TOML writes `nan` and `inf`, which no scene may hold, in small letters.
        self.line(key, format!("{value:?}").to_lowercase());
    }

    fn quantity(&mut self, key: &str, value: f64, unit: &str) {
        self.line(key, in_unit(value, unit));
    }

    fn optional(&mut self, key: &str, value: Option<f64>, unit: &str) {
        if let Some(value) = value {
            self.quantity(key, value, unit);
        }
    }

    fn ground(&mut self, ground: &Ground) {
        let layers = ground.profile.layers();
        self.section("[ground]");
        self.word("model", &ground.model.to_string());
        match ground.scaling {
            Some(PeakScaling::Longitudinal(peak)) => self.quantity("longitudinal_peak", peak, "m"),
            Some(PeakScaling::Vertical(peak)) => self.quantity("vertical_peak", peak, "m"),
            None => {}
        }
        let above_base = match (ground.profile.base(), layers) {
            (Base::Rigid, [upper @ .., last]) => {
                self.quantity("rigid_base_depth", base_depth(upper, last), "m");
                upper.len()
            }
            _ => layers.len(),
        };
        for (index, layer) in layers.iter().enumerate() {
            self.section("[[ground.layers]]");
            if index < above_base {
                self.quantity("thickness", layer.thickness(), "m");
            }
            self.soil(layer.modulus(), layer.poisson_ratio());
        }
        if let Base::HalfSpace(soil) = ground.profile.base() {
            self.section("[[ground.layers]]");
            self.soil(Modulus::Uniform(soil.young_modulus()), soil.poisson_ratio());
        }
    }

    fn soil(&mut self, modulus: Modulus, poisson_ratio: f64) {
        match modulus {
            Modulus::Uniform(modulus) => self.quantity("young_modulus", modulus, "Pa"),
            Modulus::Linear { top, bottom } => {
                let (top, bottom) = (in_unit(top, "Pa"), in_unit(bottom, "Pa"));
                self.line(
                    "young_modulus",
                    format_args!("{{ top = {top}, bottom = {bottom} }}"),
                );
            }
        }
        self.number("poisson_ratio", poisson_ratio);
    }

    fn ends(&mut self, ends: Ends) {
        self.section("[ends]");
        for (key, end) in [("upstream", ends.upstream), ("downstream", ends.downstream)] {
            match end {
                End::Free => self.word(key, "free"),
                End::Fixed => self.word(key, "fixed"),
                End::Spring(stiffness) => {
                    self.line(key, format_args!("{{ spring = {} }}", in_unit(stiffness, "N/m")));
                }
            }
        }
    }

    fn vehicle(&mut self, traffic: &TrafficVehicle) {
        let vehicle = &traffic.vehicle;
        self.section("[[vehicles]]");
        self.word("name", vehicle.name());
        self.quantity("speed", vehicle.speed(), "m/s");
        self.word("direction", &vehicle.direction().to_string());
        if traffic.lateral_offset != 0.0 {
            self.quantity("lateral_offset", traffic.lateral_offset, "m");
        }
        match vehicle.wheels() {
            [Wheel { x, y, load }] if (*x, *y, load.contact_radius()) == (0.0, 0.0, 0.0) => {
                self.quantity("load", load.force(), "N");
            }
            wheels => {
                let wheels: Vec<String> = wheels.iter().map(wheel).collect();
                self.line("wheels", format_args!("[\n{}]", wheels.concat()));
            }
        }
    }

    fn traffic(&mut self, scene: &Scene) {
        self.section("[traffic]");
        self.line("passes", scene.traffic.passes);
        if let Some(per_day) = scene.traffic.per_day {
            self.number("per_day", per_day);
        }
        match &scene.traffic.order {
            Order::Interleaved => {}
            Order::Random { seed } => {
                self.word("order", "random");
                self.line("seed", seed);
            }
            Order::Sequence(sequence) => {
                let name = |&index: &usize| scene.vehicles.get(index).map(|v| quoted(v.vehicle.name()));
                let names: Vec<String> = sequence.iter().filter_map(name).collect();
                self.line("sequence", format_args!("[{}]", names.join(", ")));
            }
        }
    }

    fn heat(&mut self, heat: &Heat) {
        self.section("[heat]");
        self.quantity("expansion", heat.expansion, "1/K");
        match &heat.warming {
            Warming::Swing(swing) => self.quantity("daily_swing", *swing, "K"),
            Warming::Profile(points) => {
                let point = |(time, kelvin): &(f64, f64)| {
                    format!("[{}, {}]", in_unit(*time, "s"), in_unit(*kelvin, "K"))
                };
                let points: Vec<String> = points.iter().map(point).collect();
                self.line("profile", format_args!("[{}]", points.join(", ")));
            }
        }
        self.quantity("offset", heat.offset, "K");
    }

    fn solver(&mut self, solver: &Solver) {
        self.section("[solver]");
        self.word("method", &solver.method.to_string());
        self.number("tolerance", solver.tolerance);
        self.optional("node_spacing", solver.node_spacing, "m");
        self.optional("vehicle_step", solver.vehicle_step, "m");
        let time_step = solver.time_step.filter(|_| solver.method.has_time_steps());
        self.optional("time_step", time_step, "s");
        self.optional("approach", solver.approach, "m");
    }
}

fn wheel(wheel: &Wheel) -> String {
    let Wheel { x, y, load } = wheel;
    let (x, y) = (in_unit(*x, "m"), in_unit(*y, "m"));
    let (force, radius) = (in_unit(load.force(), "N"), in_unit(load.contact_radius(), "m"));
    format!("  {{ x = {x}, y = {y}, load = {force}, contact_radius = {radius} }},\n")
}

/// The depth of the base \[m\] from which the last layer's thickness is computed to the last digit, if there is one.
fn base_depth(upper: &[SoilLayer], last: &SoilLayer) -> f64 {
    let above: f64 = upper.iter().map(SoilLayer::thickness).sum();
    let sum = above + last.thickness();
    let exact = |depth: &f64| depth - above == last.thickness();
    [sum, sum.next_down(), sum.next_up()]
        .into_iter()
        .find(exact)
        .unwrap_or(sum)
}

fn in_unit(value: f64, unit: &str) -> String {
    quoted(&format!("{value:?} {unit}"))
}

/// A text in quotes, as TOML has it.
pub fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                // Writing to a text does not fail.
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
