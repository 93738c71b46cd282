//! Every solver on every model.

use std::time::Instant;

use cable_dem::FrictionLaw;

use super::harness::{Bar, Kind, Outcome, Pass, Run, SHEATH, truck};
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
            let started = Instant::now();
            let name = format!(
                "{}, {}, {:?} downstream, {kind:?}",
                model.name,
                friction.law().name(),
                model.problem.cable.downstream()
            );
            let mut run = Run::new(kind, &model.problem)?;
            let mut worst = 0.0_f64;
            for (passes, &drive) in (1..).zip(&model.traffic) {
                let pass = run.pass(drive).map_err(|error| format!("{name}: {error}"))?;
                assert!(
                    pass.outcome.dissipated >= -model.problem.negligible_work(),
                    "{name}: {pass:?}"
                );
                for exact in model.exact.iter().filter(|exact| exact.passes == passes) {
                    let found = exact.quantity.read(&model.problem, &run, &pass);
                    let (error, allowed) = ((found - exact.value).abs(), exact.allowed(kind));
                    // Written so that NaN fails.
                    if error <= allowed {
                        worst = worst.max(if allowed > 0.0 { error / allowed } else { 0.0 });
                    } else {
                        failures.push(format!("{name}: {found} for {exact:?}"));
                    }
                    answers += 1;
                }
            }
            println!("{name}: {worst:.2} of what is allowed, {:.2?}", started.elapsed());
        }
        assert!(answers >= model.exact.len());
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

/// What is read during a pass and after it, at 40 km/h. Each solver books its heat in its own way: at windows of nodes, or node by node and
/// step by step.
#[test]
fn both_solvers_tell_the_same_of_a_pass() -> Outcome {
    let truck = truck()?;
    for law in [FrictionLaw::Coulomb, SHEATH] {
        let bar = Bar {
            length: 15.0,
            law,
            // With vehicle steps of 50 mm the quasi-static answer itself is half a percent off.
            mesh: (0.1, 0.025),
            ..Bar::default()
        };
        let problem = bar.under(&truck)?;
        for passes in [1, 2, 10] {
            let last = |kind| Run::new(kind, &problem)?.passes(passes);
            let (still, moving) = (last(Kind::QuasiStatic)?, last(Kind::Explicit)?);
            let heat = moving.outcome.dissipated / still.outcome.dissipated - 1.0;
            assert!(heat.abs() < 0.02, "{}, pass {passes}: {heat}", law.name());
            // The first passes move the cable by next to nothing.
            if passes < 10 {
                continue;
            }
            let told = |Pass { outcome, .. }: &Pass| {
                [
                    outcome.force.downstream,
                    outcome.peak.downstream,
                    outcome.max_compression,
                    outcome.upstream_displacement,
                ]
            };
            for (expected, found) in told(&still).into_iter().zip(told(&moving)) {
                let off = found / expected - 1.0;
                assert!(off.abs() < 5e-3, "{}: {off} of {expected}", law.name());
            }
            // The ground's return to rest takes some percent off, with vibration or without; what the vibration left amounts to the rest.
            let returned = |pass: &Pass| pass.before_rest.downstream - pass.outcome.force.downstream;
            let vibration = (returned(&moving) - returned(&still)) / still.outcome.force.downstream;
            assert!(vibration.abs() < 1e-3, "{vibration}");
        }
    }
    Ok(())
}
