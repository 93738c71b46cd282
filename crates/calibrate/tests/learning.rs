//! What a fit learns of its model: few runs, fewer where a coarser model or its parts are known, and all that the answer rests on.

use calibrate::{
    Calibration, CalibrationError, Emulator, Fit, Loss, Model, ModelError, Parameter, Part, Prior,
};

use super::common::{
    assert_near, fitted, fitted_with, linear, logarithmic, measured, passes, saturation,
    saturation_parameters,
};

/// Asserts that two fits' values and closed ends differ by little of a standard error, and that what is open in one is open in both.
#[track_caller]
fn assert_alike(one: &Fit, other: &Fit) {
    for (a, b) in one.estimates.iter().zip(&other.estimates) {
        let allowed = 0.15 * a.standard_error.unwrap();
        assert_near(b.value, a.value, allowed);
        let ends = |fit: &calibrate::Estimate| [fit.interval.lower, fit.interval.upper];
        for (a, b) in ends(a).into_iter().zip(ends(b)) {
            assert_eq!(a.is_some(), b.is_some());
            assert_near(b.unwrap_or_default(), a.unwrap_or_default(), allowed);
        }
    }
}

/// Few runs, and the residuals are those of the model itself.
#[test]
fn a_smooth_model_takes_few_runs() {
    let model = saturation(&passes(40));
    for (seed, truth) in (0..).zip([[550.0, 20.0], [900.0, 3.0], [400.0, 45.0], [120.0, 8.0]]) {
        let noise = 0.01 * truth[0];
        let data = measured(&model, &truth, noise, seed);
        for (loss, sigma) in [
            (Loss::Squares, None),
            (Loss::Squares, Some(noise)),
            (Loss::Tukey, None),
        ] {
            let fit = fitted_with(&model, saturation_parameters(), data.clone(), sigma, |fit| {
                fit.with_loss(loss)
            });
            for (estimate, truth) in fit.estimates.iter().zip(truth) {
                assert_near(estimate.value, truth, 3.0 * estimate.standard_error.unwrap());
            }
            assert!(fit.evaluations <= 80, "{truth:?} {loss:?}: {}", fit.evaluations);
            assert_eq!(fit.emulator.runs(), fit.evaluations);
            let exact = model.predict(&fit.values()).unwrap();
            for (fitted, exact) in fit.fitted.iter().zip(&exact) {
                assert_near(*fitted, *exact, 1e-9 * exact);
            }
        }
    }
}

/// What a coarse model has taught is not learned again.
#[test]
fn a_finer_model_takes_few_runs() {
    let fine = saturation(&passes(40));
    let coarse = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
        let forces = fine.predict(p)?.into_iter().zip(passes(40));
        Ok(forces.map(|(force, n)| force + 0.2 * n - 3.2).collect())
    };
    let data = measured(&fine, &[550.0, 12.0], 5.0, 3);
    let on = |model| Calibration::new(model, saturation_parameters(), data.clone()).unwrap();
    let first = on(&coarse).fit().unwrap();
    let second = on(&fine).with_emulator(first.emulator.of_finer()).fit().unwrap();
    assert_alike(&on(&fine).fit().unwrap(), &second);
    assert!(second.evaluations <= 16, "{}", second.evaluations);
}

/// What is known of a model serves other observations of it: the fit is the same with fewer runs.
#[test]
fn what_is_known_of_a_model_is_not_learned_again() {
    let model = saturation(&passes(40));
    let on = |truth: &[f64; 2], seed| {
        let data = measured(&model, truth, 5.0, seed);
        Calibration::new(&model, saturation_parameters(), data).unwrap()
    };
    let first = on(&[550.0, 12.0], 3).fit().unwrap();
    let alone = on(&[560.0, 12.5], 4).fit().unwrap();
    let known = on(&[560.0, 12.5], 4).with_emulator(first.emulator).fit().unwrap();
    assert_alike(&alone, &known);
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
    let truth = [550.0, 12.0, 800.0, 9.0, 1.0];
    let data = measured(&TwoSeries { says_parts: true }, &truth, 5.0, 4);
    let (value, sigma) = (1.0, 0.05);
    let factor = logarithmic("factor", 0.3, 3.0).with_prior(Prior { value, sigma });
    let parameters = vec![
        logarithmic("force_1", 20.0, 2000.0),
        logarithmic("passes_1", 1.0, 100.0),
        logarithmic("force_2", 20.0, 2000.0),
        logarithmic("passes_2", 1.0, 100.0),
        factor.unwrap(),
    ];
    let fit = |says_parts| {
        let model = TwoSeries { says_parts };
        fitted(&model, parameters.clone(), data.clone(), None)
    };
    let [parts, whole] = [true, false].map(fit);
    assert_alike(&whole, &parts);
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
        let found = calibration.fit().err();
        assert!(matches!(found, Some(CalibrationError::Invalid { .. })));
    }
}

/// A parameter without effect stays open, and one known beforehand takes its prior's width.
#[test]
fn what_the_data_do_not_hold_is_called_so() {
    let inner = saturation(&passes(30));
    let model =
        |p: &[f64]| -> Result<Vec<f64>, ModelError> { inner.predict(&[p[0], p[1] * (1.0 + 1e-9 * p[2])]) };
    let data = measured(&model, &[550.0, 12.0, 0.5], 5.0, 1);
    let with = |third: Parameter| {
        let parameters = [saturation_parameters(), vec![third]].concat();
        fitted(&model, parameters, data.clone(), None)
    };
    let third = linear("nothing", 0.0, 1.0);
    let fit = with(third.clone());
    let interval = fit.estimates[2].interval;
    assert_eq!((interval.lower, interval.upper), (None, None));
    assert!(fit.estimates[0].identifiable && fit.estimates[1].identifiable);
    let (value, sigma) = (0.5, 0.02);
    let fit = with(third.with_prior(Prior { value, sigma }).unwrap());
    let known = &fit.estimates[2];
    assert_near(known.standard_error.unwrap(), 0.02, 0.01 * 0.02);
    assert_near(known.value, 0.5, 1e-3);
    assert!(known.identifiable);
}

/// What was learned of other parameters or observations is refused.
#[test]
fn a_stranger_is_no_coarse_model() {
    let fit = |count: u32, parameters: Vec<Parameter>, coarse: Option<Emulator>| {
        let model = saturation(&passes(count));
        let data = measured(&model, &[550.0, 12.0], 5.0, 2);
        let mut calibration = Calibration::new(&model, parameters, data).unwrap();
        if let Some(coarse) = coarse {
            calibration = calibration.with_emulator(coarse.of_finer());
        }
        calibration.fit()
    };
    let emulator = fit(30, saturation_parameters(), None).unwrap().emulator;
    let narrower = vec![linear("force", 100.0, 5000.0), logarithmic("passes", 0.5, 500.0)];
    assert!(fit(30, saturation_parameters(), Some(emulator.clone())).is_ok());
    for found in [
        fit(31, saturation_parameters(), Some(emulator.clone())),
        fit(30, narrower, Some(emulator)),
    ] {
        let found = found.err();
        assert!(matches!(found, Some(CalibrationError::Invalid { .. })));
    }
}
