//! Time of the parts: one vehicle step of each implicit solver, one step of the explicit one, the exact step, and the
//! tables of a passage.

use std::hint::black_box;

use boussinesq::HalfSpace;
use cable_dem::{
    CableState, DuctedCable, End, Explicit, ExplicitOptions, Friction, FrictionLaw, Mesh, MovingDuct,
    Passage, QuasiStatic,
};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};

/// q = μ_d N′ of the reference cable \[N/m\].
const LIMIT: f64 = 0.25 * 108.8;
/// Mass per metre \[kg/m\].
const MASS: f64 = 108.8 / 9.80665;
const LENGTH: f64 = 30.0;
const APPROACH: f64 = 15.0;
const SHEATH: FrictionLaw = FrictionLaw::ElasticPlastic {
    shape_factor: 2e8 / LIMIT,
};

fn motion() -> DuctMotion {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4).expect("a valid soil"));
    let truck = Vehicle::point("truck", 196_133.0, 11.1).expect("a valid vehicle");
    let line = DuctLine::new(1.2, 0.0).expect("a valid line");
    DuctMotion::new(&ground, &truck, line, 60.0, 1e-6).expect("a smooth field")
}

fn cable(law: FrictionLaw, stiffness: f64) -> DuctedCable {
    let friction = Friction::new(law, LIMIT).expect("valid friction");
    DuctedCable::new(LENGTH, stiffness, friction)
        .and_then(|cable| cable.with_ends(End::Free, End::Fixed))
        .expect("a valid cable")
}

fn mesh() -> Mesh {
    Mesh::new(LENGTH, 0.2, 0.1).expect("a valid mesh")
}

/// Criterion's elements a second are linear solves, node updates or exact steps: those of a whole pass over its time.
fn kernels(criterion: &mut Criterion) {
    let (motion, mesh) = (motion(), mesh());
    let mut group = criterion.benchmark_group("kernels");
    group.sample_size(20);

    // The tridiagonal solve with its check: a window on the whole cable is solved at every step.
    for (name, law, stiffness) in [
        ("active set, nodes", SHEATH, 8.01e6),
        // Half of its windows cycle: what remains besides the iteration is the exact step.
        ("active set and exact step, nodes", FrictionLaw::Coulomb, 1e10),
    ] {
        let cable = cable(law, stiffness);
        let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
        let mut solver = QuasiStatic::new(cable, mesh).expect("a valid solver");
        let mut state = CableState::at_rest(&mesh);
        solver.pass(&passage, &mut state).expect("an equilibrium");
        let work = solver.clone().pass(&passage, &mut state.clone());
        let work = work.expect("an equilibrium").statistics;
        group.throughput(Throughput::Elements(work.node_updates as u64));
        group.bench_function(name, |bencher| {
            bencher.iter_batched(
                || (solver.clone(), state.clone()),
                |(mut solver, mut state)| solver.pass(&passage, &mut state).expect("an equilibrium"),
                BatchSize::LargeInput,
            );
        });
    }

    for law in [SHEATH, FrictionLaw::Sigmoid { shape_factor: 1e8 }] {
        let cable = cable(law, 8.01e6);
        let duct = MovingDuct::new(&cable, &mesh, &motion, APPROACH).expect("a valid duct");
        let mut explicit =
            Explicit::new(cable, mesh, MASS, ExplicitOptions::default()).expect("a valid solver");
        let work = explicit.pass(&duct, &mut CableState::at_rest(&mesh));
        let work = work.expect("an answer").pass.statistics;
        group.throughput(Throughput::Elements(work.node_updates as u64));
        group.bench_function(format!("explicit step, {}, nodes", law.name()), |bencher| {
            bencher.iter(|| explicit.pass(black_box(&duct), &mut CableState::at_rest(&mesh)));
        });
    }

    let cable = cable(SHEATH, 8.01e6);
    group.throughput(Throughput::Elements(mesh.nodes() as u64));
    group.bench_function("passage", |bencher| {
        bencher.iter(|| Passage::new(black_box(&cable), &mesh, &motion, APPROACH));
    });
    group.bench_function("moving duct", |bencher| {
        bencher.iter(|| MovingDuct::new(black_box(&cable), &mesh, &motion, APPROACH));
    });
    group.finish();
}

criterion_group!(benches, kernels);
criterion_main!(benches);
