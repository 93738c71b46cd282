//! The tables of a scene file and their keys. Those that a scene has as they are written stand with its data; these are turned into it.

use cable_dem::{End, Restraint};
use ground_field::{Direction, Modulus};

use crate::data::{Arrangement, Duct, Ends, GroundModel, Solver};
use crate::document::{Content, Entry, Node};
use crate::error::{SceneError, WrongKind};
use crate::key::{Form, Keys, Kind, List, Optional, Or, Text, Visit, Whole, Word, keys, section};
use crate::range::{
    ANY_WHOLE, AXIAL_STIFFNESS, CLAMP, COEFFICIENT, CONDUCTOR_AREA, CONDUCTOR_MODULUS, CONTACT_RADIUS,
    DIAMETER, EXPANSION, LANE, LOAD, LOAD_FACTOR, LONGITUDINAL_PEAK, MODULUS, MODULUS_AT_AN_END, OFFSET,
    PASSES, PER_DAY, POISSON, POSITION, RIGID_BASE_DEPTH, SHAPE_FACTOR, SHARE, SPEED, SPRING, SWING,
    TEMPERATURE, THICKNESS, TIME_OF_DAY, VERTICAL_PEAK, WEIGHT, WHEEL_LOAD, WHEEL_X, WHEEL_Y, YEARS,
};
use crate::units::Dimension;
use crate::value::Value;

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
        heat: Option<HeatKeys> = Optional(section::<HeatKeys>()), "none";
        /// How to compute.
        solver: Solver = Or(section::<Solver>(), Solver::default()), "all is chosen";
    }
}

pub const VEHICLES: &str = "one [[vehicles]] or more, or traffic.histogram";
pub const LAYERS: &str = "one [[ground.layers]] or more, from the top down";

keys! {
    #[derive(Default)]
    pub struct GroundKeys {
        /// A pavement by its name; keys beside it override its values.
        preset: () = Preset, "none";
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
        young_modulus: Modulus = ModulusKind;
        /// Poisson's ratio.
        poisson_ratio: f64 = POISSON;
    }
}

keys! {
    #[derive(Copy)]
    pub struct GradedKeys {
        /// Young's modulus at the top of a layer in which it varies.
        top: f64 = MODULUS_AT_AN_END;
        /// The same at the bottom.
        bottom: f64 = MODULUS_AT_AN_END;
    }
}

keys! {
    #[derive(Copy)]
    pub struct CableKeys {
        /// A cable by its name; keys beside it override its values.
        preset: () = Preset, "none";
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
    #[derive(Copy)]
    pub struct FrictionKeys {
        /// A pair of surfaces by its name; keys beside it override its values.
        preset: () = Preset, "none";
        /// How friction follows slip.
        law: Law = Or(Word::of(LAWS), Law::ElasticPlastic), "\"elastic-plastic\"";
        /// Friction of the slipping cable in normal forces, μ_d.
        dynamic_coefficient: f64 = COEFFICIENT;
        /// How steeply friction builds up before the cable slips, b: the slope is q b/2.
        shape_factor: Option<f64> = Optional(SHAPE_FACTOR), "required, but not with Coulomb's law";
    }
}

keys! {
    #[derive(Copy)]
    pub struct SpringKeys {
        /// Stiffness of the spring at this end; `stiffness` is understood too.
        spring: f64 = SPRING;
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
        /// A vehicle by its name; keys beside it override its values.
        preset: () = Preset, "none";
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
    #[derive(Copy)]
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
        histogram: Option<HistogramKeys> = Optional(HistogramKind), "[[vehicles]] instead";
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

pub const TABLE: &str = "the name of a table, such as \"axles.csv\"";
const TEXT: Text = Text("a text in quotes");

keys! {
    #[derive(Default)]
    pub struct HistogramKeys {
        /// The table, from the folder of the scene on.
        file: String = Text(TABLE);
        /// What stands between its cells.
        separator: Option<String> = Optional(Text("comma, semicolon, tab, space or |, in quotes")), "recognised";
        /// What stands before its decimals.
        decimal: Option<String> = Optional(Text("\"point\" or \"comma\"")), "recognised";
        /// How its characters are written.
        encoding: Option<String> = Optional(Text("utf-8, utf-16, latin-1, shift_jis, …, in quotes")), "recognised";
        /// Its line with the names of the columns.
        header_line: Option<u64> = Optional(Whole(ANY_WHOLE)), "recognised";
        /// Rows below the names that hold no axles.
        skip: Option<u64> = Optional(Whole(ANY_WHOLE)), "recognised";
        /// Sheet of a workbook.
        sheet: Option<String> = Optional(TEXT), "the first with rows";
        /// Unit of the loads.
        unit: Option<String> = Optional(Text("a unit of force, in quotes")), "that of the header";
        /// Name of the column with the loads.
        column_load: Option<String> = Optional(TEXT), "recognised";
        /// Name of the column with the numbers of axles.
        column_count: Option<String> = Optional(TEXT), "recognised";
        /// Name of the column with the radii.
        column_contact_radius: Option<String> = Optional(TEXT), "recognised";
    }
}

keys! {
    pub struct HeatKeys {
        /// Thermal expansion of the cable per length and degree.
        expansion: f64 = EXPANSION;
        /// From the day's lowest to its highest mean temperature of the cable, a cosine over the day.
        daily_swing: Option<f64> = Optional(SWING), "`profile` instead";
        /// The day's lowest temperature above that at laying; added to a profile.
        offset: f64 = Or(OFFSET, 0.0), "0 K";
        /// Temperatures at times of the day, joined by straight lines, every day the same.
        profile: Option<Vec<(f64, f64)>> = Optional(List(PointKind, 2, POINTS)), "`daily_swing` instead";
    }
}

pub const POINTS: &str = "two points of the day or more, such as [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]], their times ascending";

/// The name of a preset, which is no longer there when a table is read.
pub struct Preset;

impl Kind for Preset {
    type Value = ();

    fn read(&self, value: &Value) -> Result<(), SceneError> {
        value.text("a name that `creepage presets` lists").map(|_| ())
    }

    fn write(&self, (): &()) -> Option<Content> {
        None
    }

    fn form(&self) -> Form {
        Form::Text("a name that `creepage presets` lists")
    }

    fn absent(&self) -> Option<()> {
        Some(())
    }
}

/// What holds an end: a word, or a table with a spring.
pub struct EndKind;

const HELD: &[(&str, End)] = &[("free", End::Free), ("fixed", End::Fixed)];
const END: &str = "\"free\", \"fixed\" or { spring = \"3 MN/m\" }";

impl Kind for EndKind {
    type Value = End;

    fn read(&self, value: &Value) -> Result<End, SceneError> {
        if value.is_table() {
            return Ok(End::Spring(section::<SpringKeys>().read(value)?.spring));
        }
        let spring = Dimension::ForcePerLength.parse(&value.text(END)?);
        let meant = spring.map_or_else(
            |_| String::new(),
            |_| format!("; did you mean {{ spring = {} }}?", value.written()),
        );
        value.word(HELD, &format!("{END}{meant}"))
    }

    fn write(&self, value: &End) -> Option<Content> {
        match value {
            End::Spring(spring) => section().write(&SpringKeys { spring: *spring }),
            held => Word::of(HELD).write(held),
        }
    }

    fn each(&self, value: &End, path: &str, visit: &mut Visit) {
        if let End::Spring(spring) = value {
            SpringKeys { spring: *spring }.each(path, visit);
        }
    }

    fn form(&self) -> Form {
        let words = HELD.iter().map(|(word, _)| *word).collect();
        Form::Either(Box::new(Form::Words(words, None)), SpringKeys::keys(), Some(END))
    }
}

/// A modulus, or a table with those at the top and at the bottom of a layer.
pub struct ModulusKind;

impl Kind for ModulusKind {
    type Value = Modulus;

    fn read(&self, value: &Value) -> Result<Modulus, SceneError> {
        if !value.is_table() {
            return value.quantity(MODULUS).map(Modulus::Uniform);
        }
        let GradedKeys { top, bottom } = section().read(value)?;
        Ok(Modulus::Linear { top, bottom })
    }

    fn write(&self, value: &Modulus) -> Option<Content> {
        match *value {
            Modulus::Uniform(modulus) => MODULUS.write(&modulus),
            Modulus::Linear { top, bottom } => section().write(&GradedKeys { top, bottom }),
        }
    }

    fn each(&self, value: &Modulus, path: &str, visit: &mut Visit) {
        match *value {
            Modulus::Uniform(modulus) => visit(path, modulus, MODULUS),
            Modulus::Linear { top, bottom } => GradedKeys { top, bottom }.each(path, visit),
        }
    }

    fn form(&self) -> Form {
        Form::Either(Box::new(Form::Quantity(MODULUS)), GradedKeys::keys(), None)
    }
}

/// The name of a table of axles, or a table that says how it is to be read.
pub struct HistogramKind;

const HISTOGRAM: &str = "the name of a table, such as \"axles.csv\", with the columns load, count and, if wanted, contact_radius, \
                         or { file = \"axles.csv\", decimal = \"comma\" }";

impl Kind for HistogramKind {
    type Value = HistogramKeys;

    fn read(&self, value: &Value) -> Result<HistogramKeys, SceneError> {
        if value.is_table() {
            return section::<HistogramKeys>().read(value);
        }
        Ok(HistogramKeys {
            file: value.text(TABLE)?,
            ..HistogramKeys::default()
        })
    }

    fn write(&self, value: &HistogramKeys) -> Option<Content> {
        section::<HistogramKeys>().write(value)
    }

    fn form(&self) -> Form {
        Form::Either(
            Box::new(Form::Text(TABLE)),
            HistogramKeys::keys(),
            Some(HISTOGRAM),
        )
    }
}

/// A time of the day and a temperature.
pub struct PointKind;

impl Kind for PointKind {
    type Value = (f64, f64);

    fn read(&self, value: &Value) -> Result<(f64, f64), SceneError> {
        let [time, kelvin] = &value.items(POINTS)?[..] else {
            let allowed = "a point of the day: [\"15 h\", \"20 K\"]";
            return Err(value.wrong(WrongKind::Value, value.written(), allowed));
        };
        Ok((time.quantity(TIME_OF_DAY)?, kelvin.quantity(TEMPERATURE)?))
    }

    fn write(&self, (time, kelvin): &(f64, f64)) -> Option<Content> {
        let items = [TIME_OF_DAY.write(time)?, TEMPERATURE.write(kelvin)?];
        Some(Content::Array(items.map(Node::of_program).into()))
    }

    fn each(&self, (time, kelvin): &(f64, f64), path: &str, visit: &mut Visit) {
        visit(&format!("{path}.0"), *time, TIME_OF_DAY);
        visit(&format!("{path}.1"), *kelvin, TEMPERATURE);
    }

    fn form(&self) -> Form {
        Form::Text("a point of the day: [\"15 h\", \"20 K\"]")
    }
}

impl SceneKeys {
    /// The keys as entries of a document.
    pub fn entries(&self) -> Vec<Entry> {
        let entry = |(key, content)| Entry::of_program(key, content);
        self.write().into_iter().map(entry).collect()
    }
}
