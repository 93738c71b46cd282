//! Speed on the road of the reference table: 196 133 N on a disc of 150 mm, 200 radii to 20 m at 1.2 m depth.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use ground_field::{Base, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};
use layered_fem::LayeredFem;

fn road() -> SoilProfile {
    let soil = |e, nu| Soil::new(e, nu).expect("a valid soil");
    let layer = |e| SoilLayer::uniform(0.05, soil(e, 0.35)).expect("a valid layer");
    SoilProfile::new(vec![layer(4e9), layer(8e8)], Base::HalfSpace(soil(8e8, 0.4))).expect("a valid profile")
}

fn profile(criterion: &mut Criterion) {
    let road = road();
    let load = SurfaceLoad::new(196_133.0, 0.15).expect("a valid load");
    let radii: Vec<f64> = (0..200).map(|k| 20.0 * f64::from(k) / 199.0).collect();
    for accuracy in [5e-3, 1e-3] {
        criterion.bench_function(
            &format!("mesh, factor, solve, 200 points at {accuracy}"),
            |bencher| {
                bencher.iter(|| {
                    let ground = LayeredFem::new(black_box(&road), accuracy).expect("a solvable ground");
                    ground.displacements(load, &radii, 1.2).expect("an answer")
                });
            },
        );
    }
    let ground = LayeredFem::new(&road, 5e-3).expect("a solvable ground");
    criterion.bench_function("200 points at a known depth", |bencher| {
        bencher.iter(|| {
            ground
                .displacements(load, black_box(&radii), 1.2)
                .expect("an answer")
        });
    });
    let mut depth = 0.6;
    criterion.bench_function("200 points at a new depth", |bencher| {
        bencher.iter(|| {
            depth = if depth > 2.0 { 0.6 } else { depth + 1e-4 };
            ground
                .displacements(load, &radii, black_box(depth))
                .expect("an answer")
        });
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = profile
}
criterion_main!(benches);
