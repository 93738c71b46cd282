//! Every input has a finite answer or an error that says why not; and the work stays within bounds.

use super::common::{case, ground, profile};
use burmister::LayeredHalfSpace;
use ground_field::{
    Base, Displacement, GroundError, GroundField, Modulus, SoilLayer, SoilProfile, SurfaceLoad,
};

#[test]
fn a_graded_layer_is_unsupported() {
    let (top, bottom) = (1e7, 2e7);
    let layer = SoilLayer::new(1.0, Modulus::Linear { top, bottom }, 0.3).expect("layer");
    let profile = SoilProfile::new(vec![layer], Base::Rigid).expect("profile");
    let refused = LayeredHalfSpace::new(&profile).err();
    assert!(matches!(refused, Some(GroundError::Unsupported { .. })));
}

#[test]
fn no_radii_and_no_force_are_answered() {
    let (ground, load) = case("task3");
    assert!(ground.displacements(load, &[], 1.2).expect("none").is_empty());
    let nothing = SurfaceLoad::point(0.0).expect("load");
    let still = ground.displacement(nothing, 1.0, 1.2).expect("zero");
    assert_eq!(still, Displacement::ZERO);
}

#[test]
fn a_point_load_is_singular_in_its_own_point_only() {
    for ground in [
        ground(&[100.0], &[5e3, 50.0], &[0.3, 0.4]),
        ground(&[], &[50.0], &[0.4]),
    ] {
        let point = SurfaceLoad::point(1e5).expect("load");
        let disc = SurfaceLoad::new(1e5, 0.1).expect("load");
        let refused = ground.displacement(point, 0.0, 0.0).err();
        assert!(matches!(refused, Some(GroundError::Singular { .. })));
        assert!(ground.displacement(point, 0.01, 0.0).is_ok());
        assert!(ground.displacement(point, 0.0, 0.01).is_ok());
        for radius in [0.0, 0.1, 3.0] {
            assert!(ground.displacement(disc, radius, 0.0).is_ok());
        }
    }
}

#[test]
fn arguments_out_of_range_are_named() {
    let (ground, load) = case("task3");
    let (nan, infinite) = (f64::NAN, f64::INFINITY);
    for (radius, depth) in [(-1.0, 1.0), (nan, 1.0), (infinite, 1.0), (1.0, -1.0), (1.0, nan)] {
        let refused = ground.displacement(load, radius, depth).err();
        assert!(matches!(refused, Some(GroundError::InvalidParameter { .. })));
    }
    for accuracy in [0.0, -1.0, f64::NAN, 0.2, 1e-16] {
        assert!(ground.clone().with_accuracy(accuracy).is_err(), "{accuracy}");
    }
}

/// What double precision cannot show is an error, with the accuracy that was reached.
#[test]
fn too_much_accuracy_is_refused() {
    let (ground, load) = case("five");
    let ground = ground.with_accuracy(1e-15).expect("accuracy");
    let Err(GroundError::Accuracy { asked, reached, .. }) = ground.displacement(load, 1.0, 1.2) else {
        panic!("1e-15 cannot be had");
    };
    assert!(asked == 1e-15 && reached > asked && reached < 1e-10);
}

#[test]
fn rock_does_not_move() {
    let ground = ground(&[300.0], &[50.0], &[0.3]);
    let load = SurfaceLoad::new(1e5, 0.1).expect("load");
    for depth in [0.3, 0.31, 100.0] {
        let still = ground.displacement(load, 0.2, depth).expect("rock");
        assert_eq!(still, Displacement::ZERO);
    }
    assert!(ground.displacement(load, 0.2, 0.299).expect("soil").vertical > 0.0);
}

/// Layers of one soil are joined: no integral is done for them, and splitting costs nothing.
#[test]
fn equal_neighbours_are_joined() {
    let load = SurfaceLoad::new(1e5, 0.1).expect("load");
    let same = ground(&[100.0, 200.0], &[50.0, 50.0, 50.0], &[0.4, 0.4, 0.4]);
    let answer = same.displacements_with_statistics(load, &[0.0, 1.0], 0.2);
    let (_, statistics) = answer.expect("same");
    assert_eq!((statistics.wavenumbers, statistics.bessel_pairs), (0, 0));
}

/// The work of the 200-radius task, of one far point and of twenty layers, pinned from above.
#[test]
fn the_work_stays_within_bounds() {
    let (task3, load) = case("task3");
    let thickness: Vec<f64> = (0..20).map(|i| 10.0 * f64::from(1 + i * i)).collect();
    let modulus: Vec<f64> = (0..21).map(|i| if i % 2 == 0 { 1000.0 } else { 10.0 }).collect();
    let twenty = LayeredHalfSpace::new(&profile(&thickness, &modulus, &[0.35; 21])).expect("ground");
    let radii: Vec<f64> = (0..200).map(|i| 20.0 * f64::from(i) / 199.0).collect();
    for (ground, radii, depth, wavenumbers, pairs) in [
        (&task3, &radii[..], 1.2, 160, 26_000),
        (&task3, &[1e7], 0.0, 400, 2_000),
        (&task3, &[1e7], 1.2, 400, 2_000),
        (&twenty, &radii, 1.2, 800, 60_000),
    ] {
        let answer = ground.displacements_with_statistics(load, radii, depth);
        let (_, work) = answer.expect("an answer");
        assert!(work.wavenumbers <= wavenumbers, "{work:?}");
        assert!(work.bessel_pairs <= pairs, "{work:?}");
        assert!(work.estimated_error <= 1e-8, "{work:?}");
    }
}
