//! Would an error of a load cell explain the readings better?
//!
//! The score test looks from the optimum; where an error of the cell has led the fit far away, only
//! a fit with the error shows what it explains. These fits run on the coarsest mesh, corrected by
//! what the final one says more at the optimum, where most runs are known. What they find is looked
//! at on the final mesh.

use calibrate::{Fit, probability_of_gain};

use super::meshes::Final;
use super::problem::Problem;
use super::terms::{Cell, Term, term};
use super::unknown::Quantity;
use crate::Error;

/// Probability on the coarsest mesh below which the final one is asked.
const WORTH_ASKING: f64 = 0.3;
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

/// The most striking error of each kind, of all cells; `rows` are judged.
pub fn alternatives<'a>(
    problem: &Problem<'_>,
    found: &Final,
    cells: &'a [Cell],
    rows: &[usize],
) -> Result<[Option<Alternative<'a>>; 2], Error> {
    let coarse = problem.predict(0, 1.0, &found.fit.values())?;
    let pairs = found.fit.fitted.iter().zip(coarse);
    let fits = Fits {
        problem,
        found,
        correction: pairs.map(|(fine, coarse)| fine - coarse).collect(),
        rows,
    };
    let Some(plain) = fits.fit(0, None)? else {
        return Ok([None, None]);
    };
    // The final fit is one without the error as well; scatter between meshes must not count for the
    // error.
    let before = fits.square(&plain).min(fits.square(&found.fit));
    let mut best = [None, None];
    for (best, quantity) in best.iter_mut().zip([Quantity::Drift, Quantity::ZeroOffset]) {
        let name = |cell: &Cell| cell.name(quantity, problem.series.len());
        let is_fitted = |cell: &Cell| {
            let mut terms = problem.terms.iter();
            terms.any(|term| term.parameter.name() == name(cell))
        };
        let open: Vec<&Cell> = cells.iter().filter(|cell| !is_fitted(cell)).collect();
        for cell in &open {
            let error = term(cell, quantity, &name(cell), problem.options)?;
            let Some((fit, chance)) = fits.with(before, error)? else {
                continue;
            };
            let one = Alternative {
                cell,
                quantity,
                size: fit.values().last().copied().unwrap_or(0.0),
                first_value: fit.values()[0],
                // Of several cells the most striking one is so by chance, too.
                probability: (chance * open.len() as f64).min(1.0),
            };
            let old: &Option<Alternative<'_>> = best;
            if old.as_ref().is_none_or(|old| one.probability < old.probability) {
                *best = Some(one);
            }
        }
    }
    Ok(best)
}

struct Fits<'a> {
    problem: &'a Problem<'a>,
    found: &'a Final,
    correction: Vec<f64>,
    rows: &'a [usize],
}

impl Fits<'_> {
    /// The fit with an error of a cell, and the probability that noise alone gains so much by it,
    /// where without it the squares on the coarsest mesh were `before`; nothing where it does not
    /// converge or cannot be told.
    fn with(&self, before: f64, error: Term) -> Result<Option<(Fit, f64)>, Error> {
        let last = &self.found.fit;
        let Some(fit) = self.fit(0, Some(error.clone()))? else {
            return Ok(None);
        };
        let Some(chance) = self.probability(before, &fit) else {
            return Ok(None);
        };
        // Where an interval is open, what fits as well may lie so far away that the correction does
        // not hold there.
        let is_open = last.estimates.iter().any(|estimate| !estimate.identifiable);
        if (chance < WORTH_ASKING || is_open)
            && let Some(finer) = self.fit(self.found.level, Some(error))?
            && let Some(finer_chance) = self.probability(self.square(last), &finer)
        {
            return Ok(Some((finer, finer_chance)));
        }
        Ok(Some((fit, chance)))
    }

    fn probability(&self, before: f64, fit: &Fit) -> Option<f64> {
        let last = &self.found.fit;
        let known = (!last.noise_estimated).then_some(1.0);
        let freedom = last.degrees_of_freedom - 1.0 - (last.residuals.len() - self.rows.len()) as f64;
        probability_of_gain(before, self.square(fit), freedom, known)
    }

    /// A fit on a level of meshes, the coarsest or the final one, with a term more or without;
    /// nothing where it does not converge.
    fn fit(&self, level: u32, more: Option<Term>) -> Result<Option<Fit>, Error> {
        let terms: Vec<Term> = self.problem.terms.iter().cloned().chain(more).collect();
        let problem = Problem {
            terms: &terms,
            ..*self.problem
        };
        let is_final = level == self.found.level;
        let correction = if is_final {
            self.found.correction.clone()
        } else {
            Some(self.correction.clone())
        };
        let model = problem.model(level, correction);
        let known = if is_final {
            &self.found.fit.emulator
        } else {
            &self.found.coarsest
        };
        let calibration = problem.calibration(&model, false, RUNS)?;
        match calibration.with_coarse(known.clone()).fit() {
            Ok(fit) => Ok(Some(fit)),
            Err(_) if problem.watch.is_stopped() => Err(Error::Stopped),
            Err(_) => Ok(None),
        }
    }

    /// Sum of the squared residuals in units of the sigmas.
    fn square(&self, fit: &Fit) -> f64 {
        let residuals = fit.standardised_noise();
        self.rows.iter().map(|&row| residuals[row].powi(2)).sum()
    }
}
