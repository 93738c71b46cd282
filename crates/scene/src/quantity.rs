//! Quantities with units, turned into SI.
//!
//! A unit is a power of ten times a factor. The power of ten goes into the decimal exponent before the digits become a
//! binary number, so that `"35.7 um"` is exactly the number written `35.7e-6`.

use crate::error::did_you_mean;
use crate::units::{Dimension, UNITS, Unit, normalised};

impl Dimension {
    /// The SI value of `text`, a number followed by one of this dimension's [units](Dimension::units).
    ///
    /// The value may be infinite or NaN if the text says so or the number is too large: check its range.
    ///
    /// # Errors
    ///
    /// Why the text is anything else, a number without a unit included.
    ///
    /// # Example
    ///
    /// ```
    /// use creepage_scene::Dimension;
    ///
    /// assert_eq!(Dimension::Force.parse("20 tf"), Ok(196_133.0));
    /// assert_eq!(Dimension::Force.parse("20 m"), Err("`m` is the unit of a length".to_owned()));
    /// ```
    pub fn parse(self, text: &str) -> Result<f64, String> {
        let (number, unit) = split(text).ok_or("not a number with a unit, its decimals after a point")?;
        if unit.is_empty() {
            return Err("the unit is missing".to_owned());
        }
        let symbol = normalised(unit);
        match UNITS.iter().find(|known| known.symbol == symbol) {
            Some(known) if self.takes(known.dimension) => {
                let value = shifted(number, known.exponent).ok_or("not a number")?;
                Ok(known.in_si(value))
            }
            Some(known) => Err(format!("`{unit}` is the unit of {}", known.dimension.noun())),
            None => {
                let meant = did_you_mean(self.unit_meant_by(&symbol));
                Err(format!("`{unit}` is not a known unit{meant}"))
            }
        }
    }

    /// The unit in `text`, a number followed by one of this dimension's units; `None` for anything else.
    pub fn unit_of(self, text: &str) -> Option<Unit> {
        Unit::of(self, split(text)?.1)
    }

    /// As [`Dimension::parse`], but a number without a unit is taken as SI: for values typed on a command line.
    ///
    /// # Errors
    ///
    /// As for [`Dimension::parse`].
    pub fn parse_argument(self, text: &str) -> Result<f64, String> {
        text.trim().parse().or_else(|_| self.parse(text))
    }
}

/// The number that a text begins with, and its unit, which may be empty. `None` if digits or points follow the number.
pub fn leading_number(text: &str) -> Option<(f64, &str)> {
    let (number, unit) = split(text)?;
    let value: f64 = number.parse().ok()?;
    let goes_on = unit.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    (value.is_finite() && !goes_on).then_some((value, unit))
}

/// A number times a power of ten, which goes into its exponent.
fn shifted(number: &str, exponent: i32) -> Option<f64> {
    // A word for a value that is not finite has no exponent.
    if number.ends_with(|c: char| c.is_ascii_alphabetic()) {
        return number.parse().ok();
    }
    let (digits, own) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    // An exponent too large for its type is far beyond any number: its sign decides.
    let beyond = if own.starts_with('-') { i32::MIN } else { i32::MAX };
    let own: i32 = own.parse().unwrap_or(beyond);
    format!("{digits}e{}", own.saturating_add(exponent)).parse().ok()
}

/// The number that a text begins with, and what follows, both without space around them.
fn split(text: &str) -> Option<(&str, &str)> {
    // No number is longer than this.
    const LONGEST: usize = 400;
    let text = text.trim();
    let is_number = |end: &usize| text.get(..*end).is_some_and(|text| text.parse::<f64>().is_ok());
    let end = (1..=text.len().min(LONGEST)).rev().find(is_number)?;
    let (number, rest) = text.split_at(end);
    let is_word = number.ends_with(|c: char| c.is_ascii_alphabetic());
    // A decimal comma, a second point, a digit separator, another word: not a number in this notation.
    let goes_on = |c: char| matches!(c, ',' | '.' | '_' | '+' | '-') || is_word && c.is_alphanumeric();
    (!rest.starts_with(goes_on)).then_some((number, rest.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_becomes_si() {
        #[rustfmt::skip]
        let cases: [(Dimension, &[(&str, f64)]); 11] = [
            (Dimension::Length, &[("1.2 m", 1.2), ("50mm", 0.05), (" 35.7  um ", 35.7e-6), ("35.7 µm", 35.7e-6),
                ("35.7 μm", 35.7e-6), ("-3 cm", -0.03), ("0.3 km", 300.0), (".5 m", 0.5), ("5. m", 5.0),
                ("10 ft", 3.048), ("1 in", 0.0254), ("100 yd", 91.44), ("0.5 mi", 804.672)]),
            (Dimension::Force, &[("196 kN", 196e3), ("8.01e6 N", 8.01e6), ("8.01 MN", 8.01e6), ("8.01E-3GN", 8.01e6),
                ("20 tf", 20.0 * 9806.65), ("1 tf", 9806.65), ("1 kgf", 9.80665), ("1 lbf", 4.4482216152605),
                ("2 kip", 8896.443230521)]),
            (Dimension::Pressure, &[("1 psi", 4.4482216152605 / (0.0254 * 0.0254)),
                ("2 ksi", 8896.443230521 / (0.0254 * 0.0254)), ("4000 MPa", 4e9), ("10 GPa", 1e10), ("1 kPa", 1e3),
                ("1 Pa", 1.0), ("1 N/mm2", 1e6), ("1 N/mm²", 1e6), ("1 N/mm^2", 1e6), ("1 kgf/cm2", 98066.5), ("1 kgf/mm2", 9806650.0)]),
            (Dimension::Weight, &[("11 kg/m", 11.0 * 9.80665), ("1 kg/km", 0.001 * 9.80665), ("2000 lb/1000ft", 2.0 * 4.4482216152605 / 0.3048)]),
            (Dimension::Area, &[("800 mm2", 8e-4), ("2 cm²", 2e-4), ("1 in^2", 0.0254 * 0.0254)]),
            (Dimension::ForcePerLength, &[("1 lbf/ft", 4.4482216152605 / 0.3048),
                ("1 kip/in", 4448.2216152605 / 0.0254), ("108.8 N/m", 108.8), ("3 MN/m", 3e6), ("3 kN/m", 3e3),
                ("3 GN / m", 3e9), ("3 N/mm", 3e3), ("1 kgf/m", 9.80665), ("1 tf/m", 9806.65), ("1 kgf/mm", 9806.65)]),
            (Dimension::InverseLength, &[("2e7 1/m", 2e7), ("2e7/m", 2e7), ("20 1/um", 2e7), ("2 1/mm", 2e3),
                ("2 m^-1", 2.0), ("2 m⁻¹", 2.0)]),
            (Dimension::Speed, &[("36 km/h", 10.0), ("40 km/h", 40.0 / 3.6), ("11 m/s", 11.0),
                ("30 mph", 30.0 * 1609.344 / 3600.0), ("44 ft/s", 44.0 * 0.3048), ("11 mm/s", 0.011)]),
            (Dimension::Time, &[("0.1 ms", 1e-4), ("3 s", 3.0), ("3 us", 3e-6), ("2 min", 120.0), ("2 h", 7200.0)]),
            (Dimension::Ratio, &[("1 %", 0.01)]),
            (Dimension::Slope, &[("-3 %", -0.03)]),
        ];
        for (dimension, quantities) in cases {
            for (text, value) in quantities {
                assert_eq!(dimension.parse(text), Ok(*value), "{text}");
            }
        }
    }

    #[test]
    fn an_angle_becomes_its_tangent() {
        let slope = |text| Dimension::Slope.parse(text).unwrap();
        for (text, tangent) in [("45 deg", 1.0), ("-30°", -1.0 / 3.0_f64.sqrt()), ("0 deg", 0.0)] {
            assert!((slope(text) - tangent).abs() < 1e-15, "{text}");
        }
        assert_eq!(slope("180 deg"), f64::INFINITY);
        assert_eq!(slope("-90 deg"), f64::NEG_INFINITY);
    }

    #[test]
    fn extreme_values_are_told_by_their_value() {
        let length = |text| Dimension::Length.parse(text).unwrap();
        assert_eq!(length("1e400 m"), f64::INFINITY);
        assert_eq!(length("1e99999999999999 m"), f64::INFINITY);
        assert_eq!(length("1e-99999999999999 m"), 0.0);
        assert_eq!(length("-inf m"), f64::NEG_INFINITY);
        assert!(length("NaN m").is_nan());
    }

    #[test]
    fn what_is_no_quantity_is_refused() {
        #[rustfmt::skip]
        let no_quantities = [
            "", "m", "abc", "1.2.3 m", "1_000 m", "--1 m", "+", ".", "１ m", "e5 m", "nano m", "1,2 m", "1,200.5",
            "1.2", "1e3", "-4 ", "inf", "1 M", "1 MM", "1 mE", "1 furlong", "1e", "1 2 m",
        ];
        for text in no_quantities {
            assert!(Dimension::Length.parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn no_unit_passes_for_another_dimension() {
        for unit in UNITS {
            let text = format!("1 {}", unit.symbol);
            for other in UNITS {
                let parsed = other.dimension.parse(&text);
                assert_eq!(parsed.is_ok(), other.dimension.takes(unit.dimension), "{text}");
            }
        }
    }

    #[test]
    fn values_in_si_go_back_to_every_unit() {
        for known in UNITS {
            for number in [0.0, 1.0, -0.25, 12.5] {
                let text = format!("{number} {}", known.symbol());
                let found = known.dimension.unit_of(&text).expect("a unit");
                assert_eq!(found, *known);
                let back = found.of_si(known.dimension.parse(&text).expect("a quantity"));
                assert!(
                    (back - number).abs() <= 1e-15 * f64::abs(number),
                    "{text}: {back}"
                );
            }
        }
        assert_eq!(Dimension::Length.unit_of("1.2"), None);
        assert_eq!(Dimension::Length.unit_of("1 N"), None);
        assert_eq!(Dimension::Length.unit_of("free"), None);
    }

    #[test]
    fn an_argument_may_leave_the_unit_out() {
        assert_eq!(Dimension::Force.parse_argument("500"), Ok(500.0));
        assert_eq!(Dimension::Force.parse_argument("0.5 kN"), Ok(500.0));
        assert!(Dimension::Force.parse_argument("0.5 m").is_err());
        assert!(Dimension::Force.parse_argument("much").is_err());
    }
}
