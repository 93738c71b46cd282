//! Hostile parameters: a right answer or a typed error, and nothing in between.

use cable_dem::{CableError, End, ExplicitOptions, FrictionLaw, PassOutcome};

use super::harness::{Bar, Drive, Kind, LIMITS, MASS, Outcome, Problem, Run, SHEATH, truck};

/// With so many node updates that no test takes long.
fn limited(problem: &Problem, max_node_updates: f64) -> Result<Run, CableError> {
    let options = ExplicitOptions {
        max_node_updates,
        ..ExplicitOptions::default()
    };
    Run::explicit(problem, options)
}

/// Runs two passes with both solvers; at least one answers, and where both do, they agree: the explicit one refuses what takes too many
/// steps.
///
/// Friction on one element is the mesh's resolution.
fn judge(bar: Bar, truck: &Drive) -> Result<(), CableError> {
    let problem = bar.under(truck)?;
    let inertia = cable_dem::inertia_ratio(&problem.cable, MASS, truck.speed).unwrap_or(f64::NAN);
    let mut right = Vec::new();
    for kind in Kind::ALL {
        let run = match kind {
            Kind::QuasiStatic => Run::new(kind, &problem),
            Kind::Explicit => limited(&problem, 7e7),
        };
        match run.and_then(|mut run| run.passes(2)) {
            Ok(pass) => right.push((pass.outcome.force.downstream, pass.outcome.peak.downstream)),
            Err(
                CableError::Precision { .. }
                | CableError::TooManySteps { .. }
                | CableError::NoConvergence { .. },
            ) => {}
            Err(error) => panic!("{bar:?}, {kind:?}: {error}"),
        }
    }
    assert!(!right.is_empty(), "{bar:?}: no answer");
    let (expected, expected_peak) = right[right.len() - 1];
    let resolution = bar.limit * problem.mesh.spacing();
    let bound = (0.01 + inertia) * expected.abs().max(expected_peak.abs()) + 0.5 * resolution;
    for (force, peak) in &right {
        assert!(
            peak.is_finite() && (force - expected).abs() <= bound,
            "{bar:?}: {right:?}"
        );
    }
    Ok(())
}

/// Shape factors from 1e3 to 1e14, stiffnesses from 1e3 to 1e12 N, springs from 1 to 1e12 N/m, nodes from 1 mm to 5 m apart and three of
/// them, limits from 1e-9 to 1e9 N/m.
#[test]
fn whatever_the_numbers_both_solvers_agree_or_refuse() -> Outcome {
    let truck = truck()?;
    let coarse = Bar {
        length: 15.0,
        mesh: (0.5, 0.1),
        ..Bar::default()
    };
    let mut bars = Vec::new();
    for exponent in 3..=14 {
        let shape_factor = 10_f64.powi(exponent);
        let law = FrictionLaw::ElasticPlastic { shape_factor };
        bars.push(Bar {
            law,
            ..Bar::default()
        });
    }
    // With hardly any friction peaks are ringing, which takes fine steps to follow.
    for (limit, step) in [(1e-9, 0.005), (1e-3, 0.005), (1e6, 0.1), (1e9, 0.1)] {
        bars.push(Bar {
            limit,
            mesh: (0.5, step),
            ..coarse
        });
    }
    for law in [SHEATH, FrictionLaw::Coulomb] {
        for exponent in 3..=12 {
            let axial_stiffness = 10_f64.powi(exponent);
            bars.push(Bar {
                axial_stiffness,
                law,
                ..coarse
            });
        }
        for exponent in 0..=12 {
            let ends = (End::Free, End::Spring(10_f64.powi(exponent)));
            bars.push(Bar { law, ends, ..coarse });
        }
        for (length, spacing) in [
            (0.5, 0.001),
            (2.0, 0.01),
            (30.0, 0.1),
            (30.0, 0.5),
            (30.0, 1.0),
            (30.0, 2.0),
            (30.0, 5.0),
            (10.0, 5.0),
            (2.0, 1.0),
            (0.002, 0.001),
        ] {
            let mesh = (spacing, 0.1);
            bars.push(Bar {
                length,
                law,
                mesh,
                ..Bar::default()
            });
        }
    }
    for bar in bars {
        judge(bar, &truck)?;
    }
    Ok(())
}

#[test]
fn sigmoid_shape_factors_from_1e3_to_1e14() -> Outcome {
    let truck = truck()?;
    let coarse = Bar {
        length: 12.0,
        mesh: (0.5, 0.25),
        law: FrictionLaw::Coulomb,
        ..Bar::default()
    };
    // Not the force after the pass: on the half element before a fixed end friction turns over at once with the sigmoid and bit by bit with
    // Coulomb's law.
    let read = |pass: &PassOutcome| [pass.peak.downstream, pass.upstream_displacement];
    let expected = read(
        &Run::new(Kind::QuasiStatic, &coarse.under(&truck)?)?
            .pass(0)?
            .outcome,
    );
    for exponent in 3..=14 {
        let shape_factor = 10_f64.powi(exponent);
        let law = FrictionLaw::Sigmoid { shape_factor };
        let problem = Bar { law, ..coarse }.under(&truck)?;
        match limited(&problem, 1e8)?.pass(0) {
            Ok(pass) => {
                let (found, leak) = (read(&pass.outcome), pass.leak.ok_or("no leak")?);
                let is_close = found
                    .iter()
                    .zip(expected)
                    .all(|(a, b)| (a / b - 1.0).abs() < 0.02);
                assert!(
                    leak.matters() || is_close,
                    "b = 1e{exponent}: {found:?} without a warning, {expected:?}"
                );
            }
            Err(CableError::TooManySteps { .. } | CableError::NoConvergence { .. }) => {}
            Err(error) => panic!("{error}"),
        }
    }
    Ok(())
}

#[test]
fn no_friction_and_no_load_move_nothing() -> Outcome {
    let truck = truck()?;
    let mut still = truck.clone();
    still.shape = std::rc::Rc::new(|_| 0.0);
    for law in [
        SHEATH,
        FrictionLaw::Coulomb,
        FrictionLaw::ElasticPlastic { shape_factor: 1e14 },
        FrictionLaw::Sigmoid { shape_factor: 1e9 },
    ] {
        for (limit, vehicle) in [(0.0, &truck), (LIMITS[0], &still)] {
            let mesh = (0.5, 0.1);
            let problem = Bar {
                law,
                limit,
                mesh,
                ..Bar::default()
            }
            .under(vehicle)?;
            for kind in Kind::for_law(law) {
                // A step of microseconds is no use.
                if kind == Kind::Explicit && law.shape_factor() > 1e12 {
                    continue;
                }
                let mut run = Run::new(kind, &problem)?;
                let laid = run.state.clone();
                let pass = run.passes(2)?.outcome;
                assert_eq!((pass.force.upstream, pass.force.downstream), (0.0, 0.0));
                assert_eq!((pass.peak.downstream, pass.max_compression), (0.0, 0.0));
                assert_eq!(run.state, laid, "{law:?} {kind:?}");
            }
        }
    }
    Ok(())
}
