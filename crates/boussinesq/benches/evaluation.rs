//! Time of one displacement: point load, and disc load in each of its three regions, and layers by Odemark.

use std::hint::black_box;

use boussinesq::{HalfSpace, Odemark};
use criterion::{Criterion, criterion_group, criterion_main};
use ground_field::{Base, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};

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
    let soil = |modulus| Soil::new(modulus, 0.35).expect("a valid soil");
    let layer = |thickness, modulus| SoilLayer::uniform(thickness, soil(modulus)).expect("a valid layer");
    let layers = vec![layer(0.2, 5e9), layer(0.3, 3e8), layer(1.0, 1e8)];
    let profile = SoilProfile::new(layers, Base::HalfSpace(soil(5e7))).expect("a valid profile");
    let odemark = Odemark::new(&profile).expect("uniform layers");
    for (name, load, depth) in [
        ("odemark, point, layer 4", point, 2.0),
        ("odemark, disc, layer 4", disc, 2.0),
        ("odemark, disc, layer 3", disc, 1.2),
        ("odemark, disc, layer 1", disc, 0.1),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| odemark.displacement(black_box(load), black_box(0.8), black_box(depth)));
        });
    }
    let radii: Vec<f64> = (0..200).map(|i| 0.1 * f64::from(i)).collect();
    for (name, depth) in [
        ("odemark, disc, 200 radii, layer 4", 2.0),
        ("odemark, disc, 200 radii, layer 1", 0.1),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| odemark.displacements(black_box(disc), &radii, black_box(depth)));
        });
    }
    group.bench_function("odemark, made for four layers", |bencher| {
        bencher.iter(|| Odemark::new(black_box(&profile)));
    });
    group.finish();
}

criterion_group!(benches, evaluation);
criterion_main!(benches);
