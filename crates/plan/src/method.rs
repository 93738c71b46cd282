//! How the passes of a scene are computed: by the words of `solver.method`.
//!
//! The quasi-static cable moves only near the vehicle; the explicit solver moves all of it, with
//! inertia, which changes the force by at most (v/c)². Long traffic is simulated in part: its
//! passes change the cable ever more slowly, and jumps between simulated ones follow that (crate
//! `cycle-jump`). Explicit steps are taken where the scene names them, and for the sigmoid law,
//! which has no state of rest.

use crate::cost::Estimates;
use crate::error::Error;
use crate::period::Period;
use crate::shown;
use crate::tuning::methods::{DRAWN_ERROR, SPARED};
use creepage_scene::{Scene, SolverMethod};

/// Longest run with the sigmoid law that is begun without the scene naming a method \[s\].
const LONGEST_WITHOUT_REST: f64 = 600.0;
/// Where every pass is simulated although jumps are possible, it takes no longer than this \[s\].
pub const LONGEST_EVERY_PASS: f64 = 60.0;
/// Maximum number of vehicles in a period that jumps go over: what every pass of it leaves is kept.
const LONGEST_PERIOD: usize = 5000;
/// Maximum number of passes that are simulated one by one.
pub const MAX_PASSES: u64 = 1_000_000;

pub const NO_REST: &str = "the sigmoid law has no state of rest: its friction depends on the time step";

/// The method the scene names, or the cheapest that keeps its tolerance, never `auto`; and why.
pub fn choose(
    scene: &Scene,
    period: &Period,
    estimates: &Estimates,
) -> Result<(SolverMethod, String), Error> {
    let (mut method, mut reason) = match scene.solver.method {
        SolverMethod::Auto => automatic(scene, period, estimates),
        named => (named, "the scene asks for it".to_owned()),
    };
    if method != SolverMethod::Explicit && !scene.friction.law().has_memory() {
        return Err(Error::unfit("solver.method", method.to_string(), NO_REST));
    }
    if method == SolverMethod::PassLaw && period.len() > LONGEST_PERIOD {
        method = SolverMethod::QuasiStatic;
        reason = format!("{reason}; no jumps over sequences of more than {LONGEST_PERIOD} vehicles");
    }
    if scene.friction_limit() > 0.0 {
        check_length(scene, period, method, estimates.seconds(method))?;
    }
    Ok((method, reason))
}

fn automatic(scene: &Scene, period: &Period, estimates: &Estimates) -> (SolverMethod, String) {
    if !scene.friction.law().has_memory() {
        return (SolverMethod::Explicit, NO_REST.into());
    }
    let every_pass = SolverMethod::QuasiStatic;
    let reason = format!(
        "inertia changes the force by at most {:.2} %, (v/c)²",
        100.0 * estimates.inertia
    );
    // Jumps have to spare enough of the passes.
    if estimates.most >= (1.0 - SPARED) * estimates.passes {
        return (every_pass, reason);
    }
    let stands_in = period.is_drawn || !period.others.is_empty();
    let good_enough = period.is_drawn && scene.solver.tolerance >= DRAWN_ERROR;
    let affordable = estimates.every_pass(every_pass) <= LONGEST_EVERY_PASS;
    if stands_in && !good_enough && affordable {
        let why = "with jumps, another order of vehicles would stand in for the traffic";
        return (every_pass, format!("{reason}; {why}"));
    }
    (SolverMethod::PassLaw, reason)
}

/// Refuses more passes than `method` computes, and a run of many hours that nobody has asked for.
fn check_length(scene: &Scene, period: &Period, method: SolverMethod, seconds: f64) -> Result<(), Error> {
    let has_rest = scene.friction.law().has_memory();
    if method != SolverMethod::PassLaw && scene.traffic.passes > MAX_PASSES {
        let why = if !has_rest {
            format!("jumps over passes need a state of rest: {NO_REST}")
        } else if period.len() > LONGEST_PERIOD {
            format!("there are no jumps over sequences of more than {LONGEST_PERIOD} vehicles")
        } else {
            "solver.method = \"pass-law\" computes any number".to_owned()
        };
        let (key, found) = ("traffic.passes", "more than a million passes");
        let reason = format!("at most 1 000 000 are simulated one by one; {why}");
        return Err(Error::unfit(key, found, reason));
    }
    if scene.solver.method == SolverMethod::Auto && !has_rest && seconds > LONGEST_WITHOUT_REST {
        let reason = format!(
            "without a state of rest the whole cable moves in every step and no pass can be left out, which would take {} or more; \
             solver.method = \"explicit\" computes it all the same, and the law \"elastic-plastic\" has a state of rest",
            shown::time(seconds)
        );
        return Err(Error::unfit("friction.law", "\"sigmoid\"", reason));
    }
    Ok(())
}
