//! The ways in which published layered-elastic programs fail, each with a test that this one does not.

use super::common::{case, ground};
use burmister::LayeredHalfSpace;
use ground_field::{Base, GroundField, SoilProfile, SurfaceLoad};

/// Transfer matrices overflow: exp(m h) with a load of 15 cm on layers of 1 km reaches exp(100 000).
#[test]
fn thick_layers_do_not_overflow() {
    let soil = |i: i32| testkit::soil(1e8 * (1.0 + 1e-13 * f64::from(i)), 0.35);
    let layers = (0..4).map(|i| testkit::layer(1000.0, soil(i))).collect();
    let profile = SoilProfile::new(layers, Base::HalfSpace(soil(4))).expect("profile");
    let layered = LayeredHalfSpace::new(&profile).expect("ground");
    let one = LayeredHalfSpace::new(&SoilProfile::half_space(soil(0))).expect("ground");
    let load = SurfaceLoad::new(1e5, 0.15).expect("load");
    for depth in [0.0, 0.05, 1.0, 700.0, 999.0, 1000.0, 3500.0, 5000.0] {
        let [a, b] = [&layered, &one].map(|ground| ground.displacement(load, 0.4, depth).expect("value"));
        let off = (a.vertical - b.vertical).abs().max((a.radial - b.radial).abs());
        assert!(off <= 1e-8 * b.vertical, "{depth}");
    }
}

/// The kernel bends near m ≈ 1/(total thickness) and, for a stiff plate, near 1/(bending length), far below 1/depth. Panels that
/// do not grade toward m = 0 miss it, and with it the settlement at a distance. Every far point of the tables, against its own
/// value and not against the peak.
#[test]
fn far_points_keep_relative_accuracy() {
    let mut checked = 0;
    for row in testkit::layered::table(include_str!("data/computed_layered.csv"), ("", 0.0)) {
        let (ground, load) = case(&row.case);
        for &(radius, expected) in row.points.iter().filter(|point| point.0 >= 5.0) {
            let got = ground.displacement(load, radius, row.depth).expect("value");
            let gap = (got.vertical - expected.vertical).abs();
            assert!(
                gap <= 1e-7 * expected.vertical.abs(),
                "{} r {radius} z {}: {gap:e}",
                row.case,
                row.depth
            );
            checked += 1;
        }
    }
    assert!(checked > 200);
}

/// A fixed count of Bessel zeros loses up to 90 % at far points. Far away the field is that of the base alone.
#[test]
fn nothing_is_lost_hundreds_of_metres_away() {
    let (ground, load) = case("task3");
    let base = LayeredHalfSpace::new(&SoilProfile::half_space(testkit::soil(8e8, 0.4))).expect("base");
    for depth in [0.0, 1.2] {
        for radius in [100.0, 300.0, 1e3, 1e4, 1e6] {
            let got = ground.displacement(load, radius, depth).expect("value");
            let alone = base.displacement(load, radius, depth).expect("value");
            // The layers' own part fades like (their bending length / r)².
            let share = 1e-9 + (2.0 / radius).powi(2);
            assert!(
                (got.vertical / alone.vertical - 1.0).abs() < share,
                "{radius} {depth} {got:?} {alone:?}"
            );
        }
    }
}

/// `u_r` changes sign with r: a tolerance relative to its value never stops there. The error counts against the peak.
#[test]
fn a_zero_of_the_radial_displacement_is_no_obstacle() {
    let (ground, load) = case("task3");
    let radial = |r: f64| ground.displacement(load, r, 1.2).expect("value").radial;
    let (mut inside, mut outside) = (1.0, 20.0);
    assert!(radial(inside) > 0.0 && radial(outside) < 0.0);
    for _ in 0..40 {
        let middle = 0.5 * (inside + outside);
        if radial(middle) > 0.0 {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    assert!(radial(inside).abs() <= 1e-8 * radial(1.0));
}

/// Depth exactly at an interface, a hair above it and a hair below: displacements are continuous there.
#[test]
fn interfaces_are_continuous() {
    let ground = ground(
        &[2.0, 100.0, 10.0],
        &[1e4, 1.0, 1e4, 10.0],
        &[0.2, 0.5, 0.3, 0.45],
    );
    let load = SurfaceLoad::new(1e5, 0.1).expect("load");
    for depth in [0.002, 0.102, 0.112] {
        let at = ground.displacement(load, 0.1, depth).expect("at");
        for near in [depth * (1.0 - 1e-12), depth * (1.0 + 1e-12)] {
            let near = ground.displacement(load, 0.1, near).expect("near");
            let off = (near.vertical - at.vertical)
                .abs()
                .max((near.radial - at.radial).abs());
            assert!(off <= 3e-8 * at.vertical.abs(), "{depth}");
        }
    }
}
