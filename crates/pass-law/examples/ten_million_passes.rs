//! Forces after up to ten million passes over 300 m of duct: `cargo run --release -p pass-law --example ten_million_passes`.

use boussinesq::HalfSpace;
use cable_dem::{DuctedCable, End, Friction, FrictionLaw};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
use pass_law::{PassLaw, Resolution};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let depth = 1.2;
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(depth, 0.0)?, 500.0, 1e-8)?;

    let limit = 0.25 * 108.8;
    let law = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / limit,
    };
    let friction = Friction::new(law, limit)?;
    let cable = DuctedCable::new(300.0, 8.01e6, friction)?.with_ends(End::Free, End::Fixed)?;

    let law = PassLaw::new(&cable, &[(motion, 1.0)], Resolution::new(depth)?)?;
    for concern in law.concerns() {
        println!("caution: {concern}");
    }
    println!("    passes   force, N   upstream end moved, mm");
    for record in law.run(&[30, 100, 1000, 10_000, 100_000, 10_000_000])?.records {
        println!(
            "{:10} {:10.1} {:14.2}",
            record.pass,
            record.downstream_force,
            1e3 * record.upstream_displacement
        );
    }
    if let Some(saturation) = law.saturation() {
        println!("saturated: {:.1} N", saturation.downstream_force);
    }
    Ok(())
}
