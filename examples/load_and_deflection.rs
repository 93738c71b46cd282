//! What the form of the load and the stiffness of the ground do to the force: a point or axles, a modulus or the measured deflection.
//!
//! K. Kashiro et al. put the 20 tf of their truck on one point; their forces level off at about 550 N (upper cable) and 900 N (lower one,
//! section 4.2). A truck has axles. They measured that the duct sinks by 90 to 140 µm (Table 1); a modulus of 800 MPa gives 100 µm under the point, and less under
//! axles. The axles of a 20 t truck are not in the paper: here 27.5, 36.25 and 36.25 % of the weight at 0, −5.0 and −6.3 m, an
//! assumption, as points above the duct or as pairs of wheels 1.8 m apart with the duct midway between them.
//!
//! `cargo run --release --example load_and_deflection`

mod common;

use common::{Failure, save, scene};
use creepage::figure::{Axis, Chart, Panels, Reference, Series};
use rayon::prelude::*;

/// A cable, its scene, and the force the paper reads off \[N\].
pub const CABLES: [(&str, &str, f64); 2] = [
    ("upper", "full-scale-upper.toml", 550.0),
    ("lower", "full-scale-lower.toml", 900.0),
];
/// Forms of the load, and how a scene says them.
pub const LOADS: [(&str, Option<&str>); 3] = [
    ("one point", None),
    ("three axles", Some(AXLES)),
    ("six wheels", Some(WHEELS)),
];
const AXLES: &str = r#"vehicles.0.wheels=[{x="0 m", y="0 m", load="5.5 tf"}, {x="-5.0 m", y="0 m", load="7.25 tf"}, {x="-6.3 m", y="0 m", load="7.25 tf"}]"#;
const WHEELS: &str = r#"vehicles.0.wheels=[{x="0 m", y="0.9 m", load="2.75 tf"}, {x="0 m", y="-0.9 m", load="2.75 tf"}, {x="-5.0 m", y="0.9 m", load="3.625 tf"}, {x="-5.0 m", y="-0.9 m", load="3.625 tf"}, {x="-6.3 m", y="0.9 m", load="3.625 tf"}, {x="-6.3 m", y="-0.9 m", load="3.625 tf"}]"#;
/// Measured deflections \[µm\].
const MEASURED: (f64, f64) = (90.0, 140.0);
/// Deflections looked at \[µm\].
const DEFLECTIONS: [f64; 5] = [90.0, 100.0, 120.0, 140.0, 160.0];

/// Where the force stands after 200 passes.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// Largest deflection of the duct \[µm\].
    pub deflection: f64,
    /// max|D_l| \[µm\].
    pub longitudinal: f64,
    /// Force at the load cell \[N\].
    pub force: f64,
}

/// After 200 passes; `deflection` \[µm\] scales the ground, which has 800 MPa otherwise.
///
/// # Errors
///
/// Those of the scene and the run.
pub fn outcome(file: &str, load: Option<&str>, deflection: Option<f64>) -> Result<Outcome, Failure> {
    on(file, load, None, deflection)
}

/// The same within a tolerance of your own, such as `5 %`.
///
/// # Errors
///
/// Those of the scene and the run.
pub fn outcome_within(
    tolerance: &str,
    file: &str,
    load: Option<&str>,
    deflection: Option<f64>,
) -> Result<Outcome, Failure> {
    let tolerance = format!("solver.tolerance={tolerance}");
    after_200(
        file,
        [Some(tolerance), load.map(Into::into), scaled_to(deflection)],
    )
}

/// The same on another ground than the scene's.
///
/// # Errors
///
/// Those of the scene and the run.
pub fn on(
    file: &str,
    load: Option<&str>,
    ground: Option<&str>,
    deflection: Option<f64>,
) -> Result<Outcome, Failure> {
    let overrides = [
        ground.map(Into::into),
        load.map(Into::into),
        scaled_to(deflection),
    ];
    after_200(file, overrides)
}

fn scaled_to(deflection: Option<f64>) -> Option<String> {
    deflection.map(|peak| format!("ground.vertical_peak={peak} um"))
}

fn after_200(file: &str, overrides: [Option<String>; 3]) -> Result<Outcome, Failure> {
    let mut overrides: Vec<String> = overrides.into_iter().flatten().collect();
    overrides.push("traffic.passes=200".into());
    let run = creepage::run(&scene(file, &overrides)?)?;
    Ok(Outcome {
        deflection: run.duct_motion.peak_vertical_m * 1e6,
        longitudinal: run.duct_motion.peak_longitudinal_m * 1e6,
        force: run.passes[run.passes.len() - 1].downstream_force_n,
    })
}

/// Grounds of Table 1: its subgrade alone, and its layers on rock as deep as the paper's ratio of displacements asks for.
pub const GROUNDS: [(&str, Option<&str>); 2] =
    [("half-space", None), ("Table 1 on rock at 8 m", Some(ON_ROCK))];
const ON_ROCK: &str = r#"ground={preset="kashiro"}"#;
/// Deflections between the least and the most that were measured \[µm\].
pub const WITHIN: [f64; 3] = [90.0, 115.0, 140.0];

fn main() -> Result<(), Failure> {
    let mut panels = Panels::new("Force after 200 passes against the deflection of the duct");
    for (name, file, paper) in CABLES {
        println!("{name} cable; paper: about {paper} N, deflection 90 to 140 um measured");
        let mut chart = Chart::new(
            format!("{name} cable"),
            Axis::linear("largest deflection of the duct, µm").range(40.0, 165.0),
            Axis::linear("force, N").range(0.0, 1000.0),
        )
        .refer(Reference::vertical_band(MEASURED.0, MEASURED.1, "measured"))
        .refer(Reference::horizontal(paper, format!("paper: about {paper} N")));
        for (look, (form, load)) in LOADS.into_iter().enumerate() {
            let grounds: Vec<Option<f64>> = std::iter::once(None).chain(DEFLECTIONS.map(Some)).collect();
            let solve =
                |ground: &Option<f64>| outcome(file, load, *ground).map_err(|error| error.to_string());
            let outcomes: Vec<Outcome> = grounds.par_iter().map(solve).collect::<Result<_, _>>()?;
            for (ground, found) in grounds.iter().zip(&outcomes) {
                println!(
                    "  {form:11}  {:9}  down {:5.1} um, along {:4.1} um: {:5.1} N",
                    if ground.is_some() { "scaled" } else { "800 MPa" },
                    found.deflection,
                    found.longitudinal,
                    found.force
                );
            }
            let mut points: Vec<_> = outcomes
                .iter()
                .map(|found| (found.deflection, found.force))
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            chart = chart.with(Series::line_points(form, points).look(look));
        }
        panels = panels.with(chart);
    }
    println!("one point, both grounds scaled to the deflection, after 200 passes:");
    for (name, file, paper) in CABLES {
        for (ground, preset) in GROUNDS {
            let solve = |deflection: &f64| {
                on(file, None, preset, Some(*deflection)).map_err(|error| error.to_string())
            };
            let outcomes: Vec<Outcome> = WITHIN.par_iter().map(solve).collect::<Result<_, _>>()?;
            for (deflection, found) in WITHIN.iter().zip(&outcomes) {
                println!(
                    "  {name}, {ground:22} {deflection:5.1} um: {:5.1} N, {:+.1} % of the paper's",
                    found.force,
                    100.0 * (found.force / paper - 1.0)
                );
            }
        }
    }
    println!("three axles with the moduli of Table 1, lower cable, after 200 passes:");
    for (ground, preset) in GROUNDS {
        let found = on(CABLES[1].1, LOADS[1].1, preset, None)?;
        println!("  {ground:22} {:5.1} um: {:5.1} N", found.deflection, found.force);
    }
    save("load-and-deflection.svg", &panels.to_svg()?)
}
