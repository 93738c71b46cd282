//! One pass over 30 m and over 300 m by each solver, at a mesh that keeps the force within 1 %.
#![allow(missing_docs, reason = "criterion's macro makes an undocumented function")]

use boussinesq::HalfSpace;
use cable_dem::{
    CableError, CableState, DuctedCable, End, Explicit, ExplicitOptions, Friction, FrictionLaw, Mesh,
    MovingDuct, Passage, QuasiStatic,
};
use criterion::{Criterion, criterion_group, criterion_main};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};

const MASS: f64 = 108.8 / 9.80665;
const APPROACH: f64 = 15.0;
/// Passes before the one that is measured.
const WARM_UP: usize = 10;

fn solvers(criterion: &mut Criterion) -> Result<(), Box<dyn std::error::Error>> {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("truck", 196_133.0, 40.0 / 3.6)?;
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 100.0, 1e-8)?;
    let limit = 27.2;
    let sheath = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / limit,
    };
    for (length, law) in [(30.0, sheath), (30.0, FrictionLaw::Coulomb), (300.0, sheath)] {
        let mut group = criterion.benchmark_group(format!("pass of {length} m, {}", law.name()));
        group.sample_size(10);
        let cable =
            DuctedCable::new(length, 8.01e6, Friction::new(law, limit)?)?.with_ends(End::Free, End::Fixed)?;
        let mesh = Mesh::new(length, 0.2, 0.1)?;
        let passage = Passage::new(&cable, &mesh, &motion, APPROACH)?;
        let duct = MovingDuct::new(&cable, &mesh, &motion, APPROACH)?;

        let mut quasi_static = QuasiStatic::new(cable.clone(), mesh)?;
        let mut measure = |name: &str, pass: &mut dyn FnMut(&mut CableState) -> Result<f64, CableError>| {
            let mut state = CableState::at_rest(&mesh);
            for _ in 0..WARM_UP {
                pass(&mut state)?;
            }
            group.bench_function(name, |bencher| bencher.iter(|| pass(&mut state.clone())));
            Ok::<(), CableError>(())
        };
        measure("quasi-static", &mut |state| {
            Ok(quasi_static.pass(&passage, state)?.force.downstream)
        })?;
        let mut explicit = Explicit::new(cable, mesh, MASS, ExplicitOptions::default())?;
        measure("explicit", &mut |state| {
            Ok(explicit.pass(&duct, state)?.pass.force.downstream)
        })?;
        group.finish();
    }
    Ok(())
}

fn bench(criterion: &mut Criterion) {
    if let Err(error) = solvers(criterion) {
        panic!("{error}");
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
