//! The motion of a duct against its ground, asked point by point.

use burmister::LayeredHalfSpace;
use ground_field::{Base, Direction, DuctLine, DuctMotion, GroundField, SoilProfile, Vehicle, Wheel};

use super::common::{load, profile, soil, table_1};

const FORCE: f64 = 5e4;

/// Axles at these places, each a wheel above the duct.
fn vehicle(axles: &[f64]) -> Vehicle {
    let wheel = |&x: &f64| Wheel {
        x,
        y: 0.0,
        load: load(FORCE, 0.15),
    };
    Vehicle::new(
        "axles",
        axles.iter().map(wheel).collect(),
        11.1,
        Direction::Forward,
    )
    .expect("vehicle")
}

/// D_l at each of `places`, from the ground itself.
fn along(ground: &LayeredHalfSpace, axles: &[f64], depth: f64, places: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; places.len()];
    for axle in axles {
        let radii: Vec<f64> = places.iter().map(|xi| (xi - axle).abs()).collect();
        let values = ground
            .displacements(load(FORCE, 0.15), &radii, depth)
            .expect("values");
        for ((sum, value), xi) in sums.iter_mut().zip(values).zip(places) {
            *sum += value.radial * (xi - axle).signum();
        }
    }
    sums
}

fn slab(thickness: f64, modulus: f64, poisson: f64, below: f64) -> SoilProfile {
    profile(
        &[(thickness, soil(modulus, poisson))],
        Base::HalfSpace(soil(below, 0.45)),
    )
}

/// A stiff slab bends over many times the depth of a duct in it, and D_l peaks there.
#[test]
fn the_peak_over_a_stiff_slab_is_the_largest_of_all_places() {
    let concrete = || slab(0.26, 3e10, 0.2, 2e7);
    let grounds: [(SoilProfile, f64, &[f64]); 6] = [
        (concrete(), 0.05, &[0.0]),
        (concrete(), 0.10, &[0.0]),
        (slab(0.30, 3e10, 0.2, 5e6), 0.10, &[0.0]),
        (concrete(), 0.10, &[0.0, -4.0]),
        (concrete(), 0.60, &[0.0]),
        (slab(0.20, 5e9, 0.35, 5e7), 0.10, &[0.0]),
    ];
    for (profile, depth, axles) in grounds {
        let ground = LayeredHalfSpace::new(&profile).expect("ground");
        let places: Vec<f64> = (0..4000).map(|k| -14.0 + 0.005 * f64::from(k)).collect();
        let largest = along(&ground, axles, depth, &places)
            .iter()
            .fold(0.0_f64, |most, d| most.max(d.abs()));
        // Reaches short of the slab's peak and beyond it; between two places D_l rises by a little.
        for reach in [0.4, 60.0] {
            let line = DuctLine::new(depth, 0.0).expect("line");
            let motion = DuctMotion::new(&ground, &vehicle(axles), line, reach, 1e-7).expect("motion");
            let off = motion.peak_longitudinal() / largest - 1.0;
            assert!(
                (-1e-6..1e-3).contains(&off),
                "{profile:?} at {depth} m, reach {reach} m: {off:.1e}"
            );
        }
    }
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
    for ground in [
        table_1(),
        on_rock(8.0),
        on_rock(30.0),
        slab(0.26, 3e10, 0.2, 2e7),
        soft,
    ] {
        let exact = LayeredHalfSpace::new(&ground)
            .and_then(|exact| exact.with_accuracy(1e-10))
            .expect("ground");
        let (axles, depth, reach, accuracy) = ([0.0, -5.0, -6.3], 1.2, 400.0, 1e-7);
        let line = DuctLine::new(depth, 0.0).expect("line");
        let motion = DuctMotion::new(&exact, &vehicle(&axles), line, reach, accuracy).expect("motion");
        assert!(motion.reach() >= reach);
        let places: Vec<f64> = (0..200)
            .map(|k| 6.0 * 1.0213_f64.powi(k))
            .flat_map(|xi| [xi, -xi])
            .collect();
        assert!(places[398] > 390.0 && places[398] < reach);
        // Each wheel's error is a share of its own peak.
        let one = DuctMotion::new(&exact, &vehicle(&[0.0]), line, reach, accuracy).expect("motion");
        let allowed = 3.0 * accuracy * one.peak_longitudinal();
        for (xi, truth) in places.iter().zip(along(&exact, &axles, depth, &places)) {
            let off = (motion.longitudinal(*xi) - truth).abs();
            assert!(
                off <= allowed,
                "{ground:?} at {xi} m: {off:.1e} of {truth:.1e} m, allowed {allowed:.1e}"
            );
        }
    }
}
