//! Would an error of a load cell explain the readings better?
//!
//! Where an error of the cell has led the fit far away, only a fit with the error shows what it explains.

use calibrate::{Fit, probability_of_gain};

use super::meshes::Final;
use super::model::MeshOf;
use super::problem::{Problem, Way};
use super::terms::{Cell, term};
use super::unknown::Quantity;
use creepage_run::Error;

/// Model runs that each may take.
const RUNS: usize = 400;

/// An error of a cell that would explain readings.
pub struct Alternative<'a> {
    pub cell: &'a Cell,
    pub quantity: Quantity,
    /// Its size.
    pub size: f64,
    /// What the first parameter would then be.
    pub first_value: f64,
    /// Probability that noise alone gains so much by it.
    pub probability: f64,
}

impl Alternative<'_> {
    /// What it would do, to the parameter called `first` too.
    pub fn words(&self, first: &str) -> String {
        let (what, unit) = match self.quantity {
            Quantity::Drift => ("drift", "N a pass"),
            _ => ("zero offset", "N"),
        };
        let (place, size, value) = (self.cell.observed.place(), self.size, self.first_value);
        format!(
            "a {what} of the {place} cell of about {size:.2} {unit} would explain them better and make {first} {value:.4}"
        )
    }
}

/// The most striking error of this kind, of all cells; `rows` are judged.
pub fn alternative<'a>(
    problem: &Problem<'_>,
    found: &Final,
    quantity: Quantity,
    cells: &'a [Cell],
    rows: &[usize],
) -> Result<Option<Alternative<'a>>, Error> {
    let last = &found.fit;
    let square = |fit: &Fit| -> f64 {
        let residuals = fit.standardised_noise();
        rows.iter().map(|&row| residuals[row].powi(2)).sum()
    };
    let known = (!last.noise_estimated).then_some(1.0);
    let freedom = last.degrees_of_freedom - 1.0 - (last.residuals.len() - rows.len()) as f64;
    let is_open = |cell: &&Cell| {
        let name = cell.name(quantity, problem.series.len());
        problem.terms.iter().all(|term| term.parameter.name() != name)
    };
    let open: Vec<&Cell> = cells.iter().filter(is_open).collect();
    let mut best: Option<Alternative<'_>> = None;
    for &cell in &open {
        let Some(fit) = with_error(problem, found, cell, quantity)? else {
            continue;
        };
        let Some(chance) = probability_of_gain(square(last), square(&fit), freedom, known) else {
            continue;
        };
        // Of several cells the most striking one is so by chance, too.
        let probability = (chance * open.len() as f64).min(1.0);
        if best.as_ref().is_none_or(|best| probability < best.probability) {
            best = Some(Alternative {
                cell,
                quantity,
                size: fit.values().last().copied().unwrap_or(0.0),
                first_value: fit.values()[0],
                probability,
            });
        }
    }
    Ok(best)
}

/// The fit with an error of a cell more; nothing where it does not converge.
fn with_error(
    problem: &Problem<'_>,
    found: &Final,
    cell: &Cell,
    quantity: Quantity,
) -> Result<Option<Fit>, Error> {
    let more = term(
        cell,
        quantity,
        &cell.name(quantity, problem.series.len()),
        problem.options,
    )?;
    let terms: Vec<_> = problem.terms.iter().cloned().chain([more]).collect();
    let wider = Problem {
        terms: &terms,
        ..*problem
    };
    let way = Way {
        mesh: MeshOf::Answer,
        difference: &found.difference,
        profiles: false,
        runs: found.evaluations + RUNS,
    };
    match wider.fit(way, Some(found.fit.emulator.clone())) {
        Ok(fit) => Ok(Some(fit)),
        Err(_) if problem.watch.is_stopped() => Err(Error::Stopped),
        Err(_) => Ok(None),
    }
}
