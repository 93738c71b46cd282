//! Nothing that can be given to the public interface makes it panic or hang: an answer that is finite, or an error.

use ground_field::{
    Base, Direction, Displacement, DuctLine, DuctMotion, GroundError, GroundField, Modulus, RadialProfile,
    Soil, SoilLayer, SoilProfile, SurfaceLoad, Vehicle, Wheel,
};
use testkit::NASTY;

/// Boussinesq's u_z and a u_r of its kind, with an error where they are no numbers.
struct Ground;

impl GroundField for Ground {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        let distance = radius.hypot(depth);
        let value = Displacement {
            radial: load.force() * (radius / distance) * (depth / distance) / distance,
            vertical: load.force() / distance,
        };
        let model = "test";
        let error = GroundError::Singular { model, radius, depth };
        if value.is_finite() { Ok(value) } else { Err(error) }
    }
}

#[test]
fn soils_loads_and_vehicles() {
    for a in NASTY {
        for b in NASTY {
            if let Ok(soil) = Soil::new(a, b) {
                assert!(soil.shear_modulus() >= 0.0);
            }
            if let Ok(load) = SurfaceLoad::new(a, b) {
                let _ = (load.pressure(), load.is_point());
            }
            let _ = DuctLine::new(a, b);
            for c in NASTY {
                let layers = [Modulus::Uniform(a), Modulus::Linear { top: a, bottom: b }]
                    .map(|modulus| SoilLayer::new(c, modulus, 0.3).ok());
                for layer in layers.into_iter().flatten() {
                    let _ = (layer.young_modulus_at(a), layer.young_modulus_at(f64::NAN));
                    layer.soil();
                    let profile = SoilProfile::new(vec![layer; 3], Base::Rigid).expect("a profile");
                    let _ = (profile.base_depth(), profile.homogeneous());
                }
            }
        }
    }
    assert!(SoilProfile::new(Vec::new(), Base::Rigid).is_err());
    assert!(Vehicle::new("", Vec::new(), 1.0, Direction::Forward).is_err());
}

#[test]
fn profiles() {
    for depth in NASTY {
        for reach in NASTY {
            for accuracy in [f64::NAN, 0.0, 1e-3] {
                let Ok(profile) = RadialProfile::sample(&Ground, 0.0, depth, reach, accuracy) else {
                    continue;
                };
                for radius in NASTY {
                    let is_finite = profile.displacement(radius).is_finite();
                    assert!(is_finite || !radius.is_finite(), "{depth} {reach} {radius}");
                }
            }
        }
    }
    assert!(RadialProfile::sample(&Ground, f64::NAN, 1.0, 1.0, 1e-3).is_err());
}

#[test]
fn motions() {
    let load = SurfaceLoad::point(1.0).expect("a load");
    for x in [f64::NAN, f64::MIN, 0.0, 1e-160, 1e9, 1e160] {
        for y in [f64::INFINITY, -1e160, 0.0, 5e-324, 1.0] {
            let wheels = vec![Wheel { x, y, load }, Wheel { x: 1.0, y: 0.0, load }];
            let Ok(vehicle) = Vehicle::new("", wheels, 1.0, Direction::Reverse) else {
                continue;
            };
            for (depth, offset, reach, accuracy) in NASTY.into_iter().flat_map(|v| {
                [
                    (v, 0.0, 1.0, 1e-3),
                    (1.0, v, 1.0, 1e-3),
                    (1.0, 0.0, v, 1e-3),
                    (1.0, 0.0, 1.0, v),
                ]
            }) {
                let Ok(line) = DuctLine::new(depth, offset) else {
                    continue;
                };
                let Ok(motion) = DuctMotion::new(&Ground, &vehicle, line, reach, accuracy) else {
                    continue;
                };
                assert!(motion.peak_longitudinal().is_finite() && motion.peak_vertical().is_finite());
                assert!(motion.reach() >= reach);
                for xi in NASTY {
                    let _ = (motion.longitudinal(xi), motion.vertical(xi));
                    motion.longitudinal_velocity(xi);
                    if let Ok(scaled) = motion.clone().scaled(xi) {
                        assert!(scaled.peak_longitudinal().is_finite());
                    }
                }
            }
        }
    }
}
