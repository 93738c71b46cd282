//! What is refused: numbers that are none, parts of another mesh or cable, arguments out of range; and what a failed pass leaves.

use cable_dem::{
    CableError, CableState, DuctedCable, End, Explicit, ExplicitOptions, Friction, FrictionLaw, Mesh,
    MovingDuct, Order, Passage, QuasiStatic, Restraint, Traffic,
};
use ground_field::Direction;

use super::scenes::{APPROACH, LIMITS, Run, coulomb, elastic_plastic, reference_cable, reference_motion};

#[test]
fn a_motion_that_is_not_a_number_is_refused() {
    let mesh = Mesh::new(6.0, 0.2, 0.1).expect("a valid mesh");
    for friction in [coulomb(27.2), elastic_plastic(1e7, 27.2)] {
        let cable = reference_cable(6.0, friction);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            // At a single point only, with little motion elsewhere.
            let little = |xi: f64| 1e-12 * (-xi * xi).exp();
            let shape = |xi: f64| if (xi - 1.0).abs() < 0.05 { bad } else { little(xi) };
            let refused = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, APPROACH);
            let refused = refused.err();
            assert!(matches!(refused, Some(CableError::InvalidParameter { .. })));
        }
    }
}

/// The solver with inertia says so.
#[test]
fn inertia_and_heat_do_not_go_together() {
    let bar = reference_cable(10.0, coulomb(LIMITS[0]));
    let mesh = Mesh::for_depth(10.0, 1.2, 6.0).expect("a valid mesh");
    let duct = MovingDuct::new(&bar, &mesh, &reference_motion(), APPROACH).expect("a valid duct");
    let mut solver = Explicit::new(bar, mesh, 11.1, ExplicitOptions::default()).expect("a valid solver");
    let mut warm = solver.at_rest().with_thermal_force(1.0).expect("a number");
    assert_eq!(solver.pass(&duct, &mut warm).err(), Some(CableError::Heated));
}

#[test]
fn a_failed_pass_leaves_the_state_and_the_solver_as_they_were() {
    let cable = reference_cable(12.0, coulomb(LIMITS[0]));
    let (mut run, passage) = Run::under_truck(&cable, 0.2);
    let far = |xi: f64| 1e6 * (-xi * xi).exp();
    let far = Passage::from_shape(&cable, run.solver.mesh(), Direction::Forward, far, APPROACH);
    run.passes(2, &passage);
    let mut undisturbed = run.clone();
    let before = run.state.clone();
    let far = far.expect("a valid passage");
    let error = run.try_pass(&far).expect_err("rounding swamps friction");
    assert!(matches!(error, CableError::Precision { .. }), "{error}");
    assert_eq!(run.state, before);
    assert_eq!(run.pass(&passage), undisturbed.pass(&passage));
    assert_eq!(run.state, undisturbed.state);
}

#[test]
fn what_belongs_to_another_mesh_or_cable_is_refused() {
    let cable = reference_cable(12.0, coulomb(LIMITS[0]));
    let (mut run, passage) = Run::under_truck(&cable, 0.2);
    let (mesh, motion) = (*run.solver.mesh(), reference_motion());

    let coarse = Mesh::new(12.0, 0.4, 0.1).expect("a valid mesh");
    let mut other = CableState::at_rest(&coarse);
    let refused = run.solver.pass(&passage, &mut other);
    let (found, expected) = (31, 61);
    assert_eq!(refused, Err(CableError::StateMismatch { found, expected }));
    assert_eq!(other, CableState::at_rest(&coarse));

    let [longer, long, finer] = [(13.0, 0.2), (24.0, 0.2), (12.0, 0.1)]
        .map(|(length, spacing)| Mesh::new(length, spacing, 0.1).expect("a valid mesh"));
    assert!(QuasiStatic::new(cable.clone(), longer).is_err());
    let long_cable = reference_cable(24.0, coulomb(LIMITS[0]));
    let stiffer = reference_cable(12.0, elastic_plastic(1e5, LIMITS[0]));
    let others = [(&cable, coarse), (&cable, finer), (&long_cable, long)];
    for (cable, mesh) in others.into_iter().chain([(&stiffer, mesh)]) {
        let wrong = Passage::new(cable, &mesh, &motion, APPROACH).expect("a valid passage");
        let before = run.state.clone();
        assert!(run.try_pass(&wrong).is_err());
        assert_eq!(run.state, before);
    }
}

#[test]
fn arguments_out_of_range_are_refused() {
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0];
    let friction = coulomb(1.0);
    let clamp = |position, stiffness| vec![Restraint::new(position, stiffness)];
    let cable = DuctedCable::new(10.0, 1e6, friction).expect("a valid cable");
    let mesh = Mesh::new(10.0, 1.0, 0.5).expect("a valid mesh");
    let flat = |approach| Passage::from_shape(&cable, &mesh, Direction::Forward, |_| 0.0, approach);
    for value in bad.into_iter().chain([0.0]) {
        assert!(DuctedCable::new(value, 1e6, friction).is_err());
        assert!(DuctedCable::new(10.0, value, friction).is_err());
        let shaped = FrictionLaw::ElasticPlastic { shape_factor: value };
        assert!(Friction::new(shaped, 1.0).is_err());
        assert!(Friction::new(FrictionLaw::Sigmoid { shape_factor: value }, 1.0).is_err());
        assert!(Mesh::new(value, 1.0, 1.0).is_err());
        assert!(Mesh::new(10.0, value, 1.0).is_err());
        assert!(Mesh::new(10.0, 1.0, value).is_err());
        assert!(flat(value).is_err());
        assert!(Traffic::new(&[1.0, value], Order::Interleaved).is_err());
    }
    for value in bad {
        assert!(Friction::new(FrictionLaw::Coulomb, value).is_err());
        assert!(cable.clone().with_ends(End::Spring(value), End::Free).is_err());
        assert!(cable.clone().with_ends(End::Free, End::Spring(value)).is_err());
        assert!(cable.clone().with_restraints(clamp(value, 1.0)).is_err());
        assert!(cable.clone().with_restraints(clamp(1.0, value)).is_err());
    }
    assert!(cable.clone().with_restraints(clamp(10.1, 1.0)).is_err());
    assert!(Mesh::new(10.0, 6.0, 1.0).is_err(), "fewer than two elements");
    assert!(Mesh::new(10.0, 1e-7, 1.0).is_err(), "too many nodes");
    assert!(flat(1e6).is_err());
    let sigmoid = Friction::new(FrictionLaw::Sigmoid { shape_factor: 1e7 }, 1.0).expect("valid friction");
    let refused = QuasiStatic::new(DuctedCable::new(10.0, 1e6, sigmoid).expect("a valid cable"), mesh);
    assert!(matches!(refused, Err(CableError::NoRest { law: "sigmoid", .. })));
}
