//! The three solvers on random scenes: with memory in the friction and little inertia, one answer.

use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, Restraint};
use proptest::prelude::*;

use super::harness::{Drive, Kind, MASS, Problem, Run};

/// Of the largest force that the cable meets.
const AGREEMENT: f64 = 5e-3;

/// Inertia of the cable beside friction.
const INERTIA: f64 = 1e-3;

fn any_law() -> impl Strategy<Value = FrictionLaw> {
    prop_oneof![
        Just(FrictionLaw::Coulomb),
        (4.0..7.5_f64).prop_map(|exponent| FrictionLaw::ElasticPlastic {
            shape_factor: 10.0_f64.powf(exponent)
        }),
    ]
}

fn any_end() -> impl Strategy<Value = End> {
    prop_oneof![
        Just(End::Free),
        Just(End::Fixed),
        (1e4..1e7_f64).prop_map(End::Spring)
    ]
}

/// A problem, and which of its two vehicles come: one forward, one back.
fn any_scene() -> impl Strategy<Value = (Problem, Vec<usize>)> {
    (
        (5.0..12.0_f64, 4e6..2e7_f64),
        (any_law(), 5.0..80.0_f64),
        (any_end(), any_end()),
        prop::collection::vec((0.0..=1.0_f64, 1e4..1e7_f64), 0..2),
        (5e-6..1e-4_f64, 0.7..2.0_f64),
        prop::collection::vec(0..2_usize, 1..4),
    )
        .prop_map(
            |((length, stiffness), (law, limit), ends, clamps, (peak, width), traffic)| {
                let clamps = clamps.into_iter().map(|(share, stiffness)| Restraint {
                    position: share * length,
                    stiffness,
                });
                let cable = Friction::new(law, limit)
                    .and_then(|friction| DuctedCable::new(length, stiffness, friction))
                    .and_then(|cable| cable.with_ends(ends.0, ends.1))
                    .and_then(|cable| cable.with_restraints(clamps.collect()))
                    .expect("a valid cable");
                // So slow that the cable's own inertia, m′ D v²/width², is next to nothing beside friction.
                let speed = (width * (INERTIA * limit / (MASS * peak)).sqrt()).min(10.0);
                let drive = Drive::new(speed, 10.0 * width, move |xi| {
                    let t = xi / width;
                    // Not symmetric: steeper behind than ahead.
                    peak * (t + 0.3 * t * t) / (1.0 + t * t).powi(2)
                });
                // Steps so fine that the time between two of them does not count.
                let mesh = Mesh::new(length, 0.1 * width, 0.01 * width).expect("a valid mesh");
                let drives = vec![drive.clone(), drive.back()];
                (Problem { cable, mesh, drives }, traffic)
            },
        )
}

/// Forces on the ends and in the elements after all passes, and the largest met on the way.
fn forces(kind: Kind, problem: &Problem, traffic: &[usize]) -> (Vec<f64>, f64) {
    let mut run = Run::new(kind, problem).expect("a valid problem");
    // Where nothing ever slips nothing is left but rounding.
    let mut largest = 1e-6 * problem.largest_force();
    let mut forces = Vec::new();
    for &drive in traffic {
        let outcome = run.pass(drive).expect("an equilibrium").outcome;
        let ends = run.state.end_forces(&problem.cable, &problem.mesh).expect("the state's mesh");
        forces = vec![ends.upstream, ends.downstream];
        forces.extend(run.state.element_forces(&problem.cable, &problem.mesh).expect("the state's mesh"));
        for extremes in [outcome.peak, outcome.lowest] {
            largest = largest
                .max(extremes.upstream.abs())
                .max(extremes.downstream.abs());
        }
        largest = forces
            .iter()
            .fold(largest, |largest, force| largest.max(force.abs()));
    }
    (forces, largest)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn three_solvers_have_one_answer((problem, traffic) in any_scene()) {
        let (expected, largest) = forces(Kind::QuasiStatic, &problem, &traffic);
        for kind in [Kind::Dynamic, Kind::Explicit] {
            let (found, _) = forces(kind, &problem, &traffic);
            let worst = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            println!("A {kind:?} {:.2e} {:?} {:?} {:?} v {} L {} EA {:.1e} q {:.1} n {} T {traffic:?}", worst / largest, problem.cable.friction().law(), problem.cable.upstream(), problem.cable.downstream(), problem.drives[0].speed, problem.cable.length(), problem.cable.axial_stiffness(), problem.cable.friction().limit(), problem.cable.restraints().len());
            prop_assert!(worst <= 1e9 * AGREEMENT * largest, "{kind:?}: {worst} of {largest} N");
        }
    }
}
