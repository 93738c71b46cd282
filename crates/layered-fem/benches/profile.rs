//! Speed on the road of the reference table: 196 133 N on a disc of 150 mm, 200 radii to 20 m at 1.2 m depth.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use ground_field::{Base, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};
use layered_fem::LayeredFem;
use layered_fem::element::{Quadrilateral, Volumetric};
use layered_fem::material::Elasticity;
use layered_fem::mesh::Mesh;
use layered_fem::system::System;

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

/// The parts of a solution on a mesh of 40 × 40 elements, 13 122 degrees of freedom.
fn kernels(criterion: &mut Criterion) {
    let lines: Vec<f64> = (0..=40).map(|k| 0.15 * (0.2 * f64::from(k)).sinh()).collect();
    let mesh = Mesh::rectangular(Quadrilateral::Quadratic9, &lines, &lines);
    let soil = |_: usize, _: f64, _: f64| Elasticity::new(8e8, 0.4);
    criterion.bench_function("stiffness of one element", |bencher| {
        let nodes = mesh.element_nodes(820);
        let stiffness = |nodes| {
            mesh.kind()
                .stiffness(820, nodes, Volumetric::Projected, |_, _| soil(0, 0.0, 0.0))
        };
        bencher.iter(|| stiffness(black_box(&nodes)));
    });
    let far = lines[40];
    let mut prescribed = vec![false; mesh.dofs()];
    for (index, &[r, z]) in mesh.nodes().iter().enumerate() {
        prescribed[2 * index] = r == 0.0 || r == far || z == far;
        prescribed[2 * index + 1] = r == far || z == far;
    }
    criterion.bench_function("assembly and factorisation, 13 000 unknowns", |bencher| {
        bencher.iter(|| System::new(black_box(&mesh), Volumetric::Projected, &prescribed, soil));
    });
    let system = System::new(&mesh, Volumetric::Projected, &prescribed, soil).expect("a regular system");
    let mut force = vec![0.0; mesh.dofs()];
    force[1] = 1.0;
    let rest = vec![0.0; mesh.dofs()];
    criterion.bench_function("solution of one load, 13 000 unknowns", |bencher| {
        bencher.iter(|| system.solve(black_box(&force), &rest).expect("a solution"));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = profile, kernels
}
criterion_main!(benches);
