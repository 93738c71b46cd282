//! Hostile parameters: a right answer or a typed error, and nothing in between.

use cable_dem::{CableError, End, FrictionLaw};

use super::harness::{
    Bar, Drive, Kind, LIMITS, MASS, Outcome, Run, SHEATH, UPPER, assert_near, limited, truck,
};

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
            // No bar takes long.
            Kind::Explicit => Run::explicit(&problem, limited(7e7)),
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
    for &(force, peak) in &right {
        assert!(peak.is_finite(), "{bar:?}: {right:?}");
        assert_near(force, expected, bound, bar);
    }
    Ok(())
}

/// Shape factors from 1e3 to 1e14, stiffnesses from 1e3 to 1e12 N, springs from 1 to 1e12 N/m, nodes from 1 mm to 5 m apart and three of
/// them, limits from 1e-9 to 1e9 N/m.
#[test]
fn whatever_the_numbers_both_solvers_agree_or_refuse() -> Outcome {
    let truck = truck();
    let coarse = Bar {
        length: 15.0,
        mesh: (0.5, 0.1),
        ..UPPER
    };
    let sheath = |exponent| FrictionLaw::ElasticPlastic {
        shape_factor: 10_f64.powi(exponent),
    };
    let mut bars = Vec::new();
    bars.extend((3..=14).map(|exponent| Bar {
        law: sheath(exponent),
        ..UPPER
    }));
    // With hardly any friction peaks are ringing, which takes fine steps to follow.
    let limits = [(1e-9, 0.005), (1e-3, 0.005), (1e6, 0.1), (1e9, 0.1)];
    bars.extend(limits.map(|(limit, step)| Bar {
        limit,
        mesh: (0.5, step),
        ..coarse
    }));
    // Every second power of ten with either law.
    for (law, stiffness, spring) in [(SHEATH, 3, 1), (FrictionLaw::Coulomb, 4, 0)] {
        bars.extend((stiffness..=12).step_by(2).map(|exponent| Bar {
            axial_stiffness: 10_f64.powi(exponent),
            law,
            ..coarse
        }));
        bars.extend((spring..=12).step_by(2).map(|exponent| Bar {
            law,
            ends: (End::Free, End::Spring(10_f64.powi(exponent))),
            ..coarse
        }));
        let short = [(0.5, 0.001), (2.0, 0.01), (2.0, 1.0), (10.0, 5.0), (0.002, 0.001)];
        let long = [0.1, 0.5, 1.0, 2.0, 5.0].map(|spacing| (30.0, spacing));
        bars.extend(short.into_iter().chain(long).map(|(length, spacing)| Bar {
            length,
            law,
            mesh: (spacing, 0.1),
            ..UPPER
        }));
    }
    for bar in bars {
        judge(bar, &truck)?;
    }
    Ok(())
}

#[test]
fn no_friction_and_no_load_move_nothing() -> Outcome {
    let truck = truck();
    let still = Drive::new(truck.speed, truck.approach, |_| 0.0);
    for law in [
        SHEATH,
        FrictionLaw::Coulomb,
        FrictionLaw::ElasticPlastic { shape_factor: 1e14 },
        FrictionLaw::Sigmoid { shape_factor: 1e9 },
    ] {
        for (limit, vehicle) in [(0.0, &truck), (LIMITS[0], &still)] {
            let bar = Bar {
                law,
                limit,
                mesh: (0.5, 0.1),
                ..UPPER
            };
            let problem = bar.under(vehicle)?;
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
