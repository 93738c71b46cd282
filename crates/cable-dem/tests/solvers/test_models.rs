//! Every solver on every model.

use cable_dem::{CableError, FrictionLaw};

use super::harness::{Bar, Kind, Outcome, Run, SHEATH, UPPER, assert_near, truck};
use super::models;

/// In two threads: it is the longest test of this program, and its last.
#[test]
fn every_solver_has_the_exact_answer_to_every_model() {
    std::thread::scope(|threads| {
        for half in 0..2 {
            threads.spawn(move || every_solver_on_every_second_model(half).expect("answers"));
        }
    });
}

fn every_solver_on_every_second_model(first: usize) -> Outcome {
    let mut failures = Vec::new();
    for model in models::all()?.into_iter().skip(first).step_by(2) {
        let friction = model.problem.cable.friction();
        let mut answers = 0;
        for kind in Kind::for_law(friction.law()) {
            let (law, end) = (friction.law().name(), model.problem.cable.downstream());
            let name = format!("{}, {law}, {end:?} downstream, {kind:?}", model.name);
            let mut run = Run::new(kind, &model.problem)?;
            for (passes, &drive) in (1..).zip(&model.traffic) {
                let pass = run.pass(drive).map_err(|error| format!("{name}: {error}"))?;
                let heat = pass.outcome.dissipated;
                assert!(heat >= -model.problem.negligible_work(), "{name}: {heat} J");
                for exact in model.exact.iter().filter(|exact| exact.passes == passes) {
                    let found = exact.quantity.read(&model.problem, &run, &pass);
                    let (error, allowed) = ((found - exact.value).abs(), exact.allowed(kind));
                    if error > allowed || error.is_nan() {
                        failures.push(format!("{name}: {found} for {exact:?}"));
                    }
                    answers += 1;
                }
            }
        }
        assert!(answers >= model.exact.len());
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

/// Each solver books its heat in its own way: at windows of nodes, or node by node and step by step.
#[test]
fn both_solvers_tell_the_same_heat_of_a_pass() -> Outcome {
    let truck = truck();
    for law in [FrictionLaw::Coulomb, SHEATH] {
        let bar = Bar {
            length: 15.0,
            law,
            // With vehicle steps of 50 mm the quasi-static answer itself is half a percent off.
            mesh: (0.1, 0.025),
            ..UPPER
        };
        let problem = bar.under(&truck)?;
        for passes in [1, 2, 10] {
            let heat = |kind| -> Result<f64, CableError> {
                Ok(Run::new(kind, &problem)?.passes(passes)?.outcome.dissipated)
            };
            let expected = heat(Kind::QuasiStatic)?;
            assert_near(heat(Kind::Explicit)?, expected, 0.02 * expected, (law, passes));
        }
    }
    Ok(())
}
