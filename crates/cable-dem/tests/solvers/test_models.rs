//! Every solver on every model.

use std::time::Instant;

use cable_dem::{CableError, DuctedCable, End, Friction, FrictionLaw, Mesh};

use super::harness::{AXIAL_STIFFNESS, Kind, LIMITS, Outcome, Problem, Run, sheathed, truck};
use super::models;

#[test]
fn every_solver_has_the_exact_answer_to_every_model() -> Outcome {
    let mut failures = Vec::new();
    for model in models::all()? {
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

/// Each solver books its heat in its own way: at windows of nodes, or node by node and step by step.
#[test]
fn both_solvers_find_the_same_heat() -> Outcome {
    let truck = truck()?;
    for law in [FrictionLaw::Coulomb, sheathed(LIMITS[0])] {
        let problem = Problem {
            cable: DuctedCable::new(15.0, AXIAL_STIFFNESS, Friction::new(law, LIMITS[0])?)?
                .with_ends(End::Free, End::Fixed)?,
            mesh: Mesh::new(15.0, 0.1, 0.05)?,
            drives: vec![truck.clone()],
        };
        for passes in [1, 2, 5] {
            let heat =
                |kind| Ok::<_, CableError>(Run::new(kind, &problem)?.passes(passes)?.outcome.dissipated);
            let expected = heat(Kind::QuasiStatic)?;
            let found = heat(Kind::Explicit)? / expected - 1.0;
            println!("{} pass {passes}: {expected:.3e} J {found:+.1e}", law.name());
            assert!(found.abs() < 0.02, "{}: {found} of {expected} J", law.name());
        }
    }
    Ok(())
}
