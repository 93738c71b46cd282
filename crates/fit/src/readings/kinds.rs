//! What a column holds, by its name in the header, and in which units.

use creepage_tables::{Kind, Layout, Name};

use super::{Measured, Place};
use creepage_scene::{CableEnd, Dimension};

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
pub const VEHICLES: Kind = Kind(
    "vehicles vehicle trucks lkw lorries hgv count counts fahrzeuge anzahl véhicules vehicules veicoli vehículos 台数",
);
pub const RUN: Kind = Kind("run runs series versuch lauf essai prova ensayo");
pub const TIME: Kind =
    Kind("time timestamp date datetime zeit zeitstempel datum temps heure data ora fecha 日時");
pub const POSITION: Kind = Kind("position place ort posizione posición posicion 位置");
pub const MEASURED: [Kind; 4] = [FORCE, MOVEMENT, STRAIN, DEFLECTION];
const ENDS: [(CableEnd, Kind); 2] = [
    (CableEnd::Upstream, Kind("upstream up start")),
    (CableEnd::Downstream, Kind("downstream down end")),
];

/// Maximum number of vehicles of a pass or a count.
const MAX_COUNT: f64 = 1e15;

/// A table of readings.
pub const LAYOUT: Layout = Layout {
    kinds: &[
        EXTREME, SIGMA, FORCE, MOVEMENT, STRAIN, DEFLECTION, PASS, VEHICLES, RUN, TIME, POSITION,
    ],
    measured: Some(FORCE),
    missing: |names| {
        let has = |kinds: &[Kind]| {
            let mut kinds_there = names.iter().filter_map(|name| name.kind);
            kinds_there.any(|kind| kinds.contains(&kind))
        };
        let column = if has(&[PASS, VEHICLES]) { "force_n" } else { "pass" };
        (column == "pass" || !has(&MEASURED)).then_some(column)
    },
    is_number: |name| name.kind.is_some_and(|kind| ![RUN, TIME].contains(&kind)),
    unnamed: &["pass", "force_n", "sigma_n"],
    unit: Dimension::unit_by_word,
    si,
    // A million readings many times over.
    most: 64 << 20,
    allowed: "a header `pass,force_n` or `pass,force_n,sigma_n`, names such as `Force [kN]`, or names chosen by --column-pass, \
              --column-vehicles, --column-force; times alone say nothing of passes",
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

/// The value in SI of a number in a column of this kind, in a unit if any; or what is allowed.
pub fn si(kind: Kind, digits: &str, unit: &str) -> Result<f64, String> {
    let bare = || digits.parse().ok();
    // A length per metre is a length in metres.
    let value = match (kind, &*unit.replace(['µ', 'μ'], "u")) {
        (PASS | VEHICLES, "") => {
            bare().filter(|value: &f64| value.fract() == 0.0 && (0.0..=MAX_COUNT).contains(value))
        }
        (PASS | VEHICLES, _) => None,
        (STRAIN, "-" | "1" | "m/m") | (_, "") => bare(),
        (STRAIN, "%") => Dimension::Ratio.in_table(digits, "%"),
        (STRAIN, "mm/m" | "‰") => Dimension::Length.in_table(digits, "mm"),
        (STRAIN, "um/m" | "ustrain" | "ue" | "1e-6" | "10^-6") => Dimension::Length.in_table(digits, "um"),
        (STRAIN, _) => None,
        (MOVEMENT | DEFLECTION | POSITION, unit) => Dimension::Length.in_table(digits, unit),
        (_, unit) => Dimension::Force.in_table(digits, unit),
    };
    let allowed = match kind {
        PASS | VEHICLES => "a whole number, 0 for the reading before the first pass",
        POSITION => "metres from the upstream end",
        _ => "a finite number, with a unit if any",
    };
    let value = value.filter(|value| value.is_finite());
    value.ok_or_else(|| allowed.to_owned())
}

#[cfg(test)]
mod tests {
    use creepage_tables::Options;

    use super::*;

    fn name(text: &str) -> Name {
        LAYOUT.name(text, &Options::default())
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
        let si = |kind, unit| si(kind, "1", unit).ok();
        let force = |unit| si(FORCE, unit);
        assert_eq!(
            (force("kn"), force("MN"), force("mN"), force("mV")),
            (Some(1e3), Some(1e6), Some(1e-3), None)
        );
        assert_eq!((force("daN"), force("kp")), (Some(10.0), Some(9.80665)));
        assert_eq!((si(STRAIN, "µm/m"), si(STRAIN, "V")), (Some(1e-6), None));
        assert_eq!(si(POSITION, "mm"), Some(1e-3));
    }
}
