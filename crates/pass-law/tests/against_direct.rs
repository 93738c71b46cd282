//! The law against the direct simulation of every pass.

mod common;

use cable_dem::End;
use common::{Outcome, TRUCK, assert_within, both, cable, motion};
use ground_field::Direction::{Forward, Reverse};

#[test]
fn a_hundred_metres_within_two_per_cent_beyond_the_tenth_pass() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    let passes = [11, 15, 20, 30, 50, 100, 200, 300, 500, 800, 1500];
    let records = both(&cable(100.0, 0.25, 108.8)?, &traffic, &passes)?;
    assert_within(0.02, &records, |record| record.downstream_force);
    assert_within(0.02, &records, |record| record.max_compression);
    assert_within(0.03, &records, |record| record.upstream_displacement);
    Ok(())
}

#[test]
fn three_hundred_metres_within_two_per_cent() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    let passes = [11, 20, 50, 100, 200, 500, 1000, 2000, 3000];
    let records = both(&cable(300.0, 0.25, 108.8)?, &traffic, &passes)?;
    assert_within(0.02, &records, |record| record.downstream_force);
    Ok(())
}

#[test]
fn both_cables_of_the_experiment_saturate_within_two_per_cent() -> Outcome {
    for (mu, load, expected) in [(0.25, 108.8, 542.0), (0.27, 163.2, 711.0)] {
        let traffic = [(motion(TRUCK, Forward)?, 1.0)];
        let records = both(&cable(30.0, mu, load)?, &traffic, &[11, 20, 60, 300, 500])?;
        assert_within(0.02, &records, |record| record.downstream_force);
        let saturated = records[4].0.downstream_force;
        assert!((saturated / expected - 1.0).abs() < 0.02, "{saturated}");
    }
    Ok(())
}

#[test]
fn two_vehicles_of_different_weight_within_three_per_cent() -> Outcome {
    let traffic = [
        (motion(TRUCK, Forward)?, 1.0),
        (motion(0.6 * TRUCK, Forward)?, 1.0),
    ];
    let records = both(&cable(60.0, 0.25, 108.8)?, &traffic, &[12, 20, 50, 100, 200, 600])?;
    assert_within(0.03, &records, |record| record.downstream_force);
    Ok(())
}

#[test]
fn two_to_one_traffic_within_three_per_cent() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 2.0), (motion(TRUCK, Reverse)?, 1.0)];
    let passes = [12, 15, 21, 30, 60, 99, 150, 300, 600, 900];
    let records = both(&cable(60.0, 0.25, 108.8)?, &traffic, &passes)?;
    assert_within(0.03, &records, |record| record.downstream_force);
    Ok(())
}

#[test]
fn a_cable_that_nothing_holds_walks_on() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    let free = cable(60.0, 0.25, 108.8)?.with_ends(End::Free, End::Free)?;
    let records = both(&free, &traffic, &[20, 100, 300])?;
    assert_within(0.02, &records, |record| record.upstream_displacement);
    assert_within(0.02, &records, |record| record.downstream_displacement);
    Ok(())
}

#[test]
fn springs_trade_force_for_movement() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    for stiffness in [1e5, 1e6, 1e7] {
        let held = cable(60.0, 0.25, 108.8)?.with_ends(End::Free, End::Spring(stiffness))?;
        let records = both(&held, &traffic, &[20, 50, 100, 600])?;
        assert_within(0.03, &records, |record| record.downstream_force);
    }
    Ok(())
}

#[test]
fn both_ends_fixed() -> Outcome {
    let traffic = [(motion(TRUCK, Forward)?, 1.0)];
    let held = cable(60.0, 0.25, 108.8)?.with_ends(End::Fixed, End::Fixed)?;
    let records = both(&held, &traffic, &[20, 50, 100, 600])?;
    assert_within(0.03, &records, |record| record.downstream_force);
    assert_within(0.03, &records, |record| record.upstream_force);
    Ok(())
}

#[test]
fn reverse_traffic_is_the_mirror_image() -> Outcome {
    let run = |direction, upstream, downstream| {
        let traffic = [(motion(TRUCK, direction)?, 1.0)];
        let cable = cable(60.0, 0.25, 108.8)?.with_ends(upstream, downstream)?;
        let law = pass_law::PassLaw::new(&cable, &traffic, common::resolution()?)?;
        Ok::<_, Box<dyn std::error::Error>>(law.run(&[100])?.records[0])
    };
    let forward = run(Forward, End::Free, End::Fixed)?;
    let reverse = run(Reverse, End::Fixed, End::Free)?;
    let error = reverse.upstream_force / forward.downstream_force - 1.0;
    assert!(error.abs() < 1e-4, "{error:e}");
    Ok(())
}
