//! The explicit solver: its energy, its step limits, and what it shows of a pass.

use approx::assert_relative_eq;
use cable_dem::{
    CableError, CableState, Explicit, ExplicitOptions, FrictionLaw, MovingDuct, Restraint, laid,
};

use super::harness::{
    APPROACH, AXIAL_STIFFNESS, Bar, Kind, LIMITS, MASS, Outcome, Problem, Run, SHEATH, UPPER, assert_near,
    truck,
};
use super::shared::reference_motion;

/// With a step of so many times what its stability allows.
fn in_steps_of(problem: &Problem, share: f64, check_limits: bool) -> Result<Run, CableError> {
    let Problem { cable, mesh, .. } = problem;
    let solver = Explicit::new(cable.clone(), *mesh, MASS, ExplicitOptions::default())?;
    let options = ExplicitOptions {
        time_step: Some(share * solver.limits().together()),
        check_limits,
        ..ExplicitOptions::default()
    };
    Run::explicit(problem, options)
}

#[test]
fn energy_balances_and_the_cable_comes_to_rest() -> Outcome {
    let truck = truck();
    for (law, speed) in [
        (SHEATH, 40.0),
        (SHEATH, 100.0),
        (FrictionLaw::Coulomb, 40.0),
        (FrictionLaw::Sigmoid { shape_factor: 1e8 }, 40.0),
    ] {
        let problem = Bar { law, ..UPPER }.under(&truck.at(speed / 3.6))?;
        let mut run = Run::new(Kind::Explicit, &problem)?;
        let pass = run.passes(2)?;
        assert_eq!(pass.leak.is_none(), law.has_memory());
        let energy = pass.energy.ok_or("no energy")?;
        assert!(energy.unbalanced_share() < 1e-5, "{law:?}: {energy:?}");
        assert!(energy.returned_share() < 1e-8, "{law:?}: {energy:?}");
        assert!(energy.dissipated > 0.0 && energy.peak_kinetic < 1e-3 * energy.duct_work);

        let forces: Vec<f64> = run.state.element_forces(&problem.cable)?.collect();
        let (friction, h) = (run.state.friction(), problem.mesh.spacing());
        for (node, pair) in (1..).zip(forces.windows(2)) {
            let balance = pair[0] - pair[1] + h * friction[node];
            assert_near(balance, 0.0, 2e-6 * LIMITS[0] * h, (law, node));
        }
    }
    Ok(())
}

#[test]
fn step_limits_follow_their_formulas() -> Outcome {
    let shape_factor = 2e8 / LIMITS[0];
    let mesh = (0.1, 0.05);
    for (law, expected) in [
        (SHEATH, (4.0 * MASS / 1e8_f64).sqrt()),
        (
            FrictionLaw::Sigmoid { shape_factor },
            (2.0 * MASS / 1e8_f64).sqrt(),
        ),
        (FrictionLaw::Coulomb, f64::INFINITY),
    ] {
        let bar = Bar { law, mesh, ..UPPER };
        let Problem { cable, mesh, .. } = bar.under(&truck())?;
        let duct = MovingDuct::new(&cable, &mesh, &reference_motion(), APPROACH)?;
        let solver = |cable| Explicit::new(cable, mesh, MASS, ExplicitOptions::default());
        // A clamp on an end that is fixed anyway does not swing.
        let clamped = solver(cable.clone().with_restraints(vec![Restraint::new(30.0, 1e12)])?)?;
        let solver = solver(cable)?;
        let limits = solver.limits();
        assert_eq!(clamped.limits(), limits);
        // One element's travel time of an elastic wave.
        let wave = 0.1 / (AXIAL_STIFFNESS / MASS).sqrt();
        assert_relative_eq!(limits.elastic, wave, max_relative = 1e-12);
        assert_relative_eq!(limits.friction, expected, max_relative = 1e-12);
        assert!(limits.together() <= limits.elastic.min(limits.friction));
        assert!(limits.together() > 1.1 * solver.time_step(&duct));
    }
    Ok(())
}

/// Beyond its limit a step is refused; with the limit switched off, the energy alone must tell: chatter of finite size, and overflow.
#[test]
fn a_step_beyond_the_limit_is_refused_and_seen_by_its_energy() -> Outcome {
    let truck = truck();
    let shape_factor = 2e9;
    for law in [
        FrictionLaw::Sigmoid { shape_factor },
        FrictionLaw::ElasticPlastic { shape_factor },
        FrictionLaw::Coulomb,
    ] {
        let problem = Bar { law, ..UPPER }.under(&truck)?;
        let refused = |share| in_steps_of(&problem, share, true).err();
        assert_eq!(refused(0.999), None);
        assert!(matches!(refused(1.001), Some(CableError::UnstableStep { .. })));
        let invalid = refused(f64::NAN);
        assert!(matches!(invalid, Some(CableError::InvalidParameter { .. })));
        for share in [1.1, 1.3, 2.0, 5.0] {
            let mut run = in_steps_of(&problem, share, false)?;
            let outcome = run.pass(0);
            assert!(
                matches!(outcome, Err(CableError::EnergyNotConserved { .. })),
                "{law:?} at {share} of its limit: {outcome:?}"
            );
            assert_eq!(run.state, laid(&problem.cable, &problem.mesh)?);
        }
    }
    Ok(())
}

#[test]
fn both_solvers_show_the_cable_at_every_vehicle_position() -> Outcome {
    let problem = UPPER.under(&truck())?;
    let mut middles = Vec::new();
    for kind in Kind::ALL {
        let (mut positions, mut middle): (Vec<f64>, Option<CableState>) = Default::default();
        Run::new(kind, &problem)?.watch(0, |vehicle, state| {
            positions.push(vehicle);
            if vehicle >= 15.0 && middle.is_none() {
                middle = Some(state());
            }
        })?;
        assert!(positions.windows(2).all(|pair| pair[0] < pair[1]));
        assert_near(positions[0], -15.0, 0.2, kind);
        assert_near(positions[positions.len() - 1], 45.0, 0.2, kind);
        let state = middle.ok_or("nothing was shown")?;
        let slip = state.slip_lengths(&problem.cable)?;
        let force = state.end_forces(&problem.cable)?.downstream;
        middles.push((force, [slip.forward, slip.backward]));
    }
    let [(expected, lengths), (found, others)] = middles[..] else {
        return Err("two solvers".into());
    };
    assert!(expected.abs() > 10.0);
    assert_near(found, expected, 0.03 * expected.abs(), "N");
    for (one, other) in lengths.into_iter().zip(others) {
        assert_near(one, other, 1.0, "m");
    }
    Ok(())
}
