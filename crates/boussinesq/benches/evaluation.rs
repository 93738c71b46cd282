//! Time of one displacement: point load, and disc load in each of its three regions.

use std::hint::black_box;

use boussinesq::HalfSpace;
use criterion::{Criterion, criterion_group, criterion_main};
use ground_field::{GroundField, Soil, SurfaceLoad};

fn evaluation(criterion: &mut Criterion) {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4).expect("a valid soil"));
    let point = SurfaceLoad::point(196_133.0).expect("a valid load");
    let disc = SurfaceLoad::new(196_133.0, 0.15).expect("a valid load");
    let mut group = criterion.benchmark_group("displacement");
    for (name, load, radius, depth) in [
        ("point", point, 0.8, 1.2),
        ("disc, far: 1.4 m", disc, 0.8, 1.2),
        ("disc, far: 50 m", disc, 50.0, 1.2),
        ("disc, just far", disc, 0.45, 0.4),
        ("disc, elliptic", disc, 0.25, 0.3),
        ("disc, elliptic at the rim", disc, 0.1499, 1e-4),
        ("disc, near the axis", disc, 0.01, 0.3),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| ground.displacement(black_box(load), black_box(radius), black_box(depth)));
        });
    }
    group.finish();
}

criterion_group!(benches, evaluation);
criterion_main!(benches);
