//! A force that levels off, fitted to its early and to its whole history: `cargo run -p calibrate --example what_data_tell`.
//!
//! Before the force levels off, the data hold the rate at which it begins and hardly anything else: the interval of the
//! saturated force is wide or open, and the fit says so.

use calibrate::{Calibration, ModelError, Parameter, Scale};

/// F = F_s (1 − e^(−n/τ)) with F_s = 550 N and τ = 20 passes, and noise of some newtons.
const READINGS: [(f64, f64); 8] = [
    (1.0, 29.0),
    (2.0, 50.0),
    (3.0, 79.0),
    (5.0, 119.0),
    (10.0, 219.0),
    (20.0, 345.0),
    (40.0, 478.0),
    (80.0, 538.0),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for count in [4, 8] {
        let readings = &READINGS[..count];
        let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
            let force = |n: f64| p[0] * (1.0 - (-n / p[1]).exp());
            Ok(readings.iter().map(|&(n, _)| force(n)).collect())
        };
        let parameters = vec![
            Parameter::new("saturated force, N", 50.0, 5000.0, Scale::Logarithmic)?,
            Parameter::new("passes", 1.0, 1000.0, Scale::Logarithmic)?,
        ];
        let measured = readings.iter().map(|&(_, force)| force).collect();
        let fit = Calibration::new(&model, parameters, measured)?.fit()?;
        println!("after {} passes:", readings[count - 1].0);
        for estimate in &fit.estimates {
            let end = |value: Option<f64>| value.map_or("open".into(), |value| format!("{value:.1}"));
            let known = if estimate.identifiable {
                "known"
            } else {
                "not known"
            };
            println!(
                "  {:20} {:8.1}, 95 % between {} and {}: {known}",
                estimate.name,
                estimate.value,
                end(estimate.interval.lower),
                end(estimate.interval.upper),
            );
        }
        for warning in &fit.warnings {
            println!("  {warning}");
        }
    }
    Ok(())
}
