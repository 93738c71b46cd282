//! Both solvers on random scenes: with memory in the friction and little inertia, one answer.

use cable_dem::{
    CableError, CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic, Restraint,
};
use proptest::prelude::*;

use super::harness::{Drive, Kind, MASS, Problem, Run};

/// Of the largest force that the cable meets, at the worst place.
const AGREEMENT: f64 = 5e-3;

/// Inertia of the cable beside friction.
const INERTIA: f64 = 1e-4;

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
        (any_law(), 5.0..80.0_f64, prop_oneof![Just(0.0), -0.9..0.9_f64]),
        (any_end(), any_end()),
        prop::collection::vec((0.0..=1.0_f64, 1e4..1e7_f64), 0..2),
        (5e-6..1e-4_f64, 0.7..2.0_f64),
        prop::collection::vec(0..2_usize, 1..4),
    )
        .prop_map(
            |((length, stiffness), (law, limit, steepness), ends, clamps, (peak, width), traffic)| {
                let clamps = clamps.into_iter().map(|(share, stiffness)| Restraint {
                    position: share * length,
                    stiffness,
                });
                let cable = Friction::new(law, limit)
                    .and_then(|friction| DuctedCable::new(length, stiffness, friction))
                    .and_then(|cable| cable.with_ends(ends.0, ends.1))
                    .and_then(|cable| cable.with_restraints(clamps.collect()))
                    .and_then(|cable| cable.with_body_force(steepness * limit))
                    .expect("a valid cable");
                // So slow that the cable's own inertia, m′ D v²/width², is next to nothing beside friction.
                let speed = (width * (INERTIA * limit / (MASS * peak)).sqrt()).min(1.5);
                let drive = Drive::new(speed, 10.0 * width, move |xi| {
                    let t = xi / width;
                    // Not symmetric: steeper behind than ahead.
                    peak * (t + 0.3 * t * t) / (1.0 + t * t).powi(2)
                });
                // Steps so fine that the time between two of them does not count.
                let mesh = Mesh::new(length, 0.1 * width, 0.005 * width).expect("a valid mesh");
                let drives = vec![drive.clone(), drive.back()];
                (Problem { cable, mesh, drives }, traffic)
            },
        )
}

/// Forces on the ends and in the elements after all passes.
fn forces(problem: &Problem, state: &CableState) -> Vec<f64> {
    let ends = state.end_forces(&problem.cable).expect("the state's mesh");
    let inner = state.element_forces(&problem.cable).expect("the state's mesh");
    [ends.upstream, ends.downstream]
        .into_iter()
        .chain(inner)
        .collect()
}

/// The quasi-static answer, and the largest force in the cable at any time.
fn without_inertia(problem: &Problem, traffic: &[usize]) -> Result<(Vec<f64>, f64), CableError> {
    let Problem { cable, mesh, drives } = problem;
    let mut solver = QuasiStatic::new(cable.clone(), *mesh)?;
    let mut state = solver.at_rest();
    // Where nothing moves nothing is left but rounding.
    let mut largest = 1e-6 * problem.largest_force();
    for &drive in traffic {
        let Drive {
            direction,
            approach,
            shape,
            ..
        } = &drives[drive];
        let passage = Passage::from_shape(cable, mesh, *direction, &**shape, *approach)?;
        solver.pass_observed(&passage, &mut state, |_, state| {
            let state = state();
            let forces = state.element_forces(cable).expect("the cable's length");
            largest = forces.fold(largest, |largest, force| largest.max(force.abs()));
        })?;
    }
    Ok((forces(problem, &state), largest))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Measured in 280 scenes: 4.2e-3 of the largest force; with steps twice as long 6.1e-3 in one of them, under Coulomb's law.
    #[test]
    fn both_solvers_have_one_answer((problem, traffic) in any_scene()) {
        let (expected, largest) = without_inertia(&problem, &traffic).expect("an equilibrium");
        let mut run = Run::new(Kind::Explicit, &problem).expect("a valid problem");
        for &drive in &traffic {
            run.pass(drive).expect("an answer");
        }
        let found = forces(&problem, &run.state);
        let errors = found.iter().zip(&expected).map(|(a, b)| (a - b).abs() / largest);
        let worst = errors.fold(0.0, f64::max);
        prop_assert!(worst <= AGREEMENT, "{worst}");
    }
}
