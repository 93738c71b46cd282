//! What a scene needs: the cheapest ground model, the cheapest way to compute the passes and the coarsest mesh that keep
//! its tolerance.
//!
//! This is the one place that weighs accuracy against cost. A [`Plan`] is made in milliseconds from estimates that are
//! computed for the scene: what layers and wheels do to the motion of the duct, how far inertia can matter, what the
//! passes will cost. It shows every rung of each ladder, the one taken and why the others were not; [`Plan::run`] carries
//! it out, measures what the estimates promised, and climbs where they promised too much.

pub mod ground;
pub mod mesh;
pub mod method;
pub mod occurrence;

use ground_field::GroundField;
use serde::Serialize;

use crate::analysis::run::{self, RunOptions};
use crate::analysis::{cable::PassMethod, road};
use crate::scene::unusual;
use crate::{Error, Run, Scene};
use ground::GroundChoice;
use mesh::Levels;
use method::MethodChoice;
use occurrence::Occurrence;

/// Density of soil \[kg/m³\] for the speed of its shear waves: moist sand and clay have 1700 to 2000.
const SOIL_DENSITY: f64 = 1800.0;
/// Mach number of a vehicle in the ground above which the ground's own inertia is no longer small.
const FAST: f64 = 0.3;

/// A rung of a ladder: one model or mesh, taken or not.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rung {
    /// What it models: `ground`, `cable` or `mesh`.
    pub part: &'static str,
    /// Name of the model.
    pub name: String,
    /// Whether it was taken.
    pub chosen: bool,
    /// How wrong it is, as a share: of the peak of D_l for the ground, of the force for the others.
    pub estimated_error: Option<f64>,
    /// Time it takes \[s\] on a core of about 3 GHz, within a factor of three or so.
    pub estimated_seconds: Option<f64>,
    /// Why it was taken, or why not.
    pub reason: String,
}

impl Rung {
    pub(crate) fn rejected(
        part: &'static str,
        name: &str,
        estimated_error: Option<f64>,
        estimated_seconds: Option<f64>,
        reason: &str,
    ) -> Self {
        Self {
            part,
            name: name.into(),
            chosen: false,
            estimated_error,
            estimated_seconds,
            reason: reason.into(),
        }
    }

    pub(crate) fn chosen(
        part: &'static str,
        name: &str,
        error: f64,
        seconds: Option<f64>,
        reason: &str,
    ) -> Self {
        Self {
            chosen: true,
            ..Self::rejected(part, name, Some(error), seconds, reason)
        }
    }
}

/// How a scene will be computed.
pub struct Plan<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) ground: GroundChoice<'a>,
    pub(crate) method: MethodChoice,
    pub(crate) levels: Levels,
    pub(crate) warnings: Vec<String>,
    mesh: (f64, f64),
}

/// A plan for a reader. The names of the fields are those of the JSON document, units included.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlanReport {
    /// The scene's title.
    pub title: String,
    /// Ground model.
    pub ground: String,
    /// How the passes are computed.
    pub cable: String,
    /// Distance between nodes to begin with \[m\]; the run refines it until its error is small enough.
    pub node_spacing_m: f64,
    /// Advance of the vehicle per step to begin with \[m\].
    pub vehicle_step_m: f64,
    /// Why these.
    pub reasons: Vec<String>,
    /// Error to expect, as a share of the force; `None` on a mesh that the scene names.
    pub estimated_error: Option<f64>,
    /// Time of the run \[s\] on a core of about 3 GHz, within a factor of three or so.
    pub estimated_seconds: f64,
    /// Whether the cable creeps, and how much force there can be, by one number; `None` where the duct's motion is not known before the
    /// run (finite elements, a model that the scene names) or there is none.
    pub occurrence: Option<Occurrence>,
    /// Every rung that was looked at.
    pub ladder: Vec<Rung>,
    /// What the user should know before trusting the answer.
    pub warnings: Vec<String>,
}

/// Plans how to compute `scene`.
///
/// # Errors
///
/// [`Error`] when the scene asks for what does not fit together.
pub fn plan(scene: &Scene) -> Result<Plan<'_>, Error> {
    plan_on(scene, None)
}

/// Plans how to compute `scene` on a ground model of the caller's own, where there is one.
///
/// # Errors
///
/// As for [`plan`].
pub fn plan_on<'a>(scene: &'a Scene, own: Option<&'a dyn GroundField>) -> Result<Plan<'a>, Error> {
    scene.validate()?;
    let by_time_step =
        scene.solver.method == crate::scene::SolverMethod::Explicit && scene.solver.time_step.is_some();
    let ground = ground::choose(scene, own)?;
    let approach = road::approach(scene, ground.known().unwrap_or_default())?;
    let levels = Levels::new(scene, approach, by_time_step);
    let first = levels.mesh(levels.first())?;
    let method = method::choose(scene, &levels)?;
    if method.method != PassMethod::Law {
        run::check_passes(scene)?;
    }
    Ok(Plan {
        scene,
        warnings: [unusual(scene), warnings(scene)].concat(),
        ground,
        method,
        mesh: (first.spacing(), first.vehicle_step()),
        levels,
    })
}

impl Plan<'_> {
    /// Carries the plan out.
    ///
    /// # Errors
    ///
    /// [`Error`] when the computation fails.
    pub fn run(&self) -> Result<Run, Error> {
        self.run_with(&RunOptions::default())
    }

    /// Carries the plan out with options; their ground model is the one of [`plan_on`].
    ///
    /// # Errors
    ///
    /// As for [`Plan::run`].
    pub fn run_with(&self, options: &RunOptions<'_>) -> Result<Run, Error> {
        run::carry_out(self, options)
    }

    /// The plan for a reader.
    pub fn report(&self) -> PlanReport {
        let level = self.levels.first();
        let mut ladder = self.ground.rungs.clone();
        ladder.extend(self.method.rungs.iter().cloned());
        let law = self.method.method == PassMethod::Law;
        if !law {
            ladder.extend(self.mesh_rungs());
        }
        let mesh_error = if law {
            Some(0.0)
        } else {
            self.levels.expected_error(level)
        };
        let seconds = ladder
            .iter()
            .filter(|rung| rung.chosen && rung.part != "mesh")
            .filter_map(|rung| rung.estimated_seconds)
            .sum();
        PlanReport {
            title: self.scene.title.clone(),
            ground: self.ground.name.into(),
            cable: self.method.method.name().into(),
            node_spacing_m: self.mesh.0,
            vehicle_step_m: self.mesh.1,
            reasons: self.reasons(),
            estimated_error: mesh_error.map(|error| error + self.method.error + self.ground.error),
            estimated_seconds: seconds,
            occurrence: self
                .ground
                .known()
                .and_then(|motions| Occurrence::new(self.scene, motions)),
            ladder,
            warnings: self.warnings.clone(),
        }
    }

    /// Why the ground model and the method were taken.
    pub(crate) fn reasons(&self) -> Vec<String> {
        vec![
            format!("ground {}: {}", self.ground.name, self.ground.reason),
            format!("cable {}: {}", self.method.method.name(), self.method.reason),
        ]
    }

    fn mesh_rungs(&self) -> Vec<Rung> {
        let tolerance = self.scene.solver.tolerance;
        (0..=self.levels.finest())
            .filter_map(|level| Some((level, self.levels.mesh(level).ok()?)))
            .map(|(level, mesh)| {
                let chosen = level == self.levels.first();
                let reason = match level.cmp(&self.levels.first()) {
                    std::cmp::Ordering::Less => "too coarse; computed to tell the error of the next".into(),
                    std::cmp::Ordering::Equal if self.levels.named() => "as the scene asks".into(),
                    std::cmp::Ordering::Equal => {
                        format!("the coarsest that should keep {} %", 100.0 * tolerance)
                    }
                    std::cmp::Ordering::Greater => "only if the one before proves too coarse".into(),
                };
                Rung {
                    part: "mesh",
                    name: format!("{:.3} m", mesh.spacing()),
                    chosen,
                    estimated_error: self.levels.expected_error(level),
                    estimated_seconds: None,
                    reason,
                }
            })
            .collect()
    }
}

/// What lies outside the model's range whatever is chosen.
fn warnings(scene: &Scene) -> Vec<String> {
    let profile = &scene.ground.profile;
    let base = match profile.base() {
        ground_field::Base::HalfSpace(soil) => Some(soil.shear_modulus()),
        ground_field::Base::Rigid => None,
    };
    let softest = profile
        .layers()
        .iter()
        .map(|layer| {
            let modulus = layer
                .young_modulus_at(0.0)
                .min(layer.young_modulus_at(layer.thickness()));
            modulus / (2.0 * (1.0 + layer.poisson_ratio()))
        })
        .chain(base)
        .fold(f64::INFINITY, f64::min);
    let wave = (softest / SOIL_DENSITY).sqrt();
    let fastest = scene
        .vehicles
        .iter()
        .map(|traffic| traffic.vehicle.speed())
        .fold(0.0, f64::max);
    if fastest > FAST * wave {
        vec![format!(
            "a vehicle drives at {:.2} of the speed of shear waves in the softest soil ({wave:.0} m/s at {SOIL_DENSITY} kg/m³): \
             the ground is computed without its inertia, which matters above {FAST}",
            fastest / wave
        )]
    } else {
        Vec::new()
    }
}
