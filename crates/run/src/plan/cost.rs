//! Roughly how long every method would take, from counted work.

use cable_dem::{Explicit, ExplicitOptions, inertia_ratio};

use super::mesh::Levels;
use super::pass_method::{CableMethod, PassMethod};
use super::period::Period;
use crate::scene::Scene;
use crate::tuning::methods::{
    DAYS, EVERY_PASS_MESHES, EXPLICIT_SECONDS, JUMP_MESHES, MOST_PERIODS, PERIODS_A_DAY,
    QUASI_STATIC_SECONDS, SPARED, TYPICAL_PERIODS,
};
use crate::{Error, cable};

/// Where every pass is simulated although jumps are possible, it takes no longer than this
/// \[s\].
pub const LONGEST_SECONDS: f64 = 60.0;

/// What the choice of a method rests on.
#[derive(Debug)]
pub struct Estimates {
    /// (v/c)² of the fastest vehicle.
    pub inertia: f64,
    /// Passes that jumps leave to be simulated: as a rule, and at most.
    pub typical: f64,
    pub most: f64,
    pub passes: f64,
    /// Time of one pass by each method, on the level to begin with \[s\].
    quasi_static: f64,
    explicit: f64,
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

impl Estimates {
    pub fn new(scene: &Scene, levels: &Levels, period: &Period) -> Result<Self, Error> {
        let cable = cable::cable(scene)?;
        let mut inertia = 0.0_f64;
        for traffic in &scene.vehicles {
            inertia = inertia.max(inertia_ratio(&cable, cable::mass(scene), traffic.speed)?);
        }
        let first = levels.first;
        let (passes, length) = (scene.traffic.passes as f64, period.len() as f64);
        let periods = (passes / length).max(1.0);
        let simulated = |(first, per_e): (f64, f64)| match (scene.warming(), scene.traffic.per_day) {
            (Some(_), Some(per_day)) => DAYS.min(passes / per_day) * per_day.min(length * PERIODS_A_DAY),
            _ => (length * (first + per_e * periods.ln())).min(passes),
        };
        let whole_cable = levels.whole_cable_updates(first);
        Ok(Self {
            inertia,
            typical: simulated(TYPICAL_PERIODS),
            most: simulated(MOST_PERIODS),
            passes,
            quasi_static: QUASI_STATIC_SECONDS * levels.node_updates(first),
            explicit: EXPLICIT_SECONDS * explicit_steps(scene, levels)? * whole_cable,
        })
    }

    /// Whether jumps spare enough of the passes.
    pub fn jumps_pay(&self) -> bool {
        self.most < (1.0 - SPARED) * self.passes
    }

    /// Whether they do and every pass by `method` would take long.
    pub fn jumps_pay_for(&self, method: CableMethod) -> bool {
        self.jumps_pay() && self.every_pass(method) > LONGEST_SECONDS
    }

    fn one_pass(&self, method: CableMethod) -> f64 {
        match method {
            CableMethod::QuasiStatic => self.quasi_static,
            CableMethod::Explicit => self.explicit,
        }
    }

    /// Time of every pass by `method` \[s\].
    pub fn every_pass(&self, method: CableMethod) -> f64 {
        self.passes * self.one_pass(method)
    }

    /// Rough time of a whole run by `method` \[s\], on all its meshes.
    pub fn seconds(&self, method: PassMethod) -> f64 {
        match method {
            PassMethod::EveryPass(method) => EVERY_PASS_MESHES * self.every_pass(method),
            PassMethod::Jumps(method) => JUMP_MESHES * self.typical * self.one_pass(method),
        }
    }
}
