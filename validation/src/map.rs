//! A map: a grid of scenes, each computed and judged, as a table and as panels of a figure.

use creepage::figure::{Axis, Chart};
use rayon::prelude::*;

/// Error beyond which an answer counts as wrong.
pub const WRONG: f64 = 0.05;
/// Depth of the duct \[m\].
pub const DEPTH: f64 = 1.2;

/// What became of a scene, in the order of names in tables and legends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    Right,
    /// Beyond [`WRONG`], without a word.
    Wrong,
    /// An error before anything is computed, or doubts that the method states itself.
    Refused,
    /// An error from the computation, or no number.
    Failed,
    /// Beyond [`WRONG`] with a warning, or less than that beyond the map's tolerance.
    Off,
}

/// What came out and the right force \[N\], or the error as a share; NaN if there is no answer.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    pub outcome: Outcome,
    pub found: f64,
    pub expected: f64,
}

/// `count` values from 10^`from` to 10^`to`, even in the exponent.
pub fn decades(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| 10_f64.powf(from + (to - from) * k as f64 / (count - 1) as f64))
        .collect()
}

/// Cells over x and y, the latter running slowest.
pub struct Grid<C> {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub cells: Vec<C>,
}

impl<C: Send> Grid<C> {
    /// Fills the grid with what `cell` says of its index, x and y, in parallel; the first error is that of a scene that cannot be made.
    pub fn fill<E: Send>(
        x: Vec<f64>,
        y: Vec<f64>,
        cell: impl Fn(usize, f64, f64) -> Result<C, E> + Sync,
    ) -> Result<Self, E> {
        let cells = (0..x.len() * y.len()).into_par_iter();
        let cells = cells
            .map(|index| cell(index, x[index % x.len()], y[index / x.len()]))
            .collect::<Result<_, _>>()?;
        Ok(Self { x, y, cells })
    }

    /// The axis of x, whose values are even in their logarithms.
    pub fn x_axis(&self, label: &str) -> Axis {
        Axis::logarithmic(label).cells(self.x.clone())
    }

    /// The axis of y likewise.
    pub fn y_axis(&self, label: &str) -> Axis {
        Axis::logarithmic(label).cells(self.y.clone())
    }

    /// As a panel of a figure.
    pub fn panel<const N: usize>(
        &self,
        title: &str,
        [x, y]: [Axis; 2],
        names: [&str; N],
        class: impl Fn(&C) -> usize,
    ) -> Chart {
        Chart::of_classes(title, x, y, names, self.cells.iter().map(class))
    }

    /// A line of a table for each cell, which `line` writes from x, y and the cell.
    pub fn lines(&self, line: impl Fn(f64, f64, &C) -> String) -> String {
        let places = self.y.iter().flat_map(|&y| self.x.iter().map(move |&x| (x, y)));
        let lines = places
            .zip(&self.cells)
            .map(|((x, y), cell)| line(x, y, cell) + "\n");
        lines.collect()
    }
}

/// Two methods side by side.
impl Grid<[Cell; 2]> {
    /// How often a method ended so.
    pub fn count(&self, method: usize, outcome: Outcome) -> usize {
        let same = |cell: &&[Cell; 2]| cell[method].outcome == outcome;
        self.cells.iter().filter(same).count()
    }

    /// One line on what came out of a method.
    pub fn summary(&self, method: usize) -> String {
        use Outcome::{Failed, Off, Refused, Right, Wrong};
        let all = [Right, Wrong, Refused, Failed, Off];
        let counts = all.map(|outcome| format!("{} {outcome:?}", self.count(method, outcome)));
        format!("{} cells: {}", self.cells.len(), counts.join(", "))
    }
}
