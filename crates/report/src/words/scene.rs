//! The scene of a run in words.

use ground_field::{Base, Direction, Modulus};

use super::answer::Answer;
use super::number::{passes, power_of_ten, quantity, range, significant};
use super::reader::Reader;
use super::table::Table;
use creepage_plan::{ground::load_ratio, shown::words_if};
use creepage_run::answer::after;
use creepage_scene::{Arrangement, End, FrictionLaw, Order, RouteSection, TrafficVehicle};

/// Vehicles that differ by their load alone have one row where there are more than this.
const MAX_ROWS: usize = 12;
/// Kilometres an hour of a metre a second.
const KILOMETRES_PER_HOUR: f64 = 3.6;

/// What holds an end: "free", "fixed", "spring of 3000 kN/m".
pub fn held_by(end: End, reader: &Reader) -> String {
    match end {
        End::Free => "free".into(),
        End::Fixed => "fixed".into(),
        End::Spring(spring) => format!("spring of {}", reader.stiffness(spring)),
    }
}

/// "rises by 2 %", "falls with x by 2 %"
fn sloping(slope: f64, along: &str) -> String {
    let way = if slope > 0.0 { "rises" } else { "falls" };
    format!("{way}{along} by {} %", significant(100.0 * slope.abs()))
}

/// Middle between a vehicle's outer wheels, to the left of the line from which the scene measures \[m\].
pub fn middle(vehicle: &TrafficVehicle) -> f64 {
    let [right, left] = range(vehicle.wheels().into_iter().map(|wheel| wheel.y));
    0.5 * (right + left) + vehicle.lateral_offset
}

impl Answer<'_> {
    /// What lies where and what holds it: a point for each part.
    pub fn points(&self) -> Vec<String> {
        let Self { scene, reader, .. } = self;
        let (long, deep) = (reader.length(scene.duct.length), reader.length(scene.duct.depth));
        let [upstream, downstream] =
            [scene.ends.upstream, scene.ends.downstream].map(|end| held_by(end, reader));
        let mut points = vec![
            format!(
                "Duct: {long} long, {deep} from the road surface to the cable{}.",
                self.slope()
            ),
            self.cable(),
            self.friction(),
            format!("Ends: upstream (x = 0) {upstream}, downstream (x = {long}) {downstream}."),
        ];
        let mut begin = 0.0;
        for section in &scene.route {
            let end = begin + section.length.unwrap_or(0.0);
            points.push(self.section(section, begin, end));
            begin = end;
        }
        for (number, clamp) in (1..).zip(&scene.restraints) {
            let (stiffness, place) = (reader.stiffness(clamp.stiffness), reader.length(clamp.position));
            let slips = clamp
                .holds
                .map(|holds| format!(", slips above {}", reader.force(holds)));
            let slips = slips.unwrap_or_default();
            points.push(format!("Clamp {number}: {stiffness} at {place}{slips}."));
        }
        points.push(self.traffic());
        points
    }

    /// Which way the duct slopes, and what draws the cable down it.
    fn slope(&self) -> String {
        let slope = self.scene.duct.slope;
        if slope == 0.0 {
            return String::new();
        }
        let drawn = self.reader.weight(self.scene.body_force().abs());
        let slope = sloping(slope, " with x");
        format!("; it {slope}, and {drawn} of the cable’s weight draw it down")
    }

    /// A part of the route, and what its bend does.
    fn section(&self, section: &RouteSection, begin: f64, end: f64) -> String {
        let Self { scene, reader, run } = self;
        let compressions = run.passes.iter().map(|pass| pass.max_compression_n.abs());
        let largest = compressions.fold(0.0, f64::max);
        let slope = match section.slope {
            0.0 => "level".to_owned(),
            slope => sloping(slope, ""),
        };
        let bend = section.bend_radius.map_or_else(String::new, |radius| {
            let effect = if largest > scene.cable.weight * radius {
                "more than its weight, so that the bend anchors it"
            } else {
                "less than its weight, which adds a few per cent"
            };
            let radius = reader.length(radius);
            format!(", bend of {radius} radius: the cable’s force presses it sideways with {effect}")
        });
        let friction = section.dynamic_coefficient.map(significant);
        let friction = friction.map_or_else(String::new, |friction| format!(", friction {friction}"));
        let (from, to) = (reader.length(begin), reader.length(end));
        format!("Section from {from} to {to}: {slope}{bend}{friction}.")
    }

    fn cable(&self) -> String {
        let Self { scene, reader, .. } = self;
        let cable = &scene.cable;
        let (under, place) = match cable.arrangement {
            Arrangement::TrefoilUpper => ("the two lower cables", "the upper one of three cables in trefoil"),
            Arrangement::TrefoilLower => ("the duct", "a lower one of three cables in trefoil"),
            Arrangement::CradledOuter => ("the duct", "an outer one of three cables side by side"),
            Arrangement::CradledMiddle => ("the duct", "the middle one of three cables side by side"),
            Arrangement::Single => ("the duct", ""),
        };
        let factor = scene.normal_load_factor();
        let pressed = match significant(factor) {
            _ if factor == 1.0 => "it lies on the duct with its own weight".to_owned(),
            times => format!("it presses on {under} with {times} times its weight"),
        };
        let diameters = [scene.duct.inner_diameter, cable.diameter];
        let [inner, own] = diameters.map(|diameter| reader.length(diameter.unwrap_or_default()));
        let beside = format!(", as {place}, {own} thick in a duct of {inner}");
        let beside = words_if(!place.is_empty(), &beside);
        let (weight, stiffness) = (reader.weight(cable.weight), reader.load(cable.axial_stiffness));
        format!("Cable: {weight} heavy, axial stiffness EA {stiffness}; {pressed}{beside}.")
    }

    fn friction(&self) -> String {
        let Self { scene, reader, .. } = self;
        let shape = |b: f64| format!("shape factor {} 1/m", power_of_ten(b));
        let law = match scene.friction.law() {
            FrictionLaw::Coulomb => "Coulomb's law".to_owned(),
            FrictionLaw::ElasticPlastic { shape_factor } => {
                format!("elastic-plastic law, {}", shape(shape_factor))
            }
            FrictionLaw::Sigmoid { shape_factor } => format!("sigmoid law, {}", shape(shape_factor)),
            _ => "a law of its own".to_owned(),
        };
        // What computing several cables together would change.
        let together = match scene.cable.arrangement {
            Arrangement::Single => "",
            Arrangement::TrefoilUpper | Arrangement::TrefoilLower => {
                " The cables are computed one by one, each with the share of the weight that it carries: compute the others too. Together \
                 the lower ones would also carry the upper one’s friction, which is left out."
            }
            _ => {
                " The cables are computed one by one, without friction between them: compute the others too."
            }
        };
        let coefficient = significant(scene.friction.dynamic_coefficient);
        let limit = reader.weight(scene.friction_limit());
        format!("Friction: dynamic coefficient {coefficient}, so at most {limit}; {law}.{together}")
    }

    fn traffic(&self) -> String {
        let (traffic, vehicles) = (&self.scene.traffic, self.scene.vehicles.len());
        let rate = traffic.per_day.zip(traffic.years_after(traffic.passes));
        let rate =
            rate.map(|(per_day, years)| format!(" in {}, {} a day,", after(years), significant(per_day)));
        let passes = passes(traffic.passes) + &rate.unwrap_or_default();
        let order = match self.scene.order() {
            _ if vehicles == 1 => return format!("Traffic: {passes} of one vehicle."),
            Order::Interleaved => "mixed evenly by their shares",
            Order::Random { .. } => "at random by their shares",
            Order::Sequence(_) => "in a given sequence, over and over",
        };
        format!("Traffic: {passes} of {vehicles} kinds of vehicles, {order}.")
    }

    /// The layers of the ground from the surface down; none of a ground that cannot be.
    pub fn ground(&self) -> Option<Table> {
        let Self { scene, reader, .. } = self;
        let profile = scene.ground.profile().ok()?;
        let row = |depth: String, modulus: Modulus, ratio: f64| {
            vec![depth, reader.moduli(modulus), significant(ratio)]
        };
        let mut rows = Vec::new();
        let mut top = 0.0;
        for layer in profile.layers() {
            let depths = reader.depths(top, top + layer.thickness());
            rows.push(row(depths, layer.modulus(), layer.poisson_ratio()));
            top += layer.thickness();
        }
        let below = match reader.depth(top) {
            _ if top == 0.0 => "everywhere".to_owned(),
            depth => format!("below {depth}"),
        };
        rows.push(match profile.base() {
            Base::HalfSpace(soil) => {
                let modulus = Modulus::Uniform(soil.young_modulus());
                row(below, modulus, soil.poisson_ratio())
            }
            Base::Rigid => vec![below, "rock that does not move".into(), "–".into()],
        });
        let head = ["ground at depth", "Young’s modulus", "Poisson’s ratio"];
        Some(Table::new(head, rows, 1))
    }

    /// How the ground was scaled to a measurement, if it was.
    pub fn scaling(&self) -> Option<String> {
        let ground = &self.scene.ground;
        let peak = ground.longitudinal_peak.or(ground.vertical_peak)?;
        let peak = quantity(peak, "m");
        let how = match ground.longitudinal_peak {
            Some(_) => format!("so that each vehicle moves it by {peak} along its axis at most"),
            None => format!("to a measured deflection: {peak} down under the first vehicle"),
        };
        Some(format!("The motion of the duct is scaled {how}."))
    }

    /// The vehicles, and where they drive.
    pub fn vehicles(&self) -> Table {
        let Self { scene, reader, .. } = self;
        let first = &scene.vehicles[0];
        let alike = |other: &TrafficVehicle| load_ratio(other, first).is_some();
        let row = |(vehicle, share): (&TrafficVehicle, f64)| {
            let speed = significant(KILOMETRES_PER_HOUR * vehicle.speed);
            let direction = match vehicle.direction {
                Direction::Forward => "forward",
                Direction::Reverse => "reverse",
            };
            vec![
                vehicle.name.clone(),
                format!("{speed} km/h {direction}, {}", self.lane(vehicle)),
                load(vehicle, reader),
                format!("{} %", significant(100.0 * share)),
            ]
        };
        let mut rows: Vec<Vec<String>> = scene.vehicles.iter().zip(scene.shares()).map(row).collect();
        if rows.len() > MAX_ROWS && scene.vehicles.iter().all(alike) {
            let name = format!("{} classes of axles", rows.len());
            rows = vec![vec![name, rows[0][1].clone(), self.loads(), "100 %".to_owned()]];
        }
        Table::new(["vehicle", "drives", "load", "share"], rows, 3)
    }

    /// The range of the vehicles' loads and their mean.
    fn loads(&self) -> String {
        let weights = || self.scene.vehicles.iter().map(TrafficVehicle::weight);
        let shared = weights().zip(self.scene.shares());
        let mean: f64 = shared.map(|(weight, share)| share * weight).sum();
        let [least, most] = range(weights());
        let [least, most, mean] = [least, most, mean].map(|load| self.reader.load(load));
        format!("{least} to {most}, in the mean {mean}")
    }

    /// Where a vehicle drives relative to the duct, seen toward growing x.
    fn lane(&self, vehicle: &TrafficVehicle) -> String {
        let left = middle(vehicle) - self.scene.duct.lateral_offset;
        if left.abs() < 5e-4 {
            return "right above the duct".into();
        }
        let side = if left > 0.0 { "left" } else { "right" };
        format!("{} {side} of the duct", self.reader.length(left.abs()))
    }
}

fn load(vehicle: &TrafficVehicle, reader: &Reader) -> String {
    let whole = reader.load(vehicle.weight());
    match &vehicle.wheels()[..] {
        [wheel] if wheel.contact_radius == 0.0 => format!("{whole}, concentrated"),
        [_] => format!("{whole}, one wheel"),
        wheels => format!("{whole} on {} wheels", wheels.len()),
    }
}
