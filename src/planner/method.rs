//! How the passes of a scene are computed.
//!
//! The ladder climbs from the pass law, which costs the same for ten passes as for ten million, through the quasi-static
//! cable, which moves only near the vehicle, to the solvers with inertia, which move all of it. Inertia changes the force
//! by at most (v/c)²; the law is as good as its guards and the comparison with simulated passes say.

use super::Rung;
use super::mesh::Levels;
use crate::Error;
use crate::analysis::cable::{self, CableMethod, PassMethod};
use crate::analysis::law;
use crate::scene::{Scene, SolverMethod};
use cable_dem::inertia_ratio;

/// Measured time a node's update takes \[s\] on one core of about 3 GHz: without inertia, with it, and explicit.
const QUASI_STATIC_SECONDS: f64 = 1.6e-8;
const DYNAMIC_SECONDS: f64 = 6e-8;
const EXPLICIT_SECONDS: f64 = 1e-9;
/// Measured time of the pass law, whatever the number of passes \[s\].
const LAW_SECONDS: f64 = 0.2;
/// The law takes over where it is as accurate as asked and passes one by one would take so many times its own time.
const WORTHWHILE: f64 = 20.0;
/// Passes one by one that take longer than this on the level for 1 % \[s\] are left to the law, whatever the tolerance.
const LONGEST_SECONDS: f64 = 60.0;
/// The level for 1 %, and the one for tolerances that the law can keep.
const FINE: usize = 2;
const COARSE: usize = 1;
/// Share of the tolerance that leaving inertia out may cost.
const INERTIA_SHARE: f64 = 0.5;
/// Speed of waves in the cable beside the vehicle's time step, for the explicit solver's share of the work.
const EXPLICIT_STEPS: f64 = 40.0;

/// How the passes are computed, and why.
pub struct MethodChoice {
    pub method: PassMethod,
    pub reason: String,
    /// By what share of the force the method is off, beside its mesh.
    pub error: f64,
    pub rungs: Vec<Rung>,
    /// By what share of the force leaving inertia out is off at most, where it is left out.
    pub inertia: f64,
    /// Whether the passes may be computed one by one where the law proves too rough.
    pub one_by_one: bool,
}

/// The method the scene names, or the cheapest that keeps its tolerance.
pub fn choose(scene: &Scene, levels: &Levels) -> Result<MethodChoice, Error> {
    let estimates = Estimates::new(scene, levels)?;
    let (method, reason) = match scene.solver.method {
        SolverMethod::Auto => automatic(scene, &estimates),
        asked => (
            named(scene, asked, &estimates)?,
            "the scene asks for it".to_owned(),
        ),
    };
    Ok(MethodChoice {
        error: match method {
            PassMethod::Law => law::ERROR,
            PassMethod::EveryPass(CableMethod::QuasiStatic) => estimates.inertia,
            PassMethod::EveryPass(_) => 0.0,
        },
        rungs: estimates.rungs(scene, method, &reason),
        inertia: match method {
            PassMethod::Law | PassMethod::EveryPass(CableMethod::QuasiStatic) => estimates.inertia,
            PassMethod::EveryPass(_) => 0.0,
        },
        one_by_one: scene.solver.method == SolverMethod::Auto && estimates.fine <= LONGEST_SECONDS,
        method,
        reason,
    })
}

fn named(scene: &Scene, asked: SolverMethod, estimates: &Estimates) -> Result<PassMethod, Error> {
    let unfit = |found, reason: String| Error::Unfit {
        key: "solver.method",
        found,
        reason: reason.into(),
    };
    match asked {
        SolverMethod::PassLaw => match &estimates.refusal {
            Some(concern) => Err(unfit("pass-law", concern.clone())),
            None => Ok(PassMethod::Law),
        },
        SolverMethod::Dynamic => Ok(PassMethod::EveryPass(CableMethod::Dynamic)),
        SolverMethod::Explicit => Ok(PassMethod::EveryPass(CableMethod::Explicit)),
        SolverMethod::Auto | SolverMethod::QuasiStatic => {
            if scene.friction.law.has_memory() {
                Ok(PassMethod::EveryPass(CableMethod::QuasiStatic))
            } else {
                Err(unfit("quasi-static", NO_REST.into()))
            }
        }
    }
}

const NO_REST: &str = "the sigmoid law has no state of rest: its friction depends on the time step";

/// What the choice rests on.
struct Estimates {
    /// (v/c)² of the fastest vehicle.
    inertia: f64,
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
        let mut inertia = 0.0_f64;
        for traffic in &scene.vehicles {
            inertia = inertia.max(inertia_ratio(
                &cable,
                cable::mass(scene),
                traffic.vehicle.speed(),
            )?);
        }
        let passes = scene.traffic.passes;
        let seconds = |level| QUASI_STATIC_SECONDS * levels.node_updates(level, passes);
        let lattice = levels.lattice(levels.first(), passes);
        Ok(Self {
            inertia,
            refusal: law::refusal(scene)?.map(|concern| concern.to_string()),
            coarse: seconds(COARSE),
            fine: seconds(FINE),
            first: seconds(levels.first()),
            dynamic: DYNAMIC_SECONDS * lattice,
            explicit: EXPLICIT_SECONDS * EXPLICIT_STEPS * lattice,
        })
    }

    fn rungs(&self, scene: &Scene, method: PassMethod, reason: &str) -> Vec<Rung> {
        let tolerance = scene.solver.tolerance;
        let no_rest = !scene.friction.law.has_memory();
        let law = match &self.refusal {
            Some(concern) => concern.clone(),
            None if law::ERROR > tolerance => format!("less accurate than {} %", 100.0 * tolerance),
            None if !scene.restraints.is_empty() => "it has no layers around clamps".into(),
            None => "the passes one by one cost little more and are more accurate".into(),
        };
        let quasi_static = if no_rest {
            NO_REST.to_owned()
        } else if self.inertia > INERTIA_SHARE * tolerance {
            inertia_matters(self.inertia)
        } else {
            "the passes one by one would take too long".into()
        };
        let more = "more than the tolerance needs";
        let all = [
            (PassMethod::Law, Some(law::ERROR), Some(LAW_SECONDS), law.as_str()),
            (
                PassMethod::EveryPass(CableMethod::QuasiStatic),
                (!no_rest).then_some(self.inertia),
                Some(self.first),
                quasi_static.as_str(),
            ),
            (
                PassMethod::EveryPass(CableMethod::Dynamic),
                Some(0.0),
                Some(self.dynamic),
                more,
            ),
            (
                PassMethod::EveryPass(CableMethod::Explicit),
                Some(0.0),
                Some(self.explicit),
                "as accurate as dynamic, with far shorter steps",
            ),
        ];
        all.into_iter()
            .map(|(candidate, error, seconds, rejected)| {
                let chosen = candidate == method;
                let mut rung = Rung::rejected(
                    "cable",
                    candidate.name(),
                    error,
                    seconds,
                    if chosen { reason } else { rejected },
                );
                rung.chosen = chosen;
                rung
            })
            .collect()
    }
}

fn automatic(scene: &Scene, estimates: &Estimates) -> (PassMethod, String) {
    let tolerance = scene.solver.tolerance;
    if !scene.friction.law.has_memory() {
        return (PassMethod::EveryPass(CableMethod::Dynamic), NO_REST.into());
    }
    if estimates.inertia > INERTIA_SHARE * tolerance {
        let reason = inertia_matters(estimates.inertia);
        return (PassMethod::EveryPass(CableMethod::Dynamic), reason);
    }
    if estimates.refusal.is_none() && scene.restraints.is_empty() {
        if estimates.fine > LONGEST_SECONDS {
            let reason = format!("{} passes one by one would take minutes", scene.traffic.passes);
            return (PassMethod::Law, reason);
        }
        if law::ERROR <= tolerance && estimates.coarse > WORTHWHILE * LAW_SECONDS {
            let reason = format!(
                "within the tolerance, and {} passes one by one would take {:.0} times as long",
                scene.traffic.passes,
                estimates.coarse / LAW_SECONDS
            );
            return (PassMethod::Law, reason);
        }
    }
    let reason = format!(
        "inertia changes the force by at most {:.2e} of it, (v/c)²",
        estimates.inertia
    );
    (PassMethod::EveryPass(CableMethod::QuasiStatic), reason)
}

fn inertia_matters(ratio: f64) -> String {
    format!("inertia changes the force by up to {ratio:.2e} of it, (v/c)²: too much for the tolerance")
}
