//! The bowl a wheel presses into one soil, and into the same soil below asphalt (approximately):
//! `cargo run -p boussinesq --example deflection_bowl`.

use boussinesq::{HalfSpace, Odemark};
use ground_field::{Base, GroundError, GroundField, Soil, SoilLayer, SoilProfile, SurfaceLoad};

fn main() -> Result<(), GroundError> {
    let subgrade = Soil::new(60e6, 0.4)?;
    let asphalt = SoilLayer::uniform(0.2, Soil::new(5e9, 0.35)?)?;
    let road = Odemark::new(&SoilProfile::new(vec![asphalt], Base::HalfSpace(subgrade))?)?;
    let earth = HalfSpace::new(subgrade);
    let wheel = SurfaceLoad::new(49e3, 0.15)?;
    let depth = 1.2;
    println!("displacements in µm at {depth} m depth under a wheel of 49 kN");
    println!("           one soil          below asphalt");
    println!("  r, m     u_r     u_z        u_r     u_z");
    for k in 0..=12 {
        let radius = 0.5 * f64::from(k);
        let (bare, paved) = (
            earth.displacement(wheel, radius, depth)? * 1e6,
            road.displacement(wheel, radius, depth)? * 1e6,
        );
        println!(
            "{radius:6.1} {:7.1} {:7.1}    {:7.1} {:7.1}",
            bare.radial, bare.vertical, paved.radial, paved.vertical
        );
    }
    Ok(())
}
