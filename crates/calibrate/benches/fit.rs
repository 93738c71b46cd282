//! What a fit costs besides the model: forces in closed form, so that nearly all of the time is the calibrator's own.

use std::hint::black_box;

use calibrate::{Calibration, Model, ModelError, Parameter, Scale};
use criterion::{Criterion, criterion_group, criterion_main};

const PASSES: u32 = 40;

/// A force that levels off, F (1 − exp(−n/m)).
fn force(parameters: &[f64]) -> Vec<f64> {
    (1..=PASSES)
        .map(|pass| parameters[0] * (1.0 - (-f64::from(pass) / parameters[1]).exp()))
        .collect()
}

fn parameters() -> Vec<Parameter> {
    vec![
        Parameter::new("force", 10.0, 5000.0, Scale::Linear).expect("bounds in order"),
        Parameter::new("passes", 0.5, 500.0, Scale::Logarithmic).expect("bounds in order"),
    ]
}

/// The forces, a little off by turns.
fn observations() -> Vec<f64> {
    let exact = force(&[550.0, 12.0]);
    let off = (0..13).cycle().map(|k| f64::from(k * 5 % 13) - 6.0);
    exact.iter().zip(off).map(|(force, off)| force + off).collect()
}

fn bench(criterion: &mut Criterion) {
    let model = |parameters: &[f64]| Ok::<_, ModelError>(force(parameters));
    let model: &dyn Model = &model;
    let profiled = Calibration::new(model, parameters(), observations()).expect("a calibration");
    let plain = profiled.clone().without_profiles();
    let mut group = criterion.benchmark_group("two parameters, 40 readings");
    for (name, calibration) in [("optimum", plain), ("optimum and profiles", profiled)] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(&calibration).fit().expect("a fit"));
        });
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
