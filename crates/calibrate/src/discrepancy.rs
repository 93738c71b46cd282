//! Smooth functions, by a sum of which a model may be off.

/// Distance of neighbouring functions, in lengths of correlation: their squares then sum up to 1 within
/// 1e-3.
const SPACING: f64 = 0.75;
/// How far beyond the places functions begin, in lengths of correlation.
const MARGIN: f64 = 2.0;

/// Functions of `places`, each with a value at each place, of which a sum with independent standard normal
/// coefficients is a Gaussian process: its covariance at a distance d is exp(−d²/(2 length²)). They are bells
/// φ(x) = √(h/length) (2/π)^(1/4) exp(−(x − s)²/length²) whose centres s lie h apart. None if a place or
/// the length is no finite number, the length is not positive, or there would be more than a thousand.
///
/// ```
/// use calibrate::{Calibration, ModelError, Parameter, Scale, smooth_functions};
///
/// // A line of slope 1 with a wave on it, read to 0.01; the model is the line alone.
/// let places: Vec<f64> = (1..=20).map(|k| 0.05 * f64::from(k)).collect();
/// let noise = |k: usize| if k % 2 == 0 { 0.01 } else { -0.01 };
/// let measured = places.iter().enumerate().map(|(k, x)| x + 0.05 * (4.0 * x).cos() + noise(k)).collect();
/// let line = |p: &[f64]| -> Result<Vec<f64>, ModelError> { Ok(places.iter().map(|x| p[0] * x).collect()) };
/// let slope = Parameter::new("slope", 0.0, 10.0, Scale::Linear)?;
/// let plain = Calibration::new(&line, vec![slope], measured)?;
/// // It may be off by 0.1, over lengths of 0.5.
/// let mut functions = smooth_functions(&places, 0.5);
/// functions.iter_mut().flatten().for_each(|value| *value *= 0.1);
/// let allowed = plain.clone().with_discrepancy(&functions)?;
/// assert!(!plain.fit()?.estimates[0].interval.contains(1.0));
/// assert!(allowed.fit()?.estimates[0].interval.contains(1.0));
/// # Ok::<(), calibrate::CalibrationError>(())
/// ```
pub fn smooth_functions(places: &[f64], length: f64) -> Vec<Vec<f64>> {
    let lower = places.iter().copied().fold(f64::INFINITY, f64::min) - MARGIN * length;
    let upper = places.iter().copied().fold(f64::NEG_INFINITY, f64::max) + MARGIN * length;
    let count = (upper - lower) / (SPACING * length);
    if !(0.0..1000.0).contains(&count) {
        return Vec::new();
    }
    let size = SPACING.sqrt() * std::f64::consts::FRAC_2_PI.powf(0.25);
    let bell = |index: usize| -> Vec<f64> {
        let centre = lower + index as f64 * SPACING * length;
        let value = |place: &f64| size * (-((place - centre) / length).powi(2)).exp();
        places.iter().map(value).collect()
    };
    (0..=count.ceil() as usize).map(bell).collect()
}

#[cfg(test)]
mod tests {
    use super::smooth_functions;

    #[test]
    fn covariance_is_that_of_the_process() {
        let places: Vec<f64> = (0..50).map(|k| 0.37 * f64::from(k)).collect();
        let functions = smooth_functions(&places, 2.0);
        for (i, one) in places.iter().enumerate() {
            for (j, other) in places.iter().enumerate() {
                let found: f64 = functions.iter().map(|f| f[i] * f[j]).sum();
                let wanted = (-0.125 * (one - other).powi(2)).exp();
                assert!((found - wanted).abs() < 1e-3, "{found} {wanted}");
            }
        }
        assert!(smooth_functions(&[1.0, f64::NAN], f64::NAN).is_empty());
        assert!(smooth_functions(&[1.0, 1e9], 1.0).is_empty());
    }
}
