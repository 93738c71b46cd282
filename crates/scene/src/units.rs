//! The dimensions and units of scene files.

use crate::nearest::nearest;

/// A dimension in a row: its name, its noun with an article, and its units, that of SI first: symbol, power of ten, factor. A unit that
/// answers are given in has a name of its own.
macro_rules! dimensions {
    ($($dimension:ident $noun:literal: $($($name:ident)? $symbol:literal $exponent:literal $factor:tt $(/ $divisor:expr)?),+;)+) => {
        /// Physical dimension of a quantity in a scene.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Dimension {
            $(#[doc = concat!("It is ", $noun, ".")] $dimension,)+
        }

        impl Dimension {
            /// Every dimension.
            pub const ALL: &'static [Self] = &[$(Self::$dimension),+];

            /// The dimension in words, with its article: "a length".
            pub fn noun(self) -> &'static str {
                match self {
                    $(Self::$dimension => $noun,)+
                }
            }
        }

        impl Unit {
            $($($(
                #[doc = concat!("1 ", $symbol, ".")]
                pub const $name: Self = unit($symbol, Dimension::$dimension, $exponent, ($factor, 1.0));
            )?)+)+
        }

        /// Every unit of a scene file, the SI unit of each dimension first.
        pub const UNITS: &[Unit] =
            &[$($(unit($symbol, Dimension::$dimension, $exponent, ($factor, [$($divisor,)? 1.0][0]))),+),+];
    };
}

dimensions! {
    Length "a length": METRE "m" 0 1.0, "cm" -2 1.0, MILLIMETRE "mm" -3 1.0, MICROMETRE "um" -6 1.0, "nm" -9 1.0, "km" 3 1.0,
        INCH "in" 0 INCH, FOOT "ft" 0 FOOT, "yd" 0 YARD, "mi" 0 MILE;
    Force "a force": NEWTON "N" 0 1.0, "kN" 3 1.0, "MN" 6 1.0, "GN" 9 1.0, "kgf" 0 STANDARD_GRAVITY, "tf" 3 STANDARD_GRAVITY,
        "lbf" 0 POUND_FORCE, "kip" 3 POUND_FORCE;
    Pressure "a pressure or modulus": "Pa" 0 1.0, "kPa" 3 1.0, MEGAPASCAL "MPa" 6 1.0, "GPa" 9 1.0, "N/m2" 0 1.0, "kN/m2" 3 1.0, "MN/m2" 6 1.0,
        "N/mm2" 6 1.0, "kgf/cm2" 4 STANDARD_GRAVITY, "kgf/mm2" 6 STANDARD_GRAVITY, "tf/m2" 3 STANDARD_GRAVITY,
        "psi" 0 POUND_FORCE / SQUARE_INCH, "ksi" 3 POUND_FORCE / SQUARE_INCH;
    ForcePerLength "a force per length": NEWTON_PER_METRE "N/m" 0 1.0, KILONEWTON_PER_METRE "kN/m" 3 1.0, "MN/m" 6 1.0, "GN/m" 9 1.0,
        "N/mm" 3 1.0, "kN/mm" 6 1.0, "kgf/m" 0 STANDARD_GRAVITY, "kgf/mm" 3 STANDARD_GRAVITY, "tf/m" 3 STANDARD_GRAVITY,
        "lbf/ft" 0 POUND_FORCE / FOOT, "kip/in" 3 POUND_FORCE / INCH;
    Weight "a weight per length": "kg/m" 0 STANDARD_GRAVITY, "kg/km" -3 STANDARD_GRAVITY, "lb/1000ft" -3 POUND_FORCE / FOOT;
    InverseLength "an inverse length": "1/m" 0 1.0, "1/cm" 2 1.0, "1/mm" 3 1.0, "1/um" 6 1.0;
    Area "an area": "m2" 0 1.0, "cm2" -4 1.0, "mm2" -6 1.0, "in2" 0 SQUARE_INCH;
    Speed "a speed": "m/s" 0 1.0, "cm/s" -2 1.0, "mm/s" -3 1.0, "km/h" 0 1.0 / 3.6, "ft/s" 0 FOOT, "mph" 0 MILE / 3600.0;
    Time "a time": "s" 0 1.0, "ms" -3 1.0, "us" -6 1.0, "ns" -9 1.0, "min" 0 60.0, "h" 0 3600.0;
    Temperature "a difference of temperatures": "K" 0 1.0;
    InverseTemperature "an expansion per degree": "1/K" 0 1.0;
    Ratio "a ratio": "%" -2 1.0;
    Slope "a slope": "deg" 0 DEGREE;
}

impl Dimension {
    /// The symbols of this dimension's units, the SI unit first; ratios and slopes have none in SI.
    ///
    /// Written variants are accepted too: `µm` and `μm` for `um`, `N/mm²` and `N/mm^2` for `N/mm2`, `/m` and `m^-1` for
    /// `1/m`.
    pub fn units(self) -> impl Iterator<Item = &'static str> {
        let own = UNITS.iter().filter(move |unit| self.takes(unit.dimension));
        own.map(|unit| unit.symbol)
    }

    /// The symbol of the unit of force or length that a word is, whatever its case; mN is not MN.
    pub fn unit_by_word(word: &str) -> Option<&'static str> {
        let of_tables = ["daN", "kp", "mN"];
        let all = || Self::Force.units().chain(Self::Length.units()).chain(of_tables);
        let exact = all().find(|unit| *unit == word);
        let is_alike = |unit: &&str| unit.eq_ignore_ascii_case(word) && !word.eq_ignore_ascii_case("mN");
        exact.or_else(|| all().find(is_alike))
    }

    /// The value in SI of a number in a unit as tables write it: whatever its case, daN, kp and mN too. `None` for a unit of another
    /// dimension.
    pub fn in_table(self, digits: &str, unit: &str) -> Option<f64> {
        let symbol = Self::unit_by_word(unit).unwrap_or(unit);
        let of = |symbol: &str| self.parse(&format!("{digits} {symbol}")).ok();
        match symbol {
            "daN" => Some(of("N")? * 10.0),
            "mN" => Some(of("N")? / 1e3),
            "kp" => of("kgf"),
            symbol => of(symbol),
        }
    }

    /// The symbol of its SI unit; ratios and slopes have none.
    pub fn si(self) -> Option<&'static str> {
        self.units().next().filter(|unit| *unit != "%")
    }

    /// The unit that was probably meant by an unknown one.
    pub(crate) fn unit_meant_by(self, unknown: &str) -> Option<&'static str> {
        let word = unknown.to_lowercase();
        let named = self.units().find(|unit| IN_WORDS.contains(&(&word, unit)));
        named.or_else(|| nearest(unknown, self.units()))
    }

    /// Whether it takes units of `dimension`: a slope may be a ratio, a weight per length is a force per length.
    pub(crate) fn takes(self, dimension: Self) -> bool {
        let wider = [(Self::Slope, Self::Ratio), (Self::Weight, Self::ForcePerLength)];
        dimension == self || wider.contains(&(self, dimension))
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
const SQUARE_INCH: f64 = INCH * INCH;
const DEGREE: f64 = RIGHT_ANGLE / 90.0;
/// International mile and yard \[m\].
const MILE: f64 = 1609.344;
const YARD: f64 = 0.9144;

/// Units in words and other symbols for them, in small letters.
#[rustfmt::skip]
const IN_WORDS: &[(&str, &str)] = &[
    ("c", "K"), ("°c", "K"), ("degc", "K"), ("celsius", "K"), ("kelvin", "K"), ("1/°c", "1/K"), ("/°c", "1/K"),
    ("feet", "ft"), ("foot", "ft"), ("inch", "in"), ("inches", "in"), ("yard", "yd"), ("yards", "yd"),
    ("mile", "mi"), ("miles", "mi"), ("mi/h", "mph"), ("miles/h", "mph"), ("fps", "ft/s"),
    ("kph", "km/h"), ("km/hr", "km/h"), ("kmph", "km/h"),
    ("meter", "m"), ("meters", "m"), ("metre", "m"), ("metres", "m"),
    ("kg", "kgf"), ("kg", "kg/m"), ("kg/mm", "kgf/mm"), ("t", "tf"), ("ton", "tf"), ("tonnes", "tf"), ("sqmm", "mm2"),
];

/// A unit of a scene file: one of it is `scale.0 / scale.1 · 10^exponent` in SI; for a slope that is
/// the angle, and its tangent counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    pub(crate) symbol: &'static str,
    pub(crate) dimension: Dimension,
    pub(crate) exponent: i32,
    scale: (f64, f64),
}

impl Unit {
    /// The unit of this dimension that is written so.
    pub fn of(dimension: Dimension, symbol: &str) -> Option<Self> {
        let symbol = normalised(symbol);
        let is_meant = |unit: &&Self| unit.symbol == symbol && dimension.takes(unit.dimension);
        UNITS.iter().find(is_meant).copied()
    }

    /// The stiffness that is this force per length: N/m, kN/m, tf/m, kip/in.
    pub fn per_length(&self) -> Option<Self> {
        let of_length = |unit: &&Self| unit.dimension == Dimension::ForcePerLength;
        let mut stiffnesses = UNITS.iter().filter(of_length);
        stiffnesses.find(|unit| unit.force() == Some(*self)).copied()
    }

    /// Of a force per length, the force.
    pub fn force(&self) -> Option<Self> {
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
    pub fn of_si(&self, si: f64) -> f64 {
        let is_angle = self.dimension == Dimension::Slope;
        let value = if is_angle { si.atan() } else { si } / self.scale.0 * self.scale.1;
        let power = 10_f64.powi(self.exponent.abs());
        if self.exponent < 0 {
            value * power
        } else {
            value / power
        }
    }

    /// The value in SI of `number`, from which the power of ten is already taken out.
    pub(crate) fn in_si(&self, number: f64) -> f64 {
        let value = number * self.scale.0 / self.scale.1;
        match self.dimension {
            // Steeper than upright is no slope.
            Dimension::Slope if value.abs() < RIGHT_ANGLE => value.tan(),
            Dimension::Slope => f64::INFINITY.copysign(value),
            _ => value,
        }
    }
}

const fn unit(symbol: &'static str, dimension: Dimension, exponent: i32, scale: (f64, f64)) -> Unit {
    Unit {
        symbol,
        dimension,
        exponent,
        scale,
    }
}

/// The unit in the spelling of [`UNITS`].
pub fn normalised(unit: &str) -> String {
    let plain: String = unit.split_whitespace().collect();
    let plain = plain.replace('^', "").replace(['µ', 'μ'], "u").replace('²', "2");
    let plain = plain.replace('⁻', "-").replace('¹', "1").replace('％', "%");
    match plain.strip_prefix('/').or(plain.strip_suffix("-1")) {
        Some(unit @ ("m" | "cm" | "mm" | "um" | "K")) => format!("1/{unit}"),
        _ if plain == "°" => "deg".to_owned(),
        _ => plain,
    }
}
