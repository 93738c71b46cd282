//! Quantities as an engineer says them: in the units that were typed, four digits, a prefix, groups of thousands.

use ground_field::Modulus;

use crate::scene::Unit;
use crate::shown::rounded;
use crate::{Limited, Units};

/// SI prefixes and what they stand for, the largest first.
const PREFIXES: [(f64, &str); 7] = [
    (1e9, "G"),
    (1e6, "M"),
    (1e3, "k"),
    (1.0, ""),
    (1e-3, "m"),
    (1e-6, "µ"),
    (1e-9, "n"),
];

/// Last digits of forces \[N\] and movements \[m\], if four are not fewer.
const FORCE_DIGIT: f64 = 0.1;
const MOVEMENT_DIGIT: f64 = 1e-7;
/// Shortest length that is said in m \[m\].
const SHORT: f64 = 0.1;

/// How the page shows quantities.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    /// The units that were typed, in which tables and charts are.
    pub units: Units,
    /// The largest movement of an end \[m\] that means more than that the cable leaves the duct.
    pub most: f64,
}

impl Shown {
    pub fn new(units: Units, most: f64) -> Self {
        let units = units.for_springs();
        Self { units, most }
    }

    /// A force with its unit: "551.2 N".
    pub fn force(&self, newtons: f64) -> String {
        format!("{} {}", self.force_number(newtons), self.units.force.symbol())
    }

    /// The same without its unit.
    pub fn force_number(&self, newtons: f64) -> String {
        four_digits(newtons, self.units.force, FORCE_DIGIT)
    }

    /// A movement with its unit: "0.0520 mm".
    pub fn movement(&self, metres: f64) -> String {
        format!(
            "{} {}",
            self.movement_number(metres),
            self.units.movement.symbol()
        )
    }

    /// The same without its unit; where the cable leaves the duct, only that it does: "> 2500".
    pub fn movement_number(&self, metres: f64) -> String {
        let beyond = match metres {
            metres if metres > self.most => "> ",
            metres if metres < -self.most => "< ",
            _ => "",
        };
        let shown = metres.clamp(-self.most, self.most);
        beyond.to_owned() + &four_digits(shown, self.units.movement, MOVEMENT_DIGIT)
    }

    /// What a limit is for, in words.
    pub fn limited(&self, quantity: Limited, value: f64) -> String {
        match quantity {
            Limited::Force => self.force(value),
            Limited::Movement => self.movement(value),
        }
    }

    /// What is given of a force in its unit: "force, N".
    pub fn in_force(&self, what: &str) -> String {
        format!("{what}, {}", self.units.force.symbol())
    }

    /// The same of a movement: "movement, mm".
    pub fn in_movement(&self, what: &str) -> String {
        format!("{what}, {}", self.units.movement.symbol())
    }

    /// The same of a place: "place along the duct, m".
    pub fn in_length(&self, what: &str) -> String {
        format!("{what}, {}", self.units.length.symbol())
    }

    /// A large force that was given: "8.01 MN", "1800 kip".
    pub fn load(&self, newtons: f64) -> String {
        if self.units.force == Unit::NEWTON {
            quantity(newtons, "N")
        } else {
            stated(newtons, self.units.force)
        }
    }

    /// Weight or friction per length: "108.8 N/m".
    pub fn weight(&self, newtons_per_metre: f64) -> String {
        stated(newtons_per_metre, self.units.weight)
    }

    /// Stiffness of a spring or a clamp: "3000 kN/m".
    pub fn stiffness(&self, newtons_per_metre: f64) -> String {
        stated(newtons_per_metre, self.units.stiffness)
    }

    /// A length in the unit one would say it in: "0.9 m", "50 mm", "4 ft", "2 in".
    pub fn length(&self, metres: f64) -> String {
        let unit = self.units.length;
        if unit == Unit::METRE && metres.abs() < SHORT {
            quantity(metres, "m")
        } else if unit == Unit::FOOT && metres != 0.0 && unit.of_si(metres.abs()) < 1.0 {
            stated(metres, Unit::INCH)
        } else {
            stated(metres, unit)
        }
    }

    /// A thickness or depth, of which many stand below each other: "0.05 m"; feet also have inches.
    pub fn depth(&self, metres: f64) -> String {
        if self.units.length == Unit::METRE {
            stated(metres, Unit::METRE)
        } else {
            self.length(metres)
        }
    }

    /// Depths from the first to the second: "0 to 0.05 m", "4 in to 1 ft".
    pub fn depths(&self, from: f64, to: f64) -> String {
        let [from, to] = [from, to].map(|depth| self.depth(depth));
        match (from.split_once(' '), to.split_once(' ')) {
            (Some((number, unit)), Some((_, same))) if unit == same || number == "0" => {
                format!("{number} to {to}")
            }
            _ => format!("{from} to {to}"),
        }
    }

    /// Young's modulus, at the top and at the bottom where it varies: "3000 MPa", "100 to 250 MPa".
    pub fn moduli(&self, modulus: Modulus) -> String {
        let unit = self.units.modulus;
        match modulus {
            Modulus::Uniform(modulus) => stated(modulus, unit),
            Modulus::Linear { top, bottom } => {
                format!("{} to {}", significant(unit.of_si(top)), stated(bottom, unit))
            }
        }
    }
}

/// A value in SI to four digits in this unit, none of them below `digit` in SI.
fn four_digits(si: f64, unit: Unit, digit: f64) -> String {
    let value = unit.of_si(si);
    let finest = (-unit.of_si(digit).log10()).round().max(0.0);
    // Of what is rounded: 0.09999996 is 0.1000.
    let rounded_up = format!("{value:.3e}");
    let exponent = rounded_up.split_once('e').map_or("0", |(_, exponent)| exponent);
    let exponent: f64 = exponent.parse().unwrap_or(0.0);
    let decimals = (3.0 - exponent).clamp(0.0, finest);
    let text = rounded(value, decimals as usize);
    if text.bytes().all(|byte| matches!(byte, b'0' | b'.')) {
        return "0".into();
    }
    text
}

/// A value in SI to four digits in this unit.
fn stated(si: f64, unit: Unit) -> String {
    format!("{} {}", significant(unit.of_si(si)), unit.symbol())
}

/// A quantity to four digits with the prefix that suits its size: "8.01 MN".
pub fn quantity(value: f64, unit: &str) -> String {
    let size = value.abs();
    let (factor, prefix) = PREFIXES
        .into_iter()
        .find(|(factor, _)| size >= *factor)
        .unwrap_or((1.0, ""));
    format!("{} {prefix}{unit}", significant(value / factor))
}

/// The largest of …, 0.5, 1, 2, 5, 10, … that is not above `number`, which is positive.
pub fn round_below(number: f64) -> f64 {
    // The cube root of a thousand comes out a little below ten.
    let number = number * (1.0 + 1e-9);
    let power = 10_f64.powf(number.log10().floor());
    let step = [5.0, 2.0].into_iter().find(|step| number / power >= *step);
    step.unwrap_or(1.0) * power
}

/// A whole number in groups of three digits, which do not break: "5 840 000".
pub fn count(number: u64) -> String {
    let digits = number.to_string();
    let mut grouped = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if digits.len() > 4 && index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push('\u{a0}');
        }
        grouped.push(digit);
    }
    grouped
}

/// A number with its power of ten: "7.4·10⁶".
pub fn power_of_ten(value: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let text = format!("{value:.3e}");
    let (leading, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let leading = leading.trim_end_matches('0').trim_end_matches('.');
    let raised = |digit: char| digit.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    let exponent: String = exponent.chars().map(raised).collect();
    format!("{leading}·10{exponent}")
}

/// Four digits, without zeros at the end; very large and small numbers with an exponent.
pub fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-4..9).contains(&magnitude) {
        return power_of_ten(value);
    }
    let text = format!("{value:.*}", (3 - magnitude).max(0) as usize);
    if text.contains('.') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_have_four_digits_and_a_prefix() {
        for (value, unit, expected) in [
            (8.01e6, "N", "8.01 MN"),
            (0.05, "m", "50 mm"),
            (-35.7e-6, "m", "-35.7 µm"),
            (0.0, "N", "0 N"),
            (108.8, "N/m", "108.8 N/m"),
            (999.99, "N", "1000 N"),
            (7_352_941.0, "1/m", "7.353 M1/m"),
        ] {
            assert_eq!(quantity(value, unit), expected);
        }
        assert_eq!(
            [7, 2000, 5_840_000].map(count),
            ["7", "2000", "5\u{a0}840\u{a0}000"]
        );
        assert_eq!(significant(7_352_941.0), "7352941");
        assert_eq!(significant(1e-7), "1·10⁻⁷");
        assert_eq!(significant(120.0), "120");
        assert_eq!(power_of_ten(7.4e6), "7.4·10⁶");
    }

    #[test]
    fn quantities_are_in_the_units_that_were_typed() {
        let metric = Shown::new(Units::default(), 2.5);
        let lengths = [0.9, 1500.0, 0.05].map(|metres| metric.length(metres));
        assert_eq!(lengths, ["0.9 m", "1500 m", "50 mm"]);
        assert_eq!(metric.depths(0.0, 0.05), "0 to 0.05 m");
        assert_eq!(metric.load(8.01e6), "8.01 MN");
        assert_eq!(metric.stiffness(3e6), "3000 kN/m");
        assert_eq!(metric.moduli(Modulus::Uniform(3e9)), "3000 MPa");
        assert_eq!(metric.movement(1.23456e-3), "1.235 mm");
        assert_eq!(metric.movement(822.115), "> 2500 mm");
        let numbers = [0.0, 0.04, 12.34, 4627.44, -52_119.5].map(|newtons| metric.force_number(newtons));
        assert_eq!(numbers, ["0", "0", "12.3", "4627", "-52120"]);
        assert_eq!(metric.in_length("place"), "place, m");

        let text = "[duct]\nlength = \"98 ft\"\n[cable]\nweight = \"7 lbf/ft\"\n[ends]\ndownstream = { spring = \"2 kip/in\" }\n\
                    [[ground.layers]]\nyoung_modulus = \"1e5 psi\"";
        let file = crate::SceneFile::from_toml("scene", text).expect("a file");
        let imperial = Shown::new(Units::typed(&file, None, None), 2.5);
        // 1 ft = 12 in = 0.3048 m, 1 kip = 4448.2216 N, 1 psi = 1 lbf/in².
        let lengths = [0.0, 0.0254, 0.3048, 30.48].map(|metres| imperial.length(metres));
        assert_eq!(lengths, ["0 ft", "1 in", "1 ft", "100 ft"]);
        assert_eq!(imperial.depths(0.0, 0.1016), "0 to 4 in");
        assert_eq!(imperial.depths(0.1016, 0.6096), "4 in to 2 ft");
        assert_eq!(imperial.load(8.01e6), "1801 kip");
        assert_eq!(imperial.force(-444.822), "-0.1000 kip");
        assert_eq!(imperial.stiffness(350_253.67), "2 kip/in");
        assert_eq!(imperial.weight(102.156), "7 lbf/ft");
        let linear = Modulus::Linear {
            top: 6_894_757.0,
            bottom: 13_789_514.0,
        };
        assert_eq!(imperial.moduli(linear), "1000 to 2000 psi");
        assert_eq!(imperial.movement(0.0254), "1.000 in");
        assert_eq!(imperial.in_movement("movement"), "movement, in");
    }
}
