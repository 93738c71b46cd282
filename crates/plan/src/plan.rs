//! How a scene is computed: the ground's motion, the method, the meshes. Data only; a run carries
//! it out.
//!
//! A plan is made from the motion of the duct and from estimates: how far inertia can matter, what
//! the passes will cost. The run measures what the estimates promise, and refines where they
//! promise too much.

use std::sync::Arc;

use creepage_scene::{Scene, SolverMethod};

use crate::cost::Estimates;
use crate::error::Error;
use crate::ground::{Ground, road};
use crate::mesh::Levels;
use crate::method::{self, LONGEST_EVERY_PASS, MAX_PASSES};
use crate::period::Period;
use crate::saved_state::SavedState;
use crate::warnings;

/// How a scene will be computed.
#[derive(Debug)]
pub struct Plan<'a> {
    /// What is computed.
    pub scene: &'a Scene,
    /// Its ground, and the motion of its duct under each vehicle.
    pub ground: Arc<Ground>,
    /// The period of its traffic.
    pub period: Period,
    /// How the passes are computed.
    pub method: SolverMethod,
    /// Why.
    pub reason: String,
    /// What every method would cost.
    pub estimates: Estimates,
    /// Its meshes, from coarse to fine.
    pub levels: Levels,
    /// What the reader must know of it.
    pub warnings: Vec<String>,
    /// The state that the passes begin with, if not as laid.
    pub start: Option<&'a SavedState>,
}

/// Plans how to compute `scene`.
///
/// # Errors
///
/// [`Error`] when the scene asks for what does not fit together.
pub fn plan(scene: &Scene) -> Result<Plan<'_>, Error> {
    scene.validate()?;
    let ground = Ground::new(scene, None, road::reach(scene))?;
    plan_over(scene, Arc::new(ground))
}

/// Plans how to compute a valid `scene` over a `ground` that is known to be its own.
///
/// # Errors
///
/// As for [`plan`].
pub fn plan_over(scene: &Scene, ground: Arc<Ground>) -> Result<Plan<'_>, Error> {
    let approach = road::approach(scene, &ground.motions)?;
    let levels = Levels::new(scene, &ground.motions, approach);
    let period = Period::new(scene, &ground.motions)?;
    // Refuses an impossible mesh before any pass.
    levels.mesh(levels.first)?;
    let estimates = Estimates::new(scene, &levels, &period)?;
    let (method, reason) = method::choose(scene, &period, &estimates)?;
    let mut plan = Plan {
        scene,
        ground,
        period,
        method,
        reason,
        estimates,
        levels,
        warnings: Vec::new(),
        start: None,
    };
    plan.warnings = warnings::warnings(scene, plan.inertia(), &plan.ground.motions)?;
    Ok(plan)
}

impl Plan<'_> {
    /// By what share of the force leaving inertia out is off at most, where it is left out.
    pub fn inertia(&self) -> f64 {
        match self.method {
            SolverMethod::Explicit => 0.0,
            _ => self.estimates.inertia,
        }
    }

    /// Whether every pass may be simulated where jumps do not get on.
    pub fn may_simulate_all(&self) -> bool {
        self.method == SolverMethod::PassLaw
            && self.scene.traffic.passes <= MAX_PASSES
            && self.estimates.every_pass(self.method) <= LONGEST_EVERY_PASS
    }
}
