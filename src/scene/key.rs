//! Every key a scene file may hold, once: messages, readers and `creepage explain` know no other.

use std::ops::RangeInclusive;

use serde::Serialize;

use super::data::{Arrangement, GroundModel, SolverMethod};
#[cfg(feature = "sweep")]
use super::nearest::nearest;
use super::range::{self as of, Quantity, allowed_whole};

/// What may stand at a key.
#[derive(Clone)]
pub(super) enum Allowed {
    Quantity(Quantity),
    Whole(RangeInclusive<u64>),
    Words(fn() -> Vec<&'static str>),
    /// Anything else, in words.
    As(&'static str),
}

use Allowed::{As, Quantity as Q, Whole, Words};

/// A key: its section, its name, what it means, what may stand there, and what counts where it is left out (nothing: it is required).
pub(super) struct Key {
    pub section: &'static str,
    pub name: &'static str,
    meaning: &'static str,
    allowed: Allowed,
    default: Option<&'static str>,
}

impl Key {
    /// The SI unit of its value; none for what is no number or has no unit.
    #[cfg(feature = "sweep")]
    pub fn si_unit(&self) -> Option<&'static str> {
        match &self.allowed {
            Q(quantity) => quantity.dimension?.si(),
            _ => None,
        }
    }
}

/// Rows of a table that is read as one.
macro_rules! keys {
    ($($section:literal $name:literal: $allowed:expr, $default:expr, $meaning:literal;)+) => {
        &[$(Key { section: $section, name: $name, meaning: $meaning, allowed: $allowed, default: $default }),+]
    };
}

const NONE: Option<&str> = Some("none");
const RECOGNISED: Option<&str> = Some("recognised");
const SECTION: Allowed = As("a section");
const PRESET: Allowed = As("a name that `creepage presets` lists");

/// The top level, then the sections, then tables inside them.
pub(super) const KEYS: &[Key] = keys! {
    "" "title": As("a text"), Some("the file's name"), "Name of the scene in tables and reports.";
    "" "duct": SECTION, None, "Where the duct lies: straight, and as deep everywhere below a road that may slope.";
    "" "ground": SECTION, None, "The ground around the duct.";
    "" "cable": SECTION, None, "The cable in the duct.";
    "" "friction": SECTION, None, "Friction between cable and duct.";
    "" "ends": SECTION, None, "What holds the cable's two ends.";
    "" "restraints": As("any number of [[restraints]]"), NONE, "Clamps along the cable.";
    "" "vehicles": As("one [[vehicles]] or more, or traffic.histogram"), None, "Who drives above the duct.";
    "" "traffic": SECTION, None, "How much traffic, and in which order.";
    "" "heat": SECTION, NONE, "How warm the cable gets every day; needs `traffic.per_day`.";
    "" "solver": SECTION, Some("all is chosen"), "How to compute.";
    "duct" "length": Q(of::DUCT_LENGTH), None, "Length of the duct, from manhole to manhole.";
    "duct" "depth": Q(of::DEPTH), None, "Depth of the cable below the road surface.";
    "duct" "lateral_offset": Q(of::LATERAL_OFFSET), Some("0 m"),
        "How far the duct lies to the left of the first lane's axis, seen along forward traffic.";
    "duct" "slope": Q(of::SLOPE), Some("0"), "How steeply the duct rises with x.";
    "duct" "inner_diameter": Q(of::INNER_DIAMETER), NONE, "Inner diameter of the duct; needed for several cables in it.";
    "ground" "preset": PRESET, NONE, "A pavement by its name; keys beside it override its values.";
    "ground" "model": Words(|| words(GroundModel::WORDS)), Some("\"auto\""), "Model of the ground.";
    "ground" "rigid_base_depth": Q(of::RIGID_BASE_DEPTH), Some("no rock"), "Depth of rock that does not move.";
    "ground" "longitudinal_peak": Q(of::LONGITUDINAL_PEAK), Some("not scaled"),
        "Scales the ground so that each vehicle moves the duct so far along its axis.";
    "ground" "vertical_peak": Q(of::VERTICAL_PEAK), Some("not scaled"),
        "Measured deflection of the duct under the first vehicle, to which the ground is scaled.";
    "ground" "layers": As("one [[ground.layers]] or more"), None, "Layers from the surface down.";
    "ground.layers" "thickness": Q(of::THICKNESS), Some("the last layer has none"), "Thickness of the layer.";
    "ground.layers" "young_modulus": Q(of::MODULUS), None, "Young's modulus at small strains, several times that of a settlement test.";
    "ground.layers" "poisson_ratio": Q(of::POISSON), None, "Poisson's ratio.";
    "cable" "preset": PRESET, NONE, "A cable by its name; keys beside it override its values.";
    "cable" "weight": Q(of::WEIGHT), None, "Weight of the cable per length.";
    "cable" "axial_stiffness": Q(of::AXIAL_STIFFNESS), None, "Young's modulus times cross-section, EA.";
    "cable" "normal_load_factor": Q(of::LOAD_FACTOR), Some("1"), "Normal force on the duct, in weights of the cable.";
    "cable" "diameter": Q(of::DIAMETER), NONE, "Diameter of the cable; of several in a duct it sets the normal load factor.";
    "cable" "arrangement": Words(|| words(Arrangement::WORDS)), Some("\"single\""), "How it lies beside others in its duct.";
    "friction" "preset": PRESET, NONE, "A pair of surfaces by its name; keys beside it override its values.";
    "friction" "law": As("\"coulomb\", \"elastic-plastic\" or \"sigmoid\""), Some("\"elastic-plastic\""), "How friction follows slip.";
    "friction" "dynamic_coefficient": Q(of::COEFFICIENT), None, "Friction of the slipping cable in normal forces, μ_d.";
    "friction" "shape_factor": Q(of::SHAPE_FACTOR), Some("required, but not with Coulomb's law"),
        "How steeply friction builds up before the cable slips, b: the slope is q b/2.";
    "ends" "upstream": As(END), None, "What holds the end at x = 0, where forward vehicles come in.";
    "ends" "downstream": As(END), None, "What holds the end at x = length.";
    "restraints" "position": Q(of::POSITION), None, "Where the clamp is along the duct, from x = 0.";
    "restraints" "stiffness": Q(of::CLAMP), None, "Stiffness of the clamp; `spring` is understood too.";
    "vehicles" "preset": PRESET, NONE, "A vehicle by its name; keys beside it override its values.";
    "vehicles" "name": As("a text that no other vehicle has"), Some("\"vehicle 1\", \"vehicle 2\", …"), "Name of the vehicle.";
    "vehicles" "speed": Q(of::SPEED), None, "Speed of the vehicle.";
    "vehicles" "load": Q(of::LOAD), Some("`wheels` instead"), "One concentrated load.";
    "vehicles" "wheels": As("a list of { x, y, load, contact_radius }"), Some("`load` instead"), "Wheels of the vehicle.";
    "vehicles" "lateral_offset": Q(of::LANE), Some("0 m"),
        "Its lane: how far its axis lies to the left of the first lane's, seen along forward traffic.";
    "vehicles" "direction": As("\"forward\" or \"reverse\""), Some("\"forward\""), "Forward is toward growing x.";
    "vehicles" "share": Q(of::SHARE), Some("equal shares"), "Its share of the passes, beside those of the others.";
    "traffic" "passes": Whole(of::PASSES), Some("`years` instead"), "Number of passes, all vehicles together.";
    "traffic" "years": Q(of::YEARS), Some("`passes` instead"), "Years of traffic, of 365.25 days; needs `per_day`.";
    "traffic" "per_day": Q(of::PER_DAY), Some("passes have no time"), "Vehicles a day, or axles of a histogram.";
    "traffic" "histogram": As( "the name of a table, such as \"axles.csv\", with the columns load, count and, if wanted, contact_radius, or { file = \"axles.csv\", decimal = \"comma\" }", ), Some("[[vehicles]] instead"),
        "Axles as weigh-in-motion counts them, in place of vehicles; from the folder of the scene on.";
    "traffic" "speed": Q(of::SPEED), Some("40 km/h"), "Speed of the axles of a histogram.";
    "traffic" "order": As("\"interleaved\" or \"random\""), Some("\"interleaved\""), "How vehicles follow each other.";
    "traffic" "seed": Whole(0..=u64::MAX), Some("1"), "Seed of a random order.";
    "traffic" "sequence": As("a list of vehicles' names"), NONE, "Vehicles in this order, over and over; shares do not count.";
    "heat" "expansion": Q(of::EXPANSION), None, "Thermal expansion of the cable per length and degree.";
    "heat" "daily_swing": Q(of::SWING), Some("`profile` instead"),
        "From the day's lowest to its highest mean temperature of the cable, a cosine over the day.";
    "heat" "offset": Q(of::OFFSET), Some("0 K"), "The day's lowest temperature above that at laying; added to a profile.";
    "heat" "profile": As("points of the day, [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]]"), Some("`daily_swing` instead"),
        "Temperatures at times of the day, joined by straight lines, every day the same.";
    "solver" "method": Words(|| words(SolverMethod::WORDS)), Some("\"auto\""), "How the passes are computed.";
    "solver" "tolerance": Q(of::TOLERANCE), Some("0.01"), "Error allowed, as a share of the forces and of the movement of the ends.";
    "solver" "node_spacing": Q(of::STEP), Some("chosen"), "Distance between points of the cable that are computed.";
    "solver" "vehicle_step": Q(of::STEP), Some("chosen"), "Advance of the vehicle from one computed place to the next.";
    "solver" "time_step": Q(of::TIME_STEP), Some("chosen"), "Time step of the method `explicit`.";
    "solver" "approach": Q(of::APPROACH), Some("as far as it matters"), "How far beyond the duct's ends vehicles are followed.";
    "ground.layers.young_modulus" "top": Q(of::MODULUS_AT_AN_END), None, "Young's modulus at the top of a layer in which it varies.";
    "ground.layers.young_modulus" "bottom": Q(of::MODULUS_AT_AN_END), None, "The same at the bottom.";
    "ends.upstream" "spring": Q(of::SPRING), None, "Stiffness of the spring at this end; `stiffness` is understood too.";
    "ends.downstream" "spring": Q(of::SPRING), None, "Stiffness of the spring at this end; `stiffness` is understood too.";
    "traffic.histogram" "file": As("the name of a table"), None, "The table, from the folder of the scene on.";
    "traffic.histogram" "separator": As("comma, semicolon, tab, space or |, in quotes"), RECOGNISED, "What stands between its cells.";
    "traffic.histogram" "decimal": As("\"point\" or \"comma\""), RECOGNISED, "What stands before its decimals.";
    "traffic.histogram" "encoding": As("utf-8, utf-16, latin-1, shift_jis, …, in quotes"), RECOGNISED, "How its characters are written.";
    "traffic.histogram" "header_line": As("a whole number"), RECOGNISED, "Its line with the names of the columns.";
    "traffic.histogram" "skip": As("a whole number"), RECOGNISED, "Rows below the names that hold no axles.";
    "traffic.histogram" "sheet": As("a text"), Some("the first with rows"), "Sheet of a workbook.";
    "traffic.histogram" "unit": As("a unit of force, in quotes"), Some("that of the header"), "Unit of the loads.";
    "traffic.histogram" "column_load": As("a text"), RECOGNISED, "Name of the column with the loads.";
    "traffic.histogram" "column_count": As("a text"), RECOGNISED, "Name of the column with the numbers of axles.";
    "traffic.histogram" "column_contact_radius": As("a text"), RECOGNISED, "Name of the column with the radii.";
    "vehicles.wheels" "x": Q(of::WHEEL_X), Some("0 m"), "Where the wheel is ahead of the vehicle's origin, along the road.";
    "vehicles.wheels" "y": Q(of::WHEEL_Y), Some("0 m"), "Where it is to the left of the vehicle's axis, seen along forward traffic.";
    "vehicles.wheels" "load": Q(of::WHEEL_LOAD), None, "Load of the wheel.";
    "vehicles.wheels" "contact_radius": Q(of::CONTACT_RADIUS), Some("0 m, a point"), "Radius of the disc that it loads.";
};

const END: &str = "\"free\", \"fixed\" or { spring = \"3 MN/m\" }";

fn words<T>(words: &[(&'static str, T)]) -> Vec<&'static str> {
    words.iter().map(|(word, _)| *word).collect()
}

/// What a key of a scene means.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct KeyMeaning {
    /// The key with its section, without the numbers of list items: `vehicles.speed`.
    pub key: String,
    /// What it means.
    pub meaning: &'static str,
    /// What may stand there: range and units, or words.
    pub allowed: String,
    /// What counts where it is left out; `None` where it is required.
    pub default: Option<&'static str>,
}

/// Every key of a scene, section by section.
///
/// ```
/// let depth = creepage::scene::key_meanings().into_iter().find(|key| key.key == "duct.depth").unwrap();
/// assert!(depth.allowed.starts_with("a length greater than 0, from 1 cm to 1 km") && depth.default.is_none());
/// ```
pub fn key_meanings() -> Vec<KeyMeaning> {
    let meaning = |key: &Key| KeyMeaning {
        key: joined(key.section, key.name),
        meaning: key.meaning,
        allowed: match &key.allowed {
            Q(quantity) => quantity.allowed(),
            Whole(range) => allowed_whole(range),
            Words(words) => words()
                .iter()
                .map(|word| format!("\"{word}\""))
                .collect::<Vec<_>>()
                .join(", "),
            As(words) => (*words).to_owned(),
        },
        default: key.default,
    };
    KEYS.iter().map(meaning).collect()
}

/// The key nearest to `text`, by its last word where that has no section.
#[cfg(feature = "sweep")]
pub(crate) fn nearest_key(text: &str) -> Option<String> {
    let keys: Vec<String> = key_meanings().into_iter().map(|key| key.key).collect();
    if text.contains('.') {
        return nearest(text, keys.iter().map(String::as_str)).map(str::to_owned);
    }
    let name = nearest(text, KEYS.iter().map(|key| key.name))?;
    keys.into_iter().find(|key| key.rsplit('.').next() == Some(name))
}

/// A key with those of the tables around it.
pub fn joined(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}
