//! Figure 7 of the paper: dynamic friction on the cable, equal in size forward and backward, but over a longer stretch forward.
//!
//! K. Kashiro et al., section 2.3: friction has the size q = μ_d N′ wherever the duct slips past the cable, whatever the speed, and the sign of
//! the slip. As the duct runs forward over a longer stretch than backward, the sum pushes the cable forward: that is why cables creep.
//! That picture holds for a cable that does not follow its duct: first panel, the upper cable of the experiment made ten
//! thousand times as stiff. The cable itself, below, at the first pass follows most of the slow forward motion elastically,
//! with less than the largest friction. When the force has levelled off, the friction locked in by then is near its limit
//! before the vehicle comes, and the duct slips forward over the longer stretch again.
//!
//! `cargo run --release --example figure_7`

mod common;

use boussinesq::HalfSpace;
use cable_dem::{
    CableState, DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic, SlipLengths,
};
use common::{Failure, save};
use creepage::figure::{Axis, Chart, Panels, Reference, Series};
use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};

const LENGTH: f64 = 30.0;
const DEPTH: f64 = 1.2;
/// Largest friction μ_d N′ of the upper cable \[N/m\].
pub const LIMIT: f64 = 0.25 * 108.8;
/// Vehicles come from this far beyond the duct \[m\].
const APPROACH: f64 = 15.0;

/// EA of the cable \[N\].
pub const AXIAL_STIFFNESS: f64 = 8.01e6;
/// EA of one that does not follow its duct \[N\].
pub const STIFF: f64 = 1e4 * AXIAL_STIFFNESS;

/// Friction with the vehicle over the middle of the duct.
pub struct Snapshot {
    /// EA \[N\].
    pub axial_stiffness: f64,
    /// Number of the pass.
    pub pass: u32,
    /// Places from the vehicle \[m\] and friction on the cable \[N/m\].
    pub friction: Vec<(f64, f64)>,
    /// Lengths at the limit.
    pub slip: SlipLengths,
}

impl Snapshot {
    /// Length at the limit backward between the outermost turns of D_l on either side of the vehicle \[m\]: ten depths off, 2/(1 − 2ν).
    /// Beyond them an endless half-space moves the duct backward once more, by little.
    pub fn backward_near(&self) -> f64 {
        let spacing = self.friction[1].0 - self.friction[0].0;
        let near = |place: &&(f64, f64)| place.0.abs() < 10.0 * DEPTH && place.1 < -0.999 * LIMIT;
        spacing * self.friction.iter().filter(near).count() as f64
    }

    /// What cable.
    fn cable(&self) -> &'static str {
        if self.axial_stiffness == STIFF {
            "stiff cable"
        } else {
            "the cable"
        }
    }
}

/// The given passes, ascending, of a cable of a given EA \[N\].
///
/// # Errors
///
/// Those of the ground and the cable.
pub fn snapshots(axial_stiffness: f64, passes: &[u32]) -> Result<Vec<Snapshot>, Failure> {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
    let truck = Vehicle::point("20 tf", 20.0 * 9806.65, 40.0 / 3.6)?;
    let duct = DuctLine::new(DEPTH, 0.0)?;
    let motion = DuctMotion::new(&ground, &truck, duct, LENGTH + 2.0 * APPROACH, 1e-9)?;
    let law = FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / LIMIT,
    };
    let cable = DuctedCable::new(LENGTH, axial_stiffness, Friction::new(law, LIMIT)?)?
        .with_ends(End::Free, End::Fixed)?;
    let mesh = Mesh::new(LENGTH, 0.1, 0.05)?;
    let passage = Passage::new(&cable, &mesh, &motion, APPROACH)?;
    let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
    let mut state = CableState::at_rest(&mesh);
    let mut found = Vec::new();
    for pass in 1..=passes.last().copied().unwrap_or(0) {
        let wanted = passes.contains(&pass);
        let mut nearest = f64::INFINITY;
        let mut snapshot = None;
        solver.pass_observed(&passage, &mut state, |vehicle, state| {
            let distance = (vehicle - 0.5 * LENGTH).abs();
            if wanted && distance < nearest {
                nearest = distance;
                let place = |node: usize| node as f64 * mesh.spacing() - vehicle;
                let state = state();
                snapshot = Some(Snapshot {
                    axial_stiffness,
                    pass,
                    friction: state
                        .friction()
                        .iter()
                        .enumerate()
                        .map(|(node, friction)| (place(node), *friction))
                        .collect(),
                    slip: state.slip_lengths(&cable).unwrap_or_default(),
                });
            }
        })?;
        found.extend(snapshot);
    }
    Ok(found)
}

/// Friction along the duct in each snapshot.
pub fn figure(snapshots: &[Snapshot]) -> Panels {
    snapshots.iter().fold(
        Panels::new("Figure 7: friction on the cable, vehicle over the middle").panel_size(800.0, 330.0),
        |panels, snapshot| {
            let title = format!(
                "{}, pass {}: at the limit over {:.1} m forward, {:.1} m backward",
                snapshot.cable(),
                snapshot.pass,
                snapshot.slip.forward,
                snapshot.slip.backward
            );
            let chart = Chart::new(
                title,
                Axis::linear("place from the vehicle, m"),
                Axis::linear("friction, N/m").range(-40.0, 40.0),
            )
            .refer(Reference::horizontal(LIMIT, "+μ N′"))
            .refer(Reference::horizontal(-LIMIT, "−μ N′"))
            .with(Series::area(
                "friction on the cable, positive in the vehicle's direction",
                snapshot.friction.clone(),
            ));
            panels.with(chart)
        },
    )
}

fn main() -> Result<(), Failure> {
    let mut snapshots = snapshots(STIFF, &[1])?;
    snapshots.extend(self::snapshots(AXIAL_STIFFNESS, &[1, 200])?);
    println!("paper: equal size, forward over a longer stretch than backward");
    for snapshot in &snapshots {
        let most = |sign: f64| {
            snapshot
                .friction
                .iter()
                .fold(0.0_f64, |most, f| most.max(sign * f.1))
        };
        println!(
            "{:11}  pass {:3}: forward {:5.2} m at {:.2} N/m, backward {:5.2} m at {:.2} N/m, {:.2} m of them within ten depths",
            snapshot.cable(),
            snapshot.pass,
            snapshot.slip.forward,
            most(1.0),
            snapshot.slip.backward,
            most(-1.0),
            snapshot.backward_near()
        );
    }
    save("figure-7.svg", &figure(&snapshots).to_svg()?)
}
