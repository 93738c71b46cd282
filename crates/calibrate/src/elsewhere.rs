//! Where a model might fit as well, for all that its emulator knows.
//!
//! An emulator is right where its model ran: around the optimum that it found, and at the ends of the intervals. A valley elsewhere that it
//! takes for higher than it is would never be seen. So each parameter is led over its whole range, the others are fitted on the emulator, and
//! the model is asked wherever the emulator's own error might hide a fit as good (after D. R. Jones, M. Schonlau, W. J. Welch, "Efficient Global
//! Optimization of Expensive Black-Box Functions", Journal of Global Optimization 13, 1998, section 4.1).

use nalgebra::DVector;

use crate::descent::Optimum;
use crate::emulator::{Doubt, least_sure};
use crate::evaluator::Evaluator;
use crate::point::{Point, all_over};
use crate::search::{RIVAL, Search};
use crate::{CalibrationError, Emulator};

/// Values of each parameter over its range.
const VALUES: usize = 12;
/// Points of the others, for each of them, from the best of which they are fitted.
const SCAN: usize = 64;
/// Standard errors of the emulator by which the model might be better than it says.
const DOUBTS: f64 = 2.0;
/// Root of the rise by the emulator from which a place is not asked about.
const FAR: f64 = 5.0;

/// Places at which to ask the model, by its `emulator`, which `evaluator` runs; a `doubt` of less than `least` hides nothing.
pub(crate) fn places(
    evaluator: &Evaluator<'_>,
    emulator: &Emulator,
    optimum: &Optimum,
    mut doubt: Doubt,
    least: f64,
) -> Result<Vec<DVector<f64>>, CalibrationError> {
    let search = Search::new(evaluator);
    let mut left = Vec::new();
    for k in evaluator.calibration.of_model() {
        for value in 0..VALUES {
            let share = (value as f64 + 0.5) / VALUES as f64;
            let held = (share / (1.0 - share)).ln();
            left.push(with_others_fitted(&search, optimum, k, held)?);
        }
    }
    let root = |point: &Point| {
        let rise = optimum.deviance.total(&point.residuals) - optimum.value();
        rise.max(0.0).sqrt()
    };
    left.retain(|point| root(point) < FAR);
    // What would show as the same fit, or a better one.
    let allowed = |point: &Point| least.max((root(point) - RIVAL.sqrt()) / DOUBTS);
    let mut asked = Vec::new();
    loop {
        let size = |point: &Point| doubt.at(&emulator.place(&point.free)) / allowed(point);
        let Some(most) = least_sure(&left.iter().map(size).collect::<Vec<f64>>()) else {
            return Ok(asked);
        };
        let point = left.swap_remove(most);
        doubt.without(&emulator.place(&point.free));
        asked.push(point.free);
    }
}

/// The best fit on the emulator with free variable `k` held.
fn with_others_fitted(
    search: &Search<'_>,
    optimum: &Optimum,
    k: usize,
    held: f64,
) -> Result<Point, CalibrationError> {
    let others = optimum.point.free.len() - 1;
    let places = all_over(others, (SCAN * others).max(1));
    let places = places
        .into_iter()
        .map(|place| place.insert_row(k, held))
        .collect();
    let mut points = search.evaluator.points_with_terms(places, Some(k))?;
    let value = |point: &Point| optimum.deviance.total(&point.residuals);
    points.sort_by(|a, b| value(a).total_cmp(&value(b)));
    let best = points.swap_remove(0);
    if others == 0 || !value(&best).is_finite() {
        return Ok(best);
    }
    let descent = search.brief_descent(optimum.deviance, None, Some(k));
    Ok(descent.run(best)?.point)
}

#[cfg(test)]
mod tests {
    use nalgebra::{DVector, dvector};

    use super::places;
    use crate::evaluator::Evaluator;
    use crate::search::Search;
    use crate::{Calibration, CalibrationError, Emulator, ModelError, Parameter, Part, Scale};

    /// Where the second parameter does nothing that the emulator knows of, the model is asked all along it, until it is known.
    #[test]
    fn what_is_not_known_is_asked() -> Result<(), CalibrationError> {
        let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
            Ok((0..20).map(|k| p[0] * f64::from(k)).collect())
        };
        let parameters = ["slope", "idle"]
            .map(|name| Parameter::new(name, 0.0, 1.0, Scale::Linear))
            .into_iter()
            .collect::<Result<Vec<_>, _>>()?;
        let data: Vec<f64> = (0..20).map(|k| 0.4 * f64::from(k)).collect();
        let calibration = Calibration::new(&model, parameters.clone(), data)?.with_sigmas(vec![0.1; 20])?;
        let part = Part {
            predictions: 20,
            parameters: vec![0, 1],
        };
        let mut emulator = Emulator::new(&parameters, vec![part], None);
        let runs = Evaluator::new(&calibration);
        let learn = |emulator: &mut Emulator, places: Vec<DVector<f64>>| -> Result<(), CalibrationError> {
            for free in places {
                let predicted = runs.predict(&free)?.unwrap_or_default();
                emulator.learn([(free, predicted)]);
            }
            Ok(())
        };
        // Shares 0.1 to 0.9 of the slope, all at the middle of the other.
        let design = [-2.2, -0.8, -0.4, 0.0, 0.8, 2.2].map(|free| dvector![free, 0.0]);
        learn(&mut emulator, design.to_vec())?;
        let asked = |emulator: &Emulator| {
            let evaluator = Evaluator::emulated(&calibration, emulator);
            let search = Search::new(&evaluator);
            let (optimum, _) = search.best(&search.scan(None, 50)?)?;
            let doubt = emulator.doubt(|_| 100.0).expect("runs were learned");
            places(&evaluator, emulator, &optimum, doubt, 0.5)
        };
        let first = asked(&emulator)?;
        let reached = |sign: f64| first.iter().any(|free| sign * free[1] > 2.0);
        assert!(reached(-1.0) && reached(1.0), "{first:?}");
        // They lie in the emulator's valley, which bends back to its mean where it knows nothing.
        let slope = |free: &DVector<f64>| 1.0 / (1.0 + (-free[0]).exp());
        assert!(
            first.iter().all(|free| (slope(free) - 0.4).abs() < 0.1),
            "{first:?}"
        );
        // What it learns moves its valley, until it knows that there the second parameter does nothing.
        let mut rounds = vec![first.len()];
        learn(&mut emulator, first)?;
        while rounds.last().is_some_and(|&asked| asked > 0) && rounds.len() < 6 {
            let next = asked(&emulator)?;
            rounds.push(next.len());
            learn(&mut emulator, next)?;
        }
        assert_eq!(rounds.last(), Some(&0), "{rounds:?}");
        Ok(())
    }
}
