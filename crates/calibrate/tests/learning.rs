//! What a fit learns of its model: few runs, fewer where a coarser model or its parts are known, and all that the answer rests on.

use calibrate::{
    Calibration, CalibrationError, Emulator, Fit, Loss, Model, ModelError, Parameter, Part, Prior,
};

use super::common::{
    fitted, fitted_with, linear, logarithmic, noisy, passes, saturation, saturation_parameters,
};

/// Differences of two fits' values and closed ends, in standard errors; what is open in one is open in both.
fn differences(one: &Fit, other: &Fit) -> Vec<f64> {
    let mut differences = Vec::new();
    for (a, b) in one.estimates.iter().zip(&other.estimates) {
        let error = a.standard_error.unwrap();
        differences.push((a.value - b.value).abs() / error);
        let ends = |fit: &calibrate::Estimate| [fit.interval.lower, fit.interval.upper];
        for pair in ends(a).into_iter().zip(ends(b)) {
            match pair {
                (Some(a), Some(b)) => differences.push((a - b).abs() / error),
                (None, None) => {}
                _ => panic!("{a:?} {b:?}"),
            }
        }
    }
    differences
}

/// Few runs, and the residuals are those of the model itself.
#[test]
fn a_smooth_model_takes_few_runs() {
    let model = saturation(&passes(40));
    for (seed, truth) in (0..).zip([[550.0, 20.0], [900.0, 3.0], [400.0, 45.0], [120.0, 8.0]]) {
        let data = noisy(&model.predict(&truth).unwrap(), 0.01 * truth[0], seed);
        for (loss, sigma) in [
            (Loss::Squares, None),
            (Loss::Squares, Some(0.01 * truth[0])),
            (Loss::Tukey, None),
        ] {
            let fit = fitted_with(
                &model,
                saturation_parameters(),
                data.clone(),
                sigma,
                |calibration| calibration.with_loss(loss),
            );
            for (estimate, truth) in fit.estimates.iter().zip(truth) {
                let off = (estimate.value - truth) / estimate.standard_error.unwrap();
                assert!(off.abs() < 3.0, "{estimate:?}");
            }
            assert!(fit.evaluations <= 80, "{truth:?} {loss:?}: {}", fit.evaluations);
            assert_eq!(fit.emulator.runs(), fit.evaluations);
            let exact = model.predict(&fit.values()).unwrap();
            for (fitted, exact) in fit.fitted.iter().zip(&exact) {
                assert!((fitted - exact).abs() < 1e-9 * exact, "{fitted} {exact}");
            }
        }
    }
}

/// What a coarse model has taught is not learned again.
#[test]
fn a_finer_model_takes_few_runs() {
    let fine = saturation(&passes(40));
    let coarse = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
        let forces = fine.predict(p)?;
        Ok((0..)
            .zip(forces)
            .map(|(n, force)| force + 0.2 * f64::from(n) - 3.0)
            .collect())
    };
    let data = noisy(&fine.predict(&[550.0, 12.0]).unwrap(), 5.0, 3);
    let on = |model| Calibration::new(model, saturation_parameters(), data.clone()).unwrap();
    let first = on(&coarse).fit().unwrap();
    let second = on(&fine).with_emulator(first.emulator.of_finer()).fit().unwrap();
    let alone = on(&fine).fit().unwrap();
    let most = differences(&alone, &second).into_iter().fold(0.0, f64::max);
    assert!(most < 0.15, "{most}");
    assert!(second.evaluations <= 16, "{}", second.evaluations);
}

/// What is known of a model serves other observations of it: the fit is the same with fewer runs.
#[test]
fn what_is_known_of_a_model_is_not_learned_again() {
    let model = saturation(&passes(40));
    let on = |truth: &[f64; 2], seed| {
        let data = noisy(&model.predict(truth).unwrap(), 5.0, seed);
        Calibration::new(&model, saturation_parameters(), data).unwrap()
    };
    let first = on(&[550.0, 12.0], 3).fit().unwrap();
    let alone = on(&[560.0, 12.5], 4).fit().unwrap();
    let known = on(&[560.0, 12.5], 4).with_emulator(first.emulator).fit().unwrap();
    let most = differences(&alone, &known).into_iter().fold(0.0, f64::max);
    assert!(most < 0.15, "{most}");
    let more = known.evaluations - first.evaluations;
    assert!(more <= 6, "{more}");
}

/// Two series, each with a force of its own, that share the passes and a factor of both forces.
struct TwoSeries {
    says_parts: bool,
}

impl Model for TwoSeries {
    fn predict(&self, p: &[f64]) -> Result<Vec<f64>, ModelError> {
        let series = |force: f64, own: f64, count| saturation(&passes(count)).predict(&[force * p[4], own]);
        Ok([series(p[0], p[1], 40)?, series(p[2], p[3], 30)?].concat())
    }

    fn parts(&self) -> Vec<Part> {
        let part = |predictions, own: [usize; 2]| Part {
            predictions,
            parameters: vec![own[0], own[1], 4],
        };
        if self.says_parts {
            vec![part(40, [0, 1]), part(30, [2, 3])]
        } else {
            Vec::new()
        }
    }
}

/// A model that says which parameters act on which series is fitted with fewer runs, and alike.
#[test]
fn each_series_is_followed_by_itself() {
    let data = TwoSeries { says_parts: true }
        .predict(&[550.0, 12.0, 800.0, 9.0, 1.0])
        .unwrap();
    let data = noisy(&data, 5.0, 4);
    let mut parameters = Vec::new();
    for series in ["1", "2"] {
        for (name, upper) in [("force", 2000.0), ("passes", 100.0)] {
            let name = format!("{name}_{series}");
            parameters.push(logarithmic(&name, 0.01 * upper, upper));
        }
    }
    let shared = logarithmic("factor", 0.3, 3.0);
    let (value, sigma) = (1.0, 0.05);
    let prior = Prior { value, sigma };
    parameters.push(shared.with_prior(prior).unwrap());
    let fit = |says_parts| {
        let model = TwoSeries { says_parts };
        fitted(&model, parameters.clone(), data.clone(), None)
    };
    let [parts, whole] = [true, false].map(fit);
    let most = differences(&whole, &parts).into_iter().fold(0.0, f64::max);
    assert!(most < 0.15, "{most}");
    let (few, many) = (parts.evaluations, whole.evaluations);
    assert!(5 * few < 4 * many, "{few} {many}");
}

#[test]
fn parts_that_do_not_fit_the_observations_are_refused() {
    struct Wrong(Part);
    impl Model for Wrong {
        fn predict(&self, p: &[f64]) -> Result<Vec<f64>, ModelError> {
            saturation(&passes(40)).predict(p)
        }

        fn parts(&self) -> Vec<Part> {
            vec![self.0.clone()]
        }
    }
    for (predictions, parameter) in [(39, 1), (40, 2)] {
        let model = Wrong(Part {
            predictions,
            parameters: vec![0, parameter],
        });
        let calibration = Calibration::new(&model, saturation_parameters(), vec![1.0; 40]).unwrap();
        let found = calibration.fit();
        assert!(
            matches!(found, Err(CalibrationError::Invalid { .. })),
            "{found:?}"
        );
    }
}

/// A parameter without effect stays open, and one known beforehand takes its prior's width.
#[test]
fn what_the_data_do_not_hold_is_called_so() {
    let inner = saturation(&passes(30));
    let model =
        |p: &[f64]| -> Result<Vec<f64>, ModelError> { inner.predict(&[p[0], p[1] * (1.0 + 1e-9 * p[2])]) };
    let data = noisy(&model(&[550.0, 12.0, 0.5]).unwrap(), 5.0, 1);
    let with = |third: Parameter| {
        let mut parameters = saturation_parameters();
        parameters.push(third);
        fitted(&model, parameters, data.clone(), None)
    };
    let third = linear("nothing", 0.0, 1.0);
    let fit = with(third.clone());
    assert_eq!(
        (fit.estimates[2].interval.lower, fit.estimates[2].interval.upper),
        (None, None)
    );
    assert!(fit.estimates[0].identifiable && fit.estimates[1].identifiable);
    let (value, sigma) = (0.5, 0.02);
    let prior = Prior { value, sigma };
    let fit = with(third.with_prior(prior).unwrap());
    let known = &fit.estimates[2];
    assert!(
        (known.standard_error.unwrap() / 0.02 - 1.0).abs() < 0.01,
        "{known:?}"
    );
    assert!(
        (known.value - 0.5).abs() < 1e-3 && known.identifiable,
        "{known:?}"
    );
}

/// What was learned of other parameters or observations is refused.
#[test]
fn a_stranger_is_no_coarse_model() {
    let fit = |count: u32, parameters: Vec<Parameter>, coarse: Option<Emulator>| {
        let model = saturation(&passes(count));
        let data = noisy(&model.predict(&[550.0, 12.0]).unwrap(), 5.0, 2);
        let calibration = Calibration::new(&model, parameters, data).unwrap();
        match coarse {
            Some(coarse) => calibration.with_emulator(coarse.of_finer()).fit(),
            None => calibration.fit(),
        }
    };
    let emulator = fit(30, saturation_parameters(), None).unwrap().emulator;
    let narrower = vec![linear("force", 100.0, 5000.0), logarithmic("passes", 0.5, 500.0)];
    assert!(fit(30, saturation_parameters(), Some(emulator.clone())).is_ok());
    for found in [
        fit(31, saturation_parameters(), Some(emulator.clone())),
        fit(30, narrower, Some(emulator)),
    ] {
        assert!(
            matches!(found, Err(CalibrationError::Invalid { .. })),
            "{found:?}"
        );
    }
}
