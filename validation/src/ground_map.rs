//! What the stability maps of ground models share: the wheel, and what counts as right.

use std::path::Path;

use creepage::figure::{Axis, Panels};
use ground_field::{Displacement, GroundError, GroundField, SurfaceLoad};

use crate::Failure;
use crate::map::{Cell, DEPTH, Grid, Outcome, WRONG};

/// Two models side by side: the crate is model 0.
pub struct GroundMap {
    pub models: [&'static str; 2],
    /// Error, as a share of the peak, up to which an answer is right.
    pub tolerance: f64,
    pub grid: Grid<[Cell; 2]>,
}

/// Judges `found` against `exact`, u_r by the largest |u_r| and u_z by the largest |u_z|.
pub fn judge(found: Result<Vec<Displacement>, GroundError>, exact: &[Displacement], tolerance: f64) -> Cell {
    let cell = |outcome, found| Cell {
        outcome,
        found,
        expected: 0.0,
    };
    let Ok(found) = found else {
        return cell(Outcome::Refused, f64::NAN);
    };
    let parts = [|u: &Displacement| u.radial, |u: &Displacement| u.vertical];
    let gaps = parts.iter().flat_map(|part| {
        let peak = exact.iter().fold(0.0_f64, |peak, u| peak.max(part(u).abs()));
        (found.iter().zip(exact)).map(move |(a, b)| (part(a) - part(b)).abs() / peak)
    });
    // `f64::max` would drop a NaN.
    let error = gaps.fold(
        0.0,
        |worst: f64, gap| {
            if gap > worst || gap.is_nan() { gap } else { worst }
        },
    );
    let outcome = if found.is_empty() || !error.is_finite() {
        Outcome::Failed
    } else if error > WRONG {
        Outcome::Wrong
    } else if error > tolerance {
        Outcome::Off
    } else {
        Outcome::Right
    };
    cell(outcome, error)
}

/// What one model says of the wheel of all maps, to be judged.
pub fn ask(
    model: Result<impl GroundField, GroundError>,
    radii: &[f64],
) -> Result<Vec<Displacement>, GroundError> {
    model?.displacements(wheel()?, radii, DEPTH)
}

/// The wheel of all maps: 100 kN on a disc of 0.15 m radius.
pub fn wheel() -> Result<SurfaceLoad, GroundError> {
    SurfaceLoad::new(1e5, 0.15)
}

/// Radii to 15 m at which answers are compared.
pub fn radii() -> Vec<f64> {
    (0..=50).map(|k| 0.3 * f64::from(k)).collect()
}

impl GroundMap {
    /// An error if the crate gave a wrong answer anywhere: with its guards on it may be right or refuse.
    pub fn never_wrong(&self) -> Result<(), String> {
        use Outcome::{Failed, Off, Wrong};
        let wrong = [Off, Wrong, Failed].map(|outcome| self.grid.count(0, outcome));
        if wrong == [0; 3] {
            return Ok(());
        }
        Err(format!(
            "{}: {wrong:?} cells are off, wrong or failed",
            self.models[0]
        ))
    }

    /// Writes the table, one row a cell and model, and adds one panel a model over contrast and `y`.
    pub fn write(
        &self,
        file: &Path,
        (heading, y): (&str, &Axis),
        what: &str,
        mut panels: Panels,
    ) -> Result<Panels, Failure> {
        self.never_wrong()?;
        let tolerance = match self.tolerance {
            5e-3 => "0.5 %".to_owned(),
            share => format!("{share:e}"),
        };
        let (right, off) = (
            format!("right within {tolerance}"),
            format!("off by {tolerance} to 5 %"),
        );
        let names = [
            &right,
            "wrong by more than 5 %",
            "refused",
            "failed: no number",
            &off,
        ];
        let mut table = format!("modulus_of_layer_over_base,{heading},model,outcome,error_share_of_peak\n");
        for (model, name) in self.models.iter().enumerate() {
            table += &self.grid.lines(|x, y, cell| {
                let outcome = names[cell[model].outcome as usize];
                format!("{x:e},{y:e},\"{name}\",\"{outcome}\",{:.2e}", cell[model].found)
            });
            let x = self
                .grid
                .x_axis("modulus of the layer over that of the half-space");
            let title = format!("{name}: {what}");
            let class = |cell: &[Cell; 2]| cell[model].outcome as usize;
            panels = panels.with(self.grid.panel(&title, [x, y.clone()], names, class));
        }
        crate::table::write(file, &table)?;
        Ok(panels)
    }
}
