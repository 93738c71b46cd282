//! Nothing that can be given to the public interface makes it panic or hang: an answer that is finite, or an error.

use boussinesq::{HalfSpace, Odemark};
use ground_field::{Base, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};

/// Everything a float can be.
const NASTY: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MIN,
    -1.0,
    -0.0,
    0.0,
    5e-324,
    f64::MIN_POSITIVE,
    1e-160,
    1e-9,
    1.0,
    1e9,
    1e160,
    1e300,
    f64::MAX,
];

/// Grounds whose numbers are as far apart as numbers can be.
fn grounds() -> Vec<SoilProfile> {
    let sizes = [5e-324, 1e-300, 1e-9, 1.0, 1e9, 1e300, f64::MAX];
    let mut grounds = Vec::new();
    for thickness in sizes {
        for modulus in sizes {
            for poisson in [0.0, 0.5] {
                let soil = Soil::new(modulus, poisson).expect("a soil");
                let other = Soil::new(1e7, 0.3).expect("a soil");
                let layer = SoilLayer::uniform(thickness, soil).expect("a layer");
                let thin = SoilLayer::uniform(0.1, other).expect("a layer");
                for layers in [vec![], vec![layer], vec![thin, layer], vec![layer, thin, layer]] {
                    for base in [Base::Rigid, Base::HalfSpace(soil), Base::HalfSpace(other)] {
                        grounds.extend(SoilProfile::new(layers.clone(), base));
                    }
                }
            }
        }
    }
    grounds
}

/// Loads of every size that one can have.
fn loads() -> impl Iterator<Item = SurfaceLoad> {
    NASTY
        .into_iter()
        .flat_map(|a| [SurfaceLoad::new(1e5, a), SurfaceLoad::new(a, 0.15)])
        .flatten()
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
        assert!(
            field
                .displacements(load, &[], f64::NAN)
                .is_ok_and(|values| values.is_empty())
                || field.displacements(load, &[], 1.0).is_ok()
        );
        assert!(field.displacements(load, &NASTY, 1.0).is_err());
    }
}

#[test]
fn half_spaces() {
    for modulus in NASTY {
        for poisson in NASTY {
            let Ok(soil) = Soil::new(modulus, poisson) else {
                continue;
            };
            let ground = HalfSpace::new(soil);
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

#[test]
fn layers() {
    for (k, profile) in grounds().iter().enumerate() {
        let Ok(ground) = Odemark::new(profile) else {
            continue;
        };
        if k % 7 == 0 {
            answers_or_refuses(&ground);
        }
        for depth in NASTY {
            let Ok(transform) = ground.transform_at(depth) else {
                continue;
            };
            for wavenumber in NASTY {
                let _ = transform(wavenumber);
            }
        }
    }
}
