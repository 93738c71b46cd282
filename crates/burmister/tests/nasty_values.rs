//! Nothing that can be given to the public interface makes it panic or hang: an answer that is finite, or an error.

use burmister::LayeredHalfSpace;
use ground_field::{Base, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};
use testkit::{NASTY, nasty_grounds};

#[test]
fn grounds_are_answered_or_refused() {
    let ordinary = [(1e5, 0.15), (1e5, 0.0), (0.0, 0.0)];
    let loads = [&ordinary[..], &[(f64::MAX, 1e-9), (5e-324, 1e300)]].concat();
    let loads: Vec<_> = loads
        .into_iter()
        .map(|(force, radius)| SurfaceLoad::new(force, radius).expect("a load"))
        .collect();
    for (k, profile) in nasty_grounds().iter().enumerate() {
        let Ok(ground) = LayeredHalfSpace::new(profile) else {
            continue;
        };
        // Every ground with some loads and depths, every load and depth with some grounds.
        let load = loads[k % loads.len()];
        assert!(ground.displacements_with_statistics(load, &NASTY, 1.0).is_err());
        for depth in [NASTY[k % NASTY.len()], NASTY[5 * k % NASTY.len()], 0.05] {
            for radii in [&[][..], &[0.0, 1.0, 1e12], &[5e-324, 1e300, f64::MAX]] {
                if let Ok((values, statistics)) = ground.displacements_with_statistics(load, radii, depth) {
                    let all = values.iter().all(|value| value.is_finite());
                    assert!(all, "{depth} {load:?} {profile:?}");
                    assert!(statistics.estimated_error <= ground.accuracy());
                }
            }
        }
    }
}

#[test]
fn accuracies_are_taken_or_refused() {
    let soil = Soil::new(1e8, 0.3).expect("a soil");
    let layer = SoilLayer::uniform(0.2, Soil::new(5e9, 0.3).expect("a soil")).expect("a layer");
    let profile = SoilProfile::new(vec![layer], Base::HalfSpace(soil)).expect("a profile");
    let load = SurfaceLoad::new(1e5, 0.15).expect("a load");
    for accuracy in NASTY.into_iter().chain([1e-15, 1e-13, 0.1]) {
        let Ok(ground) = LayeredHalfSpace::new(&profile).and_then(|ground| ground.with_accuracy(accuracy))
        else {
            continue;
        };
        for radius in NASTY {
            if let Ok(value) = ground.displacement(load, radius, 1.2) {
                assert!(value.is_finite());
            }
        }
    }
}
