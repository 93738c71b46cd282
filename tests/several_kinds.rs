//! Fits of what else is measured besides a load cell's force: readings are runs on a mesh of 24 nodes per depth with known parameters, and noise;
//! fits choose their own.

use creepage::calibration::{Quantity, Unknown};
use creepage::readings::{Measured, Place};
use creepage::scene::{End, Law};
use creepage::{CableEnd, CalibrateOptions, Calibrated, Reading, Readings, Scene, calibrate};

use crate::answers::common::{assert_within, staged};

const PASSES: u64 = 24;
const FRICTION: f64 = 0.3;
const SHAPE_FACTOR: f64 = 2e6;
/// Node spacing of the truth \[m\].
const SPACING: f64 = 0.05;

/// The full-scale experiment with a spring at its upstream end, on ground so many times as stiff.
fn scene(stiffness: f64) -> Scene {
    let modulus = format!("ground.layers.0.young_modulus={} MPa", 800.0 * stiffness);
    let mut scene = crate::scenes::upper(&[&modulus]);
    scene.ends.upstream = End::Spring(5e6);
    scene.traffic.passes = PASSES;
    scene
}

/// Readings of these instruments, each with its noise, after every pass.
fn measured(instruments: &[(Measured, f64)], stiffness: f64) -> Readings {
    let mut truth = scene(stiffness);
    (truth.solver.node_spacing, truth.solver.vehicle_step) = (Some(SPACING), Some(0.5 * SPACING));
    truth.friction.dynamic_coefficient = FRICTION;
    (truth.friction.law, truth.friction.shape_factor) = (Law::ElasticPlastic, Some(SHAPE_FACTOR));
    let stages: Vec<u64> = (1..=PASSES).collect();
    let run = staged(&truth, &stages);
    let deflection = creepage::profile_at(&truth, &[0.0]).unwrap().vertical_m[0];
    let mut random = fastrand::Rng::with_seed(7);
    let mut readings = Vec::new();
    for (pass, stage) in run.passes.iter().zip(&run.stages) {
        let (places, forces) = (&stage.force_profile.positions_m, &stage.force_profile.force_n);
        // Places of the instruments lie in the middle of an element of this mesh.
        let force = |x: f64| forces[places.iter().position(|place| (place - x).abs() < 1e-9).unwrap()];
        for &(instrument, noise) in instruments {
            let value = match instrument {
                Measured::Force(Place::At(x)) => force(x),
                Measured::Force(_) => pass.downstream_force_n,
                Measured::Movement(_) => pass.upstream_displacement_m,
                Measured::Strain(Place::At(x)) => force(x) / truth.cable.axial_stiffness,
                Measured::Deflection => deflection,
                _ => unreachable!("{instrument:?}"),
            };
            readings.push(Reading {
                measured: instrument,
                ..Reading::force(pass.pass, value + noise * testkit::gaussian(&mut random))
            });
        }
    }
    readings.into_iter().collect()
}

fn fit(readings: &Readings, more: &[Quantity]) -> Calibrated {
    let quantities = [Quantity::DynamicCoefficient, Quantity::ShapeFactor];
    let unknowns = [&quantities, more].concat().into_iter().map(Unknown::shared);
    let options = CalibrateOptions {
        unknowns: unknowns.collect(),
        ..CalibrateOptions::default()
    };
    calibrate(&scene(1.0), readings, &options).unwrap()
}

/// Within three standard errors of the truth, and told to a share of it.
#[track_caller]
fn recovers(answer: &Calibrated, truths: &[f64], share: f64) {
    assert!(!answer.lack_of_fit.suspicious, "{:?}", answer.warnings);
    for (parameter, truth) in answer.parameters.iter().zip(truths) {
        let error = parameter.standard_error.unwrap();
        assert!(parameter.identifiable && error < share * truth, "{parameter:?}");
        assert_within(parameter.value, *truth, 3.0 * error, parameter);
    }
}

#[test]
fn strain_along_the_cable_and_movement_of_an_end() {
    let strain = Measured::Strain(Place::At(10.025));
    let movement = Measured::Movement(Place::End(CableEnd::Upstream));
    let readings = measured(&[(strain, 3e-7), (movement, 1e-6)], 1.0);
    recovers(&fit(&readings, &[]), &[FRICTION, SHAPE_FACTOR], 0.1);
}

#[test]
fn force_at_a_place_along_the_cable() {
    let readings = measured(&[(Measured::Force(Place::At(20.025)), 3.0)], 1.0);
    recovers(&fit(&readings, &[]), &[FRICTION, SHAPE_FACTOR], 0.2);
}

/// The deflection of the duct tells how stiff the ground is, which forces alone hardly do.
#[test]
fn deflection_of_the_duct_and_force() {
    let force = (Measured::Force(Place::End(CableEnd::Downstream)), 1.5);
    let readings = measured(&[force, (Measured::Deflection, 2e-6)], 0.8);
    let truths = [FRICTION, SHAPE_FACTOR, 0.8];
    let answer = fit(&readings, &[Quantity::GroundStiffness]);
    recovers(&answer, &truths, 0.1);
    let stiffness = &answer.parameters[2];
    assert!(stiffness.standard_error.unwrap() < 0.01, "{stiffness:?}");
    let told = |word: &str| answer.fit.iter().filter(|row| row.measured == word).count() as u64;
    assert_eq!((told("force"), told("deflection")), (PASSES, PASSES));
}
