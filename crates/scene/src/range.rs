//! The quantities of a scene file: dimension, range, how one is written, and how to say what is allowed.
//!
//! The limits are those of what the models can mean, far outside what is built: beyond them numbers lose their digits, or a run its end.

use crate::units::Dimension;

/// A quantity of a scene.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// Its dimension; `None` for a plain number.
    pub dimension: Option<Dimension>,
    /// Minimum and maximum value in SI.
    pub least: f64,
    /// See `least`.
    pub most: f64,
    /// The range in words, after "a length".
    pub words: &'static str,
    /// How one is written.
    pub example: &'static str,
    /// Whether it is a whole number.
    pub whole: bool,
}

/// Rows of name, dimension, least, most, range in words, example; `whole` for a whole number.
macro_rules! quantities {
    ($($name:ident: $dimension:expr, $least:expr, $most:expr, $words:literal, $example:literal $(, $whole:ident)?;)+) => {
        $(#[allow(missing_docs)]
        pub const $name: Quantity = Quantity {
            dimension: $dimension, least: $least, most: $most, words: $words, example: $example, whole: !stringify!($($whole)?).is_empty(),
        };)+
    };
}

use Dimension as D;

/// The smallest number greater than 0, and the last moment of a day \[s\].
const MIN: f64 = 5e-324;
const MIDNIGHT: f64 = 86_400.0_f64.next_down();
const MAX: f64 = f64::MAX;

quantities! {
    DUCT_LENGTH: Some(D::Length), 0.1, 1e5, "greater than 0, from 0.1 m to 100 km", "\"30 m\"";
    DEPTH: Some(D::Length), 0.01, 1e3, "greater than 0, from 1 cm to 1 km", "\"1.2 m\"";
    LATERAL_OFFSET: Some(D::Length), -1e3, 1e3, "of any sign, at most 1 km", "\"0.5 m\"";
    LANE: Some(D::Length), -1e3, 1e3, "of any sign, at most 1 km", "\"3.5 m\"";
    SLOPE: Some(D::Slope), -1.0, 1.0, "of any sign, from -100 % to 100 %", "\"3 %\", \"1.7 deg\" or 0.03";
    INNER_DIAMETER: Some(D::Length), 1e-3, 10.0, "greater than 0, from 1 mm to 10 m", "\"200 mm\"";
    DIAMETER: Some(D::Length), 1e-3, 10.0, "greater than 0, from 1 mm to 10 m", "\"67 mm\"";
    WHEEL_X: Some(D::Length), -1e3, 1e3, "of any sign, at most 1 km", "\"-4 m\"";
    WHEEL_Y: Some(D::Length), -1e3, 1e3, "of any sign, at most 1 km", "\"0.9 m\"";
    CONTACT_RADIUS: Some(D::Length), 0.0, 100.0, "of at least 0 and at most 100 m", "\"0.15 m\"";
    THICKNESS: Some(D::Length), 1e-6, 1e4, "greater than 0, from 1 um to 10 km", "\"50 mm\"";
    RIGID_BASE_DEPTH: Some(D::Length), 1e-6, 1e4, "greater than 0, from 1 um to 10 km", "\"12 m\"";
    LONGITUDINAL_PEAK: Some(D::Length), 1e-12, 1.0, "greater than 0, from 1e-6 um to 1 m", "\"35.7 um\"";
    VERTICAL_PEAK: Some(D::Length), 1e-12, 1.0, "greater than 0, from 1e-6 um to 1 m", "\"90 um\"";
    POSITION: Some(D::Length), -MAX, MAX, "of any sign", "\"20 m\"";
    STEP: Some(D::Length), MIN, MAX, "greater than 0", "\"0.1 m\"";
    APPROACH: Some(D::Length), 0.1, 1e5, "greater than 0, from 0.1 m to 100 km", "\"15 m\"";
    MODULUS: Some(D::Pressure), 1e3, 1e13, "greater than 0, from 1 kPa to 10000 GPa",
        "\"800 MPa\", or { top = \"60 MPa\", bottom = \"200 MPa\" } if it varies with depth";
    MODULUS_AT_AN_END: Some(D::Pressure), 1e3, 1e13, "greater than 0, from 1 kPa to 10000 GPa", "\"60 MPa\"";
    WEIGHT: Some(D::Weight), 1e-3, 1e6, "greater than 0, from 1e-3 N/m to 1 MN/m", "\"108.8 N/m\"";
    AXIAL_STIFFNESS: Some(D::Force), 1.0, 1e15, "greater than 0, from 1 N to 1e15 N", "\"8.01e6 N\"";
    CONDUCTOR_MODULUS: Some(D::Pressure), 1e3, 1e13, "greater than 0, from 1 kPa to 10000 GPa", "\"12 GPa\"";
    CONDUCTOR_AREA: Some(D::Area), 1e-9, 1e3, "greater than 0, from 1e-3 mm2 to 1000 m2", "\"800 mm2\"";
    SHAPE_FACTOR: Some(D::InverseLength), 1.0, 1e18, "greater than 0, from 1 to 1e18 1/m", "\"2e7 1/m\"";
    SPRING: Some(D::ForcePerLength), 1e-9, 1e18, "greater than 0, from 1e-9 to 1e18 N/m", "\"3 MN/m\"";
    CLAMP: Some(D::ForcePerLength), 1e-9, 1e18, "greater than 0, from 1e-9 to 1e18 N/m", "\"1 MN/m\"";
    HOLDS: Some(D::Force), 1e-3, 1e9, "greater than 0, from 1e-3 N to 1000 MN", "\"2 kN\"";
    SECTION_LENGTH: Some(D::Length), 1e-3, 1e5, "greater than 0, from 1 mm to 100 km", "\"40 m\"";
    BEND_RADIUS: Some(D::Length), 0.01, 1e12, "greater than 0, from 1 cm to 1e12 m", "\"10 m\"";
    LOAD: Some(D::Force), 0.0, 1e9, "of at least 0 and at most 1000 MN", "\"20 tf\"";
    WHEEL_LOAD: Some(D::Force), 0.0, 1e9, "of at least 0 and at most 1000 MN", "\"50 kN\"";
    AXLE_LOAD: Some(D::Force), MIN, 1e9, "greater than 0 and at most 1000 MN", "\"100 kN\"";
    SPEED: Some(D::Speed), 1e-3, 1e3, "greater than 0, from 1 mm/s to 1 km/s", "\"40 km/h\"";
    EXPANSION: Some(D::InverseTemperature), 0.0, 1e-3, "of at least 0 and at most 1e-3 1/K", "\"17e-6 1/K\"";
    SWING: Some(D::Temperature), 0.0, 500.0, "of at least 0 and at most 500 K", "\"20 K\"";
    TEMPERATURE: Some(D::Temperature), -500.0, 500.0, "of any sign, from -500 to 500 K", "\"20 K\"";
    OFFSET: Some(D::Temperature), -500.0, 500.0, "of any sign, from -500 to 500 K", "\"-5 K\"";
    TIME_OF_DAY: Some(D::Time), 0.0, MIDNIGHT, "from 0 h on and before 24 h", "\"15 h\"";
    TIME_STEP: Some(D::Time), MIN, MAX, "greater than 0", "\"0.1 ms\"";
    TOLERANCE: Some(D::Ratio), MIN, 0.5, "greater than 0 and at most 0.5", "0.01 or \"1 %\"";
    SHARE: Some(D::Ratio), 1e-12, 1e12, "greater than 0, from 1e-12 to 1e12", "3 or \"20 %\"";
    POISSON: None, 0.0, 0.5, "from 0 to 0.5", "";
    COEFFICIENT: None, 0.0, 10.0, "from 0 to 10", "";
    LOAD_FACTOR: None, 1e-6, 1e6, "greater than 0, from 1e-6 to 1e6", "";
    AXLE_COUNT: None, 0.0, 1e12, "of at least 0 and at most 1e12", "";
    YEARS: None, 1e-9, 1e6, "greater than 0, from 1e-9 to 1e6", "";
    PASSES: None, 1.0, 1e12, "from 1 to 1000000000000", "", whole;
    ANY_WHOLE: None, 0.0, MAX, "of at least 0", "", whole;
    PER_DAY: None, 1e-6, 1e9, "greater than 0, from 1e-6 to 1e9", "";
}

impl Quantity {
    /// Whether a value \[SI\] is in its range.
    pub fn contains(self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }

    /// What is allowed where this quantity belongs.
    pub fn allowed(self) -> String {
        let (words, example) = (self.words, self.example);
        match self.dimension {
            None if self.whole => format!("a whole number {words}, without quotes"),
            None => format!("a number {words}, without quotes or unit"),
            Some(dimension) => {
                let units: Vec<&str> = dimension.units().collect();
                let (noun, units) = (dimension.noun(), units.join(", "));
                format!("{noun} {words}, such as {example} (units: {units})")
            }
        }
    }

    /// The SI unit of its values, if they have one.
    pub fn unit(self) -> Option<&'static str> {
        self.dimension.and_then(Dimension::si)
    }
}
