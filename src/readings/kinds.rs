//! What a column holds, by its name in the header, and in which units.

use creepage_tables::{Kind, Name, Names};

use super::reading::{Measured, Place};
use crate::CableEnd;
use crate::scene::Dimension;

/// Not the value after a pass.
const EXTREME: Kind = Kind("peak max min maximum minimum");
pub const SIGMA: Kind = Kind("sigma uncertainty std sd unsicherheit");
pub const FORCE: Kind =
    Kind("force load thrust kraft last effort forza carico fuerza carga kracht 荷重 軸力");
pub const MOVEMENT: Kind =
    Kind("movement displacement verschiebung déplacement spostamento desplazamiento 変位");
const STRAIN: Kind = Kind("strain dehnung déformation deformazione ひずみ");
pub const DEFLECTION: Kind = Kind("deflection settlement setzung durchbiegung たわみ");
pub const PASS: Kind = Kind(
    "pass passes passage passages cycle cycles überfahrt überfahrten ueberfahrt ueberfahrten passaggio passaggi pasada pasadas \
     overgang 通過回数",
);
pub const VEHICLES: Kind =
    Kind("vehicles vehicle trucks count counts fahrzeuge anzahl véhicules vehicules veicoli vehículos 台数");
pub const RUN: Kind = Kind("run runs series versuch lauf essai prova ensayo");
pub const TIME: Kind =
    Kind("time timestamp date datetime zeit zeitstempel datum temps heure data ora fecha 日時");
pub const POSITION: Kind = Kind("position place ort posizione posición posicion 位置");
pub const MEASURED: [Kind; 4] = [FORCE, MOVEMENT, STRAIN, DEFLECTION];
const ENDS: [(CableEnd, Kind); 2] = [
    (CableEnd::Upstream, Kind("upstream up start")),
    (CableEnd::Downstream, Kind("downstream down end")),
];

pub const ALLOWED: &str = "a header `pass,force_n` or `pass,force_n,sigma_n`, names such as `Force [kN]`, or names chosen by --column-pass, \
                           --column-vehicles, --column-force";

/// The names of a table of readings.
pub const NAMES: Names = Names {
    kinds: &[
        EXTREME, SIGMA, FORCE, MOVEMENT, STRAIN, DEFLECTION, PASS, VEHICLES, RUN, TIME, POSITION,
    ],
    measured: Some(FORCE),
    is_header: |names| {
        let has = |kinds: &[Kind]| {
            names
                .iter()
                .any(|name| name.kind.is_some_and(|kind| kinds.contains(&kind)))
        };
        has(&[PASS, VEHICLES]) && has(&MEASURED)
    },
    unnamed: &["pass", "force_n", "sigma_n"],
    unit: Dimension::unit_by_word,
    // A million readings many times over.
    most: 64 << 20,
    allowed: ALLOWED,
};

/// The end that the name says.
pub fn end(name: &Name) -> Option<CableEnd> {
    let mut said = ENDS.into_iter().filter(|(_, words)| name.has(*words));
    let (end, _) = said.next()?;
    said.next().is_none().then_some(end)
}

/// What a column of this kind measures at a place.
pub fn measured(kind: Kind, at: Place) -> Measured {
    match kind {
        MOVEMENT => Measured::Movement(at),
        STRAIN => Measured::Strain(at),
        DEFLECTION => Measured::Deflection,
        _ => Measured::Force(at),
    }
}

/// The value in SI of a number in a column of this kind, in a unit if any.
pub fn si(kind: Kind, digits: &str, unit: &str) -> Option<f64> {
    // A length per metre is a length in metres.
    let (dimension, unit) = match (kind, &*unit.replace(['µ', 'μ'], "u")) {
        (STRAIN, "-" | "1" | "m/m") | (_, "") => return digits.parse().ok(),
        (STRAIN, "%") => (Dimension::Ratio, "%"),
        (STRAIN, "mm/m" | "‰") => (Dimension::Length, "mm"),
        (STRAIN, "um/m" | "ustrain" | "ue" | "1e-6" | "10^-6") => (Dimension::Length, "um"),
        (STRAIN, _) => return None,
        (MOVEMENT | DEFLECTION | POSITION, _) => (Dimension::Length, unit),
        _ => (Dimension::Force, unit),
    };
    dimension.in_table(digits, unit).filter(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use creepage_tables::Options;

    use super::*;

    fn name(text: &str) -> Name {
        NAMES.name(text, &Options::default())
    }

    #[test]
    fn names_say_what_a_column_holds() {
        for (text, expected, in_unit) in [
            ("pass", Some(PASS), None),
            ("Überfahrt", Some(PASS), None),
            ("Pass number", Some(PASS), None),
            ("force_n", Some(FORCE), Some("N")),
            ("force_kn", Some(FORCE), Some("kN")),
            ("Force mN", Some(FORCE), Some("mN")),
            ("Kraft [kN]", Some(FORCE), Some("kN")),
            ("Kraft in kN", Some(FORCE), Some("kN")),
            ("Load cell (lbf)", Some(FORCE), Some("lbf")),
            ("F/kN", None, Some("kN")),
            ("sigma_n", Some(SIGMA), Some("N")),
            ("force sigma", Some(SIGMA), None),
            ("movement_m", Some(MOVEMENT), Some("m")),
            ("Strain [µm/m]", Some(STRAIN), Some("µm/m")),
            ("Test Time (s)", Some(TIME), Some("s")),
            ("Peak force", Some(EXTREME), None),
            ("vehicles", Some(VEHICLES), None),
            ("X_Value", None, None),
            ("operator", None, None),
        ] {
            let name = name(text);
            assert_eq!((name.kind, name.unit.as_deref()), (expected, in_unit), "{text}");
        }
        assert_eq!(end(&name("Force upstream [N]")), Some(CableEnd::Upstream));
        assert_eq!(end(&name("downstream_force_n")), Some(CableEnd::Downstream));
        assert!(name("force_n").is_own() && !name("Kraft [N]").is_own());
    }

    #[test]
    fn units_are_told_apart() {
        let force = |unit| si(FORCE, "1", unit);
        assert_eq!(
            (force("kn"), force("MN"), force("mN"), force("mV")),
            (Some(1e3), Some(1e6), Some(1e-3), None)
        );
        assert_eq!((force("daN"), force("kp")), (Some(10.0), Some(9.80665)));
        assert_eq!(
            (si(STRAIN, "1", "µm/m"), si(STRAIN, "1", "V")),
            (Some(1e-6), None)
        );
        assert_eq!(si(POSITION, "1", "mm"), Some(1e-3));
    }
}
