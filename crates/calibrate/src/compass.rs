//! Minimum by trial along each variable, where Levenberg–Marquardt is stuck.
//!
//! Gauss–Newton's idea of the deviance fails where the model cannot reach the data: at the largest force that any friction gives,
//! the slope vanishes while the residual does not. There each variable is tried in turn to either side, and the parabola through the
//! three deviances says how far the minimum is (R. Hooke, T. A. Jeeves, "Direct search", Journal of the ACM 8, 1961; with the
//! parabola as in R. P. Brent, Algorithms for Minimization without Derivatives, 1973).

use crate::CalibrationError;
use crate::deviance::Deviance;
use crate::evaluator::Evaluator;
use crate::parameter::FARTHEST;
use crate::search::Point;

/// First step, and the factors by which it grows after a success and shrinks after a failure.
const FIRST_STEP: f64 = 0.1;
const GROWTH: f64 = 2.0;
const SHRINKAGE: f64 = 0.25;
/// Rounds over all variables.
const MAX_ROUNDS: usize = 25;

/// A minimum near `point`, and by how many standard errors it may still be missed; `None` if it was not found.
pub(crate) fn settle(
    evaluator: &Evaluator<'_>,
    deviance: &Deviance,
    mut point: Point,
    tolerance: f64,
) -> Result<Option<(Point, f64)>, CalibrationError> {
    let count = point.free.len();
    let mut lowest = deviance.total(&point.residuals);
    let mut steps = vec![FIRST_STEP; count];
    for _ in 0..MAX_ROUNDS {
        let mut left = 0.0;
        for (k, step) in steps.iter_mut().enumerate() {
            let here = point.free[k];
            let at = |offset: f64| {
                let mut free = point.free.clone();
                free[k] = (here + offset).clamp(-FARTHEST, FARTHEST);
                let residuals = evaluator.residuals(&free)?;
                Ok::<_, CalibrationError>((deviance.total(&residuals), Point { free, residuals }))
            };
            let (below, above) = (at(-*step)?, at(*step)?);
            let bend = below.0 + above.0 - 2.0 * lowest;
            let tilt = 0.5 * (below.0 - above.0);
            let best = if below.0 < above.0 { below } else { above };
            if best.0 < lowest {
                left += lowest - best.0;
                (lowest, point) = best;
                *step *= GROWTH;
                continue;
            }
            // Nothing bends where all three are equal, or where the model has no answer on both sides.
            let gain = if bend > 0.0 && bend.is_finite() {
                0.5 * tilt * tilt / bend
            } else {
                0.0
            };
            left += gain;
            if gain > tolerance * tolerance / count as f64 {
                let vertex = at(*step * tilt / bend)?;
                if vertex.0 < lowest {
                    (lowest, point) = vertex;
                }
                *step *= SHRINKAGE;
            }
        }
        if left < tolerance * tolerance {
            return Ok(Some((point, left.sqrt())));
        }
    }
    Ok(None)
}
