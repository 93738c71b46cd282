//! `[solver]`: how to compute.

use super::range::{APPROACH, POSITIVE, TOLERANCE, shown};
use super::table::Table;
use super::{Dimension, Duct, SceneError, Solver, SolverMethod, keys};

const METHODS: &[(&str, SolverMethod)] = &[
    ("auto", SolverMethod::Auto),
    ("quasi-static", SolverMethod::QuasiStatic),
    ("dynamic", SolverMethod::Dynamic),
    ("explicit", SolverMethod::Explicit),
    ("pass-law", SolverMethod::PassLaw),
];

/// Most nodes or vehicle steps over the duct.
const FINEST: f64 = 1e6;
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
    let node_spacing = table.optional_quantity("node_spacing", Dimension::Length, POSITIVE, "\"0.1 m\"")?;
    if let (Some(spacing), Some(value)) = (node_spacing, table.optional("node_spacing"))
        && !(duct.length / FINEST..=duct.length / 2.0).contains(&spacing)
    {
        let allowed = format!(
            "at most half the duct's length, {} m, and at least its millionth part",
            shown(duct.length / 2.0)
        );
        return Err(value.out_of_range(allowed));
    }
    let vehicle_step = table.optional_quantity("vehicle_step", Dimension::Length, POSITIVE, "\"0.1 m\"")?;
    if let (Some(step), Some(value)) = (vehicle_step, table.optional("vehicle_step"))
        && !(duct.length / FINEST..=duct.length).contains(&step)
    {
        let allowed = format!(
            "at most the duct's length, {} m, and at least its millionth part",
            shown(duct.length)
        );
        return Err(value.out_of_range(allowed));
    }
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
