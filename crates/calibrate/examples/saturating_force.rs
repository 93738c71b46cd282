//! A model of one's own, fitted to readings from CSV, with an outlier and an observer.
//!
//! ```sh
//! cargo run -p calibrate --example saturating_force
//! ```

use std::ops::ControlFlow;

use calibrate::{Calibration, Loss, Model, ModelError, Observer, Options, Parameter, Readings, Scale};

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

const DATA: &str = "\
# made up; the reading after pass 40 was taken with a slipped cell
pass,force_n
2,66.1
5,150.8
10,262.3
15,340.5
20,395.2
30,470.9
40,340.0
50,532.7
60,541.5
80,546.2
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let readings = Readings::from_csv("made-up.csv", DATA.as_bytes())?;
    let model = Saturating {
        passes: readings
            .readings()
            .iter()
            .map(|reading| reading.pass as f64)
            .collect(),
    };
    let parameters = vec![
        Parameter::new("saturated_force", 50.0, 5000.0, Scale::Logarithmic)?,
        Parameter::new("passes", 1.0, 1000.0, Scale::Logarithmic)?,
    ];
    let mut options = Options::default();
    options.loss = Loss::TUKEY;
    options.observer = Some(Observer::new(|progress| {
        println!("iteration {:>2}: {:?}", progress.iteration, progress.parameters);
        ControlFlow::Continue(())
    }));
    let fit = Calibration::new(&model, parameters, readings.forces())?
        .with_options(options)?
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
