//! A fill that becomes stiffer with depth, over rock, with the error estimate of every depth:
//! `cargo run --release -p layered-fem --example graded_fill`.

use ground_field::{Base, GroundError, GroundField, Modulus, Soil, SoilLayer, SoilProfile, SurfaceLoad};
use layered_fem::LayeredFem;

fn main() -> Result<(), GroundError> {
    let road = SoilLayer::uniform(0.2, Soil::new(3e9, 0.35)?)?;
    let stiffening = Modulus::Linear {
        top: 40e6,
        bottom: 160e6,
    };
    let fill = SoilLayer::new(4.0, stiffening, 0.35)?;
    let ground = LayeredFem::new(&SoilProfile::new(vec![road, fill], Base::Rigid)?, 5e-3)?;
    let wheel = SurfaceLoad::new(49e3, 0.15)?;
    println!("depth, m   largest u_r, µm   u_z below the wheel, µm   estimated error");
    for depth in [0.6, 1.2, 2.0, 3.0] {
        let radii: Vec<f64> = (0..=60).map(|k| 0.1 * f64::from(k)).collect();
        let values = ground.displacements(wheel, &radii, depth)?;
        let widest = values.iter().map(|u| u.radial).fold(0.0, f64::max);
        println!(
            "{depth:8.1} {:17.2} {:25.2} {:15.2} %",
            1e6 * widest,
            1e6 * values[0].vertical,
            100.0 * ground.error_estimate(wheel, depth)?.largest()
        );
    }
    println!("{} unknowns", ground.unknowns());
    Ok(())
}
