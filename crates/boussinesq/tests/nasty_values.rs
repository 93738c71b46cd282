//! Nothing that can be given to the public interface makes it panic or hang: an answer that is finite, or an error.

use boussinesq::HalfSpace;
use ground_field::{GroundField, Soil, SurfaceLoad};
use testkit::NASTY;

/// Loads of every size that one can have.
fn loads() -> impl Iterator<Item = SurfaceLoad> {
    let of = |a| [SurfaceLoad::new(1e5, a), SurfaceLoad::new(a, 0.15)];
    NASTY.into_iter().flat_map(of).flatten()
}

fn answers_or_refuses(field: &dyn GroundField) {
    for load in loads() {
        for radius in NASTY {
            for depth in [0.0, 5e-324, 1.2, f64::MAX, radius] {
                if let Ok(value) = field.displacement(load, radius, depth) {
                    assert!(value.is_finite(), "{radius} {depth} {load:?}: {value:?}");
                }
            }
        }
        assert!(field.displacements(load, &[], 1.0).is_ok());
        assert!(field.displacements(load, &NASTY, 1.0).is_err());
    }
}

#[test]
fn half_spaces() {
    for modulus in NASTY {
        for poisson in NASTY {
            let Ok(ground) = Soil::new(modulus, poisson).map(HalfSpace::new) else {
                continue;
            };
            answers_or_refuses(&ground);
            for force in NASTY {
                for place in NASTY {
                    if let Ok(stress) = ground.point_stress(force, place, 1.0) {
                        assert!((stress.radial + stress.vertical + stress.hoop + stress.shear).is_finite());
                    }
                }
            }
        }
    }
}
