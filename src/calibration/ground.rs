//! What another ground than the scene's would do to a fit that takes it as it is.

use calibrate::TermTest;

use super::meshes::Final;
use super::problem::Problem;
use super::unknown::Quantity;
use crate::Error;

/// How much softer: about as well as a modulus is known from tests on the road.
const SOFTER: f64 = 0.1;
/// Size of a softening, in its standard errors, from which on readings show it.
const SHOWN: f64 = 3.0;

/// What a softer ground would do to the parameters, and whether the readings would show it; nothing where the ground is fitted.
pub fn assumption(problem: &Problem<'_>, found: &Final) -> Result<Option<String>, Error> {
    let is_ground = |quantity: Quantity| quantity == Quantity::GroundStiffness;
    if problem.unknowns.iter().any(|unknown| is_ground(unknown.quantity)) {
        return Ok(None);
    }
    let values = found.fit.values();
    // A difference of a tenth needs no fine mesh.
    let at = |stiffness| problem.predict(0, stiffness, &values);
    let (soft, here) = (at(1.0 - SOFTER)?, at(1.0)?);
    let change: Vec<f64> = soft.iter().zip(&here).map(|(soft, here)| soft - here).collect();
    let shifts = found.fit.shift(&change);
    let moved = found
        .fit
        .estimates
        .iter()
        .zip(&shifts)
        .take(problem.unknowns.len())
        .filter_map(|(estimate, shift)| {
            let error = estimate.standard_error?;
            Some(format!(
                "{} by {:+.2} of its standard errors of {error:.2e}",
                estimate.name, shift
            ))
        });
    let moved: Vec<String> = moved.collect();
    if moved.is_empty() {
        return Ok(None);
    }
    // In units of this softening.
    let test = TermTest::of(&found.fit, &change);
    let hidden = test.as_ref().is_none_or(|test| test.standard_error * SHOWN > 1.0);
    let shown = if hidden {
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
