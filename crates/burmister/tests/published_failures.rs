//! Ways in which published layered-elastic programs fail, each with a test that this one does not; that transfer matrices overflow in thick layers
//! and interfaces break the field is seen by the random grounds and the tables.

use super::common::case;
use burmister::LayeredHalfSpace;
use ground_field::{GroundField, SoilProfile};

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
            let allowed = 1e-7 * expected.vertical.abs();
            assert!(gap <= allowed, "{} r {radius} z {}", row.case, row.depth);
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
            let off = (got.vertical / alone.vertical - 1.0).abs();
            assert!(off < share, "{radius} {depth} {off}");
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
        let side = if radial(middle) > 0.0 {
            &mut inside
        } else {
            &mut outside
        };
        *side = middle;
    }
    assert!(radial(inside).abs() <= 1e-8 * radial(1.0));
}
