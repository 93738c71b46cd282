//! Would an error of a load cell explain the readings better?
//!
//! Where an error of the cell has led the fit far away, only a fit with the error shows what it
//! explains.

use calibrate::{Fit, probability_of_gain};

use crate::meshes::Final;
use crate::model::MeshOf;
use crate::parameters::{Fitted, cells, error_of};
use crate::problem::Problem;
use crate::readings::Instrument;
use crate::unknown::Quantity;
use creepage_run::Error;

/// An error of a cell that would explain readings.
pub struct CellError {
    pub quantity: Quantity,
    /// Probability that noise alone gains so much by it.
    pub probability: f64,
    /// What it would do, to the first parameter too.
    pub words: String,
}

/// The most striking error of this kind, of all cells; `judged` are the rows that count.
pub fn cell_error(
    problem: &Problem<'_>,
    found: &Final,
    quantity: Quantity,
    judged: &[usize],
) -> Result<Option<CellError>, Error> {
    let last = &found.fit;
    let square = |fit: &Fit| -> f64 {
        let residuals = fit.standardised_noise();
        judged.iter().map(|&row| residuals[row].powi(2)).sum()
    };
    let known = (!last.noise_estimated).then_some(1.0);
    let freedom = last.degrees_of_freedom - 1.0 - (last.residuals.len() - judged.len()) as f64;
    let mut open = Vec::new();
    for cell in cells(problem.rows) {
        let error = error_of(cell, quantity, problem.rows, problem.options)?;
        if last.estimate(error.parameter.name()).is_none() {
            open.push((cell, error));
        }
    }
    let mut errors = Vec::new();
    for (cell, error) in &open {
        let fitted = [problem.fitted, std::slice::from_ref(error)].concat();
        let wider = Problem {
            fitted: &fitted,
            ..*problem
        };
        let fit = wider.fit(
            MeshOf::Answer,
            &found.difference,
            false,
            Some(last.emulator.clone()),
        );
        problem.check_stopped()?;
        let Ok(fit) = fit else { continue };
        if let Some(chance) = probability_of_gain(square(last), square(&fit), freedom, known) {
            errors.push(CellError {
                quantity,
                // Of several cells the most striking one is so by chance, too.
                probability: (chance * open.len() as f64).min(1.0),
                words: words(*cell, error, &fit),
            });
        }
    }
    let best = errors
        .into_iter()
        .min_by(|a, b| a.probability.total_cmp(&b.probability));
    Ok(best)
}

fn words((_, measured): Instrument, error: &Fitted, fit: &Fit) -> String {
    let (what, unit) = match error.unknown.quantity {
        Quantity::Drift => ("drift", "N a pass"),
        _ => ("zero offset", "N"),
    };
    let (first, size) = (&fit.estimates[0], fit.values().last().copied().unwrap_or(0.0));
    let (place, name, value) = (measured.place(), &first.name, first.value);
    format!(
        "a {what} of the {place} cell of about {size:.2} {unit} would explain them better and make {name} {value:.4}"
    )
}
