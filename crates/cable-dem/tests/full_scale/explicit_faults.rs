//! Hostile parameters: a right answer or a typed error, and nothing in between.

use crate::common::{EA, LIMIT, MASS, Outcome, STIFF_SHEATH, Scene, relative, truck};
use cable_dem::{CableError, End, ExplicitOptions, FrictionLaw, PassOutcome};

/// Force and peak, or what went wrong.
type Answer = Result<(f64, f64), CableError>;

/// Runs two passes with both solvers; where both answer, they must agree. Returns how many answered: the explicit one
/// refuses what takes too many steps.
///
/// Friction on one element is the mesh's resolution.
fn judge(name: &str, scene: &Scene) -> usize {
    let answers: [(&str, Answer); 2] = [
        (
            "quasi-static",
            scene
                .quasi_static(2)
                .map(|o| (o.force.downstream, o.peak.downstream)),
        ),
        (
            "explicit",
            scene
                .explicit(
                    2,
                    ExplicitOptions {
                        max_node_updates: 1e8,
                        ..ExplicitOptions::default()
                    },
                )
                .map(|o| (o.pass.force.downstream, o.pass.peak.downstream)),
        ),
    ];
    let inertia = cable_dem::inertia_ratio(&scene.cable, MASS, scene.duct.speed()).unwrap_or(f64::NAN);
    let mut right = Vec::new();
    for (solver, answer) in answers {
        match answer {
            Ok((force, peak)) => {
                assert!(
                    force.is_finite() && peak.is_finite(),
                    "{name}, {solver}: {force} {peak}"
                );
                right.push((solver, force, peak));
            }
            Err(
                CableError::Precision { .. }
                | CableError::TooManySteps { .. }
                | CableError::NoConvergence { .. },
            ) => {}
            Err(error) => panic!("{name}, {solver}: {error}"),
        }
    }
    for (solver, force, peak) in &right {
        let (other, expected, expected_peak) = right[right.len() - 1];
        let resolution = scene.cable.friction().limit() * scene.mesh.spacing();
        let bound = (0.01 + inertia) * expected.abs().max(expected_peak.abs()) + 0.5 * resolution;
        assert!(
            (force - expected).abs() <= bound,
            "{name}: {solver} {force} (peak {peak}), {other} {expected} (peak {expected_peak})"
        );
    }
    right.len()
}

fn elastic_plastic(shape_factor: f64) -> FrictionLaw {
    FrictionLaw::ElasticPlastic { shape_factor }
}

#[test]
fn shape_factors_from_1e3_to_1e14() -> Outcome {
    let motion = truck(40.0)?;
    for exponent in 3..=14 {
        let scene = Scene::thirty_metres(elastic_plastic(10_f64.powi(exponent)), 0.2, &motion)?;
        assert!(judge(&format!("b = 1e{exponent}"), &scene) >= 1);
    }
    Ok(())
}

#[test]
fn sigmoid_shape_factors_from_1e3_to_1e14() -> Outcome {
    let motion = truck(40.0)?;
    let coulomb = Scene::thirty_metres(FrictionLaw::Coulomb, 0.5, &motion)?.quasi_static(1)?;
    for exponent in 3..=14 {
        let law = FrictionLaw::Sigmoid {
            shape_factor: 10_f64.powi(exponent),
        };
        let scene = Scene::thirty_metres(law, 0.5, &motion)?;
        match scene.explicit(
            1,
            ExplicitOptions {
                max_node_updates: 3e8,
                ..ExplicitOptions::default()
            },
        ) {
            Ok(outcome) => {
                // Not the force after the pass: on the half element before a fixed end friction turns over at once with the
                // sigmoid and bit by bit with Coulomb's law.
                let read = |pass: &PassOutcome| [pass.peak.downstream, pass.upstream_displacement];
                let (found, leak) = (read(&outcome.pass), outcome.leak.ok_or("no leak")?);
                let expected = read(&coulomb);
                let close = |i: usize| relative(found[i], expected[i]).abs() < 0.02;
                assert!(
                    leak.matters() || (close(0) && close(1)),
                    "b = 1e{exponent}: {found:?} without a warning, {expected:?}"
                );
            }
            Err(error) => assert!(
                matches!(
                    error,
                    CableError::TooManySteps { .. } | CableError::NoConvergence { .. }
                ),
                "{error}"
            ),
        }
    }
    Ok(())
}

#[test]
fn axial_stiffnesses_from_1e3_to_1e12() -> Outcome {
    let motion = truck(40.0)?;
    for exponent in 3..=12 {
        for law in [STIFF_SHEATH, FrictionLaw::Coulomb] {
            let size = (30.0, 0.5, 0.1);
            let scene = Scene::new((law, LIMIT), 10_f64.powi(exponent), End::Fixed, size, &motion)?;
            assert!(judge(&format!("EA = 1e{exponent} {}", law.name()), &scene) >= 1);
        }
    }
    Ok(())
}

#[test]
fn spacings_from_1_mm_to_5_m_and_three_nodes() -> Outcome {
    let motion = truck(40.0)?;
    for (length, spacing) in [
        (0.5, 0.001),
        (3.0, 0.01),
        (30.0, 0.1),
        (30.0, 0.5),
        (30.0, 1.0),
        (30.0, 2.0),
        (30.0, 5.0),
        (10.0, 5.0),
        (2.0, 1.0),
        (0.002, 0.001),
    ] {
        for law in [STIFF_SHEATH, FrictionLaw::Coulomb] {
            let scene = Scene::new((law, LIMIT), EA, End::Fixed, (length, spacing, 0.1), &motion)?;
            assert!(judge(&format!("h = {spacing}, L = {length} {}", law.name()), &scene) >= 1);
        }
    }
    Ok(())
}

#[test]
fn end_springs_from_1_to_1e12() -> Outcome {
    let motion = truck(40.0)?;
    for exponent in 0..=12 {
        for law in [STIFF_SHEATH, FrictionLaw::Coulomb] {
            let end = End::Spring(10_f64.powi(exponent));
            let scene = Scene::new((law, LIMIT), EA, end, (30.0, 0.5, 0.1), &motion)?;
            assert!(judge(&format!("spring 1e{exponent} {}", law.name()), &scene) >= 1);
        }
    }
    Ok(())
}

#[test]
fn no_friction_and_no_load_move_nothing() -> Outcome {
    let motion = truck(40.0)?;
    for law in [
        STIFF_SHEATH,
        FrictionLaw::Coulomb,
        FrictionLaw::Sigmoid { shape_factor: 1e9 },
    ] {
        for (limit, load) in [(0.0, 1.0), (LIMIT, 0.0)] {
            let motion = motion.clone().scaled(load)?;
            let scene = Scene::new((law, limit), EA, End::Fixed, (30.0, 0.5, 0.1), &motion)?;
            let found = scene.explicit(2, ExplicitOptions::default())?.pass;
            assert_eq!(found.force.downstream, 0.0);
            assert_eq!(found.upstream_displacement, 0.0);
        }
    }
    // With hardly any friction peaks are ringing, which takes fine steps to follow.
    for (limit, vehicle_step) in [(1e-9, 0.005), (1e-3, 0.005), (1e6, 0.1), (1e9, 0.1)] {
        let size = (30.0, 0.5, vehicle_step);
        let scene = Scene::new((STIFF_SHEATH, limit), EA, End::Fixed, size, &motion)?;
        assert!(judge(&format!("q = {limit:e}"), &scene) >= 1);
    }
    Ok(())
}
