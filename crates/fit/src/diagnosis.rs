//! Whether a fit can be believed: what its residuals say, and what they would call for.
//!
//! Residuals of a model that holds, read by a cell without faults, are noise: their signs change as
//! coins do, they are as large as neighbouring readings differ, no constant and no line explains a
//! part of them, and none is far from all others.

use calibrate::{Loss, probability_of_scatter, probability_of_signs, probability_of_size};

use crate::cell_errors::{CellError, cell_error};
use crate::instrument::each_once;
use crate::meshes::Final;
use crate::noise::{MEDIAN_TO_SIGMA, median};
use crate::problem::Problem;
use crate::readings::Reading;
use crate::result::{LackOfFit, misses_by};
use crate::unknown::Quantity;
use creepage_plan::shown::words_if;
use creepage_run::Error;
use creepage_scene::FrictionLaw;

/// Probability below which chance is no longer believed. Four tests then call about three clean
/// series in a hundred suspicious.
const CHANCE: f64 = 0.01;
/// The same for errors of a cell, which move friction farthest where they show least: of 200 series
/// with a drift of 0.8 N a pass 18 go unseen with 0.02, 11 with 0.03 and 10 with 0.05, and of 200
/// clean ones 4, 6 and 14 seem to have such errors (tests/faulty_cells.rs).
const CHANCE_OF_ERRORS: f64 = 0.03;
/// Robust standard deviations from which on a reading is an outlier: of forty, Gaussian noise makes
/// one in a thousand series.
const OUTLIER: f64 = 4.5;
/// Weight below which a robust fit left a reading out.
pub const LEFT_OUT: f64 = 0.35;
/// Minimum number of readings in excess of the parameters.
const MIN_FREEDOM: f64 = 3.0;

/// Judges the fit, which explains the share `r_squared` of the readings; `mistakes` are those of
/// sign and unit that were found. Verdict and warnings.
pub fn diagnose(
    problem: &Problem<'_>,
    found: &Final,
    mistakes: Vec<String>,
    r_squared: Option<f64>,
) -> Result<(LackOfFit, Vec<String>), Error> {
    let (fit, rows) = (&found.fit, problem.rows);
    let noise = fit.standardised_noise();
    let outliers = outliers(&noise, &fit.weights);
    let judged: Vec<usize> = (0..noise.len()).filter(|row| !outliers.contains(row)).collect();
    let sequences = sequences(rows, &noise, &judged);
    // An error of a cell is smooth as well: it becomes part of the discrepancy.
    let hidden = problem.options.discrepancy.is_some() || !mistakes.is_empty();
    let is_stated = fit.degrees_of_freedom >= MIN_FREEDOM && !hidden;
    let of_cell = |quantity| {
        let error = is_stated.then(|| cell_error(problem, found, quantity, &judged));
        error.unwrap_or(Ok(None))
    };
    let errors = [of_cell(Quantity::Drift)?, of_cell(Quantity::ZeroOffset)?];
    let [p_trend, p_offset] = errors.each_ref().map(|error| Some(error.as_ref()?.probability));
    let used = noise.len() as f64 - fit.degrees_of_freedom;
    let mut lack_of_fit = LackOfFit {
        p_runs: probability_of_signs(&sequences),
        p_trend,
        p_offset,
        p_noise: probability_of_size(&sequences, used),
        p_sigma: (!fit.noise_estimated).then(|| probability_of_scatter(&sequences, used)),
        suspicious: false,
    };
    let failed = failed_tests(&lack_of_fit, &errors, r_squared);
    let is_robust = problem.options.loss != Loss::Squares;
    let draw = !outliers.is_empty() && !is_robust;
    lack_of_fit.suspicious = !failed.is_empty() || !mistakes.is_empty() || draw;
    let mut warnings = mistakes;
    if !outliers.is_empty() {
        warnings.push(outlier_words(rows, &outliers, is_robust));
    }
    if !failed.is_empty() {
        let errors = errors.iter().flatten();
        let best = errors.min_by(|a, b| a.probability.total_cmp(&b.probability));
        let best = best.filter(|error| error.probability < CHANCE_OF_ERRORS);
        let explained = r_squared.map_or_else(String::new, |r| format!(" (R² {r:.3})"));
        let way_out = way_out(problem, best.map(|error| error.quantity), draw);
        let failed = failed.join(", ");
        warnings.push(format!(
            "the model does not follow these readings{explained}: of the residuals, {failed}; values and intervals \
             may be wrong, and no parameter is called identifiable: {way_out}"
        ));
    }
    Ok((lack_of_fit, warnings))
}

/// The tests that the residuals fail, each in words.
fn failed_tests(lack: &LackOfFit, errors: &[Option<CellError>; 2], r_squared: Option<f64>) -> Vec<String> {
    let errors = errors.each_ref().map(Option::as_ref);
    let [drift, offset] = errors.map(|error| error.map_or("", |error| &error.words));
    let larger = "they are larger than neighbouring readings differ";
    let tests = [
        (Some(lack.p_runs), CHANCE, "they keep their sign"),
        (lack.p_noise, CHANCE, larger),
        (lack.p_sigma, CHANCE, "they are larger than their sigmas"),
        (lack.p_trend, CHANCE_OF_ERRORS, drift),
        (lack.p_offset, CHANCE_OF_ERRORS, offset),
    ];
    let failed = tests.into_iter().filter_map(|(p, chance, words)| {
        let p = p.filter(|p| *p < chance)?;
        Some(format!("{words} (by chance {p:.1e})"))
    });
    let missed = "they are many times the spread of the readings".to_owned();
    failed.chain(misses_by(r_squared).map(|_| missed)).collect()
}

/// What to try where tests fail: to fit the `error` of a cell that would explain the residuals
/// best, or what else.
fn way_out(problem: &Problem<'_>, error: Option<Quantity>, has_outliers: bool) -> String {
    let (of_model, models) = (problem.of_model().len(), problem.models);
    let mut fitted: Vec<Quantity> = problem.fitted.iter().map(|one| one.unknown.quantity).collect();
    // A wrong shape factor looks like an error of the cell.
    let mut laws = models.iter().map(|model| model.scene.friction.law());
    if laws.any(|law| law != FrictionLaw::Coulomb) && !fitted.contains(&Quantity::ShapeFactor) {
        fitted.insert(of_model, Quantity::ShapeFactor);
    }
    let fit_it = |quantity: Quantity| {
        let all = fitted.iter().chain([&quantity]);
        let mut names: Vec<String> = all.map(ToString::to_string).collect();
        names.dedup();
        names.join(",")
    };
    let discrepancy = words_if(
        problem.options.discrepancy.is_none(),
        "; where the model itself is not the truth, --discrepancy makes the intervals as wide as that leaves them",
    );
    match error {
        _ if has_outliers => "try --robust first, which leaves the outliers out".into(),
        Some(quantity) => format!("try --fit {}", fit_it(quantity)),
        None if models.iter().any(|model| model.readings.runs.len() > 1) => {
            "see whether each run starts as it is taken to (--run-start), and whether ground and cable are those of \
             the scene"
                .into()
        }
        None => format!(
            "see whether ground, cable and vehicles are those of the scene; try --fit {} or ground_stiffness with \
             --deflection{discrepancy}",
            fit_it(Quantity::ZeroOffset),
        ),
    }
}

/// Rows whose residual lies far from all others, or which a robust fit left out.
fn outliers(noise: &[f64], weights: &[f64]) -> Vec<usize> {
    let spread = MEDIAN_TO_SIGMA * median(noise.iter().map(|r| r.abs()));
    let is_far = |&row: &usize| noise[row].abs() > OUTLIER * spread || weights[row] < LEFT_OUT;
    let far: Vec<usize> = (0..noise.len()).filter(is_far).collect();
    // Of so many, they are no outliers: the rest is not what they lie out of. Of few readings none
    // is distinguished.
    let are_outliers = noise.len() >= 6 && 4 * far.len() <= noise.len();
    if are_outliers { far } else { Vec::new() }
}

/// Residuals of each run and instrument, or of all that have one reading, in the order of the
/// passes.
fn sequences(rows: &[Reading], noise: &[f64], judged: &[usize]) -> Vec<Vec<f64>> {
    let key = |row: usize| (rows[row].instrument(), rows[row].run);
    let group = |of| judged.iter().copied().filter(|&row| key(row) == of).collect();
    let groups = each_once(judged.iter().map(|&row| key(row)))
        .into_iter()
        .map(group);
    // Readings that are each of a run or an instrument of their own are judged as one series.
    let (mut groups, alone): (Vec<Vec<usize>>, Vec<_>) =
        groups.partition(|group: &Vec<usize>| group.len() > 1);
    groups.push(alone.concat());
    for group in &mut groups {
        group.sort_by_key(|&row| rows[row].passes);
    }
    let residuals = |group: &Vec<usize>| group.iter().map(|&row| noise[row]).collect();
    groups.iter().map(residuals).collect()
}

/// The outliers by pass and line.
fn outlier_words(rows: &[Reading], outliers: &[usize], is_robust: bool) -> String {
    let several = rows.iter().any(|row| row.series > 0);
    let one = |&row: &usize| {
        let Reading {
            series, pass, line, ..
        } = rows[row];
        let of = if several {
            format!(" of series {}", series + 1)
        } else {
            String::new()
        };
        format!("pass {pass}{of} (line {line})")
    };
    let passes: Vec<String> = outliers.iter().map(one).collect();
    let count = match outliers.len() {
        1 => "1 reading looks like an outlier".into(),
        count => format!("{count} readings look like outliers"),
    };
    let consequence = if is_robust {
        "left out"
    } else {
        "they draw the fit to themselves; --robust leaves them out"
    };
    format!("{count}: {}; {consequence}", passes.join(", "))
}
