//! A stability map of ground models: outcomes on a grid of grounds, as a table and as a figure.

use std::error::Error;
use std::fmt::Write as _;

use creepage::figure::{Axis, Chart, Panels};
use ground_field::{Displacement, GroundError, GroundField, SurfaceLoad};
use rayon::prelude::*;

/// Error, as a share of the peak, beyond which an answer counts as wrong.
pub const WRONG: f64 = 0.05;
/// Depth of the duct \[m\].
pub const DEPTH: f64 = 1.2;

/// What became of one ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Within the tolerance of the map.
    Right,
    /// Beyond it, but by less than [`WRONG`].
    Off,
    /// Beyond [`WRONG`].
    Wrong,
    /// A typed error.
    Refused,
    /// An answer that is not a number.
    Failed,
}

impl Outcome {
    /// Names in tables and legends, in the order of the variants; the map's tolerance as a text.
    pub fn names(tolerance: &str) -> [String; 5] {
        [
            format!("right within {tolerance}"),
            format!("off by {tolerance} to 5 %"),
            "wrong by more than 5 %".into(),
            "refused".into(),
            "failed: no number".into(),
        ]
    }
}

/// Outcome and error of one cell.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    pub outcome: Outcome,
    /// Share of the peak; NaN where there is no answer.
    pub error: f64,
}

/// Judges `found` against `exact`, u_r by the largest |u_r| and u_z by the largest |u_z|.
pub fn judge(found: Result<Vec<Displacement>, GroundError>, exact: &[Displacement], tolerance: f64) -> Cell {
    let Ok(found) = found else {
        return Cell {
            outcome: Outcome::Refused,
            error: f64::NAN,
        };
    };
    let error = [|u: &Displacement| u.radial, |u: &Displacement| u.vertical]
        .iter()
        .map(|part| {
            let peak = exact.iter().fold(0.0_f64, |peak, u| peak.max(part(u).abs()));
            let gaps = found
                .iter()
                .zip(exact)
                .map(|(a, b)| (part(a) - part(b)).abs() / peak);
            // `f64::max` would drop a NaN.
            gaps.fold(
                0.0_f64,
                |worst, gap| if gap > worst || gap.is_nan() { gap } else { worst },
            )
        })
        .fold(0.0_f64, |worst, error| {
            if error > worst || error.is_nan() {
                error
            } else {
                worst
            }
        });
    let outcome = if found.is_empty() || !error.is_finite() {
        Outcome::Failed
    } else if error > WRONG {
        Outcome::Wrong
    } else if error > tolerance {
        Outcome::Off
    } else {
        Outcome::Right
    };
    Cell { outcome, error }
}

/// What one model says, to be judged.
pub fn ask(
    model: Result<impl GroundField, GroundError>,
    load: SurfaceLoad,
    radii: &[f64],
) -> Result<Vec<Displacement>, GroundError> {
    model?.displacements(load, radii, DEPTH)
}

/// The wheel of all maps: 100 kN on a disc of 0.15 m radius.
///
/// # Errors
///
/// None for these numbers.
pub fn wheel() -> Result<SurfaceLoad, GroundError> {
    SurfaceLoad::new(1e5, 0.15)
}

/// Radii to 15 m at which answers are compared.
pub fn radii() -> Vec<f64> {
    (0..=50).map(|k| 0.3 * f64::from(k)).collect()
}

/// `count` values from 10^`from` to 10^`to`, even in the exponent.
pub fn decades(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| 10_f64.powf(from + (to - from) * k as f64 / (count - 1) as f64))
        .collect()
}

/// Cells of several models over x and y, the latter running slowest.
pub struct Grid {
    pub models: Vec<&'static str>,
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// One list a cell, in the order of `models`.
    pub cells: Vec<Vec<Cell>>,
}

impl Grid {
    /// Fills the grid with what `cell` says of (x, y), in parallel.
    ///
    /// # Errors
    ///
    /// The first error of `cell`: a ground that cannot be made.
    pub fn fill(
        models: Vec<&'static str>,
        x: Vec<f64>,
        y: Vec<f64>,
        cell: impl Fn(f64, f64) -> Result<Vec<Cell>, GroundError> + Sync,
    ) -> Result<Self, GroundError> {
        let places: Vec<(f64, f64)> = y.iter().flat_map(|&y| x.iter().map(move |&x| (x, y))).collect();
        let cells = places
            .par_iter()
            .map(|&(x, y)| cell(x, y))
            .collect::<Result<_, _>>()?;
        Ok(Self { models, x, y, cells })
    }

    /// All cells of one model.
    pub fn of(&self, model: usize) -> impl Iterator<Item = Cell> + '_ {
        self.cells.iter().map(move |cell| cell[model])
    }

    /// One map a model, in `panels`.
    pub fn draw(&self, mut panels: Panels, x: &Axis, y: &Axis, what: &str, tolerance: &str) -> Panels {
        for (model, name) in self.models.iter().enumerate() {
            panels = panels.with(Chart::of_classes(
                format!("{name}: {what}"),
                x.clone(),
                y.clone(),
                Outcome::names(tolerance),
                self.of(model).map(|cell| cell.outcome as usize),
            ));
        }
        panels
    }

    /// How often a model ended so.
    pub fn count(&self, model: usize, outcome: Outcome) -> usize {
        self.of(model).filter(|cell| cell.outcome == outcome).count()
    }

    /// An error if the crate, model 0, gave a wrong answer anywhere: with its guards on it may be right or refuse.
    pub fn never_wrong(&self) -> Result<(), String> {
        let wrong = [Outcome::Off, Outcome::Wrong, Outcome::Failed].map(|outcome| self.count(0, outcome));
        if wrong == [0; 3] {
            Ok(())
        } else {
            Err(format!(
                "{}: {wrong:?} cells are off, wrong or failed",
                self.models[0]
            ))
        }
    }

    /// The table, one row a cell and model.
    ///
    /// # Errors
    ///
    /// Never; writing to a text cannot fail.
    pub fn csv(&self, x: &str, y: &str, tolerance: &str) -> Result<String, Box<dyn Error>> {
        let names = Outcome::names(tolerance);
        let mut text = format!("{x},{y},model,outcome,error_share_of_peak\n");
        for (index, cells) in self.cells.iter().enumerate() {
            let (a, b) = (self.x[index % self.x.len()], self.y[index / self.x.len()]);
            for (model, cell) in self.models.iter().zip(cells) {
                writeln!(
                    text,
                    "{a:e},{b:e},\"{model}\",\"{}\",{:.2e}",
                    names[cell.outcome as usize], cell.error
                )?;
            }
        }
        Ok(text)
    }
}
