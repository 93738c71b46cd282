//! Physical laws, closed forms and guards.

mod common;

use cable_dem::{CableError, DuctedCable, End, Friction, FrictionLaw};
use common::{DEPTH, Outcome, TRUCK, cable, motion, resolution};
use ground_field::Direction::{Forward, Reverse};
use ground_field::DuctMotion;
use pass_law::{AdvanceLaw, Concern, LawError, MixedLaw, PassLaw, Resolution, concerns_before};

#[test]
fn the_advance_falls_and_vanishes_at_saturation() -> Outcome {
    let law = AdvanceLaw::new(&cable(1.0, 0.25, 108.8)?, &motion(TRUCK, Forward)?, resolution()?)?;
    assert!(law.nodes().windows(2).all(|pair| pair[1][1] < pair[0][1]));
    let star = law.saturation();
    assert!(star > 0.5 * law.friction_limit() && star < law.friction_limit());
    // f* to 1e-4 q: the sign of the advance changes within that.
    let step = 1e-4 * law.friction_limit();
    assert!(law.advance(star - step).0 > 0.0 && law.advance(star + step).0 < 0.0);
    assert!(law.lag(0.0) > 0.0);
    Ok(())
}

#[test]
fn the_opposed_law_is_that_of_the_opposite_vehicle() -> Outcome {
    let cable = cable(1.0, 0.25, 108.8)?;
    let forward = AdvanceLaw::new(&cable, &motion(TRUCK, Forward)?, resolution()?)?;
    let reverse = AdvanceLaw::new(&cable, &motion(TRUCK, Reverse)?, resolution()?)?;
    for share in [0.0, 0.2, 0.5, 0.64] {
        let f = -share * cable.friction().limit();
        let (mirrored, direct) = (forward.opposed().advance(f).0, reverse.advance(f).0);
        assert!(
            (mirrored - direct).abs() < 1e-3 * forward.free_advance(),
            "{share}: {mirrored} {direct}"
        );
    }
    Ok(())
}

#[test]
fn equal_shares_of_both_directions_cancel() -> Outcome {
    let law = AdvanceLaw::new(&cable(1.0, 0.25, 108.8)?, &motion(TRUCK, Forward)?, resolution()?)?;
    let mix = MixedLaw::new(vec![(1.0, law.clone()), (1.0, law.opposed())])?;
    assert_eq!(mix.saturation(), 0.0);
    assert!(mix.free_advance().abs() < 1e-15);
    let traffic = [(motion(TRUCK, Forward)?, 1.0), (motion(TRUCK, Reverse)?, 1.0)];
    let balanced = PassLaw::new(&cable(60.0, 0.25, 108.8)?, &traffic, resolution()?)?;
    assert!(balanced.concerns().contains(&Concern::Balanced));
    Ok(())
}

#[test]
fn more_opposing_traffic_saturates_lower() -> Outcome {
    let cable = cable(1.0, 0.25, 108.8)?;
    let law = AdvanceLaw::between(&cable, &motion(TRUCK, Forward)?, resolution()?, -15.0, 0.0)?;
    let saturation = |share: f64| -> Result<f64, LawError> {
        Ok(MixedLaw::new(vec![(1.0, law.clone()), (share, law.opposed())])?.saturation())
    };
    let all: Vec<f64> = [1e-9, 0.2, 0.5, 0.8]
        .map(&saturation)
        .into_iter()
        .collect::<Result<_, _>>()?;
    assert!(all.windows(2).all(|pair| pair[1] < pair[0]));
    assert!((all[0] / law.saturation() - 1.0).abs() < 1e-3);
    Ok(())
}

#[test]
fn cost_does_not_grow_with_the_passes() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    let law = PassLaw::new(&cable(300.0, 0.25, 108.8)?, &traffic, resolution()?)?;
    let cost = |pass: u64| law.run(&[pass]).map(|evolution| evolution.statistics);
    let (few, many) = (cost(100_000)?, cost(1_000_000_000)?);
    assert!(few.steps < 200 && few.newton_iterations < 2000, "{few:?}");
    // Ten thousand times as many passes: a few ever longer steps.
    assert!(many.steps < few.steps + 30, "{few:?} {many:?}");
    assert!(
        many.newton_iterations < few.newton_iterations + 200,
        "{few:?} {many:?}"
    );
    Ok(())
}

#[test]
fn the_evolution_ends_at_the_closed_form() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    for (upstream, downstream) in [
        (End::Free, End::Fixed),
        (End::Fixed, End::Free),
        (End::Fixed, End::Fixed),
        (End::Spring(2e5), End::Spring(1e6)),
    ] {
        let cable = cable(100.0, 0.25, 108.8)?.with_ends(upstream, downstream)?;
        let law = PassLaw::new(&cable, &traffic, resolution()?)?;
        let saturation = law.saturation().ok_or("saturates")?;
        let last = law.run(&[1_000_000_000])?.records[0];
        for (found, closed) in [
            (last.upstream_force, saturation.upstream_force),
            (last.downstream_force, saturation.downstream_force),
        ] {
            assert!(
                (found - closed).abs() < 0.01 * saturation.friction * 100.0,
                "{found} {closed}"
            );
        }
    }
    Ok(())
}

#[test]
fn the_front_spreads_with_the_root_of_the_passes() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    let law = PassLaw::new(&cable(1000.0, 0.25, 108.8)?, &traffic, resolution()?)?;
    let records = law.run(&[100, 400, 1600, 6400])?.records;
    // Differences are free of what the end's layer adds.
    let steps: Vec<f64> = records
        .windows(2)
        .map(|pair| pair[1].downstream_force - pair[0].downstream_force)
        .collect();
    assert!(
        (steps[1] / steps[0] - 2.0).abs() < 0.01 && (steps[2] / steps[1] - 2.0).abs() < 0.01,
        "{steps:?}"
    );
    let saturation = law.saturation().ok_or("saturates")?;
    let closed = saturation.early_force(6400.0) - saturation.early_force(1600.0);
    assert!((closed / steps[2] - 1.0).abs() < 0.03, "{closed} {}", steps[2]);
    Ok(())
}

#[test]
fn passes_to_a_share_agree_with_the_evolution() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    let law = PassLaw::new(&cable(300.0, 0.25, 108.8)?, &traffic, resolution()?)?;
    let saturation = law.saturation().ok_or("saturates")?;
    for share in [0.2, 0.5, 0.8] {
        let passes = saturation.passes_to(share).ok_or("a share")?;
        let force = law.run(&[passes.round() as u64])?.records[0].downstream_force;
        let reached = force / saturation.downstream_force;
        assert!(
            (reached - share).abs() < 0.05,
            "{share}: {reached} after {passes}"
        );
    }
    assert_eq!(saturation.passes_to(1.0), None);
    Ok(())
}

#[test]
fn a_soft_deep_cable_shakes_down() -> Outcome {
    let q = 1.2 * 112.7;
    let friction = Friction::new(FrictionLaw::Coulomb, q)?;
    let cable = DuctedCable::new(100.0, 1.47e6, friction)?.with_ends(End::Free, End::Fixed)?;
    let law = PassLaw::new(&cable, &[(motion(TRUCK, Forward)?, 1.0)], resolution()?)?;
    assert!(
        matches!(law.concerns()[..], [Concern::ShakesDown { .. }]),
        "{:?}",
        law.concerns()
    );
    // The ends' layers, of a few depths, are all that is left of the force.
    let force = law.run(&[1_000_000])?.records[0].downstream_force;
    assert!(force.abs() < 2.0 * common::DEPTH * q, "{force}");
    Ok(())
}

#[test]
fn what_the_law_cannot_do_it_says() -> Outcome {
    let q = 27.2;
    let fading = Friction::new(FrictionLaw::Sigmoid { shape_factor: 1e6 }, q)?;
    let short = DuctedCable::new(5.0, 8.01e6, fading)?;
    let concerns = concerns_before(&short, Resolution::new(1.2)?);
    assert!(concerns.contains(&Concern::NoMemory) && concerns.iter().all(|concern| concern.is_fatal()));
    assert_eq!(concerns.len(), 2);
    let refused = AdvanceLaw::new(&short, &motion(TRUCK, Forward)?, resolution()?);
    assert!(matches!(
        refused,
        Err(LawError::Cable(CableError::UnsupportedLaw { .. }))
    ));
    assert!(Resolution::new(f64::NAN).is_err() && Resolution::new(1.2)?.with_accuracy(0.0).is_err());
    assert!(MixedLaw::new(Vec::new()).is_err());
    Ok(())
}

#[test]
fn a_frictionless_duct_leaves_its_cable_alone() -> Outcome {
    let cable = DuctedCable::new(100.0, 8.01e6, Friction::new(FrictionLaw::Coulomb, 0.0)?)?
        .with_ends(End::Free, End::Fixed)?;
    let law = PassLaw::new(&cable, &[(motion(TRUCK, Forward)?, 1.0)], resolution()?)?;
    assert_eq!(law.run(&[1000])?.records[0].downstream_force, 0.0);
    Ok(())
}

#[test]
fn passes_must_ascend() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    let law = PassLaw::new(&cable(60.0, 0.25, 108.8)?, &traffic, resolution()?)?;
    assert!(law.run(&[10, 5]).is_err());
    assert_eq!(law.run(&[0])?.records[0].downstream_force, 0.0);
    let (once, twice) = (law.run(&[500])?.records[0], law.run(&[3, 40, 500])?.records[2]);
    assert!((once.downstream_force / twice.downstream_force - 1.0).abs() < 2e-3);
    Ok(())
}

/// A cable of the experiment of `depths` depths, and a duct that moves so far that EA·D/(q z²) is `number`.
fn of_friction_number(
    depths: f64,
    number: f64,
) -> Result<(DuctedCable, DuctMotion), Box<dyn std::error::Error>> {
    let cable = cable(depths * DEPTH, 0.25, 108.8)?;
    let motion = motion(TRUCK, Forward)?;
    let peak = number * cable.friction().limit() * DEPTH * DEPTH / cable.axial_stiffness();
    let factor = peak / motion.peak_longitudinal();
    Ok((cable, motion.scaled(factor)?))
}

#[test]
fn near_shakedown_the_law_says_so() -> Outcome {
    for (number, near) in [(0.5, true), (1.0, false)] {
        let (cable, motion) = of_friction_number(30.0, number)?;
        let law = PassLaw::new(&cable, &[(motion, 1.0)], resolution()?)?;
        let concerns = law.concerns();
        let found = concerns
            .iter()
            .any(|concern| matches!(concern, Concern::NearShakedown { .. }));
        assert_eq!(found, near, "{number}: {concerns:?}");
    }
    Ok(())
}

/// A duct that moves much farther than friction can stretch the cable: Newton's method leaves all numbers behind, which once
/// was taken for an answer.
#[test]
fn an_evolution_without_an_answer_is_an_error() -> Outcome {
    let (cable, motion) = of_friction_number(3.16, 56.2)?;
    let law = PassLaw::new(&cable, &[(motion, 1.0)], resolution()?)?;
    match law.run(&[20, 60, 200]) {
        Ok(evolution) => assert!(evolution.records.iter().all(|r| r.downstream_force.is_finite())),
        Err(error) => assert!(matches!(error, LawError::NoConvergence { .. }), "{error}"),
    }
    Ok(())
}
