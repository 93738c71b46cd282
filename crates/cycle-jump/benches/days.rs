//! Time of days with heat and traffic: 60 m of cable, 480 vehicles of 20 tf a day, 20 K, 24 real passes a day compared with all of them. Prints counts.

use boussinesq::HalfSpace;
use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic};
use criterion::{Criterion, criterion_group, criterion_main};
use cycle_jump::days::{DailyHeat, Day, Days, DaysRequest, LockedLaw, evolve_days};
use cycle_jump::{Guide, JumpError, Jumps};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};

const STIFFNESS: f64 = 8.01e6;
/// q = μ_d N′ of the reference cable \[N/m\].
const LIMIT: f64 = 0.25 * 108.8;
/// Copper, 20 K: Θ = EA α T \[N\].
const SWING: f64 = STIFFNESS * 17e-6 * 20.0;
const PER_DAY: u64 = 480;
/// Distance beyond the duct's ends from which the vehicle comes \[m\].
const APPROACH: f64 = 15.0;

type Made<T> = Result<T, Box<dyn std::error::Error>>;

fn bar(length: f64) -> Made<(DuctedCable, Mesh)> {
    let sheath = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / LIMIT,
    };
    let cable = DuctedCable::new(length, STIFFNESS, Friction::new(sheath, LIMIT)?)?;
    Ok((cable, Mesh::new(length, 0.2, 0.1)?))
}

fn motion() -> Made<DuctMotion> {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("truck", 196_133.0, 11.1)?;
    Ok(DuctMotion::new(
        &ground,
        &truck,
        DuctLine::new(1.2, 0.0)?,
        90.0,
        1e-6,
    )?)
}

/// The locked law, from two passes over 24 m of cable for each share of q.
fn law(motion: &DuctMotion) -> Made<LockedLaw> {
    let (free, mesh) = bar(24.0)?;
    let (nodes, middle) = (mesh.nodes(), mesh.nodes() / 2);
    let mut advances = [0.0; LockedLaw::SHARES.len()];
    for (advance, share) in advances.iter_mut().zip(LockedLaw::SHARES) {
        let cable = free.clone().with_body_force(-share * LIMIT)?;
        let passage = Passage::new(&cable, &mesh, motion, APPROACH)?;
        let mut solver = QuasiStatic::new(cable, mesh)?;
        let mut state = CableState::from_parts(&mesh, vec![0.0; nodes], vec![share * LIMIT; nodes])?;
        solver.pass(&passage, &mut state)?;
        let before = state.displacement()[middle];
        solver.pass(&passage, &mut state)?;
        *advance = state.displacement()[middle] - before;
    }
    Ok(LockedLaw::new(advances, LIMIT))
}

fn days(criterion: &mut Criterion) {
    let motion = motion().expect("a smooth field");
    let law = law(&motion).expect("an equilibrium");
    let (cable, mesh) = bar(60.0).expect("a valid cable");
    let cable = cable.with_ends(End::Free, End::Fixed).expect("an end that holds");
    let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
    let mut solver = QuasiStatic::new(cable.clone(), mesh).expect("a valid solver");
    let mut run = |days: u64, knots: u64| -> Result<Days, JumpError> {
        let heat = DailyHeat::Cosine {
            lowest: 0.0,
            highest: SWING,
        };
        let day = Day::new(PER_DAY, 1, heat, knots)?;
        let jumps = Jumps::new(5e-3, 1.2, (0.01 * LIMIT, 1e-6))?.with_start(3, 0.5)?;
        let request = DaysRequest {
            passes: days * PER_DAY,
            wanted: &[1],
            wanted_days: &[days],
            every_day: false,
            guide: Guide::Free,
            start: None,
        };
        evolve_days(
            &cable,
            &mesh,
            (&day, law.clone()),
            &jumps,
            &request,
            |_, state| solver.pass(&passage, state).map_err(JumpError::from),
        )
    };
    let mut group = criterion.benchmark_group("days");
    group.sample_size(10);
    for (name, count, knots) in [
        ("one day, every pass", 1, PER_DAY),
        ("one day, 24 passes", 1, 24),
        ("20 years, 24 passes", 7305, 24),
    ] {
        let lived = run(count, knots).expect("days");
        println!(
            "{name}: {} passes simulated on {} days, {} linear solves between them",
            lived.simulated, lived.simulated_days, lived.sweeps
        );
        group.bench_function(name, |bencher| {
            bencher.iter(|| run(count, knots).expect("days"));
        });
    }
    group.finish();
}

criterion_group!(benches, days);
criterion_main!(benches);
