//! Whatever the numbers and the model: a fit or an error, never a panic.

use calibrate::{Calibration, Loss, ModelError, Parameter, Prior, Scale};
use proptest::prelude::*;

fn any_number() -> impl Strategy<Value = f64> {
    let sizes = [0.0, 1.0, f64::MIN_POSITIVE, 1e-300, 1e300, f64::MAX];
    let special = [
        &sizes[..],
        &sizes.map(|size| -size),
        &[f64::NAN, f64::INFINITY, -f64::INFINITY],
    ]
    .concat();
    prop_oneof![prop::sample::select(special), any::<f64>(), -10.0..10.0_f64]
}

/// What a hostile model does at any point.
#[derive(Debug, Clone, Copy)]
enum Answer {
    Line,
    Constant(f64),
    Steep(f64),
    Short,
    Refusal,
    /// No answer in half of the range.
    Sometimes,
}

fn answers() -> impl Strategy<Value = Answer> {
    prop_oneof![
        3 => Just(Answer::Line),
        1 => any_number().prop_map(Answer::Constant),
        1 => any_number().prop_map(Answer::Steep),
        1 => Just(Answer::Short),
        1 => Just(Answer::Refusal),
        2 => Just(Answer::Sometimes),
    ]
}

fn predict(answer: Answer, count: usize, p: &[f64]) -> Result<Vec<f64>, ModelError> {
    let line = |slope: f64| {
        (0..count)
            .map(|i| p.iter().sum::<f64>() * slope * (1.0 + i as f64))
            .collect()
    };
    match answer {
        Answer::Constant(value) => Ok(vec![value; count]),
        Answer::Steep(slope) => Ok(line(slope)),
        Answer::Short => Ok(vec![1.0; count / 2]),
        Answer::Refusal => Err("no answer".into()),
        Answer::Sometimes if p.first().is_some_and(|p| p.to_bits() % 2 == 0) => Err("no answer here".into()),
        Answer::Line | Answer::Sometimes => Ok(line(1.0)),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_fit_or_an_error(
        bounds in prop::collection::vec((any_number(), any_number(), any::<bool>(), prop::option::of((any_number(), any_number()))), 0..3),
        ordinary in any::<bool>(),
        observations in prop::collection::vec(prop_oneof![4 => -100.0..100.0_f64, 1 => any_number()], 0..7),
        sigmas in prop::option::of(any_number()),
        (answer, profiles, robust) in (answers(), any::<bool>(), any::<bool>()),
        noise in any_number(),
    ) {
        let scale = |logarithmic| if logarithmic { Scale::Logarithmic } else { Scale::Linear };
        let mut parameters = Vec::new();
        for (index, (lower, upper, logarithmic, prior)) in bounds.into_iter().enumerate() {
            let (lower, upper) = if ordinary { (0.5, 5.0) } else { (lower, upper) };
            let Ok(parameter) = Parameter::new(&format!("p{index}"), lower, upper, scale(logarithmic)) else { continue; };
            let prior = prior.and_then(|(value, sigma)| parameter.clone().with_prior(Prior { value, sigma }).ok());
            parameters.push(prior.unwrap_or(parameter));
        }
        let count = observations.len();
        let model = move |p: &[f64]| predict(answer, count, p);
        let Ok(mut calibration) = Calibration::new(&model, parameters, observations) else { return Ok(()); };
        if let Some(sigma) = sigmas {
            let Ok(known) = calibration.with_sigmas(vec![sigma; count]) else { return Ok(()); };
            calibration = known;
        }
        if robust {
            calibration = calibration.with_loss(Loss::Tukey);
        }
        if !profiles {
            calibration = calibration.without_profiles();
        }
        if !ordinary {
            calibration = calibration.clone().with_relative_noise(noise).unwrap_or(calibration);
        }
        if let Ok(fit) = calibration.fit() {
            prop_assert!(fit.values().iter().all(|value| value.is_finite()), "{:?}", fit.values());
            fit.shift(&[f64::NAN; 9]);
            fit.shift(&[]);
            let _ = calibration.clone().with_emulator(fit.emulator.clone()).fit();
            let _ = calibration.with_emulator(fit.emulator.of_finer()).fit();
        }
    }
}
