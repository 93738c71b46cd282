//! Whatever the numbers: an answer or an error, never a panic. And the rule for meshes, with its errors.

use crate::common::{APPROACH, EA, LIMIT, Outcome, STIFF_SHEATH, truck};
use crate::mirrored::mirrored;
use cable_dem::{
    CableError, CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, MovingDuct, Order, Passage,
    QuasiStatic, Restraint, Traffic, inertia_ratio,
};
use ground_field::Direction;
use proptest::prelude::*;

fn any_number() -> impl Strategy<Value = f64> {
    let special = vec![
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        -1.0,
        f64::MIN_POSITIVE,
        f64::MAX,
        1.0,
        3.0,
    ];
    prop_oneof![prop::sample::select(special), any::<f64>(), 0.001..1e3_f64]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn meshes_are_made_or_refused([length, spacing, step] in [any_number(), any_number(), any_number()]) {
        for mesh in [Mesh::new(length, spacing, step), Mesh::for_depth(length, spacing, step)].into_iter().flatten() {
            prop_assert!(mesh.nodes() > 2 && mesh.spacing().is_finite() && mesh.vehicle_step() > 0.0);
            mesh.tributary_length(usize::MAX);
        }
    }

    #[test]
    fn cables_and_their_forces_are_numbers_or_refused(
        [length, stiffness, limit, shape_factor, clamp, spring, other] in prop::array::uniform7(any_number()),
        mesh_length in any_number(),
        values in prop::collection::vec(any_number(), 0..6),
        elastic in any::<bool>(),
    ) {
        let law = if elastic { FrictionLaw::ElasticPlastic { shape_factor } } else { FrictionLaw::Coulomb };
        let Ok(friction) = Friction::new(law, limit) else { return Ok(()); };
        friction.after_slip(other, clamp);
        friction.compliance();
        let cable = DuctedCable::new(length, stiffness, friction)
            .and_then(|cable| cable.with_ends(End::Spring(spring), End::Fixed))
            .and_then(|cable| cable.with_restraints(vec![Restraint::new(clamp, spring)]));
        let Ok(cable) = cable else { return Ok(()); };
        mirrored(&cable).expect("a cable").screening_length();
        let _ = inertia_ratio(&cable, clamp, other);
        for length in [length, mesh_length] {
            let Ok(mesh) = Mesh::new(length, length / 3.0, length) else { continue; };
            prop_assert!(CableState::at_rest(&mesh).friction().len() == mesh.nodes());
            let states = [
                Some(CableState::at_rest(&mesh)),
                CableState::from_parts(&mesh, values.clone(), values.clone()).ok(),
            ];
            for state in states.into_iter().flatten() {
                let fits = state.end_forces(&cable).is_ok();
                prop_assert_eq!(fits, (mesh.length() / cable.length() - 1.0).abs() < 1e-9);
                prop_assert_eq!(fits, state.element_forces(&cable).is_ok());
                prop_assert_eq!(fits, state.restraint_forces(&cable).is_ok());
            }
        }
    }

    #[test]
    fn traffic_names_vehicles_that_there_are(
        shares in prop::collection::vec(any_number(), 0..5),
        sequence in prop::collection::vec(prop_oneof![0_usize..5, Just(usize::MAX)], 0..5),
        seed in any::<u64>(),
    ) {
        for order in [Order::Interleaved, Order::Random { seed }, Order::Sequence(sequence)] {
            if let Ok(traffic) = Traffic::new(&shares, order) {
                prop_assert!(traffic.take(20).all(|vehicle| vehicle < shares.len()));
            }
        }
    }
}

#[test]
fn huge_shares_are_refused_where_their_sum_is_no_number() {
    assert!(Traffic::new(&[f64::MAX, f64::MAX], Order::Interleaved).is_err());
}

/// Force after fifty vehicles on a mesh of so many nodes per depth, with two positions of the vehicle a node.
fn force(nodes_per_depth: f64) -> Result<f64, Box<dyn std::error::Error>> {
    let friction = Friction::new(STIFF_SHEATH, LIMIT)?;
    let cable = DuctedCable::new(30.0, EA, friction)?.with_ends(End::Free, End::Fixed)?;
    let spacing = 1.2 / nodes_per_depth;
    let mesh = Mesh::new(30.0, spacing, 0.5 * spacing)?;
    if nodes_per_depth >= 3.0 {
        assert_eq!(mesh, Mesh::for_depth(30.0, 1.2, nodes_per_depth)?);
    }
    let motion = truck(40.0)?;
    // The shape itself: also on meshes too coarse to say anything of the duct.
    let shape = |xi: f64| motion.longitudinal(xi);
    let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, APPROACH)?;
    let mut solver = QuasiStatic::new(cable, mesh)?;
    let mut state = CableState::at_rest(&mesh);
    let mut force = 0.0;
    for _ in 0..50 {
        force = solver.pass(&passage, &mut state)?.force.downstream;
    }
    Ok(force)
}

/// A motion is not used beyond where it is known, and a mesh not where it knows nothing of the duct.
#[test]
fn a_passage_needs_a_motion_that_reaches_far_enough_and_a_mesh_that_is_fine_enough() -> Outcome {
    let friction = Friction::new(STIFF_SHEATH, LIMIT)?;
    let motion = truck(40.0)?;
    let reach = motion.reach();
    for (length, spacing, approach, fits) in [
        (30.0, 0.1, APPROACH, true),
        (30.0, 0.4, APPROACH, true),
        (30.0, 1.0, APPROACH, false),
        (30.0, 5.0, APPROACH, false),
        (30.0, 0.1, reach - 30.0, true),
        (30.0, 0.1, reach - 29.0, false),
        (2.0 * reach, 0.1, 1.0, false),
    ] {
        let cable = DuctedCable::new(length, EA, friction)?;
        let mesh = Mesh::new(length, spacing, 0.5 * spacing)?;
        let passage = Passage::new(&cable, &mesh, &motion, approach);
        let duct = MovingDuct::new(&cable, &mesh, &motion, approach);
        let told = |error: Option<CableError>| {
            matches!(
                error,
                Some(CableError::OutOfReach { .. } | CableError::CoarseMesh { .. })
            )
        };
        assert_eq!(
            told(passage.err()),
            !fits,
            "{length} m, {spacing} m, {approach} m"
        );
        assert_eq!(told(duct.err()), !fits, "{length} m, {spacing} m, {approach} m");
    }
    Ok(())
}

/// The errors that the documentation of [`Mesh::for_depth`] states.
#[test]
fn the_rule_for_meshes_keeps_the_errors_that_it_states() -> Outcome {
    let exact = force(24.0)?;
    for (nodes, error) in [(0.24, 1.05), (1.2, 0.14), (3.0, 0.0135), (6.0, 0.0078)] {
        let found = (force(nodes)? / exact - 1.0).abs();
        assert!(
            (0.9 * error..1.1 * error).contains(&found),
            "{nodes} nodes a depth: {found}"
        );
    }
    let found = (force(12.0)? / exact - 1.0).abs();
    assert!(found < 1e-3, "12 nodes a depth: {found}");
    assert!(Mesh::for_depth(30.0, 1.2, 1.0).is_err());
    Ok(())
}
