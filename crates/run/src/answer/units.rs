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
        Self::of(Unit::NEWTON, [Unit::MILLIMETRE, Unit::METRE])
    }
}

impl Units {
    /// Those that go with this unit of force and these of movement and length.
    fn of(force: Unit, [movement, length]: [Unit; 2]) -> Self {
        Self {
            force,
            movement,
            stiffness: force.per_length().unwrap_or(Unit::NEWTON_PER_METRE),
            length,
            weight: Unit::NEWTON_PER_METRE,
            modulus: Unit::MEGAPASCAL,
        }
    }

    /// Those that were typed in the scene and in limits of force and movement.
    pub fn typed(file: &SceneFile, limit_force: Option<Unit>, limit_movement: Option<Unit>) -> Self {
        let typed = file.typed();
        let first = |sections: &[&str], dimension| {
            let is_there = |key: &str| sections.iter().any(|section| key.starts_with(section));
            let keys = typed.iter().map(|typed| &typed.key);
            keys.filter(|key| is_there(key))
                .find_map(|key| file.typed_unit(key, dimension))
        };
        let spring = first(&["ends.", "restraints."], Dimension::ForcePerLength);
        let weight = file.typed_unit("cable.weight", Dimension::ForcePerLength);
        let suits = |force: &Unit| SUITABLE.contains(&force.symbol());
        let of_scene = spring.or(weight).and_then(|unit| unit.force()).filter(suits);
        let length = file.typed_unit("duct.length", Dimension::Length);
        let in_feet = length.is_some_and(|unit| ["ft", "in", "yd", "mi"].contains(&unit.symbol()));
        let lengths = if in_feet {
            [Unit::INCH, Unit::FOOT]
        } else {
            [Unit::MILLIMETRE, Unit::METRE]
        };
        let default = Self::of(limit_force.or(of_scene).unwrap_or(Unit::NEWTON), lengths);
        let modulus = first(&["ground."], Dimension::Pressure);
        let modulus = modulus.filter(|unit| !TOO_SMALL.contains(&unit.symbol()));
        Self {
            movement: limit_movement.unwrap_or(default.movement),
            stiffness: spring.unwrap_or(default.stiffness),
            weight: weight.unwrap_or(default.weight),
            modulus: modulus.unwrap_or(default.modulus),
            ..default
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

    /// The name of a field of an answer without the unit at its end, and the unit in which it is
    /// shown: `downstream_force_n` is `downstream_force` in N or kip. None if the name has no
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
    let (ends, units) = (["_n_per_m", "_n", "_m", "_j", "_k"], ["N/m", "N", "m", "J", "K"]);
    let mut units = ends.iter().zip(units);
    units.find_map(|(end, unit)| Some((field.strip_suffix(end)?, unit)))
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
    use crate::Limited;

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
            let [force, movement] = [Limited::Force, Limited::Movement];
            (
                force.number_in(&units, 1234.56),
                movement.number_in(&units, -0.001_234_56),
            )
        };
        let pair = |force: &str, movement: &str| (force.to_owned(), movement.to_owned());
        assert_eq!(shown("N", "mm"), pair("1234.6", "-1.2346"));
        assert_eq!(shown("kN", "cm"), pair("1.2346", "-0.12346"));
        // 1 lbf = 4.4482216 N, 1 in = 25.4 mm.
        assert_eq!(shown("lbf", "in"), pair("277.54", "-0.04860"));
        assert_eq!(shown("kip", "um"), pair("0.27754", "-1234.6"));
        let units = Units::default();
        assert_eq!(Limited::Movement.number_in(&units, 521.195_086_7), "521195");
        assert_eq!(Limited::Force.number_in(&units, -10_234.56), "-10235");
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
