//! Ranges of values, and how to say what is allowed.

use std::ops::RangeInclusive;

use super::units::Dimension;

/// A range of finite numbers.
#[derive(Clone, Copy)]
pub struct Range {
    pub least: f64,
    pub most: f64,
    /// In words, after "a length".
    pub words: &'static str,
}

/// A quantity of a scene: its range, its dimension if it is not a plain number, and how one is written.
#[derive(Clone, Copy)]
pub struct Quantity {
    pub dimension: Option<Dimension>,
    pub range: Range,
    example: &'static str,
}

const fn range(least: f64, most: f64, words: &'static str) -> Range {
    Range { least, most, words }
}

const fn length(range: Range, example: &'static str) -> Quantity {
    quantity(Dimension::Length, range, example)
}

const fn quantity(dimension: Dimension, range: Range, example: &'static str) -> Quantity {
    Quantity {
        dimension: Some(dimension),
        range,
        example,
    }
}

const fn number(least: f64, most: f64, words: &'static str) -> Quantity {
    Quantity {
        dimension: None,
        range: range(least, most, words),
        example: "",
    }
}

/// The smallest number greater than 0.
const LEAST: f64 = 5e-324;
const ANY: Range = range(f64::MIN, f64::MAX, "of any sign");
const POSITIVE: Range = range(LEAST, f64::MAX, "greater than 0");

// The limits of what the models can mean, far outside what is built: beyond them numbers lose their digits, or a run its
// end.
const OFFSETS: Range = range(-1e3, 1e3, "of any sign, at most 1 km");
const DIAMETERS: Range = range(1e-3, 10.0, "greater than 0, from 1 mm to 10 m");
const SLOPES: Range = range(-1.0, 1.0, "of any sign, from -100 % to 100 %");
const PEAKS: Range = range(1e-12, 1.0, "greater than 0, from 1e-6 um to 1 m");
const LOADS: Range = range(0.0, 1e9, "of at least 0 and at most 1000 MN");
const AXLE_LOADS: Range = range(LEAST, 1e9, "greater than 0 and at most 1000 MN");
const MODULI: Range = range(1e3, 1e13, "greater than 0, from 1 kPa to 10000 GPa");
const STIFFNESSES: Range = range(1e-9, 1e18, "greater than 0, from 1e-9 to 1e18 N/m");
const RADII: Range = range(0.0, 100.0, "of at least 0 and at most 100 m");
const DUCT_LENGTHS: Range = range(0.1, 1e5, "greater than 0, from 0.1 m to 100 km");
const DEPTHS: Range = range(0.01, 1e3, "greater than 0, from 1 cm to 1 km");
const WEIGHTS: Range = range(1e-3, 1e6, "greater than 0, from 1e-3 N/m to 1 MN/m");
const AXIAL_STIFFNESSES: Range = range(1.0, 1e15, "greater than 0, from 1 N to 1e15 N");
const SHAPE_FACTORS: Range = range(1.0, 1e18, "greater than 0, from 1 to 1e18 1/m");
const SPEEDS: Range = range(1e-3, 1e3, "greater than 0, from 1 mm/s to 1 km/s");
const TEMPERATURES: Range = range(-500.0, 500.0, "of any sign, from -500 to 500 K");
const TOLERANCES: Range = range(LEAST, 0.5, "greater than 0 and at most 0.5");
/// Thicknesses of layers, and depths of a rigid base below those above it \[m\].
pub const THICKNESSES: Range = range(1e-6, 1e4, "greater than 0, from 1 um to 10 km");

pub const DUCT_LENGTH: Quantity = length(DUCT_LENGTHS, "\"30 m\"");
pub const DEPTH: Quantity = length(DEPTHS, "\"1.2 m\"");
pub const LATERAL_OFFSET: Quantity = length(OFFSETS, "\"0.5 m\"");
pub const LANE: Quantity = length(OFFSETS, "\"3.5 m\"");
pub const SLOPE: Quantity = quantity(Dimension::Slope, SLOPES, "\"3 %\", \"1.7 deg\" or 0.03");
pub const INNER_DIAMETER: Quantity = length(DIAMETERS, "\"200 mm\"");
pub const DIAMETER: Quantity = length(DIAMETERS, "\"67 mm\"");
pub const WHEEL_X: Quantity = length(OFFSETS, "\"-4 m\"");
pub const WHEEL_Y: Quantity = length(OFFSETS, "\"0.9 m\"");
pub const CONTACT_RADIUS: Quantity = length(RADII, "\"0.15 m\"");
pub const THICKNESS: Quantity = length(THICKNESSES, "\"50 mm\"");
pub const RIGID_BASE_DEPTH: Quantity = length(THICKNESSES, "\"12 m\"");
pub const LONGITUDINAL_PEAK: Quantity = length(PEAKS, "\"35.7 um\"");
pub const VERTICAL_PEAK: Quantity = length(PEAKS, "\"90 um\"");
pub const POSITION: Quantity = length(ANY, "\"20 m\"");
pub const STEP: Quantity = length(POSITIVE, "\"0.1 m\"");
pub const APPROACH: Quantity = length(DUCT_LENGTHS, "\"15 m\"");
pub const MODULUS: Quantity = quantity(
    Dimension::Pressure,
    MODULI,
    "\"800 MPa\", or { top = \"60 MPa\", bottom = \"200 MPa\" } where it varies with depth",
);
pub const MODULUS_AT_AN_END: Quantity = quantity(Dimension::Pressure, MODULI, "\"60 MPa\"");
pub const WEIGHT: Quantity = quantity(Dimension::ForcePerLength, WEIGHTS, "\"108.8 N/m\"");
pub const AXIAL_STIFFNESS: Quantity = quantity(Dimension::Force, AXIAL_STIFFNESSES, "\"8.01e6 N\"");
pub const SHAPE_FACTOR: Quantity = quantity(Dimension::InverseLength, SHAPE_FACTORS, "\"2e7 1/m\"");
pub const SPRING: Quantity = quantity(Dimension::ForcePerLength, STIFFNESSES, "\"3 MN/m\"");
pub const CLAMP: Quantity = quantity(Dimension::ForcePerLength, STIFFNESSES, "\"1 MN/m\"");
pub const LOAD: Quantity = quantity(Dimension::Force, LOADS, "\"20 tf\"");
pub const WHEEL_LOAD: Quantity = quantity(Dimension::Force, LOADS, "\"50 kN\"");
pub const AXLE_LOAD: Quantity = quantity(Dimension::Force, AXLE_LOADS, "\"100 kN\"");
pub const SPEED: Quantity = quantity(Dimension::Speed, SPEEDS, "\"40 km/h\"");
pub const EXPANSION: Quantity = quantity(
    Dimension::InverseTemperature,
    range(0.0, 1e-3, "of at least 0 and at most 1e-3 1/K"),
    "\"17e-6 1/K\"",
);
pub const SWING: Quantity = quantity(
    Dimension::Temperature,
    range(0.0, 500.0, "of at least 0 and at most 500 K"),
    "\"20 K\"",
);
pub const TEMPERATURE: Quantity = quantity(Dimension::Temperature, TEMPERATURES, "\"20 K\"");
pub const OFFSET: Quantity = quantity(Dimension::Temperature, TEMPERATURES, "\"-5 K\"");
pub const TIME_OF_DAY: Quantity = quantity(
    Dimension::Time,
    range(0.0, 86_400.0_f64.next_down(), "from 0 h on and before 24 h"),
    "\"15 h\"",
);
pub const TIME_STEP: Quantity = quantity(Dimension::Time, POSITIVE, "\"0.1 ms\"");
pub const TOLERANCE: Quantity = quantity(Dimension::Ratio, TOLERANCES, "0.01 or \"1 %\"");

pub const POISSON: Quantity = number(0.0, 0.5, "from 0 to 0.5");
pub const COEFFICIENT: Quantity = number(0.0, 10.0, "from 0 to 10");
pub const LOAD_FACTOR: Quantity = number(1e-6, 1e6, "greater than 0, from 1e-6 to 1e6");
pub const SHARE: Quantity = number(1e-12, 1e12, "greater than 0, from 1e-12 to 1e12");

pub const AXLE_COUNT: Quantity = number(0.0, 1e12, "of at least 0 and at most 1e12");
pub const YEARS: Quantity = number(1e-9, 1e6, "greater than 0, from 1e-9 to 1e6");
pub const PER_DAY: Quantity = number(1e-6, 1e9, "greater than 0, from 1e-6 to 1e9");

/// Numbers of passes that can be computed, few of them simulated.
pub const PASSES: RangeInclusive<u64> = 1..=1_000_000_000_000;
/// Most nodes and most steps of a vehicle over the duct; where the scene gives no step there are two to a node.
const MOST_NODES: f64 = 5e6;
const MOST_STEPS: f64 = 1e7;

/// A range whose ends follow from the rest of the scene, with its words.
pub type Follows = (RangeInclusive<f64>, String);

/// Node spacings \[m\] in a duct of this length.
pub fn node_spacings(length: f64) -> Follows {
    let half = shown(length / 2.0);
    let words = format!("at most half the duct's length, {half} m, and at least its five-millionth part");
    (length / MOST_NODES..=length / 2.0, words)
}

/// Steps of a vehicle \[m\] over a duct of this length.
pub fn vehicle_steps(length: f64) -> Follows {
    let all = shown(length);
    let words = format!("at most the duct's length, {all} m, and at least its ten-millionth part");
    (length / MOST_STEPS..=length, words)
}

/// Diameters \[m\] of a cable that lies alone in a duct of this inner diameter, or of one of three that fit while the duct is `closest`
/// times as wide as each of them.
pub fn diameters(inner_diameter: f64, closest: Option<f64>) -> Follows {
    let inner = shown(inner_diameter);
    match closest {
        None => {
            let words = format!("less than the duct's inner diameter, {inner} m");
            (0.0..=inner_diameter.next_down(), words)
        }
        Some(closest) => {
            let most = inner_diameter / closest;
            let words = format!("at most {most:.4} m, so that three cables fit into the duct's {inner} m");
            (0.0..=most, words)
        }
    }
}

/// Positions of clamps \[m\] in a duct of this length.
pub fn positions(length: f64) -> Follows {
    let words = format!("a position in the duct, from 0 m to {} m", shown(length));
    (0.0..=length, words)
}

impl Range {
    pub fn contains(self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }
}

impl Quantity {
    /// What is allowed where this quantity belongs.
    pub fn allowed(self) -> String {
        let (words, example) = (self.range.words, self.example);
        let Some(dimension) = self.dimension else {
            return format!("a number {words}, without quotes or unit");
        };
        let units: Vec<&str> = dimension.units().collect();
        let (noun, units) = (dimension.noun(), units.join(", "));
        format!("{noun} {words}, such as {example} (units: {units})")
    }
}

/// What is allowed where a whole number belongs.
pub fn allowed_whole(range: &RangeInclusive<u64>) -> String {
    match (range.start(), range.end()) {
        (least, &u64::MAX) => format!("a whole number of at least {least}, without quotes"),
        (least, most) => format!("a whole number from {least} to {most}, without quotes"),
    }
}

/// A number of this program in a message, such as the end of a range.
pub fn shown(value: f64) -> String {
    if (1e-6..1e9).contains(&value.abs()) || value == 0.0 {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}
