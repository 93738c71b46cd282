//! How the passes of a scene are computed.
//!
//! The pass law costs the same for ten passes as for ten million; the quasi-static cable moves only near the vehicle; the
//! solvers with inertia move all of it. Inertia changes the force by at most (v/c)²; the pass law's error is measured on the
//! first passes. Explicit steps are taken only where the scene names them.

use cable_dem::inertia_ratio;
use pass_law::{Concern, Resolution, concerns_before};

use super::mesh::Levels;
use crate::Error;
use crate::cable;
use crate::scene::{Scene, SolverMethod};
use crate::shown::time;

/// Measured time a node's update takes \[s\] on one core of about 3 GHz: without inertia, with it, and explicit.
const QUASI_STATIC_SECONDS: f64 = 1.6e-8;
const DYNAMIC_SECONDS: f64 = 6e-8;
const EXPLICIT_SECONDS: f64 = 1e-9;
/// Speed of waves in the cable beside the vehicle's time step, for the explicit solver's share of the work.
const EXPLICIT_STEPS: f64 = 40.0;
/// Measured time of the pass law, whatever the number of passes \[s\].
const LAW_SECONDS: f64 = 0.2;
/// Error of the law itself beyond the tenth pass on the ducts it is made for, measured against the simulation of every
/// pass. What it is on a scene is measured on the scene's first passes.
pub const LAW_ERROR: f64 = 0.01;
/// The law takes over where it is as accurate as asked and simulating every pass would take this many times its own time.
const WORTHWHILE: f64 = 20.0;
/// Where simulating every pass takes longer than this on the level for 1 % \[s\], the law takes over whatever the tolerance.
const LONGEST_SECONDS: f64 = 60.0;
/// The level that keeps 1 %, and the one on which the law's time is compared.
const LEVEL_OF_ONE_PERCENT: usize = 2;
const LEVEL_OF_THE_LAW: usize = 1;
/// Share of the tolerance that leaving inertia out may cost.
const INERTIA_SHARE: f64 = 0.5;
/// Most passes that are simulated.
const MOST_PASSES: u64 = 1_000_000;

/// How all passes are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PassMethod {
    /// Every pass is simulated.
    EveryPass(CableMethod),
    /// By the pass law.
    Law,
}

/// Solver of the cable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CableMethod {
    QuasiStatic,
    Dynamic,
    Explicit,
}

impl PassMethod {
    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::EveryPass(method) => method.name(),
            Self::Law => "pass-law",
        }
    }

    /// The solver of the passes that are simulated.
    pub fn cable_method(self) -> CableMethod {
        match self {
            Self::EveryPass(method) => method,
            Self::Law => CableMethod::QuasiStatic,
        }
    }

    fn has_inertia(self) -> bool {
        self.cable_method() != CableMethod::QuasiStatic
    }
}

impl CableMethod {
    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::QuasiStatic => "quasi-static",
            Self::Dynamic => "dynamic",
            Self::Explicit => "explicit",
        }
    }
}

/// How the passes are computed, and why.
#[derive(Debug)]
pub struct MethodChoice {
    pub method: PassMethod,
    pub reason: String,
    /// By what share of the force leaving inertia out is off at most, where it is left out.
    pub inertia: f64,
    /// Whether every pass may be simulated where the law proves too rough.
    pub may_simulate: bool,
    /// What every method would cost.
    pub estimates: Estimates,
}

/// The method the scene names, or the cheapest that keeps its tolerance.
pub fn choose(scene: &Scene, levels: &Levels) -> Result<MethodChoice, Error> {
    let estimates = Estimates::new(scene, levels)?;
    let key = "solver.method";
    let method = match scene.solver.method {
        SolverMethod::Auto => None,
        SolverMethod::PassLaw => match &estimates.refusal {
            Some(refusal) => return Err(unfit(key, "pass-law", refusal)),
            None => Some(PassMethod::Law),
        },
        SolverMethod::QuasiStatic if !scene.friction.law.has_memory() => {
            return Err(unfit(key, "quasi-static", NO_REST));
        }
        SolverMethod::QuasiStatic => Some(PassMethod::EveryPass(CableMethod::QuasiStatic)),
        SolverMethod::Dynamic => Some(PassMethod::EveryPass(CableMethod::Dynamic)),
        SolverMethod::Explicit => Some(PassMethod::EveryPass(CableMethod::Explicit)),
    };
    let auto = method.is_none();
    let (method, reason) = match method {
        Some(named) => (named, "the scene asks for it".to_owned()),
        None => automatic(scene, &estimates),
    };
    let count = scene.traffic.passes;
    if method != PassMethod::Law && count > MOST_PASSES && scene.friction_limit() > 0.0 {
        return Err(unfit(
            "traffic.passes",
            "more than a million passes",
            match (&estimates.refusal, auto) {
                (Some(refusal), _) => {
                    format!("at most 1 000 000 are simulated, and the pass law does not apply: {refusal}")
                }
                (None, true) => "at most 1 000 000 are simulated".to_owned(),
                (None, false) => format!(
                    "at most 1 000 000 are simulated by solver.method = \"{}\"; \"pass-law\" computes any number",
                    method.name()
                ),
            },
        ));
    }
    Ok(MethodChoice {
        inertia: if method.has_inertia() {
            0.0
        } else {
            estimates.inertia
        },
        may_simulate: auto && estimates.fine <= LONGEST_SECONDS,
        method,
        reason,
        estimates,
    })
}

fn unfit(key: &'static str, found: &'static str, reason: impl Into<String>) -> Error {
    Error::Unfit {
        key,
        found,
        reason: reason.into().into(),
    }
}

const NO_REST: &str = "the sigmoid law has no state of rest: its friction depends on the time step";

fn automatic(scene: &Scene, estimates: &Estimates) -> (PassMethod, String) {
    let tolerance = scene.solver.tolerance;
    if !scene.friction.law.has_memory() {
        return (PassMethod::EveryPass(CableMethod::Dynamic), NO_REST.into());
    }
    if estimates.inertia_matters(tolerance) {
        let reason = format!("{}: too much for the tolerance", estimates.inertia_in_words());
        return (PassMethod::EveryPass(CableMethod::Dynamic), reason);
    }
    let passes = scene.traffic.passes;
    if estimates.refusal.is_none() && scene.restraints.is_empty() {
        if estimates.fine > LONGEST_SECONDS {
            let reason = format!(
                "simulating all {passes} passes would take {}",
                time(estimates.fine)
            );
            return (PassMethod::Law, reason);
        }
        if LAW_ERROR <= tolerance && estimates.coarse > WORTHWHILE * LAW_SECONDS {
            let times = estimates.coarse / LAW_SECONDS;
            let reason = format!(
                "within the tolerance; simulating all {passes} passes would take {times:.0} times as long"
            );
            return (PassMethod::Law, reason);
        }
    }
    let reason = estimates.inertia_in_words();
    (PassMethod::EveryPass(CableMethod::QuasiStatic), reason)
}

/// What the choice rests on.
#[derive(Debug)]
pub struct Estimates {
    /// (v/c)² of the fastest vehicle.
    pub inertia: f64,
    /// Why the pass law must not be used.
    refusal: Option<String>,
    /// Time of the quasi-static passes on the levels [`LEVEL_OF_THE_LAW`] and [`LEVEL_OF_ONE_PERCENT`] and on the one to begin with \[s\].
    coarse: f64,
    fine: f64,
    first: f64,
    dynamic: f64,
    explicit: f64,
}

impl Estimates {
    fn new(scene: &Scene, levels: &Levels) -> Result<Self, Error> {
        let cable = cable::cable(scene)?;
        let mass = cable::mass(scene);
        let mut inertia = 0.0_f64;
        for traffic in &scene.vehicles {
            inertia = inertia.max(inertia_ratio(&cable, mass, traffic.vehicle.speed())?);
        }
        let concerns = concerns_before(&cable, Resolution::new(scene.duct.depth)?);
        let passes = scene.traffic.passes;
        let seconds = |level| QUASI_STATIC_SECONDS * levels.node_updates(level, passes);
        let lattice = levels.whole_cable_updates(levels.first(), passes);
        Ok(Self {
            inertia,
            refusal: concerns
                .iter()
                .find(|concern| concern.is_fatal())
                .map(Concern::to_string),
            coarse: seconds(LEVEL_OF_THE_LAW),
            fine: seconds(LEVEL_OF_ONE_PERCENT),
            first: seconds(levels.first()),
            dynamic: DYNAMIC_SECONDS * lattice,
            explicit: EXPLICIT_SECONDS * EXPLICIT_STEPS * lattice,
        })
    }

    fn inertia_matters(&self, tolerance: f64) -> bool {
        self.inertia > INERTIA_SHARE * tolerance
    }

    fn inertia_in_words(&self) -> String {
        let percent = 100.0 * self.inertia;
        format!("inertia changes the force by at most {percent:.2} %, (v/c)²")
    }

    /// Time of a run by `method` \[s\].
    pub fn seconds(&self, method: PassMethod) -> f64 {
        match method {
            PassMethod::Law => LAW_SECONDS,
            PassMethod::EveryPass(CableMethod::QuasiStatic) => self.first,
            PassMethod::EveryPass(CableMethod::Dynamic) => self.dynamic,
            PassMethod::EveryPass(CableMethod::Explicit) => self.explicit,
        }
    }

    /// Error of `method` beside that of its mesh, as a share of the force; `None` where it does not apply.
    pub fn error(&self, scene: &Scene, method: PassMethod) -> Option<f64> {
        match method {
            PassMethod::Law => Some(LAW_ERROR + self.inertia),
            PassMethod::EveryPass(CableMethod::QuasiStatic) => {
                scene.friction.law.has_memory().then_some(self.inertia)
            }
            PassMethod::EveryPass(_) => Some(0.0),
        }
    }

    /// Why `method` was not taken.
    pub fn against(&self, scene: &Scene, method: PassMethod) -> String {
        let tolerance = scene.solver.tolerance;
        let named = scene.solver.method != SolverMethod::Auto;
        let has_rest = scene.friction.law.has_memory();
        match (method, &self.refusal) {
            (PassMethod::Law, Some(refusal)) => refusal.clone(),
            (PassMethod::EveryPass(CableMethod::QuasiStatic), _) if !has_rest => NO_REST.into(),
            _ if named => "the scene names another method".into(),
            (method, _) if !method.has_inertia() && self.inertia_matters(tolerance) => {
                self.inertia_in_words()
            }
            (PassMethod::Law, None) if LAW_ERROR > tolerance => "less accurate than the tolerance".into(),
            (PassMethod::Law, None) if !scene.restraints.is_empty() => {
                "it has no layers around clamps".into()
            }
            (PassMethod::Law, None) => "simulating every pass costs little more and is more accurate".into(),
            (PassMethod::EveryPass(CableMethod::QuasiStatic), _) => {
                "simulating every pass would take too long".into()
            }
            (PassMethod::EveryPass(CableMethod::Dynamic), _) => "more than the tolerance needs".into(),
            (PassMethod::EveryPass(CableMethod::Explicit), _) => "only where the scene names it".into(),
        }
    }
}
