//! Table 3 of the paper: which ground moves the duct by the same 35.7 µm at three depths?
//!
//! K. Kashiro et al., "Development of an Analysis Method for Power Cable Creepage Phenomenon in the Duct", Table 3, compares
//! ducts at 0.6, 1.5 and 2.0 m under vehicles of 8.57, 20 and 27.17 tf, and states one longitudinal displacement of the duct,
//! 35.7 µm, for all three, but not the ground. The peak of |D_l| on a uniform half-space is proportional to P/(E d²) for
//! a given ν: with ν = 0.4 one modulus at each depth gives the stated peak, and the peak computed with it proves it.
//!
//! `cargo run --example table_3`

#![allow(clippy::doc_markdown, reason = "D_l in the text is a formula, not code")]

use boussinesq::HalfSpace;
use ground_field::{DuctLine, DuctMotion, GroundError, Soil, Vehicle};

/// Standard gravity \[m/s²\] times a ton: one ton-force \[N\].
const TON_FORCE: f64 = 9806.65;
/// The paper's depths \[m\] and vehicle weights \[tf\].
pub const CASES: [(f64, f64); 3] = [(0.6, 8.57), (1.5, 20.0), (2.0, 27.17)];
/// Longitudinal displacement of the duct at all of them \[m\].
pub const WANTED: f64 = 35.7e-6;
/// Subgrade of the paper's Table 1: Young's modulus \[Pa\] and Poisson's ratio.
pub const SUBGRADE: (f64, f64) = (800e6, 0.4);
/// Speed of the vehicles, 40 km/h \[m/s\]; the displacement does not depend on it.
const SPEED: f64 = 40.0 / 3.6;

/// One line of the table.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// Depth of the duct \[m\].
    pub depth: f64,
    /// Weight of the vehicle \[tf\].
    pub weight: f64,
    /// max|D_l| on the subgrade of Table 1 \[m\].
    pub peak_on_subgrade: f64,
    /// Modulus that gives the wanted peak \[Pa\].
    pub modulus: f64,
    /// max|D_l| with that modulus \[m\].
    pub peak: f64,
}

/// max|D_l| \[m\] at `depth` \[m\] under a point load of `weight` \[tf\] on a half-space of `modulus` \[Pa\].
fn peak(modulus: f64, depth: f64, weight: f64) -> Result<f64, GroundError> {
    let ground = HalfSpace::new(Soil::new(modulus, SUBGRADE.1)?);
    let vehicle = Vehicle::point("truck", weight * TON_FORCE, SPEED)?;
    let duct = DuctLine::new(depth, 0.0)?;
    let motion = DuctMotion::new(&ground, &vehicle, duct, 20.0 * depth, 1e-9)?;
    Ok(motion.peak_longitudinal())
}

/// The table's three lines.
///
/// # Errors
///
/// None for these numbers; those of the ground model otherwise.
pub fn rows() -> Result<Vec<Row>, GroundError> {
    CASES
        .iter()
        .map(|&(depth, weight)| {
            let peak_on_subgrade = peak(SUBGRADE.0, depth, weight)?;
            let modulus = SUBGRADE.0 * peak_on_subgrade / WANTED;
            Ok(Row {
                depth,
                weight,
                peak_on_subgrade,
                modulus,
                peak: peak(modulus, depth, weight)?,
            })
        })
        .collect()
}

fn main() -> Result<(), GroundError> {
    println!("depth   vehicle   peak at 800 MPa   modulus for 35.7 um   peak with it");
    let rows = rows()?;
    for row in &rows {
        println!(
            "{:3.1} m  {:5.2} tf   {:12.2} um   {:15.1} MPa   {:9.3} um",
            row.depth,
            row.weight,
            row.peak_on_subgrade * 1e6,
            row.modulus * 1e-6,
            row.peak * 1e6
        );
    }
    let least = rows.iter().map(|row| row.modulus).fold(f64::INFINITY, f64::min);
    let most = rows.iter().map(|row| row.modulus).fold(0.0, f64::max);
    println!();
    println!(
        "One soil of about {:.0} to {:.0} MPa explains all three, a third of the {:.0} MPa of Table 1.",
        least * 1e-6,
        most * 1e-6,
        SUBGRADE.0 * 1e-6
    );
    Ok(())
}
