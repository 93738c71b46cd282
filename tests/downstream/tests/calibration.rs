//! The stranger's model in the calibrator: what made the data comes back out of them.

use creepage::fitting::{Calibration, Parameter, Scale};
use downstream::{BoxError, JointForce, MeasuredGround};

/// Two newtons of noise, drawn once.
const NOISE: [f64; 8] = [1.1, -2.3, 0.4, 2.6, -1.2, -0.3, 1.9, -1.6];

#[test]
fn friction_and_ground_come_back_out_of_the_forces_they_made() -> Result<(), BoxError> {
    let ground = MeasuredGround::new(vec![(0.0, 500e6), (2.0, 800e6)])?;
    let model = JointForce::new(&ground, vec![1, 2, 4, 8, 15, 30, 60, 100])?;
    let (friction, stiffness) = (0.27, 1.3);
    let measured = model
        .forces(friction, stiffness)?
        .iter()
        .zip(NOISE)
        .map(|(force, noise)| force + noise)
        .collect();
    let parameters = vec![
        Parameter::new("friction", 0.1, 0.6, Scale::Linear)?,
        Parameter::new("stiffness", 0.3, 3.0, Scale::Logarithmic)?,
    ];
    let fit = Calibration::new(&model, parameters, measured)?
        .with_sigmas(vec![2.0; NOISE.len()])?
        .fit()?;
    for (estimate, truth) in fit.estimates.iter().zip([friction, stiffness]) {
        assert!(estimate.identifiable, "{estimate:?}");
        assert!(estimate.interval.contains(truth), "{estimate:?}");
        assert!((estimate.value / truth - 1.0).abs() < 0.1, "{estimate:?}");
    }
    let squares: f64 = fit.residuals.iter().map(|residual| residual * residual).sum();
    let rms = (squares / fit.residuals.len() as f64).sqrt();
    assert!(rms < 4.0, "{rms} N");
    Ok(())
}
