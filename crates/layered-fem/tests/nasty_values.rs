//! Nothing that can be given to the public interface makes it panic or hang: an answer that is finite, or an error.

use ground_field::{Base, GroundField, Modulus, SoilLayer, SoilProfile, SurfaceLoad};
use layered_fem::LayeredFem;
use testkit::NASTY;

#[test]
fn grounds_are_answered_or_refused() {
    let sizes = [5e-324, 1e-300, 1e-9, 1.0, 1e9, 1e300, f64::MAX];
    // Little room, lest the time goes into meshes.
    let max_unknowns = 20_000;
    let load = |contact_radius| SurfaceLoad::new(1e5, contact_radius).expect("a load");
    let mut case = 0;
    for thickness in sizes {
        for (top, bottom) in sizes.into_iter().flat_map(|v| [(v, v), (v, 1e7), (1e7, v)]) {
            for poisson in [0.0, 0.5] {
                case += 1;
                let layer =
                    SoilLayer::new(thickness, Modulus::Linear { top, bottom }, poisson).expect("a layer");
                let base = [Base::Rigid, Base::HalfSpace(testkit::soil(1e7, 0.3))][case % 2];
                let profile = SoilProfile::new(vec![layer; 1 + case % 3], base).expect("a profile");
                let Ok(ground) = LayeredFem::with_max_unknowns(&profile, 0.05, max_unknowns) else {
                    continue;
                };
                for depth in [0.0, NASTY[case % NASTY.len()], 1.2] {
                    for load in [load(0.0), load(NASTY[case % 5 + 6])] {
                        for radius in [0.0, NASTY[(case / 3) % NASTY.len()], 0.8] {
                            if let Ok(value) = ground.displacement(load, radius, depth) {
                                assert!(value.is_finite(), "{profile:?}: {value:?}");
                            }
                        }
                        let _ = ground.error_estimate(load, depth);
                        let _ = ground.displacements(load, &[], depth);
                    }
                }
            }
        }
    }
}

/// A point load moves the ground, however steeply the modulus of the first millimetre falls.
#[test]
fn a_point_load_is_never_lost() {
    let (top, bottom) = (1e10, 1e-300);
    let layer = SoilLayer::new(0.1, Modulus::Linear { top, bottom }, 0.3).expect("a layer");
    let base = Base::HalfSpace(testkit::soil(1e7, 0.3));
    let profile = SoilProfile::new(vec![layer], base).expect("a profile");
    let load = SurfaceLoad::point(1e5).expect("a load");
    let ground = LayeredFem::new(&profile, 0.05);
    if let Ok(value) = ground.and_then(|ground| ground.displacement(load, 0.5, 1.0)) {
        assert!(value.vertical > 0.0, "{value:?}");
    }
}

#[test]
fn accuracies_and_limits_are_taken_or_refused() {
    let soil = testkit::soil(1e7, 0.3);
    let half_space = SoilProfile::half_space(soil);
    for accuracy in NASTY {
        let is_taken = LayeredFem::new(&half_space, accuracy).is_ok();
        assert_eq!(is_taken, (1e-6..=0.1).contains(&accuracy));
    }
    for unknowns in [0, 1, 100, usize::MAX] {
        let ground = LayeredFem::with_max_unknowns(&half_space, 0.1, unknowns);
        assert_eq!(ground.is_ok(), unknowns > 100);
        // Lines without end are refused before they are made.
        let layer = SoilLayer::uniform(f64::MAX, soil).expect("a layer");
        let endless = SoilProfile::new(vec![layer; 2], Base::HalfSpace(soil)).expect("a profile");
        assert!(LayeredFem::with_max_unknowns(&endless, 0.1, unknowns).is_err());
    }
}
