//! What a column holds, by its name in the header.

use crate::CableEnd;
use crate::scene::Dimension;

/// Words for the number of the pass, in the languages of Europe's spreadsheets and Japanese; the first is this program's own.
const PASS: &[&str] = &[
    "pass",
    "passes",
    "passage",
    "passages",
    "cycle",
    "cycles",
    "überfahrt",
    "überfahrten",
    "ueberfahrt",
    "ueberfahrten",
    "passaggio",
    "passaggi",
    "pasada",
    "pasadas",
    "overgang",
    "通過回数",
];
const VEHICLES: &[&str] = &[
    "vehicles",
    "vehicle",
    "trucks",
    "count",
    "counts",
    "fahrzeuge",
    "anzahl",
    "véhicules",
    "vehicules",
    "veicoli",
    "vehículos",
    "台数",
];
const FORCE: &[&str] = &[
    "force", "load", "thrust", "kraft", "last", "effort", "forza", "carico", "fuerza", "carga", "kracht",
    "荷重", "軸力",
];
const SIGMA: &[&str] = &["sigma", "uncertainty", "std", "sd", "unsicherheit"];
const RUN: &[&str] = &[
    "run", "runs", "series", "test", "versuch", "lauf", "essai", "prova", "ensayo",
];
const MOVEMENT: &[&str] = &[
    "movement",
    "displacement",
    "verschiebung",
    "déplacement",
    "spostamento",
    "desplazamiento",
    "変位",
];
const POSITION: &[&str] = &["position", "place", "ort", "x"];
const STRAIN: &[&str] = &["strain", "dehnung", "déformation", "deformazione", "ひずみ"];
const DEFLECTION: &[&str] = &["deflection", "settlement", "setzung", "durchbiegung", "たわみ"];
const TIME: &[&str] = &[
    "time",
    "timestamp",
    "date",
    "datetime",
    "zeit",
    "zeitstempel",
    "datum",
    "temps",
    "heure",
    "data",
    "ora",
    "fecha",
    "日時",
];
const UPSTREAM: &[&str] = &["upstream", "up", "start"];
const DOWNSTREAM: &[&str] = &["downstream", "down", "end"];
/// A column of these is not the value after a pass.
const NOT_AFTER: &[&str] = &["peak", "max", "min", "maximum", "minimum"];

/// What a column may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
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

const ROLES: [(Role, &[&str]); 10] = [
    (Role::Sigma, SIGMA),
    (Role::Force, FORCE),
    (Role::Movement, MOVEMENT),
    (Role::Strain, STRAIN),
    (Role::Deflection, DEFLECTION),
    (Role::Pass, PASS),
    (Role::Vehicles, VEHICLES),
    (Role::Run, RUN),
    (Role::Time, TIME),
    (Role::Position, POSITION),
];

/// A column's name taken apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Name {
    /// As the file has it.
    pub text: String,
    words: Vec<String>,
    /// As written: in brackets, after a slash, "in", or as the last word.
    pub unit: Option<String>,
}

impl Name {
    pub fn of(text: &str) -> Self {
        let (rest, mut unit) = bracketed(text);
        let mut words: Vec<String> = rest
            .split(|c: char| !c.is_alphanumeric())
            .filter(|word| !word.is_empty())
            .map(str::to_lowercase)
            .collect();
        if unit.is_none()
            && words.len() > 1
            && let Some(known) = words.last().and_then(|last| by_word(last))
        {
            words.pop();
            unit = Some(known.to_owned());
            if words.last().is_some_and(|word| word == "in") {
                words.pop();
            }
        }
        Self {
            text: text.to_owned(),
            words,
            unit,
        }
    }

    fn has(&self, list: &[&str]) -> bool {
        self.words.iter().any(|word| list.contains(&&**word))
    }

    /// What the name says that the column holds.
    pub fn role(&self) -> Option<Role> {
        if self.has(NOT_AFTER) {
            return None;
        }
        let found = ROLES.iter().find(|(_, words)| self.has(words));
        found.map(|(role, _)| *role)
    }

    /// Whether the name is the word of `role` that this program uses itself, and nothing else.
    pub fn is_own(&self, role: Role) -> bool {
        let own = ROLES
            .iter()
            .find(|(other, _)| *other == role)
            .map(|(_, words)| words[0]);
        matches!(&self.words[..], [only] if Some(&**only) == own)
    }

    pub fn end(&self) -> Option<CableEnd> {
        match (self.has(UPSTREAM), self.has(DOWNSTREAM)) {
            (true, false) => Some(CableEnd::Upstream),
            (false, true) => Some(CableEnd::Downstream),
            _ => None,
        }
    }
}

/// The name without the unit that stands in brackets or after a slash, and that unit.
fn bracketed(text: &str) -> (String, Option<String>) {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((before, rest)) = text.split_once(open)
            && let Some((unit, after)) = rest.split_once(close)
        {
            return (format!("{before} {after}"), Some(unit.trim().to_owned()));
        }
    }
    match text.rsplit_once('/') {
        Some((before, unit))
            if factor(Dimension::Force, unit)
                .or(factor(Dimension::Length, unit))
                .is_some() =>
        {
            (before.to_owned(), Some(unit.trim().to_owned()))
        }
        _ => (text.to_owned(), None),
    }
}

/// The unit that the last word of a name is, whatever its case: `force_kn`.
fn by_word(word: &str) -> Option<&'static str> {
    let mut units = Dimension::Force
        .units()
        .chain(Dimension::Length.units())
        .chain(["daN"]);
    units.find(|unit| unit.eq_ignore_ascii_case(word))
}

/// SI value of 1 of the unit.
pub fn factor(dimension: Dimension, unit: &str) -> Option<f64> {
    match (dimension, unit.trim()) {
        (Dimension::Force, "daN") => Some(10.0),
        (Dimension::Force, "kp") => factor(dimension, "kgf"),
        (_, unit) => {
            let known = dimension.units().find(|known| {
                // mN is not MN.
                known.eq_ignore_ascii_case(unit) && !known.starts_with('M')
            });
            dimension.parse(&format!("1 {}", known.unwrap_or(unit))).ok()
        }
    }
}

/// SI value of 1 of a unit of strain.
pub fn strain_factor(unit: &str) -> Option<f64> {
    match unit.replace(['µ', 'μ'], "u").trim() {
        "" | "-" | "1" | "m/m" => Some(1.0),
        "%" => Some(1e-2),
        "mm/m" | "‰" => Some(1e-3),
        "um/m" | "ustrain" | "ue" | "1e-6" | "10^-6" => Some(1e-6),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_what_a_column_holds() {
        for (text, role, unit) in [
            ("pass", Some(Role::Pass), None),
            ("Überfahrt", Some(Role::Pass), None),
            ("Pass number", Some(Role::Pass), None),
            ("force_n", Some(Role::Force), Some("N")),
            ("force_kn", Some(Role::Force), Some("kN")),
            ("Kraft [kN]", Some(Role::Force), Some("kN")),
            ("Kraft in kN", Some(Role::Force), Some("kN")),
            ("Load cell (lbf)", Some(Role::Force), Some("lbf")),
            ("F/kN", None, Some("kN")),
            ("sigma_n", Some(Role::Sigma), Some("N")),
            ("force sigma", Some(Role::Sigma), None),
            ("movement_m", Some(Role::Movement), Some("m")),
            ("Strain [µm/m]", Some(Role::Strain), Some("µm/m")),
            ("Peak force", None, None),
            ("vehicles", Some(Role::Vehicles), None),
            ("operator", None, None),
        ] {
            let name = Name::of(text);
            assert_eq!((name.role(), name.unit.as_deref()), (role, unit), "{text}");
        }
        assert_eq!(Name::of("Force upstream [N]").end(), Some(CableEnd::Upstream));
        assert_eq!(Name::of("downstream_force_n").end(), Some(CableEnd::Downstream));
        assert!(Name::of("force_n").is_own(Role::Force) && !Name::of("Kraft [N]").is_own(Role::Force));
    }

    #[test]
    fn units_are_told_apart() {
        let force = |unit| factor(Dimension::Force, unit);
        assert_eq!(force("kn"), Some(1e3));
        assert_eq!(force("MN"), Some(1e6));
        assert_eq!((force("mN"), force("mV")), (None, None));
        assert_eq!((force("daN"), force("kp")), (Some(10.0), Some(9.80665)));
        assert_eq!((strain_factor("µm/m"), strain_factor("V")), (Some(1e-6), None));
    }
}
