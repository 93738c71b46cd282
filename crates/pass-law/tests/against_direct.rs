//! The law against the direct simulation of every pass.

mod common;

use cable_dem::{DuctedCable, End, Friction, FrictionLaw};
use common::{Outcome, TRUCK, assert_within, both, both_at, cable, motion, under};
use ground_field::Direction::{Forward, Reverse};
use ground_field::{SurfaceLoad, Vehicle, Wheel};

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
    for (mu, load, expected) in [(0.25, 108.8, 527.84), (0.27, 163.2, 692.22)] {
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

/// The duct's largest longitudinal displacement in Kashiro et al., Table 3 \[m\].
const PEAK: f64 = 35.7e-6;

/// Within 2.5 % of the saturated force, that is of the last one. Deep ducts and soft cables are near shakedown: early forces are a
/// small part of it, and the ends' layers, whose first passes the law does not follow, a large part of them.
///
/// Table 2 and 3 of Kashiro et al.: friction coefficient, weight \[N/m\], EA \[N\] and depth \[m\].
fn class(mu: f64, weight: f64, stiffness: f64, depth: f64, law: impl Fn(f64) -> FrictionLaw) -> Outcome {
    let q = mu * weight;
    let cable =
        DuctedCable::new(60.0, stiffness, Friction::new(law(q), q)?)?.with_ends(End::Free, End::Fixed)?;
    let motion = under(&Vehicle::point("truck", TRUCK, 11.11)?, depth)?;
    let factor = PEAK / motion.peak_longitudinal();
    let records = both_at(
        depth,
        &cable,
        &[(motion.scaled(factor)?, 1.0)],
        &[11, 20, 50, 150, 500],
    )?;
    let saturated = records[records.len() - 1].1.downstream_force;
    for (law, direct) in &records {
        let error = (law.downstream_force - direct.downstream_force) / saturated;
        println!(
            "{} {} {}",
            law.pass, law.downstream_force, direct.downstream_force
        );
        assert!(
            error.abs() < 0.025,
            "pass {}: {error:.4} of the saturated force",
            law.pass
        );
    }
    Ok(())
}

fn sheath(q: f64) -> FrictionLaw {
    FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / q,
    }
}

#[test]
fn a_shallow_duct_where_the_cable_slips() -> Outcome {
    class(0.3, 108.8, 8.01e6, 0.6, sheath)
}

#[test]
fn a_deep_duct() -> Outcome {
    class(0.5, 108.8, 8.01e6, 2.0, sheath)
}

#[test]
fn a_soft_cable() -> Outcome {
    class(0.3, 112.7, 1.47e6, 1.5, sheath)
}

#[test]
fn coulombs_law() -> Outcome {
    class(0.4, 108.8, 8.01e6, 1.5, |_| FrictionLaw::Coulomb)
}

#[test]
fn a_truck_with_three_axles() -> Outcome {
    let axle = |x: f64, share: f64| -> Result<Wheel, ground_field::GroundError> {
        Ok(Wheel {
            x,
            y: 0.0,
            load: SurfaceLoad::point(share * TRUCK)?,
        })
    };
    let wheels = vec![axle(0.0, 0.3)?, axle(-3.8, 0.35)?, axle(-5.1, 0.35)?];
    let motion = under(&Vehicle::new("truck", wheels, 11.11, Forward)?, 1.2)?.scaled(2.0)?;
    let records = both(
        &cable(60.0, 0.25, 108.8)?,
        &[(motion, 1.0)],
        &[11, 20, 50, 150, 500],
    )?;
    assert_within(0.03, &records, |record| record.downstream_force);
    Ok(())
}
