//! Whether a fit can be believed: what its residuals say, and what they would call for.
//!
//! Residuals of a model that holds, read by a cell without faults, are noise: their signs change as coins do, they are as large as
//! neighbouring readings differ, no constant and no line explains a part of them, and none is far from all others.

use calibrate::{Fit, Loss, probability_of_scatter, probability_of_signs, probability_of_size};
use serde::Serialize;

use super::alternatives::{Alternative, alternatives};
use super::cell::Observed;
use super::meshes::Final;
use super::problem::Problem;
use super::terms::cells;
use super::unknown::Quantity;
use crate::Error;
use crate::readings::Reading;
use crate::scene::FrictionLaw;
use crate::shown::words_if;

/// Probability below which chance is no longer believed. Four tests then call about three clean series in a hundred suspicious.
const CHANCE: f64 = 0.01;
/// The same for errors of a cell, which move friction farthest where they show least: of 200 series with a drift of 0.8 N a pass 18 go unseen with
/// 0.02, 11 with 0.03 and 10 with 0.05, and of 200 clean ones 4, 6 and 14 seem to have such errors (tests/faulty_cells.rs).
const CHANCE_OF_ERRORS: f64 = 0.03;
/// Robust standard deviations from which on a reading is an outlier: of forty, Gaussian noise makes one in a thousand series.
const OUTLIER: f64 = 4.5;
/// Makes the median of |r| under Gaussian noise a standard deviation.
const MEDIAN_TO_SIGMA: f64 = 1.4826;
/// Weight below which a robust fit left a reading out.
pub const LEFT_OUT: f64 = 0.35;
/// Fewest readings that are judged beside the parameters.
const FEWEST: f64 = 3.0;

/// Whether the residuals are noise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LackOfFit {
    /// Probability of so few changes of sign by chance.
    pub p_runs: f64,
    /// Probability that noise alone shows so much drift; null where it is fitted or cannot be told.
    pub p_trend: Option<f64>,
    /// Probability that noise alone shows a zero that is off by so much; null as before.
    pub p_offset: Option<f64>,
    /// Probability of residuals so much larger than neighbouring readings differ: of an R² below what the noise explains.
    pub p_noise: Option<f64>,
    /// Probability of residuals so much larger than the sigmas of the readings; null where these have none.
    pub p_sigma: Option<f64>,
    /// Whether any of these is below 0.01 (0.03 of the second and third), readings are outliers, or the data look mistaken: then no parameter is called identifiable.
    pub suspicious: bool,
}

/// A verdict with its reasons.
pub struct Judgement {
    pub lack_of_fit: LackOfFit,
    pub warnings: Vec<String>,
}

/// Judges the fit; `mistakes` are those of sign and unit that were found.
pub fn judge(problem: &Problem<'_>, found: &Final, mistakes: Vec<String>) -> Result<Judgement, Error> {
    let fit = &found.fit;
    let rows = Rows::new(problem, fit);
    let outliers = rows.outliers();
    let sequences = rows.sequences(&outliers);
    let cells = cells(problem.series, problem.models);
    let judged: Vec<usize> = (0..rows.list.len())
        .filter(|row| !outliers.contains(row))
        .collect();
    // An error of a cell is smooth as well: it becomes part of the discrepancy.
    let hidden = problem.options.discrepancy.is_some() || !mistakes.is_empty();
    let alternatives = if fit.degrees_of_freedom < FEWEST || hidden {
        [None, None]
    } else {
        alternatives(problem, found, &cells, &judged)?
    };
    let [trend, offset] = [0, 1].map(|place| alternatives[place].as_ref().map(|found| found.probability));
    let used = rows.list.len() as f64 - fit.degrees_of_freedom;
    let mut lack_of_fit = LackOfFit {
        p_runs: probability_of_signs(&sequences),
        p_trend: trend,
        p_offset: offset,
        p_noise: probability_of_size(&sequences, used),
        p_sigma: (!fit.noise_estimated).then(|| probability_of_scatter(&sequences, used)),
        suspicious: false,
    };
    let misses = lack_of_fit.misses();
    let is_robust = problem.options.loss != Loss::Squares;
    let draw = !outliers.is_empty() && !is_robust;
    lack_of_fit.suspicious = misses || !mistakes.is_empty() || draw;
    let mut warnings = mistakes;
    if !outliers.is_empty() {
        warnings.push(rows.told(&outliers, is_robust));
    }
    if misses {
        warnings.push(explanation(problem, fit, &lack_of_fit, alternatives, draw));
    }
    Ok(Judgement {
        lack_of_fit,
        warnings,
    })
}

impl LackOfFit {
    fn misses(&self) -> bool {
        let strikes = |p: Option<f64>, chance: f64| p.is_some_and(|p| p < chance);
        strikes(Some(self.p_runs), CHANCE)
            || strikes(self.p_noise, CHANCE)
            || strikes(self.p_sigma, CHANCE)
            || strikes(self.p_trend, CHANCE_OF_ERRORS)
            || strikes(self.p_offset, CHANCE_OF_ERRORS)
    }
}

/// What the residuals show, and what may explain them.
fn explanation(
    problem: &Problem<'_>,
    fit: &Fit,
    lack: &LackOfFit,
    found: [Option<Alternative<'_>>; 2],
    has_outliers: bool,
) -> String {
    let chance = |p: f64| format!("{p:.1e}");
    let tests = [
        (Some(lack.p_runs), "they keep their sign"),
        (lack.p_noise, "they are larger than neighbouring readings differ"),
        (lack.p_sigma, "they are larger than their sigmas"),
    ];
    let struck = tests
        .into_iter()
        .filter_map(|(p, words)| Some((p.filter(|&p| p < CHANCE)?, words)));
    let mut shown: Vec<String> = struck
        .map(|(p, words)| format!("{words} (by chance {})", chance(p)))
        .collect();
    let mut best: Option<Alternative<'_>> = None;
    for found in found
        .into_iter()
        .flatten()
        .filter(|found| found.probability < CHANCE_OF_ERRORS)
    {
        let (what, unit) = match found.quantity {
            Quantity::Drift => ("a drift", "N a pass"),
            _ => ("a zero offset", "N"),
        };
        shown.push(format!(
            "{what} of the {} cell of about {:.2} {unit} would explain them better (by chance {}) and make {} {:.4}",
            found.cell.observed.place(),
            found.size,
            chance(found.probability),
            fit.estimates[0].name,
            found.first_value
        ));
        if best
            .as_ref()
            .is_none_or(|best| found.probability < best.probability)
        {
            best = Some(found);
        }
    }
    let is_fitted = |wanted| problem.unknowns.iter().any(|unknown| unknown.quantity == wanted);
    // A wrong shape factor looks like an error of the cell.
    let is_elastic = problem
        .series
        .iter()
        .any(|one| one.scene.friction.law() != FrictionLaw::Coulomb);
    let held = (is_elastic && !is_fitted(Quantity::ShapeFactor)).then_some(Quantity::ShapeFactor);
    let fit_it = |quantity: Quantity| {
        let fitted = problem.unknowns.iter().map(|unknown| unknown.quantity);
        let fitted = fitted
            .chain(held)
            .chain(problem.terms.iter().map(|term| term.quantity));
        let mut names: Vec<String> = fitted.chain([quantity]).map(|one| one.to_string()).collect();
        names.dedup();
        names.join(",")
    };
    let runs = problem.series.iter().any(|one| one.readings.runs().len() > 1);
    let way_out = match best {
        _ if has_outliers => "try --robust first, which leaves the outliers out".into(),
        Some(best) => format!("try --fit {}", fit_it(best.quantity)),
        None if runs => "see whether each run starts as it is taken to (--run-start), and whether ground and cable are those of the scene".into(),
        None => format!(
            "see whether ground, cable and vehicles are those of the scene; try --fit {} or ground_stiffness with --deflection{}",
            fit_it(Quantity::ZeroOffset),
            words_if(problem.options.discrepancy.is_none(), "; where the model itself is not the truth, --discrepancy makes the intervals as wide as that leaves them")
        ),
    };
    let explained = fit
        .r_squared
        .map_or_else(String::new, |r| format!(" (R² {r:.3})"));
    format!(
        "the model does not follow these readings{explained}: of the residuals, {}; values and intervals may be wrong, and no parameter is called \
         identifiable: {way_out}",
        shown.join(", ")
    )
}

/// The readings in the order in which their residuals are judged.
struct Rows<'a> {
    /// Row of the fit, series, and reading.
    list: Vec<(usize, usize, &'a Reading, Observed)>,
    /// Residuals in units of the sigmas, without what is most likely the discrepancy.
    standardised: Vec<f64>,
    weights: &'a [f64],
}

impl<'a> Rows<'a> {
    fn new(problem: &'a Problem<'_>, fit: &'a Fit) -> Self {
        let series = problem.series.iter().zip(problem.models).enumerate();
        let readings = series.flat_map(|(index, (one, model))| {
            let list = one.readings.readings().iter().zip(&model.observed);
            list.map(move |(reading, (_, observed))| (index, reading, *observed))
        });
        let list = readings
            .enumerate()
            .map(|(row, (index, reading, observed))| (row, index, reading, observed));
        Self {
            list: list.collect(),
            standardised: fit.standardised_noise(),
            weights: &fit.weights,
        }
    }

    /// Rows that lie far from all others.
    fn outliers(&self) -> Vec<usize> {
        let mut sizes: Vec<f64> = self.standardised.iter().map(|r| r.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let spread = MEDIAN_TO_SIGMA * sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
        let is_far =
            |&row: &usize| self.standardised[row].abs() > OUTLIER * spread || self.weights[row] < LEFT_OUT;
        let far: Vec<usize> = (0..self.standardised.len()).filter(is_far).collect();
        // Of so many, they are no outliers: the rest is not what they lie out of. Of few readings none is told apart.
        if self.standardised.len() < 6 || 4 * far.len() > self.standardised.len() {
            Vec::new()
        } else {
            far
        }
    }

    /// Residuals of each run and instrument, or of all that have one reading, in the order of the passes, without the outliers.
    fn sequences(&self, outliers: &[usize]) -> Vec<Vec<f64>> {
        let of = |&(row, ..): &(usize, usize, &Reading, Observed)| self.standardised[row];
        let groups = self.groups(outliers);
        groups
            .iter()
            .map(|group| group.iter().map(of).collect())
            .collect()
    }

    fn groups(&self, outliers: &[usize]) -> Vec<Vec<(usize, usize, &'a Reading, Observed)>> {
        let mut groups: Vec<Vec<(usize, usize, &Reading, Observed)>> = Vec::new();
        for one in self.list.iter().filter(|(row, ..)| !outliers.contains(row)) {
            let same = |group: &&mut Vec<(usize, usize, &Reading, Observed)>| {
                let (_, series, reading, observed) = group[0];
                (series, reading.run, observed) == (one.1, one.2.run, one.3)
            };
            match groups.iter_mut().find(same) {
                Some(group) => group.push(*one),
                None => groups.push(vec![*one]),
            }
        }
        for group in &mut groups {
            group.sort_by_key(|(_, _, reading, _)| reading.passes);
        }
        // Readings that are each of a run or an instrument of their own are judged as one series.
        let (mut groups, alone): (Vec<_>, Vec<_>) = groups.into_iter().partition(|group| group.len() > 1);
        let mut alone = alone.concat();
        alone.sort_by_key(|(row, _, reading, _)| (reading.passes, *row));
        groups.push(alone);
        groups
    }

    /// The outliers by pass and line.
    fn told(&self, outliers: &[usize], is_robust: bool) -> String {
        let several = self.list.iter().any(|(_, series, ..)| *series > 0);
        let one = |row: &usize| {
            let (_, series, reading, _) = &self.list[*row];
            let of_series = format!(" of series {}", series + 1);
            let (pass, of, line) = (reading.pass, words_if(several, &of_series), reading.line);
            format!("pass {pass}{of} (line {line})")
        };
        let list: Vec<String> = outliers.iter().map(one).collect();
        let count = if outliers.len() == 1 {
            "1 reading looks like an outlier".into()
        } else {
            format!("{} readings look like outliers", outliers.len())
        };
        let consequence = if is_robust {
            "left out"
        } else {
            "they draw the fit to themselves; --robust leaves them out"
        };
        format!("{count}: {}; {consequence}", list.join(", "))
    }
}
