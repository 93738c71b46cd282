//! The explicit solver: against the others, its step limits, and the watch on its energy.

use crate::common::{APPROACH, EA, LIMIT, MASS, Outcome, STIFF_SHEATH, Scene, relative, truck};
use crate::mirrored::mirrored;
use approx::assert_relative_eq;
use cable_dem::{
    CableError, CableState, DuctedCable, Explicit, ExplicitOptions, Friction, FrictionLaw, Mesh, MovingDuct,
    QuasiStatic, Restraint,
};
use ground_field::Direction;

#[test]
fn both_solvers_agree_at_40_km_per_hour() -> Outcome {
    let motion = truck(40.0)?;
    for law in [STIFF_SHEATH, FrictionLaw::Coulomb] {
        let scene = Scene::thirty_metres(law, 0.1, &motion)?;
        let expected = scene.quasi_static(10)?;
        let explicit = scene.explicit(10, ExplicitOptions::default())?;
        let found = &explicit.pass;
        for (found, expected) in [
            (found.force.downstream, expected.force.downstream),
            (found.peak.downstream, expected.peak.downstream),
            (found.max_compression, expected.max_compression),
            (found.upstream_displacement, expected.upstream_displacement),
        ] {
            assert!(
                relative(found, expected).abs() < 5e-3,
                "{law:?}: {found} {expected}"
            );
        }
        // The ground's return to rest takes 4 % off, with vibration or without; what the vibration left amounts to the rest.
        let returned = scene.quasi_static_before_rest(10)? - expected.force.downstream;
        let found = explicit.force_before_rest.downstream - explicit.pass.force.downstream;
        let vibration = (found - returned) / expected.force.downstream;
        assert!(vibration.abs() < 1e-3, "{vibration}");
    }
    Ok(())
}

#[test]
#[ignore = "25 s; cargo test --release -p cable-dem --test explicit -- --ignored"]
fn they_still_agree_after_sixty_passes() -> Outcome {
    let motion = truck(40.0)?;
    for law in [STIFF_SHEATH, FrictionLaw::Coulomb] {
        // A vehicle step of 25 mm: with 50 mm the quasi-static answer itself is 0.3 % off for Coulomb's law.
        let scene = Scene::new(
            (law, LIMIT),
            EA,
            cable_dem::End::Fixed,
            (30.0, 0.1, 0.025),
            &motion,
        )?;
        let expected = scene.quasi_static(60)?.force.downstream;
        let found = scene
            .explicit(60, ExplicitOptions::default())?
            .pass
            .force
            .downstream;
        assert!(
            relative(found, expected).abs() < 5e-3,
            "{law:?}: {found} {expected}"
        );
    }
    Ok(())
}

#[test]
fn energy_balances_and_friction_only_heats() -> Outcome {
    let motion = truck(40.0)?;
    for law in [
        STIFF_SHEATH,
        FrictionLaw::Coulomb,
        FrictionLaw::Sigmoid { shape_factor: 1e8 },
    ] {
        let scene = Scene::thirty_metres(law, 0.2, &motion)?;
        let energy = scene.explicit(2, ExplicitOptions::default())?.energy;
        assert!(energy.unbalanced_share() < 1e-5, "{law:?}: {energy:?}");
        assert!(energy.returned_share() < 1e-8, "{law:?}: {energy:?}");
        assert!(energy.dissipated > 0.0 && energy.peak_kinetic < 1e-3 * energy.duct_work);
    }
    Ok(())
}

#[test]
fn a_state_at_rest_is_in_equilibrium_within_the_friction_limit() -> Outcome {
    let scene = Scene::thirty_metres(STIFF_SHEATH, 0.2, &truck(100.0)?)?;
    let mut solver = Explicit::new(scene.cable.clone(), scene.mesh, MASS, ExplicitOptions::default())?;
    let mut state = CableState::at_rest(&scene.mesh);
    solver.pass(&scene.duct, &mut state)?;
    let forces: Vec<f64> = state.element_forces(&scene.cable)?.collect();
    let f = state.friction();
    assert!(f.iter().all(|f| f.abs() <= LIMIT));
    for node in 1..forces.len() {
        let balance = forces[node - 1] - forces[node] + scene.mesh.spacing() * f[node];
        assert!(
            balance.abs() < 2e-6 * LIMIT * scene.mesh.spacing(),
            "node {node}: {balance}"
        );
    }
    Ok(())
}

#[test]
fn step_limits_follow_their_formulas() -> Outcome {
    let motion = truck(40.0)?;
    for (law, expected) in [
        (STIFF_SHEATH, (4.0 * MASS / 1e8_f64).sqrt()),
        (
            FrictionLaw::Sigmoid {
                shape_factor: 2e8 / LIMIT,
            },
            (2.0 * MASS / 1e8_f64).sqrt(),
        ),
        (FrictionLaw::Coulomb, f64::INFINITY),
    ] {
        let scene = Scene::thirty_metres(law, 0.1, &motion)?;
        let solver = Explicit::new(scene.cable, scene.mesh, MASS, ExplicitOptions::default())?;
        let limits = solver.limits();
        // A clamp on an end that is fixed anyway does not swing.
        let clamped = solver
            .cable()
            .clone()
            .with_restraints(vec![Restraint::new(30.0, 1e12)])?;
        let clamped = Explicit::new(clamped, *solver.mesh(), MASS, ExplicitOptions::default())?;
        assert_eq!(clamped.limits(), limits);
        // One element's travel time of an elastic wave.
        assert_relative_eq!(limits.elastic, 0.1 / (EA / MASS).sqrt(), max_relative = 1e-12);
        if expected.is_finite() {
            assert_relative_eq!(limits.friction, expected, max_relative = 1e-12);
        } else {
            assert_eq!(limits.friction, expected);
        }
        assert!(limits.together() <= limits.elastic.min(limits.friction));
        assert!(limits.together() > 1.1 * solver.time_step(&scene.duct));
    }
    Ok(())
}

#[test]
fn a_step_beyond_the_limit_is_refused() -> Outcome {
    let scene = Scene::thirty_metres(FrictionLaw::Sigmoid { shape_factor: 2e9 }, 0.2, &truck(40.0)?)?;
    let make = |share: f64| {
        let limits =
            *Explicit::new(scene.cable.clone(), scene.mesh, MASS, ExplicitOptions::default())?.limits();
        let options = ExplicitOptions {
            time_step: Some(share * limits.together()),
            ..ExplicitOptions::default()
        };
        Explicit::new(scene.cable.clone(), scene.mesh, MASS, options)
    };
    assert!(make(0.999).is_ok());
    assert!(matches!(make(1.001), Err(CableError::UnstableStep { .. })));
    assert!(matches!(make(f64::NAN), Err(CableError::InvalidParameter { .. })));
    Ok(())
}

/// With the limit switched off, the energy alone must tell: chatter of finite size, and overflow.
#[test]
fn the_energy_watch_catches_what_the_limit_would_refuse() -> Outcome {
    let motion = truck(40.0)?;
    for law in [
        FrictionLaw::Sigmoid { shape_factor: 2e9 },
        FrictionLaw::ElasticPlastic { shape_factor: 2e9 },
        FrictionLaw::Coulomb,
    ] {
        let scene = Scene::thirty_metres(law, 0.2, &motion)?;
        let limits =
            *Explicit::new(scene.cable.clone(), scene.mesh, MASS, ExplicitOptions::default())?.limits();
        for share in [1.1, 1.3, 2.0, 5.0] {
            let options = ExplicitOptions {
                time_step: Some(share * limits.together()),
                check_limits: false,
                ..ExplicitOptions::default()
            };
            let mut solver = Explicit::new(scene.cable.clone(), scene.mesh, MASS, options)?;
            let mut state = CableState::at_rest(&scene.mesh);
            let outcome = solver.pass(&scene.duct, &mut state);
            assert!(
                matches!(outcome, Err(CableError::EnergyNotConserved { .. })),
                "{law:?} at {share} of its limit: {outcome:?}"
            );
            assert_eq!(state, CableState::at_rest(&scene.mesh));
        }
    }
    Ok(())
}

#[test]
fn reverse_traffic_is_the_mirror_image() -> Outcome {
    let friction = Friction::new(STIFF_SHEATH, LIMIT)?;
    let cable =
        DuctedCable::new(10.0, EA, friction)?.with_ends(cable_dem::End::Free, cable_dem::End::Fixed)?;
    let mesh = Mesh::new(10.0, 0.2, 0.1)?;
    let shape = |xi: f64| 40e-6 * xi / (1.0 + xi * xi).powf(1.5);
    let mut outcomes = Vec::new();
    for (cable, direction) in [
        (cable.clone(), Direction::Forward),
        (mirrored(&cable)?, Direction::Reverse),
    ] {
        let duct = MovingDuct::from_shape(&cable, &mesh, direction, 30.0, shape, 8.0)?;
        let mut explicit = Explicit::new(cable, mesh, MASS, ExplicitOptions::default())?;
        outcomes.push(explicit.pass(&duct, &mut CableState::at_rest(&mesh))?.pass);
    }
    let (forward, reverse) = (&outcomes[0], &outcomes[1]);
    assert!(forward.force.downstream > 10.0);
    for (one, other) in [
        (forward.force.downstream, reverse.force.upstream),
        (forward.peak.downstream, reverse.peak.upstream),
        (forward.upstream_displacement, -reverse.downstream_displacement),
    ] {
        assert_relative_eq!(one, other, max_relative = 1e-6);
    }
    Ok(())
}

/// What a solver shows of one pass.
#[derive(Default)]
struct Shown {
    positions: Vec<f64>,
    /// With the vehicle at 15 m.
    middle: Option<CableState>,
}

impl Shown {
    fn look(&mut self, vehicle: f64, state: &dyn Fn() -> CableState) {
        self.positions.push(vehicle);
        if vehicle >= 15.0 && self.middle.is_none() {
            self.middle = Some(state());
        }
    }
}

#[test]
fn both_solvers_show_the_cable_at_every_vehicle_position() -> Outcome {
    let motion = truck(40.0)?;
    let scene = Scene::thirty_metres(STIFF_SHEATH, 0.2, &motion)?;
    let (cable, mesh) = (&scene.cable, scene.mesh);
    let mut quasi_static = QuasiStatic::new(cable.clone(), mesh)?;
    let passage = quasi_static.passage(&motion, APPROACH)?;
    let mut still = Shown::default();
    quasi_static.pass_observed(&passage, &mut quasi_static.at_rest(), |vehicle, state| {
        still.look(vehicle, state);
    })?;
    let mut explicit = Explicit::new(cable.clone(), mesh, MASS, ExplicitOptions::default())?;
    let duct = explicit.passage(&motion, APPROACH)?;
    let mut moving = Shown::default();
    explicit.pass_observed(&duct, &mut explicit.at_rest(), |vehicle, state| {
        moving.look(vehicle, state);
    })?;
    for Shown { positions, .. } in [&still, &moving] {
        assert!(positions.windows(2).all(|pair| pair[0] < pair[1]));
        let (first, last) = (positions[0], positions[positions.len() - 1]);
        assert!(
            (first + APPROACH).abs() < 0.2 && (last - 30.0 - APPROACH).abs() < 0.2,
            "{first} {last}"
        );
    }
    let middle = |shown: Shown| shown.middle.ok_or("nothing was shown");
    let (expected, found) = (middle(still)?, middle(moving)?);
    let (expected_slip, slip) = (expected.slip_lengths(cable)?, found.slip_lengths(cable)?);
    let force = |state: &CableState| state.end_forces(cable).map(|ends| ends.downstream);
    let (expected, found) = (force(&expected)?, force(&found)?);
    assert!(
        expected.abs() > 10.0 && relative(found, expected).abs() < 0.03,
        "{found} {expected}"
    );
    for (found, expected) in [
        (slip.forward, expected_slip.forward),
        (slip.backward, expected_slip.backward),
    ] {
        assert!((found - expected).abs() < 1.0, "{slip:?} {expected_slip:?}");
    }
    Ok(())
}
