//! The sigmoid law, which has no state of rest, and what it loses by that.

use crate::common::{APPROACH, EA, LIMIT, MASS, Outcome, STIFF_SHEATH, Scene, relative, truck};
use cable_dem::{
    CableState, DuctedCable, End, Explicit, ExplicitOptions, Friction, FrictionLaw, Mesh, MovingDuct,
    QuasiStatic, SigmoidLeak,
};
use ground_field::Direction;

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
        // So fast that a pass lasts a few relaxation times, and so slow that the cable has long begun to move.
        let still = MovingDuct::from_shape(&cable, &mesh, Direction::Forward, 100.0, |_| 0.0, 15.0)?;
        let mut solver = Explicit::new(cable, mesh, MASS, ExplicitOptions::default())?;
        let leak = SigmoidLeak::new(solver.cable(), solver.time_step(&still), &still).ok_or("no leak")?;
        let mut force = |passes: usize| -> Result<f64, cable_dem::CableError> {
            let mut force = f64::NAN;
            for _ in 0..passes {
                force = solver.pass(&still, &mut state)?.pass.force.downstream;
            }
            Ok(force)
        };
        // Until the slowest mode is left alone.
        let settled = (3.0 * leak.relaxation_time / still.duration()).ceil() as usize;
        let before = force(settled)?;
        let after = force(1)?;
        let expected = 1.0 - leak.loss_per_pass;
        println!(
            "{ends:?}: {settled} passes, then {} for {expected}",
            after / before
        );
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
    let expected = Scene::thirty_metres(FrictionLaw::Coulomb, 0.5, &motion)?
        .quasi_static(2)?
        .force
        .downstream;
    let mut errors = Vec::new();
    for shape_factor in [1e8, 1e9, 1e10, 1e12] {
        let scene = Scene::thirty_metres(FrictionLaw::Sigmoid { shape_factor }, 0.5, &motion)?;
        let outcome = scene.explicit(2, ExplicitOptions::default())?;
        let error = relative(outcome.pass.force.downstream, expected).abs();
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
    let force = |shape_factor: f64, time_step: f64| -> Result<f64, cable_dem::CableError> {
        let scene = Scene::thirty_metres(FrictionLaw::Sigmoid { shape_factor }, 0.5, &motion)?;
        let options = ExplicitOptions {
            time_step: Some(time_step),
            ..ExplicitOptions::default()
        };
        Ok(scene.explicit(2, options)?.pass.force.downstream)
    };
    let (shape_factor, finest) = (1e10, 2.5e-6);
    let mut forces = Vec::new();
    for time_step in [1e-5, 5e-6, finest] {
        let found = force(shape_factor, time_step)?;
        // As short a step, with a law as much steeper.
        let same_product = force(shape_factor * time_step / finest, finest)?;
        println!("Δt = {time_step:.2e} s: {found:.1} N, {same_product:.1} N");
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

/// A cable too stiff to move in a duct that moves by D there and back at once: all slip turns into heat, L q tanh(b D/2) D each time, with the
/// clamped law in the place of the tanh.
#[test]
fn all_slip_of_a_law_without_memory_is_heat() -> Outcome {
    let (shape_factor, displacement) = (1e6, 1e-6);
    let friction = Friction::new(FrictionLaw::Sigmoid { shape_factor }, LIMIT)?;
    let cable = DuctedCable::new(30.0, 1e13, friction)?.with_ends(End::Fixed, End::Fixed)?;
    let mesh = Mesh::new(30.0, 0.5, 0.5)?;
    let duct = MovingDuct::from_shape(&cable, &mesh, Direction::Forward, 1e4, |_| displacement, 15.0)?;
    let mut solver = Explicit::new(cable, mesh, MASS, ExplicitOptions::default())?;
    let heat = solver.pass(&duct, &mut solver.at_rest())?.pass.dissipated;
    let each = 30.0 * LIMIT * 0.5 * shape_factor * displacement * displacement;
    assert!(
        relative(heat, 2.0 * each).abs() < 0.01,
        "{heat} J, not {}",
        2.0 * each
    );
    Ok(())
}
