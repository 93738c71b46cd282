//! Roughly how long every method would take, from counted work.

use cable_dem::{Explicit, ExplicitOptions, inertia_ratio};

use crate::cable;
use crate::error::Error;
use crate::mesh::Levels;
use crate::period::Period;
use crate::tuning::methods::{
    DAYS, EVERY_PASS_MESHES, EXPLICIT_SECONDS, JUMP_MESHES, MAX_PERIODS, PERIODS_A_DAY, QUASI_STATIC_SECONDS,
    TYPICAL_PERIODS,
};
use creepage_scene::{Scene, SolverMethod};

/// What the choice of a method rests on.
#[derive(Debug)]
pub struct Estimates {
    /// (v/c)² of the fastest vehicle.
    pub inertia: f64,
    /// Passes that jumps leave to be simulated, as a rule.
    pub typical: f64,
    /// The same at most.
    pub most: f64,
    /// Passes of the scene.
    pub passes: f64,
    /// Time of one pass, without inertia and explicit, on the level to begin with \[s\].
    quasi_static: f64,
    explicit: f64,
}

impl Estimates {
    /// Of a scene on these meshes.
    ///
    /// # Errors
    ///
    /// [`Error`] when a mesh is impossible.
    pub fn new(scene: &Scene, levels: &Levels, period: &Period) -> Result<Self, Error> {
        let cable = cable::cable(scene)?;
        let (passes, length) = (scene.traffic.passes as f64, period.len() as f64);
        let periods = (passes / length).max(1.0);
        let simulated = |(first, per_e): (f64, f64)| match (scene.warming(), scene.traffic.per_day) {
            (Some(_), Some(per_day)) => DAYS.min(passes / per_day) * per_day.min(length * PERIODS_A_DAY),
            _ => (length * (first + per_e * periods.ln())).min(passes),
        };
        let speeds = scene.vehicles.iter().map(|vehicle| vehicle.speed);
        let explicit_seconds = EXPLICIT_SECONDS * explicit_steps(scene, levels)?;
        Ok(Self {
            inertia: inertia_ratio(&cable, cable::mass(scene), speeds.fold(0.0, f64::max))?,
            typical: simulated(TYPICAL_PERIODS),
            most: simulated(MAX_PERIODS),
            passes,
            quasi_static: QUASI_STATIC_SECONDS * levels.node_updates(levels.first),
            explicit: explicit_seconds * levels.whole_cable_updates(levels.first),
        })
    }

    /// Time of every pass on one mesh \[s\].
    pub fn every_pass(&self, method: SolverMethod) -> f64 {
        match method {
            SolverMethod::Explicit => self.passes * self.explicit,
            _ => self.passes * self.quasi_static,
        }
    }

    /// Rough time of a whole run by `method` \[s\], on all its meshes.
    pub fn seconds(&self, method: SolverMethod) -> f64 {
        match method {
            SolverMethod::PassLaw => JUMP_MESHES * self.typical * self.quasi_static,
            _ => EVERY_PASS_MESHES * self.every_pass(method),
        }
    }
}

/// Time steps of the explicit solver per step of a vehicle: they follow waves in the cable, stiff
/// ends and slow vehicles.
fn explicit_steps(scene: &Scene, levels: &Levels) -> Result<f64, Error> {
    let (mesh, options) = (levels.mesh(levels.first)?, ExplicitOptions::default());
    let solver = Explicit::new(cable::cable(scene)?, mesh, cable::mass(scene), options)?;
    let time_step = scene.solver.time_step.unwrap_or(solver.limits().advised());
    let steps = scene.shares().into_iter().zip(&scene.vehicles);
    let steps =
        steps.map(|(share, vehicle)| share * (mesh.vehicle_step() / (vehicle.speed * time_step)).max(1.0));
    Ok(steps.sum())
}
