//! How the passes of a scene are computed.
//!
//! The quasi-static cable moves only near the vehicle; the explicit solver moves all of it, with
//! inertia, which changes the force by at most (v/c)². Long traffic is simulated in part: its
//! passes change the cable ever more slowly, and jumps between simulated ones follow that (crate
//! `cycle-jump`). Explicit steps are taken where the scene names them, and for the sigmoid law,
//! which has no state of rest.

use super::cost::{Estimates, LONGEST_SECONDS};
use super::mesh::Levels;
use super::pass_method::{CableMethod, PassMethod};
use super::period::Period;
use crate::Error;
use crate::scene::{Scene, SolverMethod};
use crate::shown;
use crate::tuning::methods::DRAWN_ERROR;

/// Longest run with the sigmoid law that is begun without the scene naming a method \[s\].
const LONGEST_WITHOUT_REST: f64 = 600.0;

/// Most vehicles in a period that jumps go over: what every pass of it leaves is kept.
const LONGEST_PERIOD: usize = 5000;
/// Most passes that are simulated one by one.
pub const MOST_PASSES: u64 = 1_000_000;

/// How the passes are computed, and why.
#[derive(Debug)]
pub struct MethodChoice {
    pub method: PassMethod,
    pub reason: String,
    /// By what share of the force leaving inertia out is off at most, where it is left out.
    pub inertia: f64,
    /// Whether every pass may be simulated where jumps do not get on.
    pub may_simulate: bool,
    /// What every method would cost.
    pub estimates: Estimates,
}

pub const NO_REST: &str = "the sigmoid law has no state of rest: its friction depends on the time step";

/// The method the scene names, or the cheapest that keeps its tolerance.
pub fn choose(scene: &Scene, levels: &Levels, period: &Period) -> Result<MethodChoice, Error> {
    let estimates = Estimates::new(scene, levels, period)?;
    let has_rest = scene.friction.law().has_memory();
    let (mut method, mut reason) = match scene.solver.method {
        SolverMethod::Auto => automatic(scene, period, &estimates),
        named => {
            let method = match named {
                SolverMethod::Explicit if has_rest && estimates.jumps_pay_for(CableMethod::Explicit) => {
                    PassMethod::Jumps(CableMethod::Explicit)
                }
                SolverMethod::Explicit => PassMethod::EveryPass(CableMethod::Explicit),
                SolverMethod::PassLaw => PassMethod::Jumps(CableMethod::QuasiStatic),
                _ => PassMethod::EveryPass(CableMethod::QuasiStatic),
            };
            if !has_rest && !method.has_inertia() {
                return Err(unfit("solver.method", method.name(), NO_REST));
            }
            (method, "the scene asks for it".to_owned())
        }
    };
    if matches!(method, PassMethod::Jumps(_)) && period.len() > LONGEST_PERIOD {
        method = PassMethod::EveryPass(method.cable_method());
        reason = format!("{reason}; no jumps over sequences of more than {LONGEST_PERIOD} vehicles");
    }
    if scene.friction_limit() > 0.0 {
        check_length(scene, period, method, estimates.seconds(method))?;
    }
    Ok(MethodChoice {
        inertia: if method.has_inertia() {
            0.0
        } else {
            estimates.inertia
        },
        may_simulate: scene.traffic.passes <= MOST_PASSES
            && estimates.every_pass(method.cable_method()) <= LONGEST_SECONDS,
        method,
        reason,
        estimates,
    })
}

/// Refuses more passes than `method` computes, and a run of many hours that nobody has asked for.
fn check_length(scene: &Scene, period: &Period, method: PassMethod, seconds: f64) -> Result<(), Error> {
    let has_rest = scene.friction.law().has_memory();
    if matches!(method, PassMethod::EveryPass(_)) && scene.traffic.passes > MOST_PASSES {
        let why = if !has_rest {
            format!("jumps over passes need a state of rest: {NO_REST}")
        } else if period.len() > LONGEST_PERIOD {
            format!("there are no jumps over sequences of more than {LONGEST_PERIOD} vehicles")
        } else {
            "solver.method = \"pass-law\" computes any number".to_owned()
        };
        let reason = format!("at most 1 000 000 are simulated one by one; {why}");
        return Err(unfit("traffic.passes", "more than a million passes", reason));
    }
    if scene.solver.method == SolverMethod::Auto && !has_rest && seconds > LONGEST_WITHOUT_REST {
        let reason = format!(
            "without a state of rest the whole cable moves in every step and no pass can be left out, which would take {} or more; \
             solver.method = \"explicit\" computes it all the same, and the law \"elastic-plastic\" has a state of rest",
            shown::time(seconds)
        );
        return Err(unfit("friction.law", "\"sigmoid\"", reason));
    }
    Ok(())
}

fn unfit(key: &'static str, found: &'static str, reason: impl Into<String>) -> Error {
    Error::Unfit {
        key,
        found,
        reason: reason.into().into(),
    }
}

fn automatic(scene: &Scene, period: &Period, estimates: &Estimates) -> (PassMethod, String) {
    if !scene.friction.law().has_memory() {
        return (PassMethod::EveryPass(CableMethod::Explicit), NO_REST.into());
    }
    let method = CableMethod::QuasiStatic;
    let reason = format!(
        "inertia changes the force by at most {:.2} %, (v/c)²",
        100.0 * estimates.inertia
    );
    if !estimates.jumps_pay() {
        return (PassMethod::EveryPass(method), reason);
    }
    let good_enough = !period.drawn.is_empty() && scene.solver.tolerance >= DRAWN_ERROR;
    let affordable = estimates.every_pass(method) <= LONGEST_SECONDS;
    if period.stands_in() && !good_enough && affordable {
        let reason =
            format!("{reason}; with jumps, another order of vehicles would stand in for the traffic");
        return (PassMethod::EveryPass(method), reason);
    }
    (PassMethod::Jumps(method), reason)
}
