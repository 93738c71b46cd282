//! A discrepancy between model and readings, of the series that comes with the project: μ_d 0.25, an elastic-plastic law.

use creepage::calibration::Loss;
use creepage::{CalibrateOptions, Calibrated, ReadOptions, Readings, calibrate};

use crate::scenes::upper;

/// An interval is as wide as the given discrepancy leaves it; where the law is not the true one, the fit is then believed.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn a_discrepancy_makes_room_where_the_law_is_wrong() {
    let data = Readings::from_file(crate::command::SERIES, &ReadOptions::default()).unwrap();
    let fit = |law: &str, discrepancy, loss| {
        let options = CalibrateOptions {
            discrepancy,
            loss,
            ..CalibrateOptions::default()
        };
        calibrate(&upper(&[law]), &data, &options)
    };
    let fitted = |law: &str, discrepancy| fit(law, discrepancy, Loss::default()).unwrap();
    let width = |answer: &Calibrated| {
        let [lower, upper] = answer.parameters[0].interval_95;
        upper.unwrap() - lower.unwrap()
    };
    let [right, wrong] = ["friction.law=elastic-plastic", "friction.law=coulomb"];
    let [plain, allowed, twice] = [None, Some(0.03), Some(0.06)].map(|share| fitted(right, share));
    assert!(width(&allowed) > 1.1 * width(&plain));
    assert!(width(&twice) > 1.2 * width(&allowed));
    assert_eq!((allowed.parameters.len(), allowed.correlation.len()), (2, 2));

    let [plain, allowed] = [None, Some(0.03)].map(|share| fitted(wrong, share));
    assert!(plain.lack_of_fit.suspicious && !allowed.lack_of_fit.suspicious);
    assert!(width(&allowed) > 4.0 * width(&plain));
    // The truth's distance, in interval widths.
    let off = |answer: &Calibrated| (answer.parameters[0].value - 0.25).abs() / width(answer);
    let [plain, allowed] = [off(&plain), off(&allowed)];
    assert!(plain > 4.0 * allowed, "{plain} {allowed}");

    let absurd = [1e-300, 11.0, f64::NAN].map(|share| (share, Loss::default(), "0.0001 to 10"));
    let robust = (0.1, Loss::Tukey, "independent noise");
    for (share, loss, told) in absurd.into_iter().chain([robust]) {
        let error = fit(right, Some(share), loss).unwrap_err();
        assert!(error.is_bad_input() && error.to_string().contains(told));
    }
}
