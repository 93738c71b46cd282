//! The dimensions and units of scene files.

use super::nearest::nearest;

/// Physical dimension of a quantity in a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Dimension {
    /// Length \[m\].
    Length,
    /// Force \[N\].
    Force,
    /// Pressure or modulus \[Pa\].
    Pressure,
    /// Stiffness, or weight per length \[N/m\].
    ForcePerLength,
    /// Inverse length \[1/m\].
    InverseLength,
    /// Speed \[m/s\].
    Speed,
    /// Time \[s\].
    Time,
    /// Difference of temperatures \[K\].
    Temperature,
    /// Inverse temperature \[1/K\].
    InverseTemperature,
    /// A ratio, as a percentage.
    Ratio,
    /// A slope: rise over horizontal distance as a ratio, or an angle, whose tangent it is.
    Slope,
}

impl Dimension {
    /// Every dimension.
    pub const ALL: [Self; 11] = [
        Self::Length,
        Self::Force,
        Self::Pressure,
        Self::ForcePerLength,
        Self::InverseLength,
        Self::Speed,
        Self::Time,
        Self::Temperature,
        Self::InverseTemperature,
        Self::Ratio,
        Self::Slope,
    ];

    /// The symbols of this dimension's units, the SI unit first; ratios and slopes have none in SI.
    ///
    /// Written variants are accepted too: `µm` and `μm` for `um`, `N/mm²` and `N/mm^2` for `N/mm2`, `/m` and `m^-1` for
    /// `1/m`.
    pub fn units(self) -> impl Iterator<Item = &'static str> {
        UNITS
            .iter()
            .filter(move |unit| self.takes(unit.dimension))
            .map(|unit| unit.symbol)
    }

    /// The symbol of the unit of force or length that a word is, whatever its case; mN is not MN.
    pub(crate) fn unit_by_word(word: &str) -> Option<&'static str> {
        let of_tables = ["daN", "kp", "mN"];
        let all = || Self::Force.units().chain(Self::Length.units()).chain(of_tables);
        let exact = all().find(|unit| *unit == word);
        let is_alike = |unit: &&str| unit.eq_ignore_ascii_case(word) && !word.eq_ignore_ascii_case("mN");
        exact.or_else(|| all().find(is_alike))
    }

    /// The symbol of its SI unit; ratios and slopes have none.
    pub(super) fn si(self) -> Option<&'static str> {
        self.units().next().filter(|unit| *unit != "%")
    }

    /// The unit that was probably meant by an unknown one.
    pub(super) fn unit_meant_by(self, unknown: &str) -> Option<&'static str> {
        let unknown_word = unknown.to_lowercase();
        let mut in_words = IN_WORDS.iter().filter(|(word, _)| *word == unknown_word);
        let meant = in_words.find_map(|(_, symbol)| self.units().find(|unit| unit == symbol));
        meant.or_else(|| nearest(unknown, self.units()))
    }

    /// The dimension in words, with its article: "a length".
    pub fn noun(self) -> &'static str {
        match self {
            Self::Length => "a length",
            Self::Force => "a force",
            Self::Pressure => "a pressure or modulus",
            Self::ForcePerLength => "a force per length",
            Self::InverseLength => "an inverse length",
            Self::Speed => "a speed",
            Self::Time => "a time",
            Self::Temperature => "a difference of temperatures",
            Self::InverseTemperature => "an expansion per degree",
            Self::Ratio => "a ratio",
            Self::Slope => "a slope",
        }
    }

    /// Whether it takes units of `dimension`: a slope may be a ratio.
    pub(super) fn takes(self, dimension: Self) -> bool {
        dimension == self || (self, dimension) == (Self::Slope, Self::Ratio)
    }
}

/// Standard gravity \[m/s²\]: 1 kgf = 9.80665 N by definition.
const STANDARD_GRAVITY: f64 = 9.80665;
/// 90 degrees.
const RIGHT_ANGLE: f64 = std::f64::consts::FRAC_PI_2;
/// International pound-force \[N\].
const POUND_FORCE: f64 = 4.4482216152605;
/// International foot and inch \[m\].
const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;
/// International mile and yard \[m\].
const MILE: f64 = 1609.344;
const YARD: f64 = 0.9144;

/// Units in words and other symbols for them, in small letters.
const IN_WORDS: [(&str, &str); 30] = [
    ("c", "K"),
    ("°c", "K"),
    ("degc", "K"),
    ("celsius", "K"),
    ("kelvin", "K"),
    ("1/°c", "1/K"),
    ("/°c", "1/K"),
    ("feet", "ft"),
    ("foot", "ft"),
    ("inch", "in"),
    ("inches", "in"),
    ("yard", "yd"),
    ("yards", "yd"),
    ("mile", "mi"),
    ("miles", "mi"),
    ("mi/h", "mph"),
    ("miles/h", "mph"),
    ("kg", "kgf"),
    ("kg", "kgf/m"),
    ("kph", "km/h"),
    ("km/hr", "km/h"),
    ("kmph", "km/h"),
    ("fps", "ft/s"),
    ("meter", "m"),
    ("meters", "m"),
    ("metre", "m"),
    ("metres", "m"),
    ("t", "tf"),
    ("ton", "tf"),
    ("tonnes", "tf"),
];

/// A unit of a scene file: one of it is `factor / divisor · 10^exponent` in SI; for a slope that is the angle, and its tangent counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    pub(super) symbol: &'static str,
    pub(super) dimension: Dimension,
    pub(super) exponent: i32,
    factor: f64,
    divisor: f64,
}

impl Unit {
    /// Newton.
    pub const NEWTON: Self = unit("N", Dimension::Force, 0, 1.0);
    /// Metre.
    pub const METRE: Self = unit("m", Dimension::Length, 0, 1.0);
    /// Millimetre.
    pub const MILLIMETRE: Self = unit("mm", Dimension::Length, -3, 1.0);
    /// Micrometre.
    pub const MICROMETRE: Self = unit("um", Dimension::Length, -6, 1.0);
    /// Foot.
    pub const FOOT: Self = unit("ft", Dimension::Length, 0, FOOT);
    /// Inch.
    pub const INCH: Self = unit("in", Dimension::Length, 0, INCH);
    /// Newton per metre.
    pub const NEWTON_PER_METRE: Self = unit("N/m", Dimension::ForcePerLength, 0, 1.0);
    /// Kilonewton per metre.
    pub const KILONEWTON_PER_METRE: Self = unit("kN/m", Dimension::ForcePerLength, 3, 1.0);
    /// Megapascal.
    pub const MEGAPASCAL: Self = unit("MPa", Dimension::Pressure, 6, 1.0);

    /// The unit of this dimension that is written so.
    pub fn of(dimension: Dimension, symbol: &str) -> Option<Self> {
        let symbol = normalised(symbol);
        let is_meant = |unit: &&Self| unit.symbol == symbol && dimension.takes(unit.dimension);
        UNITS.iter().find(is_meant).copied()
    }

    /// The stiffness that is this force per length: N/m, kN/m, tf/m, kip/in.
    pub(crate) fn per_length(&self) -> Option<Self> {
        let begins = |unit: &&Self| {
            unit.symbol
                .split_once('/')
                .is_some_and(|(force, _)| force == self.symbol)
        };
        let stiffnesses = UNITS
            .iter()
            .filter(|unit| unit.dimension == Dimension::ForcePerLength);
        stiffnesses.into_iter().find(begins).copied()
    }

    /// Of a force per length, the force.
    pub(crate) fn force(&self) -> Option<Self> {
        let (force, _) = self.symbol.split_once('/')?;
        Self::of(Dimension::Force, force)
    }

    /// Its symbol.
    pub fn symbol(&self) -> &'static str {
        match self.symbol {
            "um" => "µm",
            symbol => symbol,
        }
    }

    /// How many of it `si` is, a value in SI.
    ///
    /// ```
    /// use creepage::scene::{Dimension, Unit};
    ///
    /// let kip = Unit::of(Dimension::Force, "kip").unwrap();
    /// assert_eq!(kip.of_si(2.0 * 4448.2216152605), 2.0);
    /// ```
    pub fn of_si(&self, si: f64) -> f64 {
        let value = match self.dimension {
            Dimension::Slope => si.atan(),
            _ => si,
        };
        let value = value / self.factor * self.divisor;
        let power = 10_f64.powi(self.exponent.abs());
        if self.exponent < 0 {
            value * power
        } else {
            value / power
        }
    }

    /// The value in SI of `number`, from which the power of ten is already taken out.
    pub(super) fn in_si(&self, number: f64) -> f64 {
        let value = number * self.factor / self.divisor;
        match self.dimension {
            // Steeper than upright is no slope.
            Dimension::Slope if value.abs() < RIGHT_ANGLE => value.tan(),
            Dimension::Slope => f64::INFINITY.copysign(value),
            _ => value,
        }
    }
}

const fn unit(symbol: &'static str, dimension: Dimension, exponent: i32, factor: f64) -> Unit {
    ratio(symbol, dimension, exponent, factor, 1.0)
}

const fn ratio(symbol: &'static str, dimension: Dimension, exponent: i32, factor: f64, divisor: f64) -> Unit {
    Unit {
        symbol,
        dimension,
        exponent,
        factor,
        divisor,
    }
}

/// Every unit of a scene file, the SI unit of each dimension first.
pub const UNITS: &[Unit] = &[
    unit("m", Dimension::Length, 0, 1.0),
    unit("cm", Dimension::Length, -2, 1.0),
    unit("mm", Dimension::Length, -3, 1.0),
    unit("um", Dimension::Length, -6, 1.0),
    unit("nm", Dimension::Length, -9, 1.0),
    unit("km", Dimension::Length, 3, 1.0),
    unit("in", Dimension::Length, 0, INCH),
    unit("ft", Dimension::Length, 0, FOOT),
    unit("yd", Dimension::Length, 0, YARD),
    unit("mi", Dimension::Length, 0, MILE),
    unit("N", Dimension::Force, 0, 1.0),
    unit("kN", Dimension::Force, 3, 1.0),
    unit("MN", Dimension::Force, 6, 1.0),
    unit("GN", Dimension::Force, 9, 1.0),
    unit("kgf", Dimension::Force, 0, STANDARD_GRAVITY),
    unit("tf", Dimension::Force, 3, STANDARD_GRAVITY),
    unit("lbf", Dimension::Force, 0, POUND_FORCE),
    unit("kip", Dimension::Force, 3, POUND_FORCE),
    unit("Pa", Dimension::Pressure, 0, 1.0),
    unit("kPa", Dimension::Pressure, 3, 1.0),
    unit("MPa", Dimension::Pressure, 6, 1.0),
    unit("GPa", Dimension::Pressure, 9, 1.0),
    unit("N/m2", Dimension::Pressure, 0, 1.0),
    unit("kN/m2", Dimension::Pressure, 3, 1.0),
    unit("MN/m2", Dimension::Pressure, 6, 1.0),
    unit("N/mm2", Dimension::Pressure, 6, 1.0),
    unit("kgf/cm2", Dimension::Pressure, 4, STANDARD_GRAVITY),
    unit("tf/m2", Dimension::Pressure, 3, STANDARD_GRAVITY),
    ratio("psi", Dimension::Pressure, 0, POUND_FORCE, INCH * INCH),
    ratio("ksi", Dimension::Pressure, 3, POUND_FORCE, INCH * INCH),
    unit("N/m", Dimension::ForcePerLength, 0, 1.0),
    unit("kN/m", Dimension::ForcePerLength, 3, 1.0),
    unit("MN/m", Dimension::ForcePerLength, 6, 1.0),
    unit("GN/m", Dimension::ForcePerLength, 9, 1.0),
    unit("N/mm", Dimension::ForcePerLength, 3, 1.0),
    unit("kN/mm", Dimension::ForcePerLength, 6, 1.0),
    unit("kgf/m", Dimension::ForcePerLength, 0, STANDARD_GRAVITY),
    unit("tf/m", Dimension::ForcePerLength, 3, STANDARD_GRAVITY),
    ratio("lbf/ft", Dimension::ForcePerLength, 0, POUND_FORCE, FOOT),
    ratio("kip/in", Dimension::ForcePerLength, 3, POUND_FORCE, INCH),
    unit("1/m", Dimension::InverseLength, 0, 1.0),
    unit("1/cm", Dimension::InverseLength, 2, 1.0),
    unit("1/mm", Dimension::InverseLength, 3, 1.0),
    unit("1/um", Dimension::InverseLength, 6, 1.0),
    unit("m/s", Dimension::Speed, 0, 1.0),
    unit("cm/s", Dimension::Speed, -2, 1.0),
    unit("mm/s", Dimension::Speed, -3, 1.0),
    ratio("km/h", Dimension::Speed, 0, 1.0, 3.6),
    unit("ft/s", Dimension::Speed, 0, FOOT),
    ratio("mph", Dimension::Speed, 0, MILE, 3600.0),
    unit("s", Dimension::Time, 0, 1.0),
    unit("ms", Dimension::Time, -3, 1.0),
    unit("us", Dimension::Time, -6, 1.0),
    unit("ns", Dimension::Time, -9, 1.0),
    unit("min", Dimension::Time, 0, 60.0),
    unit("h", Dimension::Time, 0, 3600.0),
    unit("K", Dimension::Temperature, 0, 1.0),
    unit("1/K", Dimension::InverseTemperature, 0, 1.0),
    unit("%", Dimension::Ratio, -2, 1.0),
    unit("deg", Dimension::Slope, 0, RIGHT_ANGLE / 90.0),
];

/// The unit in the spelling of [`UNITS`].
pub fn normalised(unit: &str) -> String {
    let plain: String = unit
        .chars()
        .filter(|c| !c.is_whitespace() && *c != '^')
        .map(|c| match c {
            'µ' | 'μ' => 'u',
            '²' => '2',
            '⁻' => '-',
            '¹' => '1',
            '％' => '%',
            c => c,
        })
        .collect();
    if plain == "°" {
        return "deg".to_owned();
    }
    let inverse = plain.strip_prefix('/').or(plain.strip_suffix("-1"));
    match inverse {
        Some(unit @ ("m" | "cm" | "mm" | "um" | "K")) => format!("1/{unit}"),
        _ => plain,
    }
}
