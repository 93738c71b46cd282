//! Ten million passes over 300 m: cells, ends and evolution from scratch, the cells' table alone, and the evolution alone.

use std::hint::black_box;

use boussinesq::HalfSpace;
use cable_dem::{DuctedCable, End, Friction, FrictionLaw};
use criterion::{Criterion, criterion_group, criterion_main};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
use pass_law::{AdvanceLaw, PassLaw, Resolution};

type Setup = Result<(DuctedCable, [(DuctMotion, f64); 1], Resolution), Box<dyn std::error::Error>>;

fn setup() -> Setup {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 500.0, 1e-8)?;
    let q = 0.25 * 108.8;
    let friction = Friction::new(
        FrictionLaw::ElasticPlastic {
            shape_factor: 2e8 / q,
        },
        q,
    )?;
    let cable = DuctedCable::new(300.0, 8.01e6, friction)?.with_ends(End::Free, End::Fixed)?;
    Ok((cable, [(motion, 1.0)], Resolution::new(1.2)?))
}

fn bench(criterion: &mut Criterion) {
    let (cable, traffic, resolution) = setup().expect("a valid scene");
    let mut group = criterion.benchmark_group("ten million passes over 300 m");
    group.sample_size(10);
    group.bench_function("law and evolution", |bencher| {
        bencher.iter(|| {
            let law = PassLaw::new(black_box(&cable), &traffic, resolution).expect("a law");
            law.run(&[10_000_000]).expect("an evolution")
        });
    });
    group.bench_function("cells alone", |bencher| {
        bencher.iter(|| AdvanceLaw::new(black_box(&cable), &traffic[0].0, resolution).expect("a law"));
    });
    let law = PassLaw::new(&cable, &traffic, resolution).expect("a law");
    group.bench_function("evolution alone", |bencher| {
        bencher.iter(|| law.run(black_box(&[10_000_000])).expect("an evolution"));
    });
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
