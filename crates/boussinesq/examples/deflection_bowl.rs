//! The bowl a wheel presses into one soil: `cargo run -p boussinesq --example deflection_bowl`.

use boussinesq::HalfSpace;
use ground_field::{GroundError, GroundField, Soil, SurfaceLoad};

fn main() -> Result<(), GroundError> {
    let earth = HalfSpace::new(Soil::new(60e6, 0.4)?);
    let wheel = SurfaceLoad::new(49e3, 0.15)?;
    let depth = 1.2;
    println!("displacements in µm at {depth} m depth under a wheel of 49 kN");
    println!("  r, m     u_r     u_z");
    for k in 0..=12 {
        let radius = 0.5 * f64::from(k);
        let moved = earth.displacement(wheel, radius, depth)? * 1e6;
        println!("{radius:6.1} {:7.1} {:7.1}", moved.radial, moved.vertical);
    }
    Ok(())
}
