//! The tables of a scene file and their keys. Those that a scene has as they are written stand with its data; these are turned into it.

use cable_dem::Restraint;
use ground_field::{Direction, Modulus};

use crate::data::{Arrangement, Duct, Ends, GroundModel, Heat, Solver};
use crate::either::{HISTOGRAM, HistogramKeys, LAYER_MODULUS};
use crate::key::keys;
use crate::kind::{List, Optional, Or, Text, Whole, Word, section};
use crate::range::{
    ANY_WHOLE, AXIAL_STIFFNESS, CLAMP, COEFFICIENT, CONDUCTOR_AREA, CONDUCTOR_MODULUS, CONTACT_RADIUS,
    DIAMETER, LANE, LOAD, LOAD_FACTOR, LONGITUDINAL_PEAK, PASSES, PER_DAY, POISSON, POSITION,
    RIGID_BASE_DEPTH, SHAPE_FACTOR, SHARE, SPEED, THICKNESS, VERTICAL_PEAK, WEIGHT, WHEEL_LOAD, WHEEL_X,
    WHEEL_Y, YEARS,
};

keys! {
    /// A scene file.
    pub struct SceneKeys {
        /// Name of the scene in tables and reports.
        title: Option<String> = Optional(Text("a text in quotes")), "the file's name";
        /// Where the duct lies: straight, and as deep everywhere below a road that may slope.
        duct: Duct = section::<Duct>();
        /// The ground around the duct.
        ground: GroundKeys = section::<GroundKeys>();
        /// The cable in the duct.
        cable: CableKeys = section::<CableKeys>();
        /// Friction between cable and duct.
        friction: FrictionKeys = section::<FrictionKeys>();
        /// What holds the cable's two ends.
        ends: Ends = section::<Ends>();
        /// Clamps along the cable.
        restraints: Vec<Restraint> = List(section::<Restraint>(), 0, "a list of [[restraints]]"), "none";
        /// Who drives above the duct.
        vehicles: Option<Vec<VehicleKeys>> = Optional(List(section::<VehicleKeys>(), 1, VEHICLES)), "traffic.histogram instead";
        /// How much traffic, and in which order.
        traffic: TrafficKeys = section::<TrafficKeys>();
        /// How warm the cable gets every day; needs `traffic.per_day`.
        heat: Option<Heat> = Optional(section::<Heat>()), "none";
        /// How to compute.
        solver: Solver = Or(section::<Solver>(), Solver::default()), "all is chosen";
    }
}

pub const VEHICLES: &str = "one [[vehicles]] or more, or traffic.histogram";
pub const LAYERS: &str = "one [[ground.layers]] or more, from the top down";

keys! {
    #[derive(Default)]
    pub struct GroundKeys {
        preset "A pavement by its name; keys beside it override its values.";
        /// Model of the ground.
        model: GroundModel = Or(MODEL, GroundModel::Auto), "\"auto\"";
        /// Depth of rock that does not move.
        rigid_base_depth: Option<f64> = Optional(RIGID_BASE_DEPTH), "no rock";
        /// Scales the ground so that each vehicle moves the duct so far along its axis.
        longitudinal_peak: Option<f64> = Optional(LONGITUDINAL_PEAK), "not scaled";
        /// Measured deflection of the duct under the first vehicle, to which the ground is scaled.
        vertical_peak: Option<f64> = Optional(VERTICAL_PEAK), "not scaled";
        /// Layers from the surface down.
        layers: Vec<LayerKeys> = List(section::<LayerKeys>(), 1, LAYERS);
    }
}

const MODEL: Word<GroundModel> = Word {
    gone: Some((
        "odemark",
        "the exact \"burmister\" costs no more than this approximation, which is no longer there",
    )),
    ..Word::of(GroundModel::WORDS)
};

keys! {
    #[derive(Copy)]
    pub struct LayerKeys {
        /// Thickness of the layer.
        thickness: Option<f64> = Optional(THICKNESS), "the last layer has none";
        /// Young's modulus at small strains, several times that of a settlement test.
        young_modulus: Modulus = LAYER_MODULUS;
        /// Poisson's ratio.
        poisson_ratio: f64 = POISSON;
    }
}

keys! {
    pub struct CableKeys {
        preset "A cable by its name; keys beside it override its values.";
        /// Weight of the cable per length; a mass per length is multiplied by g.
        weight: f64 = WEIGHT;
        /// Young's modulus times cross-section, EA.
        axial_stiffness: Option<f64> = Optional(AXIAL_STIFFNESS), "`young_modulus` and `conductor_area` instead";
        /// Young's modulus of the cable as a whole, relative to the area of its conductors.
        young_modulus: Option<f64> = Optional(CONDUCTOR_MODULUS), "`axial_stiffness` instead";
        /// Area of its conductors; with `young_modulus` it gives EA.
        conductor_area: Option<f64> = Optional(CONDUCTOR_AREA), "`axial_stiffness` instead";
        /// Normal force on the duct, in weights of the cable.
        normal_load_factor: Option<f64> = Optional(LOAD_FACTOR), "1";
        /// Diameter of the cable; of several in a duct it sets the normal load factor.
        diameter: Option<f64> = Optional(DIAMETER), "none";
        /// How it lies beside others in its duct.
        arrangement: Arrangement = Or(Word::of(Arrangement::WORDS), Arrangement::Single), "\"single\"";
    }
}

/// The laws of friction by their names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    Coulomb,
    ElasticPlastic,
    Sigmoid,
}

const LAWS: &[(&str, Law)] = &[
    ("coulomb", Law::Coulomb),
    ("elastic-plastic", Law::ElasticPlastic),
    ("sigmoid", Law::Sigmoid),
];

keys! {
    pub struct FrictionKeys {
        preset "A pair of surfaces by its name; keys beside it override its values.";
        /// How friction follows slip.
        law: Law = Or(Word::of(LAWS), Law::ElasticPlastic), "\"elastic-plastic\"";
        /// Friction of the slipping cable in normal forces, μ_d.
        dynamic_coefficient: f64 = COEFFICIENT;
        /// How steeply friction builds up before the cable slips, b: the slope is q b/2.
        shape_factor: Option<f64> = Optional(SHAPE_FACTOR), "required, but not with Coulomb's law";
    }
}

keys! {
    for Restraint {
        /// Where the clamp is along the duct, from x = 0.
        position = POSITION;
        /// Stiffness of the clamp; `spring` is understood too.
        stiffness = CLAMP;
    }
}

const DIRECTION: Word<Direction> = Word {
    allowed: Some("\"forward\", toward the downstream end, or \"reverse\""),
    ..Word::of(&[("forward", Direction::Forward), ("reverse", Direction::Reverse)])
};
const WHEELS: &str = "a list of wheels, such as [ { x = \"0 m\", y = \"0.9 m\", load = \"50 kN\" } ]";

keys! {
    pub struct VehicleKeys {
        preset "A vehicle by its name; keys beside it override its values.";
        /// Name of the vehicle.
        name: Option<String> = Optional(Text("a name in quotes that no other vehicle has")), "\"vehicle 1\", \"vehicle 2\", …";
        /// Speed of the vehicle.
        speed: f64 = SPEED;
        /// One concentrated load.
        load: Option<f64> = Optional(LOAD), "`wheels` instead";
        /// Wheels of the vehicle.
        wheels: Option<Vec<WheelKeys>> = Optional(List(section::<WheelKeys>(), 1, WHEELS)), "`load` instead";
        /// Its lane: how far its axis lies to the left of the first lane's, seen along forward traffic.
        lateral_offset: f64 = Or(LANE, 0.0), "0 m";
        /// Forward is toward growing x.
        direction: Direction = Or(DIRECTION, Direction::Forward), "\"forward\"";
        /// Its share of the passes, relative to those of the others.
        share: Option<f64> = Optional(SHARE), "equal shares";
    }
}

keys! {
    #[derive(Copy, Default)]
    pub struct WheelKeys {
        /// Where the wheel is ahead of the vehicle's origin, along the road.
        x: f64 = Or(WHEEL_X, 0.0), "0 m";
        /// Where it is to the left of the vehicle's axis, seen along forward traffic.
        y: f64 = Or(WHEEL_Y, 0.0), "0 m";
        /// Load of the wheel.
        load: f64 = WHEEL_LOAD;
        /// Radius of the disc that it loads.
        contact_radius: f64 = Or(CONTACT_RADIUS, 0.0), "0 m, a point";
    }
}

/// Whether the order of the vehicles is random.
const RANDOM: Word<bool> = Word::of(&[("interleaved", false), ("random", true)]);
const NAMES: &str = "a list of the vehicles' names, such as [\"truck\", \"van\"]";

keys! {
    #[derive(Default)]
    pub struct TrafficKeys {
        /// Number of passes, all vehicles together.
        passes: Option<u64> = Optional(Whole(PASSES)), "`years` instead";
        /// Years of traffic, of 365.25 days; needs `per_day`.
        years: Option<f64> = Optional(YEARS), "`passes` instead";
        /// Vehicles a day, or axles of a histogram.
        per_day: Option<f64> = Optional(PER_DAY), "passes have no time";
        /// Axles as weigh-in-motion counts them, in place of vehicles; from the folder of the scene on.
        histogram: Option<HistogramKeys> = Optional(HISTOGRAM), "[[vehicles]] instead";
        /// Speed of the axles of a histogram.
        speed: Option<f64> = Optional(SPEED), "40 km/h";
        /// How vehicles follow each other; the axles of a histogram come at random.
        order: Option<bool> = Optional(RANDOM), "\"interleaved\"";
        /// Seed of a random order.
        seed: Option<u64> = Optional(Whole(ANY_WHOLE)), "1";
        /// Vehicles in this order, over and over; shares do not count.
        sequence: Option<Vec<String>> = Optional(List(Text("a vehicle's name"), 1, NAMES)), "none";
    }
}
