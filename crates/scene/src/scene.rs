//! A scene: the sections of its file.

use std::path::Path;

use cable_dem::{End, Order, Restraint, Section};

use crate::cable::{Cable, Friction};
use crate::content::Content;
use crate::error::Result;
use crate::ground::Ground;
use crate::heat::Heat;
use crate::key::Form;
use crate::key::Form::{Any, Either, Intervals, List, Name, Number, Table, Text, Words};
use crate::range;
use crate::route::RouteSection;
use crate::section::keys;
use crate::solver::Solver;
use crate::stored::{Given, Stored};
use crate::traffic::{Following, Traffic};
use crate::uncertain::{Cost, INTERVALS, Uncertain};
use crate::vehicle::TrafficVehicle;

keys! {
    /// A cable in a duct under traffic, as its file says it, in SI.
    #[non_exhaustive]
    pub struct Scene {
        /// Name of the scene in tables and reports.
        title: String = Text("a text in quotes"), "the file's name";
        /// Where the duct lies: as deep everywhere below a road that slopes and bends as it does.
        duct: Duct = Table(Duct::KEYS);
        /// Sections of a duct that slopes or bends, in place of `duct.slope`.
        route: Vec<RouteSection> = List(&[Table(RouteSection::KEYS)], 0, "a list of [[route]] sections, from x = 0 on"), "straight, with `duct.slope`";
        /// The ground around the duct.
        ground: Ground = Table(Ground::KEYS);
        /// The cable in the duct.
        cable: Cable = Table(Cable::KEYS);
        /// Friction between cable and duct.
        friction: Friction = Table(Friction::KEYS);
        /// What holds the cable's two ends.
        ends: Ends = Table(Ends::KEYS);
        /// Clamps along the cable.
        restraints: Vec<Restraint> = CLAMPS, "none";
        /// Who drives above the duct.
        vehicles: Vec<TrafficVehicle> = List(&[Table(TrafficVehicle::KEYS)], 1, VEHICLES), "traffic.histogram instead";
        /// How much traffic, and in which order.
        traffic: Traffic = Table(Traffic::KEYS);
        /// How warm the cable gets every day; needs `traffic.per_day`.
        heat: Option<Heat> = Table(Heat::KEYS), "none";
        /// How to compute.
        solver: Solver = Table(Solver::KEYS), "all is chosen";
        /// What is known only between two values: `creepage measures` and `report` compute all combinations.
        uncertain: Vec<Uncertain> = Intervals(|| Scene::KEYS, INTERVALS), "nothing";
        /// Ways to hold the cable that `creepage measures` compares; a list built in if there are none.
        measures: Vec<Measure> = List(&[Table(Measure::KEYS)], 0, "a list of [[measures]]"), "none";
    }
}

/// Speed of the axles of a histogram if the file gives none \[m/s\]: 40 km/h, as for the presets.
const AXLE_SPEED: f64 = 40.0 / 3.6;
pub const VEHICLES: &str = "one [[vehicles]] or more, or traffic.histogram";

keys! {
    /// A duct at constant depth below a road that slopes and bends as it does, from x = 0 to x = `length`; in SI.
    #[derive(Copy)]
    pub struct Duct {
        /// Length of the duct, from manhole to manhole.
        length: f64 = Number(range::DUCT_LENGTH);
        /// Depth of the cable below the road surface.
        depth: f64 = Number(range::DEPTH);
        /// How far the duct lies to the left of the first lane's axis, seen along forward traffic.
        lateral_offset: f64 = Number(range::LATERAL_OFFSET), "0 m";
        /// How steeply the duct rises with x: tan θ.
        slope: f64 = Number(range::SLOPE), "0";
        /// Inner diameter of the duct; needed for several cables in it.
        inner_diameter: Option<f64> = Number(range::INNER_DIAMETER), "none";
    }
}

keys! {
    /// What holds the cable's two ends.
    #[derive(Copy, serde::Serialize)]
    pub struct Ends {
        /// What holds the end at x = 0, where forward vehicles come in.
        upstream: End = END;
        /// What holds the end at x = length.
        downstream: End = END;
    }
}

keys! {
    for Restraint {
        /// Where the clamp is along the duct, from x = 0.
        position = Number(range::POSITION);
        /// Stiffness of the clamp; `spring` is understood too.
        stiffness = Number(range::CLAMP);
        /// Force above which the clamp slips.
        holds = Number(range::HOLDS), "it never slips";
    }
}

keys! {
    /// A way to hold the cable: what it gives takes the place of what the scene has, in SI.
    #[derive(Default)]
    pub struct Measure {
        /// Name of the measure in tables.
        name: String = Name("a name in quotes that no other measure has");
        /// What holds the end at x = 0.
        upstream: Option<End> = END, "that of [ends]";
        /// What holds the end at x = length.
        downstream: Option<End> = END, "that of [ends]";
        /// Clamps in place of all that the scene has.
        restraints: Option<Vec<Restraint>> = CLAMPS, "those of the scene";
        /// Clamps that join these.
        added_restraints: Vec<Restraint> = CLAMPS, "none";
        /// What it costs; numbers are compared, a text is only shown.
        cost: Option<Cost> = Any("a cost as a number of at least 0, or a text such as \"two weeks\""), "none";
    }
}

const CLAMPS: Form = List(&[Table(Restraint::KEYS)], 0, "a list of [[restraints]]");
const WORDS: Form = Words(&["free", "fixed"], " or { spring = \"3 MN/m\" }");
const ENDS: &[(&str, End)] = &[("free", End::Free), ("fixed", End::Fixed)];
const END: Form = Either(&WORDS, Sprung::KEYS);

keys! {
    /// An end that a spring holds.
    pub struct Sprung {
        /// Stiffness of the spring at this end; `stiffness` is understood too.
        spring: f64 = Number(range::SPRING);
    }
}

impl Stored for End {
    fn read(given: &Given) -> Result<Self> {
        match given.node.content {
            Content::Table(_) => Sprung::read(given).map(|end| Self::Spring(end.spring)),
            _ => given.word(ENDS, given.form.allowed()),
        }
    }

    fn write(&self, form: Form) -> Content {
        match *self {
            Self::Free => Content::Text("free".to_owned()),
            Self::Fixed => Content::Text("fixed".to_owned()),
            Self::Spring(spring) => Sprung { spring }.write(form),
        }
    }
}

impl Measure {
    /// The scene with this measure, which is not checked.
    pub fn applied(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.ends.upstream = self.upstream.unwrap_or(scene.ends.upstream);
        scene.ends.downstream = self.downstream.unwrap_or(scene.ends.downstream);
        scene.restraints = self.restraints.clone().unwrap_or(scene.restraints);
        scene.restraints.extend(&self.added_restraints);
        scene
    }

    /// How many ends and clamps it gives.
    pub fn parts(&self) -> usize {
        let ends = self.upstream.iter().chain(&self.downstream);
        let clamps = self.restraints.iter().flatten();
        ends.count() + clamps.chain(&self.added_restraints).count()
    }
}

impl Scene {
    /// Normal force on the duct as a multiple of the cable's weight: as it is given, or as the cable's arrangement and the diameters make
    /// it; 1 if none of them is known.
    pub fn normal_load_factor(&self) -> f64 {
        let follows = || {
            let (inner, outer) = (self.duct.inner_diameter?, self.cable.diameter?);
            Some(self.cable.arrangement.normal_load_factor(inner, outer))
        };
        self.cable.normal_load_factor.or_else(follows).unwrap_or(1.0)
    }

    /// Normal force between cable and duct per length N' in a level duct \[N/m\].
    pub fn normal_load(&self) -> f64 {
        self.normal_load_factor() * self.cable.weight
    }

    /// The route from x = 0 on; one section if there is none.
    fn whole_route(&self) -> Vec<RouteSection> {
        if !self.route.is_empty() {
            return self.route.clone();
        }
        let mut whole = RouteSection::default();
        (whole.length, whole.slope) = (Some(self.duct.length), self.duct.slope);
        vec![whole]
    }

    /// The sections of the duct from x = 0 on, each with friction, weight along the duct and bend; one if there is no route.
    pub fn sections(&self) -> Vec<Section> {
        let section = |section: &RouteSection| {
            let (sine, cosine) = section.angle();
            let of_scene = self.friction.dynamic_coefficient;
            let friction = section.dynamic_coefficient.unwrap_or(of_scene);
            let limit = friction * self.normal_load() * cosine;
            Section::new(section.length.unwrap_or(0.0), limit)
                .with_body_force(-self.cable.weight * sine)
                .with_bend(section.bend_radius.map_or(0.0, |radius| friction / radius))
        };
        self.whole_route().iter().map(section).collect()
    }

    /// Largest friction per length of cable, q = μ_d N′ cos θ \[N/m\], with the friction coefficient of the scene and the mean of cos θ.
    pub fn friction_limit(&self) -> f64 {
        self.friction.dynamic_coefficient * self.normal_load() * self.mean(|section| section.angle().1)
    }

    /// Force of the cable's weight along the duct per length, p = −w sin θ \[N/m\], positive toward growing x; its mean over the duct.
    pub fn body_force(&self) -> f64 {
        -self.cable.weight * self.mean(|section| section.angle().0)
    }

    /// The mean over the duct's length.
    fn mean(&self, of: impl Fn(&RouteSection) -> f64) -> f64 {
        let route = self.whole_route();
        let first = of(&route[0]);
        if route.iter().all(|section| of(section) == first) {
            return first;
        }
        let part = |section: &RouteSection| of(section) * section.length.unwrap_or(0.0);
        route.iter().map(part).sum::<f64>() / self.duct.length
    }

    /// Gives the last section of the route what is left of the duct.
    fn complete_route(&mut self) {
        if let Some((last, others)) = self.route.split_last_mut() {
            let used: f64 = others.iter().filter_map(|section| section.length).sum();
            let left = Some(self.duct.length - used).filter(|left| *left > 0.0);
            last.length = last.length.or(left);
        }
    }

    /// The heat of its days, if it makes any force.
    pub fn warming(&self) -> Option<&Heat> {
        self.heat.as_ref().filter(|heat| heat.makes_force())
    }

    /// How far the duct's axis lies to the left of this vehicle's axis \[m\], seen in the direction of forward traffic.
    pub fn offset_from(&self, vehicle: &TrafficVehicle) -> f64 {
        self.duct.lateral_offset - vehicle.lateral_offset
    }

    /// Which vehicle drives when.
    pub fn order(&self) -> Order {
        let index = |name: &String| self.vehicles.iter().position(|vehicle| vehicle.name == *name);
        match (&self.traffic.sequence[..], self.traffic.order) {
            ([], Following::Interleaved) => Order::Interleaved,
            ([], Following::Random) => Order::Random {
                seed: self.traffic.seed,
            },
            (names, _) => Order::Sequence(names.iter().filter_map(index).collect()),
        }
    }

    /// The share of each vehicle in the passes, or in the sequence; they sum to 1.
    pub fn shares(&self) -> Vec<f64> {
        let sequence = &self.traffic.sequence;
        let count = |name: &str| sequence.iter().filter(|other| *other == name).count() as f64;
        let share = |vehicle: &TrafficVehicle| match sequence[..] {
            [] => vehicle.share,
            _ => count(&vehicle.name),
        };
        let shares: Vec<f64> = self.vehicles.iter().map(share).collect();
        let largest = shares.iter().fold(0.0, |largest: f64, share| largest.max(*share));
        let sum: f64 = shares.iter().map(|share| share / largest).sum();
        shares.iter().map(|share| share / largest / sum).collect()
    }

    /// Puts what is computed once in place of what it follows from; `file` is the scene's.
    pub(crate) fn resolve(&mut self, file: &str) -> Result<()> {
        if self.title.is_empty() {
            let stem = Path::new(file).file_stem().unwrap_or_default();
            self.title = stem.to_string_lossy().into_owned();
        }
        self.cable.resolve()?;
        self.traffic.resolve()?;
        self.complete_route();
        if let Some(histogram) = self.traffic.histogram.take() {
            self.vehicles = histogram.axles(file, self.traffic.speed.take().unwrap_or(AXLE_SPEED))?;
            self.traffic.order = Following::Random;
        }
        for (index, vehicle) in self.vehicles.iter_mut().enumerate() {
            if vehicle.name.is_empty() {
                vehicle.name = format!("vehicle {}", index + 1);
            }
        }
        Ok(())
    }
}
