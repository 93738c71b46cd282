//! A discrepancy between model and readings, of the series that comes with the project: μ_d 0.25, an elastic-plastic law.

use creepage::calibration::Loss;
use creepage::scene::Law;
use creepage::{CalibrateOptions, Calibrated, ReadOptions, Readings, Scene, calibrate};

/// An interval is as wide as the given discrepancy leaves it; where the law is not the true one, the fit is
/// then believed.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn a_discrepancy_makes_room_where_the_law_is_wrong() {
    let data = Readings::from_file("examples/data/synthetic-upper.csv", &ReadOptions::default()).unwrap();
    let upper = Scene::from_file("examples/scenes/full-scale-upper.toml").unwrap();
    let mut coulomb = upper.clone();
    (coulomb.friction.law, coulomb.friction.shape_factor) = (Law::Coulomb, None);
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
    let (plain, allowed, twice) = (
        fit(&upper, None),
        fit(&upper, Some(0.03)),
        fit(&upper, Some(0.06)),
    );
    assert!(width(&allowed) > 1.1 * width(&plain));
    assert!(width(&twice) > 1.2 * width(&allowed));
    assert_eq!((allowed.parameters.len(), allowed.correlation.len()), (2, 2));

    let (plain, allowed) = (fit(&coulomb, None), fit(&coulomb, Some(0.03)));
    assert!(plain.lack_of_fit.suspicious && !allowed.lack_of_fit.suspicious);
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
        loss: Loss::Tukey,
        ..CalibrateOptions::default()
    };
    let error = calibrate(&upper, &data, &robust).unwrap_err();
    assert!(
        error.is_bad_input() && error.to_string().contains("independent noise"),
        "{error}"
    );
}
