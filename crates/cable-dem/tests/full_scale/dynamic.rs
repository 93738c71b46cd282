//! The dynamic implicit solver: its order, what inertia does, and the sigmoid law.

use crate::common::{APPROACH, EA, LIMIT, MASS, Outcome, STIFF_SHEATH, Scene, relative, truck};
use cable_dem::{
    CableState, DuctedCable, Dynamic, End, ExplicitOptions, Friction, FrictionLaw, Mesh, MovingDuct,
    QuasiStatic, SigmoidLeak, inertia_ratio,
};
use ground_field::Direction;

/// A soft sheath that never slips, shaken by a fast bump: a smooth problem, read in mid-swing.
#[test]
fn the_step_is_of_second_order() -> Outcome {
    let friction = Friction::new(FrictionLaw::ElasticPlastic { shape_factor: 1e4 }, LIMIT)?;
    let cable = DuctedCable::new(10.0, EA, friction)?.with_ends(End::Free, End::Fixed)?;
    let force = |vehicle_step: f64| -> Result<f64, cable_dem::CableError> {
        let mesh = Mesh::new(10.0, 0.5, vehicle_step)?;
        let bump = |xi: f64| 2e-5 * (-xi * xi / 4.0).exp();
        let duct = MovingDuct::from_shape(&cable, &mesh, Direction::Forward, 100.0, bump, 12.0)?;
        let outcome =
            Dynamic::new(cable.clone(), mesh, MASS)?.pass(&duct, &mut CableState::at_rest(&mesh))?;
        Ok(outcome.force_before_rest.downstream)
    };
    let forces = [0.025, 0.0125, 0.00625, 0.003125].map(force);
    let [a, b, c, d] = forces;
    let (a, b, c, d) = (a?, b?, c?, d?);
    assert!(d.abs() > 0.1, "{d}");
    for order in [((a - b) / (b - c)).abs().log2(), ((b - c) / (c - d)).abs().log2()] {
        assert!((1.8..2.2).contains(&order), "{order}: {a} {b} {c} {d}");
    }
    Ok(())
}

/// Near the vehicle inertia softens the cable by v²/c²: the force is smaller by a part of that share.
#[test]
fn the_inertia_ratio_predicts_what_leaving_inertia_out_costs() -> Outcome {
    let passes = 10;
    let reference = Scene::thirty_metres(STIFF_SHEATH, 0.1, &truck(40.0)?)?
        .quasi_static(passes)?
        .force
        .downstream;
    // What time stepping leaves between both solvers without inertia.
    let stepping = 3e-4;
    for speed in [40.0, 100.0, 300.0, 1000.0] {
        let scene = Scene::thirty_metres(STIFF_SHEATH, 0.1, &truck(speed)?)?;
        let ratio = inertia_ratio(&scene.cable, MASS, speed / 3.6)?;
        let found = relative(scene.dynamic(passes)?.pass.force.downstream, reference);
        println!(
            "{speed} km/h: ratio {ratio:.2e}, found {found:+.2e}, share {:.2}",
            -found / ratio
        );
        assert!(
            found < stepping && found > -ratio - stepping,
            "{speed} km/h: {found} {ratio}"
        );
        assert!(
            (-found / ratio - 0.37).abs() < 0.12 + stepping / ratio,
            "{speed} km/h: {found} {ratio}"
        );
    }
    Ok(())
}

/// At high speed the explicit scheme needs a finer mesh: nodes passed at v/h excite its lattice.
#[test]
fn both_solvers_with_inertia_agree_at_speed() -> Outcome {
    for (speed, spacing, bound) in [(100.0, 0.1, 5e-3), (300.0, 0.05, 5e-3), (1000.0, 0.05, 1e-2)] {
        let scene = Scene::thirty_metres(STIFF_SHEATH, spacing, &truck(speed)?)?;
        let dynamic = scene.dynamic(2)?.pass.force.downstream;
        let explicit = scene
            .explicit(2, ExplicitOptions::default())?
            .pass
            .force
            .downstream;
        println!("{speed} km/h: {dynamic} {explicit}");
        assert!(
            relative(dynamic, explicit).abs() < bound,
            "{speed} km/h: {dynamic} {explicit}"
        );
    }
    Ok(())
}

#[test]
fn inertia_never_creates_energy() -> Outcome {
    for (law, speed) in [
        (STIFF_SHEATH, 40.0),
        (STIFF_SHEATH, 300.0),
        (FrictionLaw::Coulomb, 40.0),
        (FrictionLaw::Sigmoid { shape_factor: 1e9 }, 40.0),
    ] {
        let energy = Scene::thirty_metres(law, 0.2, &truck(speed)?)?.dynamic(2)?.energy;
        assert!(energy.residual() > -1e-6 * energy.duct_work, "{law:?}: {energy}");
        assert!(energy.returned_share() < 1e-6, "{law:?}: {energy}");
    }
    Ok(())
}

/// Without any motion of the duct, the force stored by passes with memory leaks away as the formula says.
#[test]
fn the_sigmoid_leaks_at_the_rate_of_its_formula() -> Outcome {
    let mesh = Mesh::new(30.0, 0.5, 0.5)?;
    let law = FrictionLaw::Sigmoid { shape_factor: 1e7 };
    for ends in [
        (End::Free, End::Fixed),
        (End::Fixed, End::Fixed),
        (End::Free, End::Spring(1e5)),
    ] {
        let build = |law| -> Result<DuctedCable, cable_dem::CableError> {
            DuctedCable::new(30.0, EA, Friction::new(law, LIMIT)?)?.with_ends(ends.0, ends.1)
        };
        let mut state = CableState::at_rest(&mesh);
        let loaded = build(STIFF_SHEATH)?;
        let passage = cable_dem::Passage::new(&loaded, &mesh, &truck(40.0)?, APPROACH)?;
        QuasiStatic::new(loaded, mesh)?.pass(&passage, &mut state)?;

        let cable = build(law)?;
        let still = MovingDuct::from_shape(&cable, &mesh, Direction::Forward, 40.0 / 3.6, |_| 0.0, 15.0)?;
        let mut solver = Dynamic::new(cable, mesh, MASS)?;
        let leak = SigmoidLeak::new(solver.cable(), solver.time_step(&still), &still).ok_or("no leak")?;
        let mut force = |passes: usize| -> Result<f64, cable_dem::CableError> {
            for _ in 1..passes {
                solver.pass(&still, &mut state)?;
            }
            Ok(solver.pass(&still, &mut state)?.pass.force.downstream)
        };
        // Until the slowest mode is left alone.
        let settled = (3.0 * leak.relaxation_time / still.duration()).ceil() as usize;
        let before = force(settled)?;
        let after = force(5)?;
        let expected = (1.0 - leak.loss_per_pass).powi(5);
        assert!(
            relative(after / before, expected).abs() < 5e-3,
            "{ends:?}: {} {expected}",
            after / before
        );
    }
    Ok(())
}

#[test]
fn the_sigmoid_tends_to_coulombs_law_and_says_when_it_has_not() -> Outcome {
    let motion = truck(40.0)?;
    let expected = Scene::thirty_metres(FrictionLaw::Coulomb, 0.2, &motion)?
        .dynamic(2)?
        .pass;
    let mut errors = Vec::new();
    for shape_factor in [1e7, 1e8, 1e9, 1e10, 1e12] {
        let outcome =
            Scene::thirty_metres(FrictionLaw::Sigmoid { shape_factor }, 0.2, &motion)?.dynamic(2)?;
        let error = relative(outcome.pass.force.downstream, expected.force.downstream).abs();
        let leak = outcome.leak.ok_or("no leak")?;
        println!("b = {shape_factor:.0e}: {error:.1e}; {leak}");
        assert!(
            leak.matters() || error < 0.03,
            "{shape_factor:.0e}: silent error of {error}"
        );
        errors.push(error);
    }
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
    Ok(())
}

/// The law contains the time step: only b Δt counts, and half the step halves what friction holds on to.
#[test]
fn the_sigmoid_depends_on_the_time_step_through_the_product_with_b() -> Outcome {
    let motion = truck(40.0)?;
    let force = |shape_factor: f64, vehicle_step: f64| -> Result<f64, cable_dem::CableError> {
        let law = (FrictionLaw::Sigmoid { shape_factor }, LIMIT);
        let scene = Scene::new(law, EA, End::Fixed, (30.0, 0.2, vehicle_step), &motion)?;
        Ok(scene.dynamic(2)?.pass.force.downstream)
    };
    let mut forces = Vec::new();
    for vehicle_step in [0.2, 0.1, 0.05, 0.025] {
        let found = force(1e8, vehicle_step)?;
        let same_product = force(1e8 * vehicle_step / 0.025, 0.025)?;
        println!(
            "Δt = {:.2} ms: {found:.1} N, {same_product:.1} N",
            vehicle_step * 90.0
        );
        assert!(
            relative(found, same_product).abs() < 0.01,
            "{found} {same_product}"
        );
        forces.push(found);
    }
    assert!(
        forces.windows(2).all(|pair| pair[1] < 0.95 * pair[0]),
        "{forces:?}"
    );
    Ok(())
}

#[test]
fn a_law_with_memory_has_no_leak() -> Outcome {
    let cable = DuctedCable::new(30.0, EA, Friction::new(STIFF_SHEATH, LIMIT)?)?;
    let mesh = Mesh::new(30.0, 1.0, 1.0)?;
    let still = MovingDuct::from_shape(&cable, &mesh, Direction::Forward, 10.0, |_| 0.0, 15.0)?;
    assert_eq!(SigmoidLeak::new(&cable, 1e-3, &still), None);
    Ok(())
}
