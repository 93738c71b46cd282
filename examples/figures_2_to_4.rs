//! Figures 2 to 4 of the paper: how the ground at the duct moves while the vehicle drives over it.
//!
//! K. Kashiro et al., "Development of an Analysis Method for Power Cable Creepage Phenomenon in the Duct", section 2.1: a
//! concentrated load of 20 tf goes from A, 4.8 m before a point of the duct 1.2 m deep, over C, above it, to E, 4.8 m behind it. Their finite
//! elements, of an extent not stated, move the point by at most 16 µm along the duct and 90 µm down. Here: their three layers (Table 1) as
//! an exact half-space and over rock at 12 m, the latter by finite elements too, and the subgrade alone in closed form.
//!
//! `cargo run --release --example figures_2_to_4`

mod common;

use common::{Failure, even, save, scene};
use creepage::figure::{Axis, Chart, Panels, Reference, Series};
use creepage::{Profile, profile_at};

/// The vehicle's places A to E, before (negative) and behind the point of the duct \[m\].
pub const PLACES: [(&str, f64); 5] = [("A", -4.8), ("B", -2.4), ("C", 0.0), ("D", 2.4), ("E", 4.8)];
/// Peaks of the paper's finite elements along the duct and down \[µm\].
pub const PAPER: (f64, f64) = (16.0, 90.0);
/// Surface course and binder of Table 1 on its subgrade.
const TABLE_1: &str = r#"ground.layers=[{thickness="50 mm", young_modulus="4000 MPa", poisson_ratio=0.35}, {thickness="50 mm", young_modulus="800 MPa", poisson_ratio=0.35}, {young_modulus="800 MPa", poisson_ratio=0.4}]"#;
const ROCK: &str = "ground.rigid_base_depth=12 m";

/// A ground and the duct's motion on it.
pub struct Case {
    /// What ground, by what model.
    pub name: &'static str,
    /// Along 20 m to either side of the vehicle.
    pub profile: Profile,
    /// With the vehicle at A, B, C, D, E.
    pub at_places: Profile,
}

impl Case {
    /// Peaks along the duct and down \[µm\].
    pub fn peaks(&self) -> (f64, f64) {
        let peak = |values: &[f64]| 1e6 * values.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
        (peak(&self.profile.longitudinal_m), peak(&self.profile.vertical_m))
    }

    /// Length over which the duct sinks by a twentieth of the most or more \[m\].
    pub fn deflected_length(&self) -> f64 {
        let threshold = 0.05e-6 * self.peaks().1;
        let spacing = self.profile.positions_m[1] - self.profile.positions_m[0];
        spacing
            * self
                .profile
                .vertical_m
                .iter()
                .filter(|v| **v >= threshold)
                .count() as f64
    }
}

/// The four grounds.
///
/// # Errors
///
/// Those of the scenes and the models.
pub fn cases() -> Result<Vec<Case>, Failure> {
    let grounds: [(&str, &[&str]); 4] = [
        (
            "Table 1 on a half-space, burmister",
            &[TABLE_1, "ground.model=burmister"],
        ),
        (
            "Table 1 on rock at 12 m, burmister",
            &[TABLE_1, "ground.model=burmister", ROCK],
        ),
        (
            "Table 1 on rock at 12 m, fem",
            &[TABLE_1, "ground.model=fem", ROCK],
        ),
        ("800 MPa throughout, boussinesq", &["ground.model=boussinesq"]),
    ];
    let along: Vec<f64> = even(-20.0, 20.0, 1600).collect();
    // Where the point of the duct lies from the vehicle.
    let places: Vec<f64> = PLACES.iter().map(|(_, vehicle)| -vehicle).collect();
    grounds
        .into_iter()
        .map(|(name, overrides)| {
            let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
            let scene = scene("full-scale-upper.toml", &overrides)?;
            Ok(Case {
                name,
                profile: profile_at(&scene, &along)?,
                at_places: profile_at(&scene, &places)?,
            })
        })
        .collect()
}

/// The path of the point, and both components along the duct.
pub fn figure(cases: &[Case]) -> Panels {
    let micro = |values: &[f64], sign: f64| values.iter().map(|value| sign * 1e6 * value).collect::<Vec<_>>();
    let mut path = Chart::new(
        "Figure 2: path of the point below C",
        Axis::linear("along the duct, µm"),
        Axis::linear("vertical, µm").range(-110.0, 5.0),
    );
    let place = || Axis::linear("place from the vehicle, m").range(-10.0, 10.0);
    let mut vertical = Chart::new(
        "Figure 3: vertical",
        place(),
        Axis::linear("vertical, µm").range(-110.0, 5.0),
    )
    .refer(Reference::horizontal(-PAPER.1, "paper: down to 90 µm"));
    let mut longitudinal = Chart::new(
        "Figure 4: along the duct",
        place(),
        Axis::linear("along the duct, µm"),
    )
    .refer(Reference::horizontal(PAPER.0, "paper: up to 16 µm"));
    for (look, case) in cases.iter().enumerate() {
        let x = &case.profile.positions_m;
        let (along, up) = (
            micro(&case.profile.longitudinal_m, 1.0),
            micro(&case.profile.vertical_m, -1.0),
        );
        vertical = vertical.with(Series::line(case.name, pairs(x, &up)).look(look));
        longitudinal = longitudinal.with(Series::line(case.name, pairs(x, &along)).look(look));
        path = path.with(Series::line(case.name, pairs(&along, &up)).look(look));
    }
    // The places on the ground that comes nearest to the paper's.
    let shown = &cases[1].at_places;
    let at = pairs(
        &micro(&shown.longitudinal_m, 1.0),
        &micro(&shown.vertical_m, -1.0),
    );
    for (look, ((name, _), point)) in PLACES.iter().zip(at).enumerate() {
        path = path.with(Series::points(format!("vehicle at {name}, on rock"), [point]).look(look));
    }
    Panels::new("Motion of the duct under 20 tf, 1.2 m deep")
        .panel_size(800.0, 430.0)
        .with(path)
        .with(vertical)
        .with(longitudinal)
}

fn pairs(a: &[f64], b: &[f64]) -> Vec<(f64, f64)> {
    a.iter().copied().zip(b.iter().copied()).collect()
}

fn main() -> Result<(), Failure> {
    let cases = cases()?;
    println!("{:36}  max along   max down   deflected length", "");
    println!(
        "{:36}  {:6.2} um   {:6.2} um   7 to 11 m measured",
        "paper, finite elements", PAPER.0, PAPER.1
    );
    for case in &cases {
        let (longitudinal, vertical) = case.peaks();
        println!(
            "{:36}  {longitudinal:6.2} um   {vertical:6.2} um   {:4.1} m above 5 % of the most",
            case.name,
            case.deflected_length()
        );
    }
    println!("\nThe point of the duct below C with the vehicle at A to E, along and down, um:");
    for case in &cases {
        print!("{:36}", case.name);
        let moved = case
            .at_places
            .longitudinal_m
            .iter()
            .zip(&case.at_places.vertical_m);
        for ((place, _), (longitudinal, vertical)) in PLACES.iter().zip(moved) {
            print!("  {place} {:6.2} {:5.2}", longitudinal * 1e6, vertical * 1e6);
        }
        println!();
    }
    save("figures-2-to-4.svg", &figure(&cases).to_svg()?)
}
