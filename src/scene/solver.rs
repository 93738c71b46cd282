//! `[solver]`: how to compute.

use super::data::{Duct, Solver, SolverMethod};
use super::error::SceneError;
use super::keys;
use super::range::{APPROACH, Follows, STEP, TIME_STEP, TOLERANCE, node_spacings, vehicle_steps};
use super::table::Table;

pub fn solver(root: &Table, duct: &Duct) -> Result<Solver, SceneError> {
    let mut solver = Solver::default();
    let Some(section) = root.optional("solver") else {
        return Ok(solver);
    };
    let table = Table::new(section, keys::SOLVER)?;
    // A length that must suit the duct.
    let length = |key, range: Follows| {
        let value = table.optional(key);
        value.map(|value| value.quantity_within(STEP, range)).transpose()
    };
    solver.method = table.word("method", SolverMethod::WORDS, SolverMethod::Auto)?;
    if let Some(tolerance) = table.optional_quantity("tolerance", TOLERANCE)? {
        solver.tolerance = tolerance;
    }
    solver.node_spacing = length("node_spacing", node_spacings(duct.length))?;
    solver.vehicle_step = length("vehicle_step", vehicle_steps(duct.length))?;
    solver.time_step = table.optional_quantity("time_step", TIME_STEP)?;
    if !solver.method.has_time_steps() {
        let allowed = "`time_step` only with the method \"auto\", \"dynamic\" or \"explicit\"";
        table.refuse("time_step", "method", allowed)?;
        solver.time_step = None;
    }
    solver.approach = table.optional_quantity("approach", APPROACH)?;
    Ok(solver)
}
