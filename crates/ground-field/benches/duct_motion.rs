//! Motion of a duct under a truck: made from a ground model that costs next to nothing, and evaluated.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use ground_field::{
    Direction, Displacement, DuctLine, DuctMotion, GroundError, GroundField, SurfaceLoad, Vehicle, Wheel,
};

/// A point load on an incompressible half-space: u_r ∝ r z/R³ and u_z ∝ z²/R³ + 1/R.
struct Incompressible;

impl GroundField for Incompressible {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        let distance = radius.hypot(depth);
        let scale = 1e-9 * load.force() / distance;
        let (across, down) = (radius / distance, depth / distance);
        Ok(Displacement {
            radial: scale * across * down,
            vertical: scale * (1.0 + down * down),
        })
    }
}

fn truck(axles: u32) -> Vehicle {
    let wheel = |axle: u32, y: f64| Wheel {
        x: -1.5 * f64::from(axle),
        y,
        load: SurfaceLoad::point(49e3).expect("a load"),
    };
    let wheels = (0..axles)
        .flat_map(|axle| [wheel(axle, -0.9), wheel(axle, 0.9)])
        .collect();
    Vehicle::new("truck", wheels, 11.0, Direction::Forward).expect("a vehicle")
}

fn duct_motion(criterion: &mut Criterion) {
    let line = DuctLine::new(1.2, 0.4).expect("a duct");
    let vehicle = truck(3);
    for accuracy in [1e-3, 1e-6, 1e-9] {
        criterion.bench_function(
            &format!("made for six wheels, 30 m, accuracy {accuracy:e}"),
            |bencher| {
                bencher.iter(|| DuctMotion::new(&Incompressible, black_box(&vehicle), line, 30.0, accuracy));
            },
        );
    }
    for axles in [1, 3] {
        let motion = DuctMotion::new(&Incompressible, &truck(axles), line, 30.0, 1e-6).expect("a motion");
        criterion.bench_function(&format!("D_l at one point, {} wheels", 2 * axles), |bencher| {
            bencher.iter(|| motion.longitudinal(black_box(0.7)));
        });
    }
}

criterion_group!(benches, duct_motion);
criterion_main!(benches);
