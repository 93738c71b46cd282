//! Fits of closed forms: exact answers, exact covariances, coverage, and what cannot be known.

use std::error::Error;
use std::sync::atomic::{AtomicUsize, Ordering};

use calibrate::{Calibration, CalibrationError, Loss, Model, ModelError, Parameter, Prior, Scale, Warning};
use fastrand::Rng;

use super::common::{
    answering, assert_near, fitted, fitted_with, linear, logarithmic, measured, noisy, passes, saturation,
    saturation_parameters,
};

#[test]
fn exact_data_return_the_parameters() {
    let model = saturation(&passes(40));
    for truth in [[550.0, 20.0], [900.0, 3.0], [40.0, 200.0]] {
        let data = model.predict(&truth).unwrap();
        let fit = fitted(&model, saturation_parameters(), data, None);
        for (found, wanted) in fit.values().iter().zip(truth) {
            assert_near(*found, wanted, 1e-6 * wanted);
        }
        assert!(fit.evaluations <= 200, "{}", fit.evaluations);
    }
}

/// A straight line has the textbook's variances (N. R. Draper, H. Smith, Applied Regression Analysis, 1998, section 1.4) and an
/// interval by Student's t that is exact.
#[test]
fn straight_line_has_the_textbook_errors() {
    let x = passes(12);
    let model = answering(|p| x.iter().map(|x| p[0] + p[1] * x).collect());
    let data = noisy(&model(&[3.0, 2.0]).unwrap(), 0.5, 5);
    let parameters = vec![linear("intercept", -100.0, 100.0), linear("slope", -50.0, 50.0)];
    let fit = fitted(&model, parameters, data.clone(), None);

    let count = x.len() as f64;
    let (mean_x, mean_y) = (x.iter().sum::<f64>() / count, data.iter().sum::<f64>() / count);
    let sxx: f64 = x.iter().map(|x| (x - mean_x).powi(2)).sum();
    let pairs = || x.iter().zip(&data);
    let slope = pairs().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum::<f64>() / sxx;
    let intercept = mean_y - slope * mean_x;
    let residuals = pairs().map(|(x, y)| y - intercept - slope * x);
    let variance = residuals.map(|r| r * r).sum::<f64>() / (count - 2.0);
    let error = (variance / sxx).sqrt();
    let of_intercept = (variance * (1.0 / count + mean_x * mean_x / sxx)).sqrt();
    // t for 10 degrees of freedom at 97.5 %, from tables.
    let reach = 2.228_139 * error;

    let estimate = fit.estimate("slope").unwrap();
    assert_near(estimate.value, slope, 0.02 * error);
    for (estimate, error) in fit.estimates.iter().zip([of_intercept, error]) {
        assert_near(estimate.standard_error.unwrap(), error, 1e-3 * error);
    }
    assert_near(estimate.interval.lower.unwrap(), slope - reach, 0.03 * reach);
    assert_near(estimate.interval.upper.unwrap(), slope + reach, 0.03 * reach);
    let correlation = -mean_x / (sxx / count + mean_x * mean_x).sqrt();
    assert_near(fit.correlation[0][1].unwrap(), correlation, 1e-3);
    assert_near(fit.noise, variance.sqrt(), 1e-3 * variance.sqrt());
    assert_near(fit.degrees_of_freedom, 10.0, 1e-6);
}

/// Readings beyond the largest value that a model can take: its slope vanishes there, but its curvature still tells the parameter. With the
/// noise from n - 1 degrees of freedom, the rise of the deviance is (n - 1)(2 r c d² + c² d⁴)/r² at a distance d.
#[test]
fn a_standard_error_never_contradicts_its_interval() {
    let (largest, curvature, residual, count) = (550.0, 4000.0, 50.0, 12.0_f64);
    let model = answering(|p| vec![largest - curvature * (p[0] - 0.3).powi(2); 12]);
    let data = vec![largest + residual; 12];
    let fit = fitted(&model, vec![linear("mu", 0.01, 1.0)], data, None);
    // t for 11 degrees of freedom at 97.5 %, from tables.
    let t = 2.200_985_f64;
    let square = ((1.0 + t * t / (count - 1.0)).sqrt() - 1.0) * residual / curvature;
    let estimate = &fit.estimates[0];
    // At the maximum, where no slope tells a step.
    assert_near(estimate.value, 0.3, 0.01);
    let reach = 0.5 * (estimate.interval.upper.unwrap() - estimate.interval.lower.unwrap());
    assert_near(reach, square.sqrt(), 0.05 * square.sqrt());
    assert_near(t * estimate.standard_error.unwrap(), reach, 0.05 * reach);
}

/// Standard errors against those of the analytic Jacobian.
#[test]
fn covariance_is_that_of_the_analytic_jacobian() {
    let n = passes(40);
    let model = saturation(&n);
    let sigma = 4.0;
    let data = measured(&model, &[550.0, 15.0], sigma, 11);
    for relative_noise in [1e-12, 1e-9, 1e-6] {
        let (data, parameters) = (data.clone(), saturation_parameters());
        let fit = fitted_with(&model, parameters, data, Some(sigma), |fit| {
            fit.with_relative_noise(relative_noise).unwrap()
        });
        let (force, tau) = (fit.estimates[0].value, fit.estimates[1].value);
        let (mut a, mut b, mut c) = (0.0, 0.0, 0.0);
        for n in &n {
            let decay = (-n / tau).exp();
            let by_force = (1.0 - decay) / sigma;
            let by_tau = -force * decay * n / (tau * tau) / sigma;
            a += by_force * by_force;
            b += by_force * by_tau;
            c += by_tau * by_tau;
        }
        let determinant = a * c - b * b;
        let exact = [(c / determinant).sqrt(), (a / determinant).sqrt()];
        for (estimate, error) in fit.estimates.iter().zip(exact) {
            assert_near(estimate.standard_error.unwrap(), error, 2e-3 * error);
        }
        assert_near(fit.correlation[0][1].unwrap(), -b / (a * c).sqrt(), 2e-3);
    }
}

/// 95 % intervals hold the truth in 95 % of the cases, of a robust fit under Gaussian noise too: with 200 of them the count's standard
/// deviation is 3.1.
#[test]
#[ignore = "600 fits, ten seconds: .ci/run runs it"]
fn intervals_of_95_percent_hold_the_truth() {
    let model = saturation(&passes(30));
    let truth = [550.0, 12.0];
    let exact = model.predict(&truth).unwrap();
    let cover = |(loss, sigma, first)| {
        let mut covered = [0; 2];
        let mut seeds = Rng::with_seed(first);
        for _ in 0..200 {
            let data = noisy(&exact, 8.0, seeds.u64(..));
            let fit = fitted_with(&model, saturation_parameters(), data, sigma, |fit| {
                fit.with_loss(loss)
            });
            for (covered, (estimate, truth)) in covered.iter_mut().zip(fit.estimates.iter().zip(truth)) {
                *covered += usize::from(estimate.interval.contains(truth));
            }
        }
        for covered in covered {
            assert!((182..=197).contains(&covered), "{loss:?}: {covered}");
        }
    };
    std::thread::scope(|threads| {
        for of in [
            (Loss::Squares, None, 1000),
            (Loss::Squares, Some(8.0), 1000),
            (Loss::Tukey, None, 7000),
        ] {
            threads.spawn(move || cover(of));
        }
    });
}

/// Beyond saturation the time constant shows no more: its upper end stays open only where it should.
#[test]
fn what_the_data_do_not_hold_is_called_so() {
    // After 60 passes and more with τ = 1 only an upper limit of τ is known.
    let n: Vec<f64> = (60..90).map(f64::from).collect();
    let model = saturation(&n);
    for seed in 0..20 {
        let data = measured(&model, &[550.0, 1.0], 5.0, seed);
        let fit = fitted(&model, saturation_parameters(), data, None);
        let tau = fit.estimate("passes").unwrap();
        assert!(!tau.identifiable && tau.interval.lower.is_none(), "{tau:?}");
        assert!(tau.interval.contains(1.0));
        assert!(fit.estimate("force").unwrap().identifiable);
        let is_told = |w: &Warning| matches!(w, Warning::NotIdentifiable { name, .. } if name == "passes");
        assert!(fit.warnings.iter().any(is_told));
    }
}

/// Only the product of two parameters shows: neither is identifiable, and neither gets a standard error.
#[test]
fn two_parameters_that_show_as_a_product() {
    let n = passes(20);
    let model = answering(|p| n.iter().map(|n| p[0] * p[1] * n).collect());
    let parameters = vec![logarithmic("a", 0.1, 10.0), logarithmic("b", 0.1, 10.0)];
    let fit = fitted(&model, parameters, measured(&model, &[1.0, 2.0], 0.3, 3), None);
    assert!(fit.estimates.iter().all(|estimate| !estimate.identifiable));
    assert_near(fit.values().iter().product(), 2.0, 0.04);
}

/// A prior and the data weigh by their variances.
#[test]
fn prior_and_data_weigh_by_their_variances() {
    let model = answering(|p| vec![p[0]; 4]);
    let (value, sigma) = (50.0, 2.0);
    let level = linear("level", 0.0, 100.0)
        .with_prior(Prior { value, sigma })
        .unwrap();
    let fit = fitted(&model, vec![level], vec![60.0; 4], Some(6.0));
    // Mean of the data 60 ± 3, prior 50 ± 2.
    let weights: (f64, f64) = (1.0 / 9.0, 1.0 / 4.0);
    let mean = (60.0 * weights.0 + 50.0 * weights.1) / (weights.0 + weights.1);
    let error = (weights.0 + weights.1).sqrt().recip();
    let level = &fit.estimates[0];
    assert_near(level.value, mean, 0.02 * error);
    assert_near(level.standard_error.unwrap(), error, 1e-3 * error);
    let degrees = 4.0 - weights.0 / (weights.0 + weights.1);
    assert_near(fit.degrees_of_freedom, degrees, 1e-3);
}

/// 5 % of points off by 30 % move a robust fit by less than 1 %, and a least-squares fit by more.
#[test]
fn outliers_hardly_move_a_robust_fit() {
    let model = saturation(&passes(40));
    let exact = model.predict(&[550.0, 12.0]).unwrap();
    let mut misled = 0;
    for seed in 0..20 {
        let clean = noisy(&exact, 5.0, 500 + seed);
        let mut spoiled = clean.clone();
        for index in [17, 33] {
            spoiled[index] *= 1.3;
        }
        let fit = |data: &[f64], loss| {
            let (data, parameters) = (data.to_vec(), saturation_parameters());
            fitted_with(&model, parameters, data, None, |fit| fit.with_loss(loss))
        };
        let shift = |loss| fit(&spoiled, loss).values()[0] / fit(&clean, loss).values()[0] - 1.0;
        assert_near(shift(Loss::Tukey), 0.0, 0.01);
        let weights = fit(&spoiled, Loss::Tukey).weights;
        assert!(weights[17] < 0.35 && weights[33] < 0.35, "{weights:?}");
        misled += u32::from(shift(Loss::Squares).abs() > 0.01);
    }
    assert!(misled > 15, "{misled}");
}

/// Given sigmas that the residuals cannot be squared with are not believed.
#[test]
fn too_small_sigmas_are_told() {
    let model = saturation(&passes(40));
    let data = measured(&model, &[550.0, 12.0], 8.0, 9);
    let fit = |sigma| fitted(&model, saturation_parameters(), data.clone(), Some(sigma));
    let (honest, small) = (fit(8.0), fit(2.0));
    let is_told = |w: &Warning| matches!(w, Warning::Misfit { .. });
    assert!(!honest.warnings.iter().any(is_told) && small.warnings.iter().any(is_told));
    let ratio = small.estimates[0].standard_error.unwrap() / honest.estimates[0].standard_error.unwrap();
    assert!((0.7..1.4).contains(&ratio), "{ratio}");
}

/// A second minimum does not trap the fit: a wave of unknown length, whose squares have many minima.
#[test]
fn many_minima_do_not_trap_the_fit() {
    let x = passes(30);
    let model = answering(|p| x.iter().map(|x| (p[0] * x).sin() * p[1]).collect());
    let data = measured(&model, &[0.31, 2.0], 0.1, 4);
    let wave = linear("wavenumber", 0.05, 1.0);
    let parameters = vec![wave, logarithmic("amplitude", 0.1, 10.0)];
    let fit = fitted(&model, parameters, data, None);
    assert_near(fit.values()[0], 0.31, 0.002);
}

/// Two values that fit alike, as far below 3 and above: the one that was not chosen is named, and the interval holds both.
#[test]
fn a_second_minimum_is_told() {
    let x = passes(6);
    let model = answering(|p| x.iter().map(|x| x * (10.0 - (p[0] - 3.0).powi(2))).collect());
    let data = measured(&model, &[2.0], 0.3, 6);
    let fit = fitted(&model, vec![linear("a", 0.0, 6.0)], data, None);
    let rival = fit.warnings.iter().find_map(|w| match w {
        Warning::Ambiguous(values) => Some(values[0]),
        _ => None,
    });
    assert_near(fit.values()[0] + rival.unwrap(), 6.0, 0.05);
    let interval = fit.estimates[0].interval;
    assert!(interval.contains(2.0) && interval.contains(4.0), "{interval:?}");
}

/// Corners in which the model has no answer are avoided.
#[test]
fn failing_corners_are_avoided() {
    let inner = saturation(&passes(30));
    let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
        if p[0] > 1000.0 || p[1] < 3.0 {
            return Err("no equilibrium".into());
        }
        let broken = p[1] > 100.0;
        if broken { Ok(vec![f64::NAN; 30]) } else { inner(p) }
    };
    let data = measured(&inner, &[550.0, 12.0], 5.0, 21);
    let fit = fitted(&model, saturation_parameters(), data, None);
    assert_near(fit.values()[0], 550.0, 0.02 * 550.0);
    assert!(fit.estimates.iter().all(|estimate| estimate.identifiable));
}

#[test]
fn a_model_that_always_fails_is_an_error_with_its_reason() {
    let model = |_: &[f64]| -> Result<Vec<f64>, ModelError> { Err("no equilibrium".into()) };
    let calibration = Calibration::new(&model, saturation_parameters(), vec![1.0; 5]).unwrap();
    let error = calibration.fit().unwrap_err();
    let is_told = matches!(&error, CalibrationError::NoAnswer { places: 24, .. });
    assert!(is_told, "{error}");
    let reason = error.source().map(ToString::to_string);
    assert!(reason.is_some_and(|reason| reason.contains("no equilibrium")));
}

/// What an error of the model does to the parameters, against a fit of the wrong model.
#[test]
fn shift_is_that_of_a_refit() {
    let n = passes(40);
    let change: Vec<f64> = n.iter().map(|n| 0.02 * n).collect();
    let model = saturation(&n);
    let wrong = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
        let forces = model(p)?.into_iter().zip(&change);
        Ok(forces.map(|(force, more)| force + more).collect())
    };
    let data = measured(&model, &[550.0, 12.0], 5.0, 8);
    let fit = |model: &dyn Model| fitted(model, saturation_parameters(), data.clone(), Some(5.0));
    let (right, misled) = (fit(&model), fit(&wrong));
    for (k, shift) in right.shift(&change).0.iter().enumerate() {
        let moved = misled.values()[k] - right.values()[k];
        let found = moved / right.estimates[k].standard_error.unwrap();
        assert_near(*shift, found, 0.05 * found.abs().max(0.2));
    }
}

#[test]
fn runs_are_counted() {
    let runs = AtomicUsize::new(0);
    let inner = saturation(&passes(30));
    let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
        runs.fetch_add(1, Ordering::Relaxed);
        inner(p)
    };
    let data = measured(&inner, &[550.0, 12.0], 5.0, 21);
    let calibration = Calibration::new(&model, saturation_parameters(), data).unwrap();
    let fit = calibration.fit().unwrap();
    assert_eq!(fit.evaluations, runs.load(Ordering::Relaxed));
    assert!(fit.evaluations <= 120, "{}", fit.evaluations);

    let rough = calibration.without_profiles().fit().unwrap();
    assert!(rough.evaluations < fit.evaluations);
}

#[test]
fn bad_input_is_named() {
    let model = saturation(&passes(5));
    let with = |parameters: Vec<Parameter>, data: &[f64], sigmas: &[f64]| {
        let mut calibration = Calibration::new(&model, parameters, data.to_vec())?;
        if !sigmas.is_empty() {
            calibration = calibration.with_sigmas(sigmas.to_vec())?;
        }
        calibration.fit()
    };
    let (same, unknown) = (vec![linear("force", 1.0, 2.0); 2], [1.0, 1.0, 0.0, 1.0, 1.0]);
    let usual = saturation_parameters;
    for (found, name) in [
        (with(usual(), &[1.0, f64::NAN], &[]), "value of observation 1"),
        (with(usual(), &[1.0, 2.0], &[]), "number of observations"),
        (with(usual(), &[1.0; 4], &[]), "number of predictions"),
        (with(usual(), &[1.0; 5], &[1.0; 4]), "number of sigmas"),
        (with(usual(), &[1.0; 5], &unknown), "sigma of observation 2"),
        (with(same, &[1.0; 5], &[]), "number of parameters called force"),
    ] {
        let Err(CalibrationError::Invalid { what, .. }) = &found else {
            panic!("{name}: {found:?}")
        };
        assert!(what.starts_with(name), "{name}: {what}");
    }
    // The logarithms of the last bounds are one number.
    for (lower, upper, scale) in [
        (1.0, 1.0, Scale::Linear),
        (f64::NAN, 1.0, Scale::Linear),
        (0.0, f64::INFINITY, Scale::Linear),
        (0.0, 1.0, Scale::Logarithmic),
        (1e10, 1e10_f64.next_up(), Scale::Logarithmic),
    ] {
        let bad = Parameter::new("a", lower, upper, scale);
        assert!(matches!(bad, Err(CalibrationError::Invalid { .. })));
    }
}
