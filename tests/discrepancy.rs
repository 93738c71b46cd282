//! A discrepancy between model and readings, of the series that comes with the project: μ_d 0.25, an elastic-plastic law.

use creepage::calibration::Loss;
use creepage::scene::FrictionLaw;
use creepage::{CalibrateOptions, Calibrated, Readings, Scene, calibrate};

/// Where the law is the true one, no discrepancy is found, and the interval is a little wider; where it is not, one is, and the fit is believed.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn a_discrepancy_is_found_where_the_law_is_wrong() {
    let data = Readings::from_file("examples/data/synthetic-upper.csv").unwrap();
    let upper = Scene::from_file("examples/scenes/full-scale-upper.toml").unwrap();
    let mut coulomb = upper.clone();
    coulomb.friction.law = FrictionLaw::Coulomb;
    let fit = |scene: &Scene, discrepancy| {
        let options = CalibrateOptions {
            discrepancy,
            ..CalibrateOptions::default()
        };
        calibrate(scene, &data, &options).unwrap()
    };
    let width = |answer: &Calibrated| {
        let [lower, upper] = answer.parameters[0].interval_95;
        upper.unwrap() - lower.unwrap()
    };
    let (plain, allowed) = (fit(&upper, None), fit(&upper, Some(0.1)));
    let size = &allowed.parameters[2];
    assert_eq!((size.name.as_str(), size.unit), ("discrepancy", "1"));
    assert!(size.interval_95[0].is_none() && !size.identifiable, "{size:?}");
    assert!(size.interval_95[1].is_some_and(|upper| upper < 0.1), "{size:?}");
    assert!(width(&allowed) > 1.1 * width(&plain));
    assert!(allowed.parameters[0].identifiable);
    assert!(allowed.correlation.len() == 3 && allowed.correlation.iter().all(|row| row.len() == 3));

    let (plain, allowed) = (fit(&coulomb, None), fit(&coulomb, Some(0.1)));
    assert!(plain.lack_of_fit.suspicious && !allowed.lack_of_fit.suspicious);
    let size = &allowed.parameters[1];
    assert!(size.identifiable && (0.01..0.1).contains(&size.value), "{size:?}");
    assert!(width(&allowed) > 4.0 * width(&plain));
    // The truth's distance, in interval widths.
    let off = |answer: &Calibrated| (answer.parameters[0].value - 0.25).abs() / width(answer);
    assert!(
        off(&plain) > 4.0 * off(&allowed),
        "{} {}",
        off(&plain),
        off(&allowed)
    );

    for share in [1e-300, 11.0, f64::NAN] {
        let absurd = CalibrateOptions {
            discrepancy: Some(share),
            ..CalibrateOptions::default()
        };
        let error = calibrate(&upper, &data, &absurd).unwrap_err();
        assert!(
            error.is_bad_input() && error.to_string().contains("0.0001 to 10"),
            "{error}"
        );
    }
    let robust = CalibrateOptions {
        discrepancy: Some(0.1),
        loss: Loss::TUKEY,
        ..CalibrateOptions::default()
    };
    let error = calibrate(&upper, &data, &robust).unwrap_err();
    assert!(
        error.is_bad_input() && error.to_string().contains("independent noise"),
        "{error}"
    );
}
