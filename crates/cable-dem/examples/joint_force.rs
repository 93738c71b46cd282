//! Force on a joint, fixed or on a spring, while trucks pass: `cargo run -p cable-dem --example joint_force`.

use boussinesq::HalfSpace;
use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, QuasiStatic};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};

/// Length and depth of the duct \[m\], and nodes per depth.
const LENGTH: f64 = 30.0;
const DEPTH: f64 = 1.2;
const NODES: f64 = 12.0;
/// How far beyond the duct the truck is followed \[m\]: until the duct's motion no longer turns, twelve depths away.
const APPROACH: f64 = 15.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
    let reach = LENGTH + APPROACH + 1.0;
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(DEPTH, 0.0)?, reach, 1e-6)?;

    let limit = 0.25 * 108.8;
    let shear_stiffness = 1e8;
    let law = FrictionLaw::ElasticPlastic {
        shape_factor: 2.0 * shear_stiffness / limit,
    };
    let friction = Friction::new(law, limit)?;
    let mesh = Mesh::for_depth(LENGTH, DEPTH, NODES)?;
    println!("downstream end     passes   force, N   movement, mm");
    for (name, end) in [
        ("fixed", End::Fixed),
        ("spring 1 MN/m", End::Spring(1e6)),
        ("spring 0.1 MN/m", End::Spring(1e5)),
    ] {
        let cable = DuctedCable::new(LENGTH, 8.01e6, friction)?.with_ends(End::Free, end)?;
        let mut solver = QuasiStatic::new(cable, mesh)?;
        let passage = solver.passage(&motion, APPROACH)?;
        let mut state = solver.at_rest();
        for pass in 1..=60 {
            let outcome = solver.pass(&passage, &mut state)?;
            if [1, 10, 60].contains(&pass) {
                let (force, moved) = (outcome.force.downstream, 1e3 * outcome.downstream_displacement);
                println!("{name:17} {pass:7} {force:10.1} {moved:14.3}");
            }
        }
    }
    Ok(())
}
