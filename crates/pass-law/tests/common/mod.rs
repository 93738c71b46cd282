//! The full-scale experiment's cables and ground, and the direct simulation as the oracle.
#![allow(dead_code, reason = "every test file uses its own part")]

use boussinesq::HalfSpace;
use cable_dem::{
    CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Order, Passage, QuasiStatic, Traffic,
};
use ground_field::{Direction, DuctLine, DuctMotion, Soil, Vehicle};
use pass_law::{PassLaw, PassRecord, Resolution};

pub type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Depth of the duct \[m\].
pub const DEPTH: f64 = 1.2;
/// Where vehicles come from in the direct simulation \[m\] beyond the ends.
pub const APPROACH: f64 = 15.0;
/// Nodes a depth, in both.
pub const NODES: f64 = 6.0;

/// The duct under a point load of `force` \[N\].
pub fn motion(force: f64, direction: Direction) -> Result<DuctMotion, Box<dyn std::error::Error>> {
    under(&Vehicle::point("truck", force, 11.11)?.driving(direction), DEPTH)
}

/// A duct at `depth` \[m\] under `vehicle`.
pub fn under(vehicle: &Vehicle, depth: f64) -> Result<DuctMotion, Box<dyn std::error::Error>> {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    Ok(DuctMotion::new(
        &ground,
        vehicle,
        DuctLine::new(depth, 0.0)?,
        1000.0,
        1e-10,
    )?)
}

/// 20 tf.
pub const TRUCK: f64 = 196_133.0;

/// A cable of the experiment with friction coefficient `mu` and `load` \[N/m\] on its duct.
pub fn cable(length: f64, mu: f64, load: f64) -> Result<DuctedCable, Box<dyn std::error::Error>> {
    let q = mu * load;
    let law = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / q,
    };
    Ok(DuctedCable::new(length, 8.01e6, Friction::new(law, q)?)?.with_ends(End::Free, End::Fixed)?)
}

pub fn resolution() -> Result<Resolution, Box<dyn std::error::Error>> {
    Ok(Resolution::new(DEPTH)?.with_nodes_per_depth(NODES)?)
}

/// The law's and the direct simulation's records after the listed passes.
pub fn both(
    cable: &DuctedCable,
    traffic: &[(DuctMotion, f64)],
    passes: &[u64],
) -> Result<Vec<(PassRecord, PassRecord)>, Box<dyn std::error::Error>> {
    both_at(DEPTH, cable, traffic, passes)
}

/// As [`both`], for a duct at `depth` \[m\].
pub fn both_at(
    depth: f64,
    cable: &DuctedCable,
    traffic: &[(DuctMotion, f64)],
    passes: &[u64],
) -> Result<Vec<(PassRecord, PassRecord)>, Box<dyn std::error::Error>> {
    let resolution = Resolution::new(depth)?.with_nodes_per_depth(NODES)?;
    let law = PassLaw::new(cable, traffic, resolution)?;
    for concern in law.concerns() {
        println!("concern: {concern}");
    }
    let evolution = law.run(passes)?;
    println!("{:?} {:?}", law.preparation(), evolution.statistics);
    let direct = direct_at(depth, cable, traffic, passes)?;
    Ok(evolution.records.into_iter().zip(direct).collect())
}

pub fn direct(
    cable: &DuctedCable,
    traffic: &[(DuctMotion, f64)],
    passes: &[u64],
) -> Result<Vec<PassRecord>, Box<dyn std::error::Error>> {
    direct_at(DEPTH, cable, traffic, passes)
}

fn direct_at(
    depth: f64,
    cable: &DuctedCable,
    traffic: &[(DuctMotion, f64)],
    passes: &[u64],
) -> Result<Vec<PassRecord>, Box<dyn std::error::Error>> {
    let mesh = Mesh::new(cable.length(), depth / NODES, 0.5 * depth / NODES)?;
    let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
    let passages = traffic
        .iter()
        .map(|(motion, _)| Passage::new(cable, &mesh, motion, APPROACH))
        .collect::<Result<Vec<_>, _>>()?;
    let shares: Vec<f64> = traffic.iter().map(|stream| stream.1).collect();
    let mut state = CableState::at_rest(&mesh);
    let mut records = Vec::new();
    for (pass, vehicle) in (1..=passes[passes.len() - 1]).zip(Traffic::new(&shares, Order::Interleaved)?) {
        let outcome = solver.pass(&passages[vehicle], &mut state)?;
        if passes.contains(&pass) {
            records.push(PassRecord {
                pass,
                upstream_force: outcome.force.upstream,
                downstream_force: outcome.force.downstream,
                upstream_swing: 0.0,
                downstream_swing: 0.0,
                upstream_peak: outcome.peak.upstream,
                downstream_peak: outcome.peak.downstream,
                max_compression: outcome.max_compression,
                upstream_displacement: outcome.upstream_displacement,
                downstream_displacement: outcome.downstream_displacement,
            });
        }
    }
    Ok(records)
}

/// Asserts that `value` of all records agrees within `share` of the direct one.
pub fn assert_within(share: f64, records: &[(PassRecord, PassRecord)], value: impl Fn(&PassRecord) -> f64) {
    for (law, direct) in records {
        println!(
            "{:8} law {:12.5e} direct {:12.5e} ({:+.2} %)",
            law.pass,
            value(law),
            value(direct),
            100.0 * (value(law) / value(direct) - 1.0)
        );
    }
    for (law, direct) in records {
        let error = value(law) / value(direct) - 1.0;
        assert!(
            error.abs() <= share,
            "pass {}: {:.2} % off",
            law.pass,
            100.0 * error
        );
    }
}
