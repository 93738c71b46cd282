//! What another ground than the scene's would do to a fit that takes it as it is.

use crate::meshes::Final;
use crate::model::MeshOf;
use crate::problem::Problem;
use crate::unknown::Quantity;
use creepage_run::Error;

/// How much softer: about as well as a modulus is known from tests on the road.
const SOFTER: f64 = 0.1;
/// Size of a softening, in its standard errors, from which on readings show it.
const SHOWN: f64 = 3.0;

/// What a softer ground would do to the parameters, and whether the readings would show it; nothing
/// where the ground is fitted.
pub fn assumption(problem: &Problem<'_>, found: &Final) -> Result<Option<String>, Error> {
    let (fitted, fit) = (problem.of_model(), &found.fit);
    let mut quantities = fitted.iter().map(|fitted| fitted.unknown.quantity);
    if quantities.any(|quantity| quantity == Quantity::GroundStiffness) {
        return Ok(None);
    }
    // A difference of a tenth needs no fine mesh.
    let at = |stiffness| problem.predict(MeshOf::Guess, stiffness, &fit.values());
    let (soft, here) = (at(1.0 - SOFTER)?, at(1.0)?);
    let change: Vec<f64> = soft.iter().zip(&here).map(|(soft, here)| soft - here).collect();
    let (shifts, left) = fit.shift(&change);
    let pairs = fit.estimates.iter().zip(shifts).take(fitted.len());
    let moved = pairs.filter_map(|(estimate, shift)| {
        let (name, change) = (&estimate.name, shift * estimate.standard_error?);
        Some(format!(
            "{name} by {change:+.2e}, {shift:+.1} of its standard errors"
        ))
    });
    let moved: Vec<String> = moved.collect();
    let shown = if left < SHOWN {
        "and these readings cannot show it"
    } else {
        "though these readings would show it"
    };
    let (percent, moves) = (100.0 * SOFTER, moved.join(" and "));
    let words = format!(
        "the ground is that of the scene: one {percent:.0} % softer would move {moves}, {shown}; a measured \
         deflection (--deflection) brings it in"
    );
    Ok(Some(words).filter(|_| !moved.is_empty()))
}
