//! Whatever the numbers: an answer or an error, never a panic. And the rule for meshes, with its errors.

use cable_dem::{
    CableError, CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, MovingDuct, Order, Passage,
    Restraint, Traffic, inertia_ratio,
};
use proptest::prelude::*;

use super::harness::{APPROACH, Bar, Kind, Outcome, Run, UPPER, assert_near, truck};
use super::shared::{mirrored, reference_motion};

fn any_number() -> impl Strategy<Value = f64> {
    let special = testkit::NASTY.to_vec();
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

/// A motion is not used beyond where it is known, and a mesh not where it knows nothing of the duct: from 2 depths of the duct on.
#[test]
fn a_passage_needs_a_motion_that_reaches_far_enough_and_a_mesh_that_is_fine_enough() -> Outcome {
    let motion = reference_motion();
    let reach = motion.reach();
    for (length, spacing, approach, fits) in [
        (30.0, 0.1, APPROACH, true),
        (30.0, 0.4, APPROACH, true),
        (30.0, 1.0, APPROACH, false),
        (30.0, 2.5, APPROACH, false),
        (30.0, 5.0, APPROACH, false),
        (30.0, 15.0, APPROACH, false),
        (30.0, 0.1, reach - 30.0, true),
        (30.0, 0.1, reach - 29.0, false),
        (2.0 * reach, 0.1, 1.0, false),
    ] {
        let cable = Bar { length, ..UPPER }.cable()?;
        let mesh = Mesh::new(length, spacing, 0.5 * spacing)?;
        let passage = Passage::new(&cable, &mesh, &motion, approach).err();
        let duct = MovingDuct::new(&cable, &mesh, &motion, approach).err();
        for error in [passage, duct] {
            let is_expected = match error {
                None => fits,
                Some(CableError::OutOfReach { .. }) => !fits && spacing == 0.1,
                Some(CableError::CoarseMesh { .. }) => !fits && spacing > 0.4,
                _ => false,
            };
            assert!(is_expected, "{length} m, {spacing} m, {approach} m: {error:?}");
        }
    }
    Ok(())
}

/// The errors that the documentation of [`Mesh::for_depth`] states, after fifty vehicles with two positions of the vehicle a node.
#[test]
fn the_rule_for_meshes_keeps_the_errors_that_it_states() -> Outcome {
    let truck = truck();
    let force = |nodes_per_depth: f64| -> Result<f64, CableError> {
        let spacing = 1.2 / nodes_per_depth;
        let bar = Bar {
            mesh: (spacing, 0.5 * spacing),
            ..UPPER
        };
        let problem = bar.under(&truck)?;
        if nodes_per_depth >= 3.0 {
            assert_eq!(problem.mesh, Mesh::for_depth(30.0, 1.2, nodes_per_depth)?);
        }
        let pass = Run::new(Kind::QuasiStatic, &problem)?.passes(50)?;
        Ok(pass.outcome.force.downstream)
    };
    let exact = force(24.0)?;
    for (nodes, error) in [(0.24, 1.05), (1.2, 0.14), (3.0, 0.0135), (6.0, 0.0078)] {
        let found = (force(nodes)? / exact - 1.0).abs();
        assert_near(found, error, 0.1 * error, nodes);
    }
    assert_near(force(12.0)?, exact, 1e-3 * exact, "12 nodes a depth");
    assert!(Mesh::for_depth(30.0, 1.2, 1.0).is_err());
    Ok(())
}
