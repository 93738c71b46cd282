//! A model of one's own, fitted to readings with an outlier.
//!
//! ```sh
//! cargo run -p calibrate --example saturating_force
//! ```

use calibrate::{Calibration, Loss, Model, ModelError, Parameter, Scale};

/// F = F_s (1 − e^(−n/τ)), a force that levels off after n passes.
struct Saturating {
    passes: Vec<f64>,
}

impl Model for Saturating {
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError> {
        let &[saturated, constant] = parameters else {
            return Err("two parameters are wanted".into());
        };
        let force = |n: &f64| saturated * (1.0 - (-n / constant).exp());
        Ok(self.passes.iter().map(force).collect())
    }
}

/// Pass and force, made up; the reading after pass 40 was taken with a slipped cell.
const READINGS: [(f64, f64); 10] = [
    (2.0, 66.1),
    (5.0, 150.8),
    (10.0, 262.3),
    (15.0, 340.5),
    (20.0, 395.2),
    (30.0, 470.9),
    (40.0, 340.0),
    (50.0, 532.7),
    (60.0, 541.5),
    (80.0, 546.2),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (passes, forces) = READINGS.into_iter().unzip();
    let model = Saturating { passes };
    let parameters = vec![
        Parameter::new("saturated_force", 50.0, 5000.0, Scale::Logarithmic)?,
        Parameter::new("passes", 1.0, 1000.0, Scale::Logarithmic)?,
    ];
    let fit = Calibration::new(&model, parameters, forces)?
        .with_loss(Loss::Tukey)
        .fit()?;
    for estimate in &fit.estimates {
        println!(
            "{}: {:.1}, 95 % interval {:?} to {:?}, identifiable: {}",
            estimate.name,
            estimate.value,
            estimate.interval.lower,
            estimate.interval.upper,
            estimate.identifiable
        );
    }
    for warning in &fit.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}
