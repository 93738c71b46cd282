//! `[solver]`: how to compute.

use super::range::{self, APPROACH, Follows, POSITIVE, TOLERANCE};
use super::table::Table;
use super::{Dimension, Duct, SceneError, Solver, SolverMethod, keys};

const METHODS: &[(&str, SolverMethod)] = &[
    ("auto", SolverMethod::Auto),
    ("quasi-static", SolverMethod::QuasiStatic),
    ("dynamic", SolverMethod::Dynamic),
    ("explicit", SolverMethod::Explicit),
    ("pass-law", SolverMethod::PassLaw),
];

const DEFAULT_TOLERANCE: f64 = 0.01;

impl Default for Solver {
    fn default() -> Self {
        Self {
            method: SolverMethod::Auto,
            tolerance: DEFAULT_TOLERANCE,
            node_spacing: None,
            vehicle_step: None,
            time_step: None,
            approach: None,
        }
    }
}

pub(super) fn solver(root: &Table, duct: &Duct) -> Result<Solver, SceneError> {
    let Some(section) = root.optional("solver") else {
        return Ok(Solver::default());
    };
    let table = section.table(keys::SOLVER)?;
    let method = table.word("method", METHODS, SolverMethod::Auto)?;
    let tolerance = table.optional_quantity("tolerance", Dimension::Ratio, TOLERANCE, "0.01 or \"1 %\"")?;
    let spacings = range::node_spacings(duct.length);
    let node_spacing = length(&table, "node_spacing", spacings)?;
    let steps = range::vehicle_steps(duct.length);
    let vehicle_step = length(&table, "vehicle_step", steps)?;
    let mut time_step = table.optional_quantity("time_step", Dimension::Time, POSITIVE, "\"0.1 ms\"")?;
    if matches!(method, SolverMethod::QuasiStatic | SolverMethod::PassLaw) {
        let allowed = "`time_step` only with the method \"auto\", \"dynamic\" or \"explicit\"";
        table.refuse("time_step", "method", allowed)?;
        time_step = None;
    }
    let approach = table.optional_quantity("approach", Dimension::Length, APPROACH, "\"15 m\"")?;
    Ok(Solver {
        method,
        tolerance: tolerance.unwrap_or(DEFAULT_TOLERANCE),
        node_spacing,
        vehicle_step,
        time_step,
        approach,
    })
}

/// A length that must suit the duct.
fn length(table: &Table, key: &str, (range, words): Follows) -> Result<Option<f64>, SceneError> {
    let Some(value) = table.optional(key) else {
        return Ok(None);
    };
    let length = value.quantity(Dimension::Length, POSITIVE, "\"0.1 m\"")?;
    if range.contains(&length) {
        Ok(Some(length))
    } else {
        Err(value.out_of_range(words))
    }
}
