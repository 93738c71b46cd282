//! What a column holds, by its name in the header, and in which units.

use creepage_tables::Name;

use super::reading::{Measured, Place};
use crate::CableEnd;
use crate::scene::Dimension;

/// What a column may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    Pass,
    Vehicles,
    Run,
    Time,
    Position,
    Sigma,
    Force,
    Movement,
    Strain,
    Deflection,
}

/// Words for each, in the languages of Europe's spreadsheets and Japanese; the first is this program's own. What stands first counts first.
const WORDS: [(Role, &str); 10] = [
    (Role::Sigma, "sigma uncertainty std sd unsicherheit"),
    (
        Role::Force,
        "force load thrust kraft last effort forza carico fuerza carga kracht 荷重 軸力",
    ),
    (
        Role::Movement,
        "movement displacement verschiebung déplacement spostamento desplazamiento 変位",
    ),
    (Role::Strain, "strain dehnung déformation deformazione ひずみ"),
    (
        Role::Deflection,
        "deflection settlement setzung durchbiegung たわみ",
    ),
    (
        Role::Pass,
        "pass passes passage passages cycle cycles überfahrt überfahrten ueberfahrt ueberfahrten passaggio passaggi pasada pasadas \
         overgang 通過回数",
    ),
    (
        Role::Vehicles,
        "vehicles vehicle trucks count counts fahrzeuge anzahl véhicules vehicules veicoli vehículos 台数",
    ),
    (Role::Run, "run runs series versuch lauf essai prova ensayo"),
    (
        Role::Time,
        "time timestamp date datetime zeit zeitstempel datum temps heure data ora fecha 日時",
    ),
    (
        Role::Position,
        "position place ort posizione posición posicion 位置",
    ),
];
const ENDS: [(CableEnd, &[&str]); 2] = [
    (CableEnd::Upstream, &["upstream", "up", "start"]),
    (CableEnd::Downstream, &["downstream", "down", "end"]),
];
/// A column of these is not the value after a pass.
const NOT_AFTER: &[&str] = &["peak", "max", "min", "maximum", "minimum"];

/// What the name says that the column holds.
pub fn role(name: &Name) -> Option<Role> {
    if name.has(NOT_AFTER) {
        return None;
    }
    let holds = |words: &str| {
        words
            .split(' ')
            .any(|word| name.words.iter().any(|own| own == word))
    };
    WORDS
        .iter()
        .find(|(_, words)| holds(words))
        .map(|(role, _)| *role)
}

/// Whether the name is the word of `role` that this program uses itself, and nothing else.
pub fn is_own(name: &Name, role: Role) -> bool {
    let own = WORDS.iter().find(|(other, _)| *other == role);
    let own = own.and_then(|(_, words)| words.split(' ').next());
    matches!(&name.words[..], [only] if Some(&**only) == own)
}

/// The end that the name says.
pub fn end(name: &Name) -> Option<CableEnd> {
    let mut said = ENDS
        .iter()
        .filter(|(_, words)| name.has(words))
        .map(|(end, _)| *end);
    said.next().filter(|_| said.next().is_none())
}

impl Role {
    /// What a column of this role measures at a place.
    pub fn measured(self, at: Place) -> Measured {
        match self {
            Self::Movement => Measured::Movement(at),
            Self::Strain => Measured::Strain(at),
            Self::Deflection => Measured::Deflection,
            _ => Measured::Force(at),
        }
    }

    /// SI value of 1 of a unit in a column of this role.
    pub fn factor(self, written: &str) -> Option<f64> {
        let written = written.trim();
        let dimension = match self {
            Self::Strain => {
                return match &*written.replace(['µ', 'μ'], "u") {
                    "" | "-" | "1" | "m/m" => Some(1.0),
                    "%" => Some(1e-2),
                    "mm/m" | "‰" => Some(1e-3),
                    "um/m" | "ustrain" | "ue" | "1e-6" | "10^-6" => Some(1e-6),
                    _ => None,
                };
            }
            Self::Movement | Self::Deflection | Self::Position => Dimension::Length,
            _ => Dimension::Force,
        };
        match (dimension, Dimension::unit_by_word(written).unwrap_or(written)) {
            (Dimension::Force, "daN") => Some(10.0),
            (Dimension::Force, "mN") => Some(1e-3),
            (Dimension::Force, "kp") => dimension.parse("1 kgf").ok(),
            (_, unit) => dimension.parse(&format!("1 {unit}")).ok(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(word: &str) -> Option<&'static str> {
        Dimension::unit_by_word(word)
    }

    #[test]
    fn names_say_what_a_column_holds() {
        for (text, expected, in_unit) in [
            ("pass", Some(Role::Pass), None),
            ("Überfahrt", Some(Role::Pass), None),
            ("Pass number", Some(Role::Pass), None),
            ("force_n", Some(Role::Force), Some("N")),
            ("force_kn", Some(Role::Force), Some("kN")),
            ("Force mN", Some(Role::Force), Some("mN")),
            ("Kraft [kN]", Some(Role::Force), Some("kN")),
            ("Kraft in kN", Some(Role::Force), Some("kN")),
            ("Load cell (lbf)", Some(Role::Force), Some("lbf")),
            ("F/kN", None, Some("kN")),
            ("sigma_n", Some(Role::Sigma), Some("N")),
            ("force sigma", Some(Role::Sigma), None),
            ("movement_m", Some(Role::Movement), Some("m")),
            ("Strain [µm/m]", Some(Role::Strain), Some("µm/m")),
            ("Test Time (s)", Some(Role::Time), Some("s")),
            ("Peak force", None, None),
            ("vehicles", Some(Role::Vehicles), None),
            ("X_Value", None, None),
            ("operator", None, None),
        ] {
            let name = Name::of(text, unit);
            assert_eq!((role(&name), name.unit.as_deref()), (expected, in_unit), "{text}");
        }
        assert_eq!(
            end(&Name::of("Force upstream [N]", unit)),
            Some(CableEnd::Upstream)
        );
        assert_eq!(
            end(&Name::of("downstream_force_n", unit)),
            Some(CableEnd::Downstream)
        );
        assert!(
            is_own(&Name::of("force_n", unit), Role::Force)
                && !is_own(&Name::of("Kraft [N]", unit), Role::Force)
        );
    }

    #[test]
    fn units_are_told_apart() {
        let force = |unit| Role::Force.factor(unit);
        assert_eq!(
            (force("kn"), force("MN"), force("mN"), force("mV")),
            (Some(1e3), Some(1e6), Some(1e-3), None)
        );
        assert_eq!((force("daN"), force("kp")), (Some(10.0), Some(9.80665)));
        assert_eq!(
            (Role::Strain.factor("µm/m"), Role::Strain.factor("V")),
            (Some(1e-6), None)
        );
        assert_eq!(Role::Position.factor("mm"), Some(1e-3));
    }
}
