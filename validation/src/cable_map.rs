//! What the stability maps of cable solvers share: the cable and its road, and what counts as right.

use cable_dem::{CableError, DuctedCable, End, Friction, FrictionLaw};
use creepage::figure::{Axis, Chart};
use ground_field::{DuctLine, DuctMotion, GroundError, Soil, Vehicle};

use crate::map::{Cell, Grid, Outcome, WRONG};

/// Mass per metre of the cable \[kg/m\]: 108.8 N/m.
pub const MASS: f64 = 108.8 / 9.80665;
/// Axial stiffness EA \[N\].
pub const EA: f64 = 8.01e6;
/// Friction limit q \[N/m\]: 0.25 × 108.8 N/m.
pub const LIMIT: f64 = 0.25 * 108.8;
const NAMES: [&str; 5] = [
    "right",
    "wrong by more than 5 %",
    "refused",
    "failed with an error",
    "off, but with a warning",
];

/// Judges a force against the right one, as a share of `scale`; a number that is not finite is a failure.
pub fn judge(found: f64, expected: f64, scale: f64, warned: bool) -> Cell {
    let outcome = if !found.is_finite() {
        Outcome::Failed
    } else if (found - expected).abs() <= WRONG * scale {
        Outcome::Right
    } else if warned {
        Outcome::Off
    } else {
        Outcome::Wrong
    };
    Cell {
        outcome,
        found,
        expected,
    }
}

/// A cell without an answer.
pub fn silent(outcome: Outcome, expected: f64) -> Cell {
    Cell {
        outcome,
        found: f64::NAN,
        expected,
    }
}

/// What a solver's error means: refused before the computation, or failed in it.
pub fn unanswered(error: &CableError) -> Outcome {
    match error {
        CableError::NoConvergence { .. } | CableError::EnergyNotConserved { .. } => Outcome::Failed,
        _ => Outcome::Refused,
    }
}

/// Maps of two methods: as panels with their names, and as lines of a table of x, y, outcome, force and the right force.
pub fn panels(grid: &Grid<[Cell; 2]>, names: [&str; 2], axes: &[Axis; 2]) -> (Vec<Chart>, String) {
    let (mut charts, mut table) = (Vec::new(), String::new());
    for (method, name) in names.into_iter().enumerate() {
        println!("{name}: {}", grid.summary(method));
        charts.push(grid.panel(name, axes.clone(), NAMES, |cell| cell[method].outcome as usize));
        table += &grid.lines(|x, y, cell| {
            let cell = cell[method];
            let outcome = NAMES[cell.outcome as usize];
            format!(
                "{name:?},{x:.5e},{y:.5e},{outcome:?},{:.4},{:.4}",
                cell.found, cell.expected
            )
        });
    }
    (charts, table)
}

/// A duct at `depth` \[m\] below a point load of 20 tf at `speed` \[m/s\].
pub fn truck(depth: f64, speed: f64) -> Result<DuctMotion, GroundError> {
    let ground = boussinesq::HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("truck", 196_133.0, speed)?;
    DuctMotion::new(&ground, &truck, DuctLine::new(depth, 0.0)?, 1000.0, 1e-8)
}

/// The cable, free upstream and fixed downstream.
pub fn cable(length: f64, law: FrictionLaw) -> Result<DuctedCable, CableError> {
    DuctedCable::new(length, EA, Friction::new(law, LIMIT)?)?.with_ends(End::Free, End::Fixed)
}
