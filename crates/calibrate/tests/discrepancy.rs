//! A model that is not the truth: what a discrepancy does to intervals.

#[allow(dead_code, reason = "not every test binary needs all of it")]
mod common;

use calibrate::{
    Calibration, CalibrationError, Discrepancy, Fit, Loss, ModelError, Options, Parameter, Scale,
};

const COUNT: usize = 40;
const NOISE: f64 = 0.02;
const DRAWS: u64 = 100;

fn place(k: usize) -> f64 {
    (1.0 + k as f64).ln()
}

fn covariance(i: usize, j: usize) -> f64 {
    (-0.5 * (place(i) - place(j)).powi(2)).exp()
}

/// The truth's line through the origin, a function of the process with this size, and noise.
fn measured(size: f64, seed: u64) -> Vec<f64> {
    // A fork: generators of neighbouring seeds begin with related numbers.
    let mut random = fastrand::Rng::with_seed(seed).fork();
    let nodes: Vec<f64> = (0..60).map(|_| common::gaussian(&mut random)).collect();
    // Gaussian noise folded with a Gaussian is a process of twice its variance, whose correlation falls as `covariance` does.
    let step = 0.25;
    let width = 0.5_f64.sqrt();
    let smooth = |x: f64| {
        let parts = nodes.iter().enumerate().map(|(k, node)| {
            let off = x - (k as f64 * step - 5.0);
            node * (-0.5 * (off / width).powi(2)).exp()
        });
        parts.sum::<f64>() * (step / (width * std::f64::consts::PI.sqrt())).sqrt()
    };
    (0..COUNT)
        .map(|k| 0.5 * place(k) + size * smooth(place(k)) + NOISE * common::gaussian(&mut random))
        .collect()
}

fn fit(data: Vec<f64>, allowed: bool, sigma: Option<f64>) -> Fit {
    let line =
        |p: &[f64]| -> Result<Vec<f64>, ModelError> { Ok((0..COUNT).map(|k| p[0] * place(k)).collect()) };
    let slope = Parameter::new("slope", 0.0, 2.0, Scale::Linear).unwrap();
    let mut calibration = Calibration::new(&line, vec![slope], data).unwrap();
    if let Some(sigma) = sigma {
        calibration = calibration.with_sigmas(vec![sigma; COUNT]).unwrap();
    }
    if allowed {
        let discrepancy = Discrepancy::new(COUNT, covariance, 0.2).unwrap();
        calibration = calibration.with_discrepancy(discrepancy).unwrap();
    }
    let fit = calibration.fit().unwrap();
    // By an emulator the same.
    let (other, _) = calibration.fit_emulated(None).unwrap();
    let [a, b] = [&fit, &other].map(|fit| fit.estimates[0].interval);
    let width = a.upper.unwrap() - a.lower.unwrap();
    assert!(
        (a.upper.unwrap() - b.upper.unwrap()).abs() < 0.1 * width,
        "{a:?} {b:?}"
    );
    fit
}

/// Of 100 series each, with a size of five noises and without any: intervals of 95 % hold the truth, known noise or not.
#[test]
fn intervals_hold_where_the_model_is_off() {
    for (size, sigma) in [(0.1, None), (0.1, Some(NOISE)), (0.0, None), (0.0, Some(NOISE))] {
        let (mut plain, mut held, mut sizes) = (0, 0, 0);
        for seed in 0..DRAWS {
            let data = measured(size, seed);
            plain += usize::from(
                fit(data.clone(), false, sigma).estimates[0]
                    .interval
                    .contains(0.5),
            );
            let found = fit(data, true, sigma);
            held += usize::from(found.estimates[0].interval.contains(0.5));
            let of_size = found.discrepancy.unwrap();
            // Without a discrepancy, the interval of its size is open below.
            sizes += usize::from(
                of_size.interval.contains(size) && (size > 0.0 || of_size.interval.lower.is_none()),
            );
        }
        assert!(held >= 90, "{size} {sigma:?}: {held}");
        assert!(sizes >= 90, "{size} {sigma:?}: {sizes}");
        assert_eq!(plain < 50, size > 0.0, "{plain}");
    }
}

/// Observations at one place tell nothing of the size: the prior alone says how large it may be, and where it is wide, the interval is open.
#[test]
fn an_interval_holds_its_value() {
    let level = |p: &[f64]| -> Result<Vec<f64>, ModelError> { Ok(vec![p[0]; 6]) };
    let data = vec![100.0, 101.0, 99.0, 100.5, 99.5, 101.0];
    for sigma in [0.1, 10.0, 1e3, 1e6, 1e9] {
        let one = Parameter::new("level", 0.0, 1e3, Scale::Linear).unwrap();
        let calibration = Calibration::new(&level, vec![one], data.clone()).unwrap();
        let discrepancy = Discrepancy::new(6, |_, _| 1e4, sigma).unwrap();
        let fit = calibration.with_discrepancy(discrepancy).unwrap().fit().unwrap();
        let size = fit.discrepancy.unwrap();
        assert!(size.interval.contains(size.value), "{sigma}: {size:?}");
        assert!(!size.identifiable, "{sigma}: {size:?}");
        assert_eq!(size.interval.upper.is_some(), sigma < 1e3, "{sigma}: {size:?}");
    }
}

/// What of the residuals is smooth is found, and the rest is the noise.
#[test]
fn the_smooth_part_is_told_from_noise() {
    let found = fit(measured(0.1, 3), true, None);
    assert!((0.7..1.4).contains(&(found.noise / NOISE)), "{}", found.noise);
    let noise = found.standardised_noise();
    let rms = (noise.iter().map(|r| r * r).sum::<f64>() / COUNT as f64).sqrt();
    assert!(
        rms < 1.2 * NOISE && found.residual_rms > 1.5 * rms,
        "{rms} {}",
        found.residual_rms
    );
}

#[test]
fn what_does_not_go_together_is_refused() {
    let line = |p: &[f64]| -> Result<Vec<f64>, ModelError> { Ok(vec![p[0]; 4]) };
    let level = Parameter::new("level", 0.0, 2.0, Scale::Linear).unwrap();
    let calibration = Calibration::new(&line, vec![level], vec![1.0, 1.1, 0.9, 1.0]).unwrap();
    let of = |count| Discrepancy::new(count, |_, _| 1.0, 0.1).unwrap();
    let refused =
        |error: CalibrationError| assert!(matches!(error, CalibrationError::InvalidOption { .. }), "{error}");
    refused(calibration.clone().with_discrepancy(of(3)).unwrap_err());
    refused(Discrepancy::new(4, |_, _| f64::NAN, 0.1).unwrap_err());
    refused(Discrepancy::new(4, |_, _| 1.0, 0.0).unwrap_err());
    for none in [0.0, 1e-300_f64.powi(2)] {
        refused(Discrepancy::new(4, |_, _| none, 0.1).unwrap_err());
    }
    // So small beside the noise that nothing of it is left, or that its prior overflows.
    for (variance, sigma) in [(f64::MIN_POSITIVE, 0.1), (1.0, 1e-300), (1.0, 1e-9)] {
        let tiny = Discrepancy::new(4, |_, _| variance, sigma).unwrap();
        let tiny = calibration
            .clone()
            .with_sigmas(vec![100.0; 4])
            .unwrap()
            .with_discrepancy(tiny);
        refused(tiny.unwrap().fit().unwrap_err());
    }
    let mut options = Options::default();
    options.loss = Loss::TUKEY;
    let robust = calibration
        .with_options(options)
        .unwrap()
        .with_discrepancy(of(4))
        .unwrap();
    refused(robust.fit().unwrap_err());
}
