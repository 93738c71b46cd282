//! How far a period of the traffic advances the cable against friction that is locked in, measured
//! on a short piece of it.

use cable_dem::{CableState, DuctedCable, Mesh, QuasiStatic, Statistics};
use cycle_jump::days::LockedLaw;
use ground_field::DuctMotion;

use crate::passes::Task;
use crate::tuning::days::FINEST;
use creepage_plan::tuning::ground::LAW_LENGTH;
use creepage_plan::{
    Error,
    cable::cable,
    ground::{length_scale, road},
};

/// Periods that it takes: the first one brings the cable into the state that lasts.
const PERIODS: usize = 2;

/// The law for `passes` of `vehicles` on the mesh of `task`, or a coarser one: both ends free, a
/// body force that balances the locked friction. And what it costs.
pub fn locked_law(
    task: &Task<'_>,
    vehicles: &[usize],
    passes: usize,
) -> Result<(LockedLaw, Statistics), Error> {
    let (scene, motions, mesh) = (task.scene, task.motions, task.mesh);
    let limit = scene.friction_limit();
    let scale = length_scale(motions, scene.duct.depth);
    let coarser = (scale / FINEST / mesh.spacing()).max(1.0);
    let spacing = coarser * mesh.spacing();
    let approach = road::needed(scene, motions)?;
    // Vehicles are to stay within the reach of the motions.
    let reaches = motions.iter().map(DuctMotion::reach);
    let length = (LAW_LENGTH * scale).min(reaches.fold(f64::INFINITY, f64::min) - approach);
    let length = (length / spacing).floor() * spacing;
    let mesh = Mesh::new(length, spacing, coarser * mesh.vehicle_step())?;
    let whole = cable(scene)?;
    let short = |body_force: f64| {
        DuctedCable::new(length, whole.axial_stiffness(), whole.friction())
            .and_then(|cable| cable.with_body_force(body_force))
    };
    let solver = QuasiStatic::new(short(0.0)?, mesh)?;
    let passages = motions.iter().map(|motion| solver.passage(motion, approach));
    let passages = passages.collect::<Result<Vec<_>, _>>()?;
    let (nodes, middle) = (mesh.nodes(), mesh.nodes() / 2);
    let mut advances = [0.0; LockedLaw::SHARES.len()];
    let mut statistics = Statistics::default();
    for (advance, share) in advances.iter_mut().zip(LockedLaw::SHARES) {
        let mut solver = QuasiStatic::new(short(-share * limit)?, mesh)?;
        let mut state = CableState::from_parts(&mesh, vec![0.0; nodes], vec![share * limit; nodes])?;
        let mut before = 0.0;
        for _ in 0..PERIODS {
            before = state.displacement()[middle];
            for &vehicle in vehicles {
                statistics += solver.pass(&passages[vehicle], &mut state)?.statistics;
            }
        }
        let moved = state.displacement()[middle] - before;
        *advance = moved * passes as f64 / vehicles.len() as f64;
    }
    Ok((LockedLaw::new(advances, limit), statistics))
}
