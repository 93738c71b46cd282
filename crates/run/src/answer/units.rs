//! The units in which answers are shown to a reader. What other programs read stays SI.

use creepage_plan::shown::rounded;
use creepage_scene::{Dimension, SceneFile, Unit};

/// The last digit that is shown of a force \[N\] and of a movement \[m\].
pub(super) const FORCE_DIGIT: f64 = 0.1;
pub(super) const MOVEMENT_DIGIT: f64 = 1e-7;
/// Digits that are shown behind the first one of a large value.
const DIGITS: f64 = 4.0;
/// Units of stiffness whose force suits the ends of a cable. Springs are stiff: the MN of "3 MN/m"
/// does not.
const SUITABLE: [&str; 5] = ["kN", "kgf", "tf", "lbf", "kip"];
/// Units of moduli that do not suit: those of the ground have too many digits in them.
const TOO_SMALL: [&str; 2] = ["Pa", "N/m2"];

/// The units in which a reader gets forces, movements, lengths and the like: those that were typed,
/// where they suit.
///
/// - Forces: the unit of a limit of force; else that in the first unit of an end spring, a clamp or
///   the cable's weight, if that is kN, kgf, tf, lbf or kip; else N.
/// - Movements: the unit of a limit of movement; else inches where the duct's length is typed in
///   ft, in, yd or mi; else mm.
/// - Stiffnesses: the unit of an end spring or a clamp; else the one that goes with the force.
/// - Lengths along the duct: ft where the duct's length is typed in ft, in, yd or mi; else m.
/// - Weight and friction per length: the unit of the cable's weight; else N/m.
/// - Moduli: the first unit of a modulus of the ground, if it is not Pa; else MPa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Of forces.
    pub force: Unit,
    /// Of movements of the cable.
    pub movement: Unit,
    /// Of stiffnesses.
    pub stiffness: Unit,
    /// Of lengths along the duct.
    pub length: Unit,
    /// Of the cable's weight and of friction on it, per length.
    pub weight: Unit,
    /// Of moduli of the ground.
    pub modulus: Unit,
}

impl Default for Units {
    fn default() -> Self {
        Self {
            force: Unit::NEWTON,
            movement: Unit::MILLIMETRE,
            stiffness: Unit::NEWTON_PER_METRE,
            length: Unit::METRE,
            weight: Unit::NEWTON_PER_METRE,
            modulus: Unit::MEGAPASCAL,
        }
    }
}

impl Units {
    /// Those that were typed in the scene and in limits of force and movement.
    pub fn typed(file: &SceneFile, limit_force: Option<Unit>, limit_movement: Option<Unit>) -> Self {
        let stiffness = |key: &str| file.typed_unit(key, Dimension::ForcePerLength);
        let holds = |key: &str| key.starts_with("ends.") || key.starts_with("restraints.");
        let typed = file.typed();
        let spring = typed
            .iter()
            .filter(|typed| holds(&typed.key))
            .find_map(|typed| stiffness(&typed.key));
        let suits = |force: &Unit| SUITABLE.contains(&force.symbol());
        let weight = stiffness("cable.weight");
        let of_scene = spring.or(weight).and_then(|unit| unit.force()).filter(suits);
        let force = limit_force.or(of_scene).unwrap_or(Unit::NEWTON);
        let modulus = typed
            .iter()
            .filter(|typed| typed.key.starts_with("ground."))
            .find_map(|typed| file.typed_unit(&typed.key, Dimension::Pressure));
        let length = file.typed_unit("duct.length", Dimension::Length);
        let in_feet = length.is_some_and(|unit| ["ft", "in", "yd", "mi"].contains(&unit.symbol()));
        let [length, movement] = if in_feet {
            [Unit::FOOT, Unit::INCH]
        } else {
            [Unit::METRE, Unit::MILLIMETRE]
        };
        Self {
            force,
            movement: limit_movement.unwrap_or(movement),
            stiffness: spring.or(force.per_length()).unwrap_or(Unit::NEWTON_PER_METRE),
            length,
            weight: weight.unwrap_or(Unit::NEWTON_PER_METRE),
            modulus: modulus
                .filter(|unit| !TOO_SMALL.contains(&unit.symbol()))
                .unwrap_or(Unit::MEGAPASCAL),
        }
    }

    /// The same with stiffnesses in kN/m where they would be in N/m: springs are stiff.
    #[must_use]
    pub fn for_springs(mut self) -> Self {
        if self.stiffness == Unit::NEWTON_PER_METRE {
            self.stiffness = Unit::KILONEWTON_PER_METRE;
        }
        self
    }

    /// A force \[N\] in its unit, as many digits as 0.1 N needs.
    pub fn force(&self, newtons: f64) -> String {
        in_unit(newtons, self.force, FORCE_DIGIT)
    }

    /// A movement \[m\] in its unit, as many digits as 0.1 µm needs.
    pub fn movement(&self, metres: f64) -> String {
        in_unit(metres, self.movement, MOVEMENT_DIGIT)
    }

    /// The name of a field of an answer without the unit at its end, and the unit in which it is
    /// shown: `downstream_force_n` is `downstream_force` in N or kip. None where the name has no
    /// unit.
    pub fn of_field<'f>(&self, field: &'f str) -> Option<(&'f str, Unit)> {
        let (name, si) = si_of_field(field)?;
        let moves = ["displacement", "drift"].iter().any(|word| name.contains(word));
        let unit = match si {
            "N" => self.force,
            "N/m" => self.stiffness,
            "m" if moves => self.movement,
            // The duct's.
            "m" if name.starts_with("peak_") => Unit::MICROMETRE,
            "m" => self.length,
            _ => return None,
        };
        Some((name, unit))
    }
}

/// The name of a field of an answer without the unit at its end, and that unit:
/// `downstream_force_n` and N.
pub fn si_of_field(field: &str) -> Option<(&str, &'static str)> {
    let ends = [
        ("_n_per_m", "N/m"),
        ("_n", "N"),
        ("_m", "m"),
        ("_j", "J"),
        ("_k", "K"),
    ];
    ends.into_iter()
        .find_map(|(end, unit)| Some((field.strip_suffix(end)?, unit)))
}

/// A value in SI in a unit, rounded to the decimal that is nearest to `digit`, in SI; of large
/// values to fewer decimals.
pub fn in_unit(si: f64, unit: Unit, digit: f64) -> String {
    let value = unit.of_si(si);
    let decimals = -unit.of_si(digit).log10().round();
    let enough = DIGITS - value.abs().log10().floor();
    rounded(value, decimals.min(enough).max(0.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn units(scene: &str, limit_force: &str, limit_movement: &str) -> [&'static str; 4] {
        let file = SceneFile::from_toml("scene", scene).expect("a file");
        let limit = Unit::of(Dimension::Force, limit_force);
        let units = Units::typed(&file, limit, Unit::of(Dimension::Length, limit_movement));
        [units.force, units.movement, units.stiffness, units.length].map(|unit| unit.symbol())
    }

    #[test]
    fn units_are_those_that_were_typed_where_they_suit() {
        let spring = |unit: &str| format!("ends = {{ downstream = {{ spring = \"3 {unit}\" }} }}");
        assert_eq!(units("", "", ""), ["N", "mm", "N/m", "m"]);
        assert_eq!(units(&spring("MN/m"), "", ""), ["N", "mm", "MN/m", "m"]);
        assert_eq!(units(&spring("kN/m"), "", ""), ["kN", "mm", "kN/m", "m"]);
        assert_eq!(
            units(&spring("kip/in"), "lbf", "um"),
            ["lbf", "µm", "kip/in", "m"]
        );
        assert_eq!(units("", "kN", "cm"), ["kN", "cm", "kN/m", "m"]);
        let feet = "[duct]\nlength = \"98 ft\"\n[cable]\nweight = \"7 lbf/ft\"";
        assert_eq!(units(feet, "", ""), ["lbf", "in", "lbf/ft", "ft"]);
        let clamp = "[[restraints]]\nstiffness = 5\n[[restraints]]\nstiffness = \"2 tf/m\"";
        assert_eq!(units(clamp, "", ""), ["tf", "mm", "tf/m", "m"]);
        // A load says nothing of forces in a cable.
        assert_eq!(
            units("[[vehicles]]\nload = \"20 tf\"", "", ""),
            ["N", "mm", "N/m", "m"]
        );
    }

    #[test]
    fn weights_and_moduli_have_their_own_units() {
        let of = |scene: &str| {
            let file = SceneFile::from_toml("scene", scene).expect("a file");
            let units = Units::typed(&file, None, None);
            [units.weight, units.modulus].map(|unit| unit.symbol())
        };
        let layers = |modulus: &str| {
            format!("[cable]\nweight = \"7 lbf/ft\"\n[[ground.layers]]\nyoung_modulus = \"{modulus}\"")
        };
        assert_eq!(of(""), ["N/m", "MPa"]);
        assert_eq!(of(&layers("1e5 psi")), ["lbf/ft", "psi"]);
        assert_eq!(of(&layers("8e8 Pa")), ["lbf/ft", "MPa"]);
    }

    #[test]
    fn values_have_the_digits_of_their_unit() {
        let shown = |force, movement| {
            let units = Units {
                force: Unit::of(Dimension::Force, force).expect("a unit"),
                movement: Unit::of(Dimension::Length, movement).expect("a unit"),
                ..Units::default()
            };
            (units.force(1234.56), units.movement(-0.001_234_56))
        };
        let pair = |force: &str, movement: &str| (force.to_owned(), movement.to_owned());
        assert_eq!(shown("N", "mm"), pair("1234.6", "-1.2346"));
        assert_eq!(shown("kN", "cm"), pair("1.2346", "-0.12346"));
        // 1 lbf = 4.4482216 N, 1 in = 25.4 mm.
        assert_eq!(shown("lbf", "in"), pair("277.54", "-0.04860"));
        assert_eq!(shown("kip", "um"), pair("0.27754", "-1234.6"));
        assert_eq!(Units::default().movement(521.195_086_7), "521195");
        assert_eq!(Units::default().force(-10_234.56), "-10235");
    }

    #[test]
    fn fields_carry_their_unit_in_their_name() {
        let units = Units::default();
        let of = |field| units.of_field(field).map(|(name, unit)| (name, unit.symbol()));
        assert_eq!(of("downstream_force_n"), Some(("downstream_force", "N")));
        assert_eq!(
            of("upstream_displacement_max_m"),
            Some(("upstream_displacement_max", "mm"))
        );
        assert_eq!(of("drift_per_day_m"), Some(("drift_per_day", "mm")));
        assert_eq!(of("peak_vertical_m"), Some(("peak_vertical", "µm")));
        assert_eq!(of("stiffness_n_per_m"), Some(("stiffness", "N/m")));
        assert_eq!(of("node_spacing_m"), Some(("node_spacing", "m")));
        assert_eq!(of("pass"), None);
    }
}
