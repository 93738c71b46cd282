//! A ground model of one's own, and the motion of a duct below a lorry: `cargo run -p ground-field --example own_ground`.

use ground_field::{
    Direction, Displacement, DuctLine, DuctMotion, GroundError, GroundField, SurfaceLoad, Vehicle, Wheel,
};

/// Incompressible soil under a point load (Boussinesq with ν = 0.5): u_r = c r z/R³, u_z = c (z²/R³ + 1/R), c = 3P/(4πE).
struct Clay {
    young_modulus: f64,
}

impl GroundField for Clay {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        let distance = radius.hypot(depth);
        if distance == 0.0 {
            return Err(GroundError::Singular {
                model: "clay",
                radius,
                depth,
            });
        }
        let scale = 3.0 * load.force() / (4.0 * std::f64::consts::PI * self.young_modulus * distance);
        let (across, down) = (radius / distance, depth / distance);
        Ok(Displacement {
            radial: scale * across * down,
            vertical: scale * (down * down + 1.0),
        })
    }
}

fn main() -> Result<(), GroundError> {
    let mut wheels = Vec::new();
    for (x, force) in [(0.0, 27e3), (-4.0, 36e3), (-5.3, 36e3)] {
        for y in [-0.9, 0.9] {
            let load = SurfaceLoad::point(force)?;
            wheels.push(Wheel { x, y, load });
        }
    }
    let lorry = Vehicle::new("lorry", wheels, 11.1, Direction::Forward)?;
    let ground = Clay { young_modulus: 300e6 };
    let motion = DuctMotion::new(&ground, &lorry, DuctLine::new(1.2, 0.0)?, 30.0, 1e-6)?;
    println!("  xi, m   along, µm   down, µm   speed, µm/s");
    for k in -10..=6 {
        let xi = f64::from(k);
        println!(
            "{xi:7.1} {:11.2} {:10.2} {:13.1}",
            1e6 * motion.longitudinal(xi),
            1e6 * motion.vertical(xi),
            1e6 * motion.longitudinal_velocity(xi),
        );
    }
    println!(
        "largest: {:.2} µm along, {:.2} µm down; the model was asked {} times",
        1e6 * motion.peak_longitudinal(),
        1e6 * motion.peak_vertical(),
        motion.samples()
    );
    Ok(())
}
