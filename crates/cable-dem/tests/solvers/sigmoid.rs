//! The sigmoid law, which has no state of rest, and what it loses by that.

use cable_dem::{CableError, End, ExplicitOptions, FrictionLaw};

use super::harness::{Bar, Drive, Kind, Outcome, Pass, Run, SHEATH, UPPER, assert_near, limited, truck};

/// Without any motion of the duct, the force stored by passes with memory leaks away as the formula says.
#[test]
fn the_sigmoid_leaks_at_the_rate_of_its_formula() -> Outcome {
    // So fast that a pass lasts a few relaxation times, and so slow that the cable has long begun to move.
    let still = Drive::new(100.0, 15.0, |_| 0.0);
    for ends in [
        (End::Free, End::Fixed),
        (End::Fixed, End::Fixed),
        (End::Free, End::Spring(1e5)),
    ] {
        let bar = Bar {
            ends,
            mesh: (0.5, 0.5),
            ..UPPER
        };
        let mut loaded = Run::new(Kind::QuasiStatic, &bar.under(&truck())?)?;
        loaded.pass(0)?;

        let law = FrictionLaw::Sigmoid { shape_factor: 1e7 };
        let problem = Bar { law, ..bar }.under(&still)?;
        let mut run = Run::resumed(Kind::Explicit, &problem, loaded.state)?;
        let leak = run.pass(0)?.leak.ok_or("no leak")?;
        // Until the slowest mode is left alone.
        let duration = (bar.length + 2.0 * still.approach) / still.speed;
        let settled = (3.0 * leak.relaxation_time / duration).ceil() as usize;
        let before = run.passes(settled)?.outcome.force.downstream;
        let after = run.pass(0)?.outcome.force.downstream;
        let expected = 1.0 - leak.loss_per_pass;
        assert_near(after / before, expected, 5e-3 * expected, ends);
    }
    Ok(())
}

/// A short duct: what the law loses does not depend on the length, and its steps are many.
const SHORT: Bar = Bar {
    length: 9.0,
    law: FrictionLaw::Coulomb,
    mesh: (0.5, 0.25),
    ..UPPER
};

/// Of one that takes too many steps there is no answer.
#[test]
fn the_sigmoid_tends_to_coulombs_law_and_says_that_it_has_not() -> Outcome {
    let truck = truck();
    let moved = |pass: &Pass| pass.outcome.upstream_displacement;
    let expected = moved(&Run::new(Kind::QuasiStatic, &SHORT.under(&truck)?)?.passes(2)?);
    let mut errors = Vec::new();
    for exponent in 3..=14 {
        let shape_factor = 10_f64.powi(exponent);
        let law = FrictionLaw::Sigmoid { shape_factor };
        let mut run = Run::explicit(&Bar { law, ..SHORT }.under(&truck)?, limited(1e8))?;
        match run.passes(2) {
            Ok(pass) => {
                assert!(pass.leak.is_some_and(|leak| leak.matters()));
                errors.push((moved(&pass) / expected - 1.0).abs());
            }
            Err(CableError::TooManySteps { .. } | CableError::NoConvergence { .. }) => {}
            Err(error) => panic!("{error}"),
        }
    }
    let last = &errors[errors.len() - 4..];
    assert!(last.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
    Ok(())
}

/// The law contains the time step: only b Δt counts, and half the step halves what friction holds on to.
#[test]
fn the_sigmoid_depends_on_the_time_step_through_the_product_with_b() -> Outcome {
    let truck = truck();
    let force = |shape_factor: f64, time_step: f64| -> Result<f64, CableError> {
        let law = FrictionLaw::Sigmoid { shape_factor };
        let options = ExplicitOptions {
            time_step: Some(time_step),
            ..ExplicitOptions::default()
        };
        let mut run = Run::explicit(&Bar { law, ..SHORT }.under(&truck)?, options)?;
        Ok(run.passes(2)?.outcome.force.downstream)
    };
    let (shape_factor, finest) = (1e10, 2.5e-6);
    let mut forces = Vec::new();
    for time_step in [1e-5, 5e-6, finest] {
        let found = force(shape_factor, time_step)?;
        if time_step > finest {
            // As short a step, with a law as much steeper.
            let same_product = force(shape_factor * time_step / finest, finest)?;
            assert_near(found, same_product, 0.01 * same_product.abs(), time_step);
        }
        forces.push(found);
    }
    let falls = |pair: &[f64]| pair[1] < 0.95 * pair[0];
    assert!(forces.windows(2).all(falls), "{forces:?}");
    Ok(())
}

/// Its slip is that of one time step, which the explicit solver ties to the mesh: half the speed holds on to less. Read before the ground
/// returns to rest, for which the law takes one step whatever the speed.
#[test]
fn the_sigmoid_depends_on_speed() -> Outcome {
    let truck = truck();
    let half_the_speed = |law| -> Result<f64, CableError> {
        let force = |speed| -> Result<f64, CableError> {
            let problem = Bar { law, ..SHORT }.under(&truck.at(speed))?;
            let mut run = Run::new(Kind::Explicit, &problem)?;
            Ok(run.passes(2)?.before_rest.downstream)
        };
        Ok(force(5.5)? / force(11.0)?)
    };
    let with_sigmoid = half_the_speed(FrictionLaw::Sigmoid { shape_factor: 1e8 })?;
    let with_memory = half_the_speed(SHEATH)?;
    assert!(with_sigmoid < 0.95, "{with_sigmoid}");
    assert_near(with_memory, 1.0, 0.01, "with memory");
    Ok(())
}

/// A cable too stiff to move in a duct that moves by D there and back at once: all slip turns into heat, L q tanh(b D/2) D each time, with the
/// clamped law in the place of the tanh.
#[test]
fn all_slip_of_a_law_without_memory_is_heat() -> Outcome {
    let (shape_factor, displacement) = (1e6, 1e-6);
    let bar = Bar {
        axial_stiffness: 1e13,
        law: FrictionLaw::Sigmoid { shape_factor },
        ends: (End::Fixed, End::Fixed),
        mesh: (0.5, 0.5),
        ..UPPER
    };
    let problem = bar.under(&Drive::new(1e4, 15.0, move |_| displacement))?;
    let heat = Run::new(Kind::Explicit, &problem)?.pass(0)?.outcome.dissipated;
    let both = bar.length * bar.limit * shape_factor * displacement * displacement;
    assert_near(heat, both, 0.01 * both, "J");
    Ok(())
}
