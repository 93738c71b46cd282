//! Time of one pass of a 20 tf load at the node spacing that keeps the force within 1 %, and of preparing a passage.

use boussinesq::HalfSpace;
use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};

/// q = μ_d N′ of the reference cable \[N/m\].
const LIMIT: f64 = 0.25 * 108.8;
/// Distance beyond the duct's ends from which the vehicle comes \[m\].
const APPROACH: f64 = 15.0;

fn motion() -> DuctMotion {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4).expect("a valid soil"));
    let truck = Vehicle::point("truck", 196_133.0, 11.1).expect("a valid vehicle");
    let line = DuctLine::new(1.2, 0.0).expect("a valid line");
    DuctMotion::new(&ground, &truck, line, 60.0, 1e-6).expect("a smooth field")
}

fn cable(length: f64, law: FrictionLaw) -> DuctedCable {
    let friction = Friction::new(law, LIMIT).expect("valid friction");
    DuctedCable::new(length, 8.01e6, friction)
        .and_then(|cable| cable.with_ends(End::Free, End::Fixed))
        .expect("a valid cable")
}

fn passes(criterion: &mut Criterion) {
    let motion = motion();
    let sheath = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / LIMIT,
    };
    let mut group = criterion.benchmark_group("passes");
    for length in [30.0, 300.0] {
        let mesh = Mesh::new(length, 0.2, 0.1).expect("a valid mesh");
        for law in [sheath, FrictionLaw::Coulomb] {
            let cable = cable(length, law);
            let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
            let mut solver = QuasiStatic::new(cable, mesh).expect("a valid solver");
            let mut state = CableState::at_rest(&mesh);
            for _ in 0..10 {
                solver.pass(&passage, &mut state).expect("an equilibrium");
            }
            group.bench_function(format!("eleventh pass, {length} m, {}", law.name()), |bencher| {
                bencher.iter_batched(
                    || (solver.clone(), state.clone()),
                    |(mut solver, mut state)| {
                        solver.pass(&passage, &mut state).expect("an equilibrium");
                        (solver, state)
                    },
                    BatchSize::LargeInput,
                );
            });
        }
        let cable = cable(length, sheath);
        group.bench_function(format!("passage, {length} m"), |bencher| {
            bencher.iter(|| Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage"));
        });
    }
    group.finish();
}

criterion_group!(benches, passes);
criterion_main!(benches);
