//! A stability map of cable solvers: outcomes on a grid of scenes, as a table and as panels of a figure.

use std::fmt::Write as _;

use cable_dem::{CableError, DuctedCable, End, Friction, FrictionLaw};
use creepage::figure::{Axis, Chart};
use ground_field::{DuctLine, DuctMotion, GroundError, Soil, Vehicle};
use rayon::prelude::*;

/// Error of the force beyond which an answer counts as wrong.
pub const WRONG: f64 = 0.05;
/// Mass per metre of the cable \[kg/m\]: 108.8 N/m.
pub const MASS: f64 = 108.8 / 9.80665;
/// Axial stiffness EA \[N\].
pub const EA: f64 = 8.01e6;
/// Friction limit q \[N/m\]: 0.25 × 108.8 N/m.
pub const LIMIT: f64 = 0.25 * 108.8;
/// Depth of the duct \[m\].
pub const DEPTH: f64 = 1.2;

/// What became of one scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Within [`WRONG`].
    Right,
    /// Beyond it, without a word.
    Wrong,
    /// An error before anything is computed, or doubts that the method states itself.
    Refused,
    /// An error from the computation.
    Failed,
    /// An answer beyond [`WRONG`] that comes with a warning.
    Warned,
}

impl Outcome {
    /// Names in tables and legends, in the order of the variants.
    pub const NAMES: [&'static str; 5] = [
        "right",
        "wrong by more than 5 %",
        "refused",
        "failed with an error",
        "off, but with a warning",
    ];
}

/// Outcome of one scene, and its force beside the right one \[N\]; NaN where there is none.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    pub outcome: Outcome,
    pub force: f64,
    pub expected: f64,
}

/// Judges a force against the right one, as a share of `scale`; a number that is not finite is a failure.
pub fn judge(force: f64, expected: f64, scale: f64, warned: bool) -> Cell {
    let outcome = if !force.is_finite() {
        Outcome::Failed
    } else if (force - expected).abs() <= WRONG * scale {
        Outcome::Right
    } else if warned {
        Outcome::Warned
    } else {
        Outcome::Wrong
    };
    Cell {
        outcome,
        force,
        expected,
    }
}

/// A cell without an answer.
pub fn silent(outcome: Outcome, expected: f64) -> Cell {
    Cell {
        outcome,
        force: f64::NAN,
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

/// `count` values from 10^`from` to 10^`to`, even in the exponent.
pub fn decades(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| 10_f64.powf(from + (to - from) * k as f64 / (count - 1) as f64))
        .collect()
}

/// Cells over x and y, the latter running slowest.
pub struct Grid {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub cells: Vec<Cell>,
}

impl Grid {
    /// Fills two grids, without guards and with them, with what `cells` says of (x, y), in parallel.
    ///
    /// # Errors
    ///
    /// The first error of `cells`: a scene that cannot be made.
    pub fn fill_pair<E: Send>(
        x: &[f64],
        y: &[f64],
        cells: impl Fn(f64, f64) -> Result<[Cell; 2], E> + Sync,
    ) -> Result<[Self; 2], E> {
        let places: Vec<(f64, f64)> = y.iter().flat_map(|&y| x.iter().map(move |&x| (x, y))).collect();
        let pairs = places
            .par_iter()
            .map(|&(x, y)| cells(x, y))
            .collect::<Result<Vec<_>, E>>()?;
        Ok([0, 1].map(|which| Self {
            x: x.to_vec(),
            y: y.to_vec(),
            cells: pairs.iter().map(|pair| pair[which]).collect(),
        }))
    }

    /// How many cells came out so.
    pub fn count(&self, outcome: Outcome) -> usize {
        self.cells.iter().filter(|cell| cell.outcome == outcome).count()
    }

    /// One line on what came out.
    pub fn summary(&self) -> String {
        let all = [
            Outcome::Right,
            Outcome::Wrong,
            Outcome::Refused,
            Outcome::Failed,
            Outcome::Warned,
        ];
        let parts = all.iter().filter(|outcome| self.count(**outcome) > 0);
        let parts =
            parts.map(|&outcome| format!("{} {}", self.count(outcome), Outcome::NAMES[outcome as usize]));
        format!(
            "{} cells: {}",
            self.cells.len(),
            parts.collect::<Vec<_>>().join(", ")
        )
    }

    /// As a panel of a figure.
    pub fn map(&self, title: &str, x: Axis, y: Axis) -> Chart {
        let classes = Outcome::NAMES;
        Chart::of_classes(
            title,
            x,
            y,
            classes,
            self.cells.iter().map(|cell| cell.outcome as usize),
        )
    }

    /// Lines of a table, each begun by `name`: x, y, outcome, force and the right force.
    pub fn csv(&self, name: &str) -> String {
        let mut text = String::new();
        for (index, cell) in self.cells.iter().enumerate() {
            let (x, y) = (self.x[index % self.x.len()], self.y[index / self.x.len()]);
            let outcome = Outcome::NAMES[cell.outcome as usize];
            let _ = writeln!(
                text,
                "{name:?},{x:.5e},{y:.5e},{outcome:?},{:.4},{:.4}",
                cell.force, cell.expected
            );
        }
        text
    }
}

/// A duct at `depth` \[m\] below a point load of 20 tf at `speed` \[m/s\].
///
/// # Errors
///
/// Unless depth and speed are finite and positive.
pub fn truck(depth: f64, speed: f64) -> Result<DuctMotion, GroundError> {
    let ground = boussinesq::HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("truck", 196_133.0, speed)?;
    DuctMotion::new(&ground, &truck, DuctLine::new(depth, 0.0)?, 1000.0, 1e-8)
}

/// The cable, free upstream and fixed downstream.
///
/// # Errors
///
/// As for [`Friction::new`] and [`DuctedCable::new`].
pub fn cable(length: f64, law: FrictionLaw) -> Result<DuctedCable, CableError> {
    DuctedCable::new(length, EA, Friction::new(law, LIMIT)?)?.with_ends(End::Free, End::Fixed)
}
