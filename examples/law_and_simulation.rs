//! Draws the force at the fixed end of 100 m of duct against the passes: the law, and the simulation of every pass.
//!
//! `cargo run --release --example law_and_simulation`

mod common;

use boussinesq::HalfSpace;
use cable_dem::{CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic};
use creepage::figure::{Axis, Chart, Series};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
use pass_law::{PassLaw, Resolution};

const APPROACH: f64 = 15.0;
const LAST: u64 = 10_000;

fn main() -> Result<(), common::Failure> {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
    let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 500.0, 1e-9)?;
    let q = 0.25 * 108.8;
    let law = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / q,
    };
    let cable = DuctedCable::new(100.0, 8.01e6, Friction::new(law, q)?)?.with_ends(End::Free, End::Fixed)?;

    let mesh = Mesh::new(100.0, 0.2, 0.1)?;
    let passage = Passage::new(&cable, &mesh, &motion, APPROACH)?;
    let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
    let mut state = CableState::at_rest(&mesh);
    let listed = [1, 2, 3, 5, 8, 12, 20, 35, 60, 100, 170, 300, 500, 850, 1500];
    let mut simulated = Vec::new();
    for pass in 1..=listed[listed.len() - 1] {
        let outcome = solver.pass(&passage, &mut state)?;
        if listed.contains(&pass) {
            simulated.push((f64::from(pass), outcome.force.downstream));
        }
    }

    let passes: Vec<u64> = (0..=80)
        .map(|k| (LAST as f64).powf(f64::from(k) / 80.0).round() as u64)
        .collect();
    let resolution = Resolution::new(1.2)?;
    let law = PassLaw::new(&cable, &[(motion, 1.0)], resolution)?;
    let curve: Vec<(f64, f64)> = law
        .run(&passes)?
        .records
        .iter()
        .map(|record| (record.pass as f64, record.downstream_force))
        .collect();
    let saturation = law.saturation().ok_or("the cable saturates")?;
    let closed: Vec<(f64, f64)> = passes
        .iter()
        .map(|&pass| pass as f64)
        .map(|pass| (pass, saturation.downstream_force * saturation.share(pass)))
        .collect();

    let chart = Chart::new(
        "Force at the fixed end of 100 m of duct",
        Axis::logarithmic("passes").range(1.0, LAST as f64),
        Axis::linear("force, N"),
    )
    .with(Series::line("pass law", curve))
    .with(Series::points("simulation of every pass", simulated))
    .with(
        Series::line("closed form, without the ends' layers on the way", closed)
            .look(6)
            .dashed(),
    );
    common::save("pass-law.svg", &chart.to_svg()?)
}
