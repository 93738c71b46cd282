//! The passes of a scene on one mesh by one solver, put together from the crates: no planner, and no coarser mesh to tell an error.

use boussinesq::HalfSpace;
use cable_dem::{
    CableState, DuctedCable, Explicit, ExplicitOptions, Friction, Mesh, MovingDuct, PassOutcome, Passage,
    QuasiStatic,
};
use creepage::Scene;
use ground_field::{DuctLine, DuctMotion, GroundField};

use crate::Failure;

/// Standard acceleration of gravity \[m/s²\].
const GRAVITY: f64 = 9.80665;
/// How far beyond the duct's ends vehicles come from \[m\], where the scene names nothing else.
pub const APPROACH: f64 = 15.0;
/// Passes after which it is known what all of them will take.
const PROBE: usize = 3;

/// Which solver takes the passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solver {
    QuasiStatic,
    Explicit,
}

impl Solver {
    /// Nodes advanced in a second of a small machine, about: what an answer may take is counted, so that the same cells are left
    /// out everywhere.
    fn updates_per_second(self) -> f64 {
        match self {
            Self::QuasiStatic => 1e8,
            Self::Explicit => 3e8,
        }
    }
}

/// Forces on the downstream end after every pass \[N\], and how many nodes were solved for or advanced.
#[derive(Debug, Clone, Default)]
pub struct Answer {
    pub forces: Vec<f64>,
    pub node_updates: usize,
}

fn approach(scene: &Scene) -> f64 {
    scene.solver.approach.unwrap_or(APPROACH)
}

/// The cable of `scene`.
pub fn cable(scene: &Scene) -> Result<DuctedCable, Failure> {
    let limit = scene.friction.dynamic_coefficient * scene.normal_load();
    let friction = Friction::new(scene.friction.law(), limit)?;
    Ok(
        DuctedCable::new(scene.duct.length, scene.cable.axial_stiffness, friction)?
            .with_ends(scene.ends.upstream, scene.ends.downstream)?,
    )
}

/// Motion of the duct under the scene's first vehicle, on the ground `field`.
pub fn motion(scene: &Scene, field: &dyn GroundField, accuracy: f64) -> Result<DuctMotion, Failure> {
    let line = DuctLine::new(scene.duct.depth, scene.offset_from(&scene.vehicles[0]))?;
    let reach = scene.duct.length + 2.0 * approach(scene);
    Ok(DuctMotion::new(
        field,
        &scene.vehicles[0].vehicle()?,
        line,
        reach,
        accuracy,
    )?)
}

/// The same on the one soil of the scene's ground.
pub fn half_space_motion(scene: &Scene, accuracy: f64) -> Result<DuctMotion, Failure> {
    let soil = scene.ground.profile()?.homogeneous();
    motion(
        scene,
        &HalfSpace::new(soil.ok_or("the ground has layers")?),
        accuracy,
    )
}

/// `passes` passes of the first vehicle, with `density` nodes a depth of the duct and two steps of the vehicle a node spacing.
/// `None` if the first passes show that all of them would take longer than `seconds`, about.
pub fn simulate(
    scene: &Scene,
    motion: &DuctMotion,
    solver: Solver,
    density: f64,
    passes: usize,
    seconds: f64,
) -> Result<Option<Answer>, Failure> {
    let (cable, mass) = (cable(scene)?, scene.cable.weight / GRAVITY);
    let spacing = scene.duct.depth / density;
    let mesh = Mesh::new(scene.duct.length, spacing, 0.5 * spacing)?;
    let mut state = CableState::at_rest(&mesh);
    let mut pass: Box<dyn FnMut() -> Result<PassOutcome, cable_dem::CableError>> = match solver {
        Solver::QuasiStatic => {
            let passage = Passage::new(&cable, &mesh, motion, approach(scene))?;
            let mut quasi_static = QuasiStatic::new(cable, mesh)?;
            Box::new(move || quasi_static.pass(&passage, &mut state))
        }
        Solver::Explicit => {
            let duct = MovingDuct::new(&cable, &mesh, motion, approach(scene))?;
            let mut solver = Explicit::new(cable, mesh, mass, ExplicitOptions::default())?;
            Box::new(move || Ok(solver.pass(&duct, &mut state)?.pass))
        }
    };
    let mut answer = Answer::default();
    for done in 1..=passes {
        let outcome = pass()?;
        answer.forces.push(outcome.force.downstream);
        answer.node_updates += outcome.statistics.node_updates;
        let expected = answer.node_updates as f64 * passes as f64 / done as f64;
        if done <= PROBE && expected > seconds * solver.updates_per_second() {
            return Ok(None);
        }
    }
    Ok(Some(answer))
}

/// Forces on the downstream end after every pass \[N\], however long that takes.
pub fn forces(
    scene: &Scene,
    motion: &DuctMotion,
    solver: Solver,
    density: f64,
    passes: usize,
) -> Result<Vec<f64>, Failure> {
    let answer = simulate(scene, motion, solver, density, passes, f64::INFINITY)?;
    Ok(answer.expect("there is no limit").forces)
}

/// Largest difference of `found` from `truth` as a share of the latter, or of its tenth part at the largest where it is less;
/// infinite for what is not a number.
pub fn error(found: &[f64], truth: &[f64]) -> f64 {
    let largest = truth
        .iter()
        .fold(0.0_f64, |largest, force| largest.max(force.abs()));
    let shares = found
        .iter()
        .zip(truth)
        .map(|(found, truth)| (found - truth).abs() / truth.abs().max(0.1 * largest));
    shares.fold(0.0, |worst: f64, share| {
        if share.is_nan() {
            f64::INFINITY
        } else {
            worst.max(share)
        }
    })
}

/// Forces by quasi-static passes on a fine mesh, and how far they may be off: a third of their difference to those on a mesh half
/// as fine, which is what a scheme of second order leaves, over the passes from `from` on.
pub fn truth(
    scene: &Scene,
    motion: &DuctMotion,
    density: f64,
    passes: usize,
    from: usize,
) -> Result<(Vec<f64>, f64), Failure> {
    let at = |density| forces(scene, motion, Solver::QuasiStatic, density, passes);
    let (fine, coarse) = (at(density)?, at(0.5 * density)?);
    let gap = error(&coarse[from - 1..], &fine[from - 1..]);
    Ok((fine, gap / 3.0))
}
