//! How the passes of a scene are computed.
//!
//! The quasi-static cable moves only near the vehicle; the explicit solver moves all of it, with inertia, which changes the force
//! by at most (v/c)². Long traffic is simulated in part: its passes change the cable ever more slowly, and jumps between
//! simulated ones follow that (crate `cycle-jump`). Explicit steps are taken where the scene names them, and for the sigmoid law,
//! which has no state of rest.

use cable_dem::{Explicit, ExplicitOptions, Order, inertia_ratio};

use super::mesh::Levels;
use super::period::Period;
use crate::Error;
use crate::cable;
use crate::scene::{Scene, SolverMethod};
use crate::shown;

/// Measured time a node's update takes \[s\] on one core of about 3 GHz: without inertia, and explicit.
const QUASI_STATIC_SECONDS: f64 = 1.1e-8;
const EXPLICIT_SECONDS: f64 = 1e-9;
/// Time steps of the explicit solver per step of a vehicle, as a rule.
const EXPLICIT_STEPS: f64 = 40.0;
/// Periods that are simulated at the start, and then for every factor e of periods: half of all scenes need fewer, and nearly all.
const TYPICAL_PERIODS: (f64, f64) = (12.0, 2.2);
const MOST_PERIODS: (f64, f64) = (20.0, 8.0);
/// As a rule where a period has more than so many vehicles: most of what jumps would have to follow happens within the first one.
const MANY: usize = 48;
const TYPICAL_LONG_PERIODS: (f64, f64) = (4.5, 0.3);
/// Most vehicles in a period that jumps go over: what every pass of it leaves is kept.
const LONGEST_PERIOD: usize = 5000;
/// Periods of a day that are simulated where the cable is heated every day, and days with them until one is like the one before.
const PERIODS_A_DAY: f64 = 24.0;
const DAYS: f64 = 9.0;
/// A run takes about so many times the passes on its first mesh: those on coarser ones, and jumps that are looked for before.
const EVERY_PASS_MESHES: f64 = 1.4;
const JUMP_MESHES: f64 = 2.0;
/// Jumps are taken where they spare this share of the passes.
const SPARED: f64 = 0.3;
/// Where every pass is simulated although jumps are possible, it takes no longer than this \[s\].
const LONGEST_SECONDS: f64 = 60.0;
/// Longest run with the sigmoid law that is begun without the scene naming a method \[s\].
const LONGEST_WITHOUT_REST: f64 = 600.0;
/// What an even order leaves wrong as a rule where vehicles come in random order: 3 to 4 % of early forces.
const DRAWN_ERROR: f64 = 0.04;
/// Most passes that are simulated one by one.
pub const MOST_PASSES: u64 = 1_000_000;

/// How all passes are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PassMethod {
    /// Every pass is simulated.
    EveryPass(CableMethod),
    /// Few are, with jumps between them.
    Jumps(CableMethod),
}

/// Solver of the cable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CableMethod {
    QuasiStatic,
    Explicit,
}

impl PassMethod {
    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::EveryPass(method) => method.name(),
            Self::Jumps(_) => "pass-law",
        }
    }

    /// The solver of the passes that are simulated.
    pub fn cable_method(self) -> CableMethod {
        match self {
            Self::EveryPass(method) | Self::Jumps(method) => method,
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
    /// Whether every pass may be simulated where jumps do not get on.
    pub may_simulate: bool,
    /// What every method would cost.
    pub estimates: Estimates,
}

/// The method the scene names, or the cheapest that keeps its tolerance.
pub fn choose(scene: &Scene, levels: &Levels, period: &Period) -> Result<MethodChoice, Error> {
    let estimates = Estimates::new(scene, levels, period)?;
    let has_rest = scene.friction.law().has_memory();
    let count = scene.traffic.passes;
    let asked = |method| (method, "the scene asks for it".to_owned());
    let (method, reason) = match scene.solver.method {
        SolverMethod::Auto => automatic(scene, &estimates),
        SolverMethod::PassLaw if !has_rest => return Err(no_rest("pass-law")),
        SolverMethod::QuasiStatic if !has_rest => return Err(no_rest("quasi-static")),
        SolverMethod::PassLaw => asked(PassMethod::Jumps(CableMethod::QuasiStatic)),
        SolverMethod::Explicit => asked(estimates.affordable(CableMethod::Explicit, has_rest)),
        SolverMethod::QuasiStatic => asked(PassMethod::EveryPass(CableMethod::QuasiStatic)),
    };
    let (method, reason) = match method {
        PassMethod::Jumps(_) if period.len() > LONGEST_PERIOD && count > MOST_PASSES => {
            let reason = format!(
                "of a sequence of more than {LONGEST_PERIOD} vehicles every pass is simulated, at most 1 000 000"
            );
            return Err(unfit("traffic.passes", "more than a million passes", reason));
        }
        PassMethod::Jumps(cable) if period.len() > LONGEST_PERIOD => {
            let reason = format!("{reason}; no jumps over sequences of more than {LONGEST_PERIOD} vehicles");
            (PassMethod::EveryPass(cable), reason)
        }
        _ => (method, reason),
    };
    if matches!(method, PassMethod::EveryPass(_)) && count > MOST_PASSES && scene.friction_limit() > 0.0 {
        let reason = if has_rest {
            format!(
                "at most 1 000 000 are simulated by solver.method = \"{}\"; \"pass-law\" computes any number",
                method.name()
            )
        } else {
            format!("at most 1 000 000 are simulated, and jumps over passes need a state of rest: {NO_REST}")
        };
        return Err(unfit("traffic.passes", "more than a million passes", reason));
    }
    let seconds = estimates.seconds(method);
    let slips = scene.friction_limit() > 0.0;
    if scene.solver.method == SolverMethod::Auto && slips && !has_rest && seconds > LONGEST_WITHOUT_REST {
        let reason = format!(
            "without a state of rest the whole cable moves in every step and no pass can be left out, which would take {} or more; \
             solver.method = \"explicit\" computes it all the same, and the law \"elastic-plastic\" has a state of rest",
            shown::time(seconds)
        );
        return Err(unfit("friction.law", "\"sigmoid\"", reason));
    }
    Ok(MethodChoice {
        inertia: if method.has_inertia() {
            0.0
        } else {
            estimates.inertia
        },
        may_simulate: count <= MOST_PASSES && estimates.every_pass(method.cable_method()) <= LONGEST_SECONDS,
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

fn no_rest(found: &'static str) -> Error {
    unfit("solver.method", found, NO_REST)
}

const NO_REST: &str = "the sigmoid law has no state of rest: its friction depends on the time step";

fn automatic(scene: &Scene, estimates: &Estimates) -> (PassMethod, String) {
    let tolerance = scene.solver.tolerance;
    if !scene.friction.law().has_memory() {
        return (PassMethod::EveryPass(CableMethod::Explicit), NO_REST.into());
    }
    let (method, reason) = (CableMethod::QuasiStatic, estimates.inertia_in_words());
    if !estimates.jumps_pay() {
        return (PassMethod::EveryPass(method), reason);
    }
    let good_enough = estimates.drawn && tolerance >= DRAWN_ERROR;
    let affordable = estimates.every_pass(method) <= LONGEST_SECONDS;
    if estimates.stands_in && !good_enough && affordable {
        let reason =
            format!("{reason}; with jumps, another order of vehicles would stand in for the traffic");
        return (PassMethod::EveryPass(method), reason);
    }
    (PassMethod::Jumps(method), reason)
}

/// What the choice rests on.
#[derive(Debug)]
pub struct Estimates {
    /// (v/c)² of the fastest vehicle.
    pub inertia: f64,
    /// Passes that jumps leave to be simulated: as a rule, and at most.
    typical: f64,
    simulated: f64,
    passes: f64,
    /// Whether the period only stands in for the traffic, and whether this comes in random order.
    stands_in: bool,
    drawn: bool,
    /// Time of one pass by each method, on the level to begin with \[s\].
    quasi_static: f64,
    explicit: f64,
}

/// Time steps per step of a vehicle where the explicit method is taken: they follow waves in the cable, stiff ends and slow vehicles.
fn explicit_steps(scene: &Scene, levels: &Levels) -> Option<f64> {
    if scene.solver.method != SolverMethod::Explicit && scene.friction.law().has_memory() {
        return None;
    }
    let first = levels.first();
    let (mesh, cable) = (levels.mesh(first).ok()?, cable::cable(scene).ok()?);
    let solver = Explicit::new(cable, mesh, cable::mass(scene), ExplicitOptions::default()).ok()?;
    let time_step = scene.solver.time_step.unwrap_or(solver.limits().advised());
    let (_, step) = levels.spacing(first);
    let shares = scene.shares().into_iter();
    let steps = shares.zip(&scene.vehicles).map(|(share, vehicle)| {
        let advance = vehicle.speed * time_step;
        share * (step / advance).max(1.0)
    });
    Some(steps.sum())
}

impl Estimates {
    fn new(scene: &Scene, levels: &Levels, period: &Period) -> Result<Self, Error> {
        let cable = cable::cable(scene)?;
        let mass = cable::mass(scene);
        let mut inertia = 0.0_f64;
        for traffic in &scene.vehicles {
            inertia = inertia.max(inertia_ratio(&cable, mass, traffic.speed)?);
        }
        let first = levels.first();
        let lattice = levels.whole_cable_updates(first, 1);
        let passes = scene.traffic.passes as f64;
        let length = period.len() as f64;
        let periods = (passes / length).max(1.0);
        let simulated = |(first, per_e): (f64, f64)| match (scene.warming(), scene.traffic.per_day) {
            (Some(_), Some(per_day)) => DAYS.min(passes / per_day) * per_day.min(length * PERIODS_A_DAY),
            _ => length * (first + per_e * periods.ln()),
        };
        Ok(Self {
            inertia,
            typical: simulated(if period.len() > MANY {
                TYPICAL_LONG_PERIODS
            } else {
                TYPICAL_PERIODS
            }),
            simulated: simulated(MOST_PERIODS),
            passes,
            stands_in: period.stands_in(),
            drawn: matches!(scene.order(), Order::Random { .. }),
            quasi_static: QUASI_STATIC_SECONDS * levels.node_updates(first, 1),
            explicit: EXPLICIT_SECONDS * explicit_steps(scene, levels).unwrap_or(EXPLICIT_STEPS) * lattice,
        })
    }

    fn inertia_in_words(&self) -> String {
        let percent = 100.0 * self.inertia;
        format!("inertia changes the force by at most {percent:.2} %, (v/c)²")
    }

    /// How many passes jumps leave to be simulated.
    pub fn simulated_in_words(&self) -> String {
        let simulated = self.typical.min(self.passes);
        format!(
            "about {simulated:.0} of {} passes are simulated, with jumps between them",
            self.passes
        )
    }

    fn jumps_pay(&self) -> bool {
        self.simulated < (1.0 - SPARED) * self.passes
    }

    /// Every pass by `method`, or jumps where that would take long.
    fn affordable(&self, method: CableMethod, has_rest: bool) -> PassMethod {
        if has_rest && self.jumps_pay() && self.every_pass(method) > LONGEST_SECONDS {
            PassMethod::Jumps(method)
        } else {
            PassMethod::EveryPass(method)
        }
    }

    fn one_pass(&self, method: CableMethod) -> f64 {
        match method {
            CableMethod::QuasiStatic => self.quasi_static,
            CableMethod::Explicit => self.explicit,
        }
    }

    fn every_pass(&self, method: CableMethod) -> f64 {
        self.passes * self.one_pass(method)
    }

    /// Rough time of a whole run by `method` \[s\], on all its meshes.
    pub fn seconds(&self, method: PassMethod) -> f64 {
        match method {
            PassMethod::EveryPass(method) => EVERY_PASS_MESHES * self.every_pass(method),
            PassMethod::Jumps(method) => JUMP_MESHES * self.typical.min(self.passes) * self.one_pass(method),
        }
    }

    /// Error of `method` beside those of its mesh and its jumps, as a share of the force; `None` where it does not apply.
    pub fn error(&self, scene: &Scene, method: PassMethod) -> Option<f64> {
        let without = scene.friction.law().has_memory().then_some(self.inertia);
        if method.has_inertia() { Some(0.0) } else { without }
    }

    /// Why `method` was not taken.
    pub fn against(&self, scene: &Scene, method: PassMethod) -> String {
        let named = scene.solver.method != SolverMethod::Auto;
        let has_rest = scene.friction.law().has_memory();
        match method {
            _ if !has_rest && !method.has_inertia() => NO_REST.into(),
            _ if named => "the scene names another method".into(),
            PassMethod::EveryPass(CableMethod::Explicit) => "only where the scene names it".into(),
            PassMethod::Jumps(_) => format!(
                "jumps might leave {:.0} of {} passes to be simulated",
                self.simulated.min(self.passes),
                self.passes
            ),
            PassMethod::EveryPass(CableMethod::QuasiStatic) => {
                format!("all {} passes would be simulated", self.passes)
            }
        }
    }
}
