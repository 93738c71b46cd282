//! The motion of a duct against its ground, asked point by point.

use burmister::LayeredHalfSpace;
use ground_field::{Base, Direction, DuctLine, DuctMotion, Vehicle, Wheel};

use super::common::{line, load, profile, soil, table_1};
use crate::answers::common::assert_within;

const FORCE: f64 = 5e4;

/// Axles at these places, each a wheel above the duct.
fn vehicle(axles: &[f64]) -> Vehicle {
    let wheel = |&x: &f64| Wheel {
        x,
        y: 0.0,
        load: load(FORCE, 0.15),
    };
    let wheels = axles.iter().map(wheel).collect();
    Vehicle::new("axles", wheels, 11.1, Direction::Forward).expect("vehicle")
}

/// D_l at each of `places`, from the ground itself.
fn along(ground: &LayeredHalfSpace, axles: &[f64], depth: f64, places: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; places.len()];
    for axle in axles {
        let radii: Vec<f64> = places.iter().map(|xi| (xi - axle).abs()).collect();
        let values = line(ground, load(FORCE, 0.15), &radii, depth);
        for ((sum, value), xi) in sums.iter_mut().zip(values).zip(places) {
            *sum += value.radial * (xi - axle).signum();
        }
    }
    sums
}

/// Hundreds of depths away the motion is a small part of its peak, and still has the accuracy asked, a share of that peak.
#[test]
fn far_out_the_motion_has_the_accuracy_asked() {
    let on_rock = |depth: f64| {
        let mut layers = vec![(0.05, soil(4e9, 0.35)), (0.05, soil(8e8, 0.35))];
        layers.push((depth - 0.1, soil(8e8, 0.4)));
        profile(&layers, Base::Rigid)
    };
    let soft = profile(&[(3.0, soil(2e7, 0.45))], Base::HalfSpace(soil(1e9, 0.3)));
    let stiff = profile(&[(0.26, soil(3e10, 0.2))], Base::HalfSpace(soil(2e7, 0.45)));
    for ground in [table_1(), on_rock(8.0), on_rock(30.0), stiff, soft] {
        let exact = LayeredHalfSpace::new(&ground)
            .and_then(|exact| exact.with_accuracy(1e-10))
            .expect("ground");
        let (axles, depth, reach, accuracy) = ([0.0, -5.0, -6.3], 1.2, 400.0, 1e-7);
        let duct = DuctLine::new(depth, 0.0).expect("line");
        let motion = DuctMotion::new(&exact, &vehicle(&axles), duct, reach, accuracy).expect("motion");
        assert!(motion.reach() >= reach);
        let places: Vec<f64> = (0..200)
            .map(|k| 6.0 * 1.0213_f64.powi(k))
            .flat_map(|xi| [xi, -xi])
            .collect();
        assert!(places[398] > 390.0 && places[398] < reach);
        // Each wheel's error is a share of its own peak.
        let one = DuctMotion::new(&exact, &vehicle(&[0.0]), duct, reach, accuracy).expect("motion");
        let allowed = 3.0 * accuracy * one.peak_longitudinal();
        for (xi, truth) in places.iter().zip(along(&exact, &axles, depth, &places)) {
            assert_within(motion.longitudinal(*xi), truth, allowed, (&ground, xi));
        }
    }
}
