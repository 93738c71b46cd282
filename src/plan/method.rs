//! How the passes of a scene are computed.
//!
//! The pass law costs the same for ten passes as for ten million; the quasi-static cable moves only near the vehicle; the
//! solvers with inertia move all of it. Inertia changes the force by at most (v/c)²; the law is as good as its guards and
//! the comparison with simulated passes say.

use cable_dem::inertia_ratio;
use pass_law::{Concern, Resolution, concerns_before};

use super::mesh::Levels;
use crate::Error;
use crate::cable;
use crate::scene::{Scene, SolverMethod};

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
/// The level for 1 %, and the one for tolerances that the law can keep.
const FINE: usize = 2;
const COARSE: usize = 1;
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
    pub fn solver(self) -> CableMethod {
        match self {
            Self::EveryPass(method) => method,
            Self::Law => CableMethod::QuasiStatic,
        }
    }

    fn has_inertia(self) -> bool {
        self.solver() != CableMethod::QuasiStatic
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
    let auto = scene.solver.method == SolverMethod::Auto;
    let (method, reason) = if auto {
        automatic(scene, &estimates)
    } else {
        (named(scene, &estimates)?, "the scene asks for it".to_owned())
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

fn named(scene: &Scene, estimates: &Estimates) -> Result<PassMethod, Error> {
    let key = "solver.method";
    match scene.solver.method {
        SolverMethod::PassLaw => match &estimates.refusal {
            Some(refusal) => Err(unfit(key, "pass-law", refusal)),
            None => Ok(PassMethod::Law),
        },
        SolverMethod::Dynamic => Ok(PassMethod::EveryPass(CableMethod::Dynamic)),
        SolverMethod::Explicit => Ok(PassMethod::EveryPass(CableMethod::Explicit)),
        SolverMethod::Auto | SolverMethod::QuasiStatic if scene.friction.law.has_memory() => {
            Ok(PassMethod::EveryPass(CableMethod::QuasiStatic))
        }
        SolverMethod::Auto | SolverMethod::QuasiStatic => Err(unfit(key, "quasi-static", NO_REST)),
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
            let reason = format!("simulating all {passes} passes would take minutes");
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
    /// Time of the quasi-static passes on the levels [`COARSE`] and [`FINE`] and on the one to begin with \[s\].
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
        let lattice = levels.lattice(levels.first(), passes);
        Ok(Self {
            inertia,
            refusal: concerns
                .iter()
                .find(|concern| concern.is_fatal())
                .map(Concern::to_string),
            coarse: seconds(COARSE),
            fine: seconds(FINE),
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
            PassMethod::Law => Some(LAW_ERROR),
            PassMethod::EveryPass(CableMethod::QuasiStatic) => {
                scene.friction.law.has_memory().then_some(self.inertia)
            }
            PassMethod::EveryPass(_) => Some(0.0),
        }
    }

    /// Why `method` was not taken.
    pub fn against(&self, scene: &Scene, method: PassMethod) -> String {
        let tolerance = scene.solver.tolerance;
        match (method, &self.refusal) {
            (PassMethod::Law, Some(refusal)) => refusal.clone(),
            (PassMethod::Law, None) if LAW_ERROR > tolerance => "less accurate than the tolerance".into(),
            (PassMethod::Law, None) if !scene.restraints.is_empty() => {
                "it has no layers around clamps".into()
            }
            (PassMethod::Law, None) => "simulating every pass costs little more and is more accurate".into(),
            (PassMethod::EveryPass(CableMethod::QuasiStatic), _) => {
                if !scene.friction.law.has_memory() {
                    NO_REST.into()
                } else if self.inertia_matters(tolerance) {
                    self.inertia_in_words()
                } else {
                    "simulating every pass would take too long".into()
                }
            }
            (PassMethod::EveryPass(CableMethod::Dynamic), _) => "more than the tolerance needs".into(),
            (PassMethod::EveryPass(CableMethod::Explicit), _) => {
                "as accurate as dynamic, with far shorter steps".into()
            }
        }
    }
}
