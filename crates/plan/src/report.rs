//! A plan for a reader: what was chosen, what was not, and why.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use crate::cost::Estimates;
use crate::method::NO_REST;
use crate::occurrence::Occurrence;
use crate::plan::Plan;
use crate::shown::spacing;
use creepage_scene::SolverMethod::{self, Auto, Explicit, PassLaw, QuasiStatic};

/// Meshes and methods that a plan shows.
const LISTED: usize = 7;
const METHODS: [SolverMethod; 3] = [PassLaw, QuasiStatic, Explicit];

/// What a candidate models.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Part {
    /// The ground under the wheels.
    Ground,
    /// The cable and its passes.
    Cable,
    /// Node spacing and vehicle step.
    Mesh,
}

creepage_scene::words!(Part: Ground "ground", Cable "cable", Mesh "mesh");

/// A model or mesh that was considered, chosen or not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Candidate {
    /// What it models.
    pub part: Part,
    /// Name of the model.
    pub name: String,
    /// Whether it was chosen.
    pub chosen: bool,
    /// How wrong it is, as a share: of the peak of D_l for the ground, of the force for the others.
    pub estimated_error: Option<f64>,
    /// Rough time of the whole run with it \[s\] on one core of about 3 GHz.
    pub estimated_seconds: Option<f64>,
    /// Why it was chosen, or why not.
    pub reason: String,
}

/// A plan for a reader. The names of the fields are those of the JSON document, units included.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PlanReport {
    /// The scene's title.
    pub title: String,
    /// Ground model.
    pub ground: String,
    /// How the passes are computed.
    pub cable: String,
    /// Distance between nodes to begin with \[m\]; the run refines it until its error is small
    /// enough.
    pub node_spacing_m: f64,
    /// Advance of the vehicle per step to begin with \[m\].
    pub vehicle_step_m: f64,
    /// Why these.
    pub reasons: Vec<String>,
    /// Error to expect, as a share of the force; `None` on a mesh that the scene names.
    pub estimated_error: Option<f64>,
    /// Rough time of the whole run \[s\] on one core of about 3 GHz, from counted work: within a
    /// factor of five in about half of all scenes, far more where finer meshes prove necessary.
    pub estimated_seconds: f64,
    /// Whether the cable creeps, and how much force there can be, by one number; `None` if
    /// nothing moves the duct.
    pub occurrence: Option<Occurrence>,
    /// Everything that was considered.
    pub candidates: Vec<Candidate>,
    /// What the user should know before trusting the answer.
    pub warnings: Vec<String>,
}

impl Plan<'_> {
    /// Why the ground model was chosen, and the method for a reason of its own.
    pub fn reasons(&self, method: &str) -> Vec<String> {
        vec![
            format!("ground {}: {}", self.ground.name, self.ground.reason),
            format!("cable {}: {method}", self.method),
        ]
    }

    /// Why the method was chosen, and how many passes it is expected to simulate.
    fn foreseen(&self) -> String {
        let (reason, estimates) = (&self.reason, &self.estimates);
        match self.method {
            PassLaw => format!(
                "about {:.0} of {} passes are simulated, with jumps between them; {reason}",
                estimates.typical, estimates.passes
            ),
            _ => reason.clone(),
        }
    }

    /// The plan for a reader.
    pub fn report(&self) -> PlanReport {
        let (scene, ground, levels) = (self.scene, &self.ground, &self.levels);
        let (node_spacing_m, vehicle_step_m) = levels.spacing(levels.first);
        let chosen = Candidate {
            part: Part::Ground,
            name: ground.name.into(),
            chosen: true,
            estimated_error: Some(ground.accuracy),
            estimated_seconds: None,
            reason: ground.reason.into(),
        };
        let methods = METHODS.map(|method| self.method(method));
        let meshes = (0..=levels.finest).filter(|&level| levels.mesh(level).is_ok());
        let meshes = meshes.take(LISTED).map(|level| self.mesh(level));
        let mesh_error = levels.expected_error(levels.first);
        PlanReport {
            title: scene.title.clone(),
            ground: ground.name.into(),
            cable: self.method.to_string(),
            node_spacing_m,
            vehicle_step_m,
            reasons: self.reasons(&self.foreseen()),
            estimated_error: mesh_error.map(|error| error + self.inertia() + ground.accuracy),
            estimated_seconds: self.estimates.seconds(self.method),
            occurrence: Occurrence::new(scene, &ground.motions),
            candidates: [chosen].into_iter().chain(methods).chain(meshes).collect(),
            warnings: self.warnings.clone(),
        }
    }

    fn method(&self, method: SolverMethod) -> Candidate {
        let (scene, estimates) = (self.scene, &self.estimates);
        let chosen = method == self.method;
        let inertia = match method {
            Explicit => Some(0.0),
            _ => scene.friction.law().has_memory().then_some(estimates.inertia),
        };
        let Estimates { passes, most, .. } = estimates;
        Candidate {
            part: Part::Cable,
            name: method.to_string(),
            chosen,
            estimated_error: inertia,
            estimated_seconds: Some(estimates.seconds(method)),
            reason: match method {
                _ if chosen => self.foreseen(),
                _ if inertia.is_none() => NO_REST.into(),
                _ if scene.solver.method != Auto => "the scene names another method".into(),
                PassLaw => format!("jumps might leave {most:.0} of {passes} passes to be simulated"),
                Explicit => "only where the scene names it".into(),
                _ => format!("all {passes} passes would be simulated"),
            },
        }
    }

    fn mesh(&self, level: usize) -> Candidate {
        let levels = &self.levels;
        Candidate {
            part: Part::Mesh,
            name: format!("{} m", spacing(levels.spacing(level).0)),
            chosen: level == levels.first,
            estimated_error: levels.expected_error(level),
            estimated_seconds: None,
            reason: match level.cmp(&levels.first) {
                Ordering::Less => "too coarse; computed to measure the error of the next".into(),
                Ordering::Equal if levels.named => "the scene asks for it".into(),
                Ordering::Equal => "the coarsest that should keep the tolerance".into(),
                Ordering::Greater => "only if the one before proves too coarse".into(),
            },
        }
    }
}
