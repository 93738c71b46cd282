//! A pavement to eight digits, and what that took: `cargo run -p burmister --example pavement`.

use burmister::LayeredHalfSpace;
use ground_field::{Base, GroundError, Soil, SoilLayer, SoilProfile, SurfaceLoad};

fn main() -> Result<(), GroundError> {
    let layer = |thickness, modulus, ratio| SoilLayer::uniform(thickness, Soil::new(modulus, ratio)?);
    let layers = vec![
        layer(0.10, 2411e6, 0.35)?,
        layer(0.09, 6890e6, 0.20)?,
        layer(0.50, 207e6, 0.35)?,
    ];
    let road = SoilProfile::new(layers, Base::HalfSpace(Soil::new(103e6, 0.4)?))?;
    let wheel = SurfaceLoad::new(49e3, 0.15)?;
    let depth = 1.2;
    let ground = LayeredHalfSpace::new(&road)?;
    let radii: Vec<f64> = (0..=12).map(|k| 0.5 * f64::from(k)).collect();
    let (values, work) = ground.displacements_with_statistics(wheel, &radii, depth)?;
    println!("displacements in µm at {depth} m depth under a wheel of 49 kN");
    println!("  r, m          u_r          u_z");
    for (radius, value) in radii.iter().zip(values) {
        println!(
            "{radius:6.1} {:12.6} {:12.6}",
            1e6 * value.radial,
            1e6 * value.vertical
        );
    }
    println!(
        "{} wavenumbers; error at most {:.0e} of the peak",
        work.wavenumbers, work.estimated_error
    );
    Ok(())
}
