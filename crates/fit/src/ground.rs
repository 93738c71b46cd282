//! What another ground than the scene's would do to a fit that takes it as it is.

use super::meshes::Final;
use super::model::MeshOf;
use super::problem::Problem;
use super::unknown::Quantity;
use creepage_run::Error;

/// How much softer: about as well as a modulus is known from tests on the road.
const SOFTER: f64 = 0.1;
/// Size of a softening, in its standard errors, from which on readings show it.
const SHOWN: f64 = 3.0;

/// What a softer ground would do to the parameters, and whether the readings would show it; nothing where the ground is fitted.
pub fn assumption(problem: &Problem<'_>, found: &Final) -> Result<Option<String>, Error> {
    let mut fitted = problem.unknowns.iter().map(|unknown| unknown.quantity);
    if fitted.any(|quantity| quantity == Quantity::GroundStiffness) {
        return Ok(None);
    }
    let values = found.fit.values();
    // A difference of a tenth needs no fine mesh.
    let at = |stiffness| problem.predict(MeshOf::Guess, stiffness, &values);
    let (soft, here) = (at(1.0 - SOFTER)?, at(1.0)?);
    let change: Vec<f64> = soft.iter().zip(&here).map(|(soft, here)| soft - here).collect();
    let (shifts, left) = found.fit.shift(&change);
    let mut moved = Vec::new();
    for (estimate, shift) in found
        .fit
        .estimates
        .iter()
        .zip(&shifts)
        .take(problem.unknowns.len())
    {
        if let Some(error) = estimate.standard_error {
            let name = &estimate.name;
            moved.push(format!(
                "{name} by {:+.2e}, {shift:+.1} of its standard errors",
                shift * error
            ));
        }
    }
    if moved.is_empty() {
        return Ok(None);
    }
    let shown = if left < SHOWN {
        "and these readings cannot show it"
    } else {
        "though these readings would show it"
    };
    Ok(Some(format!(
        "the ground is that of the scene: one {:.0} % softer would move {}, {shown}; a measured deflection (--deflection) brings it in",
        100.0 * SOFTER,
        moved.join(" and "),
    )))
}
