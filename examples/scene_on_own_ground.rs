//! A scene on a ground of your own: here Boussinesq's, half as soft as the scene's.
//!
//! `cargo run --release --example scene_on_own_ground`

use creepage::boussinesq::HalfSpace;
use creepage::ground_field::{Displacement, GroundError, GroundField, Soil, SurfaceLoad};
use creepage::{RunOptions, Scene};

/// Whatever says how far a point at `depth` below the road moves, `radius` away from a load.
struct Stiffened(HalfSpace, f64);

impl GroundField for Stiffened {
    fn displacement(&self, load: SurfaceLoad, radius: f64, depth: f64) -> Result<Displacement, GroundError> {
        let Displacement { radial, vertical } = self.0.displacement(load, radius, depth)?;
        Ok(Displacement {
            radial: radial / self.1,
            vertical: vertical / self.1,
        })
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    scene.traffic.passes = 20;
    let ground = Stiffened(HalfSpace::new(Soil::new(800e6, 0.4)?), 2.0);
    let options = RunOptions {
        ground: Some(&ground),
        ..RunOptions::default()
    };
    let (own, before) = (creepage::run_with(&scene, &options)?, creepage::run(&scene)?);
    let [own, before] = [own, before].map(|run| run.passes[19].downstream_force_n);
    println!("after 20 passes: {own:.0} N on the stiffer ground, {before:.0} N on the scene's");
    Ok(())
}
