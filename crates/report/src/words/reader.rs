//! Quantities in the units of a reader: those that were typed, four digits, a prefix.

use ground_field::Modulus;

use super::number::{quantity, significant};
use creepage_plan::shown::rounded;
use creepage_run::{Limited, Units, answer::largest_movement_in_duct};
use creepage_scene::{Scene, Unit};

/// Last digits of forces \[N\] and movements \[m\], if four are not fewer.
const FORCE_DIGIT: f64 = 0.1;
const MOVEMENT_DIGIT: f64 = 1e-7;
/// Shortest length that is said in m \[m\].
const SHORT: f64 = 0.1;

/// How quantities are written for one reader: the same number is the same text on the terminal, on the page and in a workbook.
#[derive(Debug, Clone, Copy)]
pub struct Reader {
    /// The units that were typed, in which tables and charts are.
    pub units: Units,
    /// The largest movement of an end \[m\] that means more than that the cable leaves the duct.
    pub most: f64,
}

impl Reader {
    /// The reader of what `scene` answers.
    pub fn new(units: Units, scene: &Scene) -> Self {
        Self {
            units: units.for_springs(),
            most: largest_movement_in_duct(scene),
        }
    }

    /// A force \[N\] or movement \[m\] with its unit: "551.2 N", "0.0520 mm".
    pub fn amount(&self, quantity: Limited, value: f64) -> String {
        let unit = self.unit(quantity).symbol();
        format!("{} {unit}", self.number(quantity, value))
    }

    /// The same without its unit; of a movement with which the cable leaves the duct, only that it does: "> 2500".
    pub fn number(&self, quantity: Limited, value: f64) -> String {
        let most = quantity.of([f64::INFINITY, self.most]);
        let beyond = match value {
            _ if value > most => "> ",
            _ if value < -most => "< ",
            _ => "",
        };
        let digit = quantity.of([FORCE_DIGIT, MOVEMENT_DIGIT]);
        beyond.to_owned() + &four_digits(value.clamp(-most, most), self.unit(quantity), digit)
    }

    /// The unit of a force or a movement.
    pub fn unit(&self, quantity: Limited) -> Unit {
        quantity.of([self.units.force, self.units.movement])
    }

    /// What a column or an axis holds: "force, N".
    pub fn head(&self, what: &str, quantity: Limited) -> String {
        format!("{what}, {}", self.unit(quantity).symbol())
    }

    /// A force \[N\] with its unit.
    pub fn force(&self, newtons: f64) -> String {
        self.amount(Limited::Force, newtons)
    }

    /// A movement \[m\] with its unit.
    pub fn movement(&self, metres: f64) -> String {
        self.amount(Limited::Movement, metres)
    }

    /// What an axis of places holds: "place along the duct, m".
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

    /// Depths from the first to the second, of which many stand below each other: "0 to 0.05 m", "4 in to 1 ft".
    pub fn depths(&self, from: f64, to: f64) -> String {
        let [from, to] = [from, to].map(|depth| self.depth(depth));
        match (from.split_once(' '), to.split_once(' ')) {
            (Some((number, unit)), Some((_, same))) if unit == same || number == "0" => {
                format!("{number} to {to}")
            }
            _ => format!("{from} to {to}"),
        }
    }

    /// One of them: "0.05 m"; feet also have inches.
    pub fn depth(&self, metres: f64) -> String {
        if self.units.length == Unit::METRE {
            stated(metres, Unit::METRE)
        } else {
            self.length(metres)
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
    let size = creepage_scene::four_digits(value).abs().log10().floor();
    let decimals = (3.0 - size).clamp(0.0, finest);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn reader(units: Units) -> Reader {
        let units = units.for_springs();
        Reader { units, most: 2.5 }
    }

    #[test]
    fn quantities_are_in_the_units_that_were_typed() {
        let metric = reader(Units::default());
        let lengths = [0.9, 1500.0, 0.05].map(|metres| metric.length(metres));
        assert_eq!(lengths, ["0.9 m", "1500 m", "50 mm"]);
        assert_eq!(metric.depths(0.0, 0.05), "0 to 0.05 m");
        assert_eq!(metric.load(8.01e6), "8.01 MN");
        assert_eq!(metric.stiffness(3e6), "3000 kN/m");
        assert_eq!(metric.moduli(Modulus::Uniform(3e9)), "3000 MPa");
        assert_eq!(metric.movement(1.23456e-3), "1.235 mm");
        assert_eq!(metric.movement(822.115), "> 2500 mm");
        let numbers =
            [0.0, 0.04, 12.34, 4627.44, -52_119.5].map(|newtons| metric.number(Limited::Force, newtons));
        assert_eq!(numbers, ["0", "0", "12.3", "4627", "-52120"]);
        assert_eq!(metric.in_length("place"), "place, m");

        let text = "[duct]\nlength = \"98 ft\"\n[cable]\nweight = \"7 lbf/ft\"\n[ends]\ndownstream = { spring = \"2 kip/in\" }\n\
                    [[ground.layers]]\nyoung_modulus = \"1e5 psi\"";
        let file = creepage_scene::SceneFile::from_toml("scene", text).expect("a file");
        let imperial = reader(Units::typed(&file, None, None));
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
        assert_eq!(imperial.head("movement", Limited::Movement), "movement, in");
    }
}
