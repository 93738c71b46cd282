//! Terms: what an instrument adds to the predictions.

use std::sync::atomic::{AtomicUsize, Ordering};

use calibrate::{Calibration, Estimate, Fit, ModelError, Parameter, Prior, Scale};

use super::common::{answering, assert_near, fitted, linear, logarithmic, noisy};

const PASSES: usize = 30;

fn column(value: impl Fn(f64) -> f64) -> Vec<f64> {
    (1..=PASSES).map(|pass| value(pass as f64)).collect()
}

/// A force that levels off, read by a cell that is off by 20 N and drifts by 1.5 N a pass.
fn observations() -> Vec<f64> {
    let exact = column(|pass| 550.0 * (1.0 - (-pass / 6.0).exp()) + 20.0 + 1.5 * pass);
    noisy(&exact, 4.0, 3)
}

fn parameters() -> Vec<Parameter> {
    let force = logarithmic("force", 100.0, 2000.0);
    vec![force, logarithmic("passes", 1.0, 100.0)]
}

/// Terms of the instrument, or as many parameters of a model that computes them.
fn instrument(of_model: bool) -> Vec<Parameter> {
    let one = |name, bound: f64, column: Vec<f64>, sigma| {
        let term = if of_model {
            Parameter::new(name, -bound, bound, Scale::Linear)
        } else {
            Parameter::term(name, -bound, bound, &column)
        };
        term.unwrap().with_prior(Prior { value: 0.0, sigma }).unwrap()
    };
    vec![
        one("zero_offset", 500.0, column(|_| 1.0), 100.0),
        one("drift", 20.0, column(|pass| pass), 5.0),
    ]
}

fn assert_alike(one: &Fit, other: &Fit, tolerance: f64) {
    for (a, b) in one.estimates.iter().zip(&other.estimates) {
        let read = |estimate: &Estimate| {
            let Estimate { value, interval, .. } = estimate;
            [*value, interval.lower.unwrap(), interval.upper.unwrap()]
        };
        let error = b.standard_error.unwrap();
        for ((one, other), share) in read(a).into_iter().zip(read(b)).zip([1.0, 2.0, 2.0]) {
            assert_near(one, other, share * tolerance * error);
        }
    }
}

/// The same as if the model computed it, with runs for its own parameters alone.
#[test]
fn terms_fit_as_a_models_parameters_do() {
    let runs = AtomicUsize::new(0);
    let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
        runs.fetch_add(1, Ordering::Relaxed);
        assert_eq!(p.len(), 2);
        Ok(column(|pass| p[0] * (1.0 - (-pass / p[1]).exp())))
    };
    let all = answering(|p| column(|pass| p[0] * (1.0 - (-pass / p[1]).exp()) + p[2] + p[3] * pass));
    let with = |of_model| [parameters(), instrument(of_model)].concat();
    let expected = fitted(&all, with(true), observations(), None);
    let fit = fitted(&model, with(false), observations(), None);
    assert_alike(&fit, &expected, 0.03);
    assert!(runs.into_inner() <= 60, "{}", fit.evaluations);
}

/// What the parameters can make good, and what they cannot: a constant and a parabola in addition to a line, whose
/// distance from the nearest line is exact.
#[test]
fn what_the_parameters_make_good_is_told() {
    let model = answering(|p| column(|pass| p[0] + p[1] * pass));
    let of = |name| linear(name, -1e4, 1e4);
    let line = column(|pass| 100.0 + pass);
    let fit = fitted(&model, vec![of("a"), of("b")], line, Some(4.0));
    let (moved, left) = fit.shift(&column(|_| 1.0));
    let moved = moved[0] * fit.estimates[0].standard_error.unwrap();
    assert_near(moved, -1.0, 1e-3);
    assert_near(left, 0.0, 1e-3);
    // Σ of the squared values of the orthogonal polynomial of second degree, n (n² − 1)(n² − 4)/180.
    let n = PASSES as f64;
    let parabola = (n * (n * n - 1.0) * (n * n - 4.0) / 180.0).sqrt();
    let (_, left) = fit.shift(&column(|pass| pass * pass));
    assert_near(left * 4.0, parabola, 1e-3 * parabola);
}

#[test]
fn bad_columns_are_named() {
    assert!(Parameter::term("zero", -1.0, 1.0, &[1.0, f64::NAN]).is_err());
    let model = answering(|_| vec![0.0; 3]);
    let short = Parameter::term("zero", -1.0, 1.0, &[1.0, 1.0]).unwrap();
    let error = Calibration::new(&model, vec![short], vec![1.0, 2.0, 3.0]).err();
    let error = error.unwrap().to_string();
    assert!(error.contains("entries in the column of zero"), "{error}");
}
