//! Displacements of a duct's depth at 200 radii under one wheel: the work a tabulated deflection bowl asks for.

use std::hint::black_box;

use burmister::LayeredHalfSpace;
use criterion::{Criterion, criterion_group, criterion_main};
use ground_field::{Base, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};

fn pavement() -> SoilProfile {
    let soil = |modulus, ratio| Soil::new(modulus, ratio).expect("soil");
    let layer = |modulus| SoilLayer::uniform(0.05, soil(modulus, 0.35)).expect("layer");
    SoilProfile::new(vec![layer(4e9), layer(8e8)], Base::HalfSpace(soil(8e8, 0.4))).expect("profile")
}

fn profile(criterion: &mut Criterion) {
    let ground = LayeredHalfSpace::new(&pavement()).expect("ground");
    let wheel = SurfaceLoad::new(196_133.0, 0.15).expect("load");
    let radii: Vec<f64> = (0..200).map(|i| 20.0 * f64::from(i) / 199.0).collect();
    for (name, accuracy) in [("1e-4", 1e-4), ("1e-8", 1e-8), ("1e-11", 1e-11)] {
        let ground = ground.clone().with_accuracy(accuracy).expect("accuracy");
        criterion.bench_function(&format!("200 radii at depth 1.2 m, accuracy {name}"), |bencher| {
            bencher.iter(|| ground.displacements(black_box(wheel), &radii, 1.2));
        });
    }
    criterion.bench_function("one radius at depth 1.2 m, accuracy 1e-8", |bencher| {
        bencher.iter(|| ground.displacement(black_box(wheel), 3.0, 1.2));
    });
    criterion.bench_function("200 radii on the surface, accuracy 1e-8", |bencher| {
        bencher.iter(|| ground.displacements(black_box(wheel), &radii, 0.0));
    });
}

criterion_group!(benches, profile);
criterion_main!(benches);
