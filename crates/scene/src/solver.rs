//! `[solver]`: how to compute.

use crate::key::Form::Number;
use crate::range::{APPROACH, STEP, TIME_STEP, TOLERANCE};
use crate::section::{file_words, keys};

keys! {
    /// How to compute, in SI. What is `None` is chosen to suit the scene.
    #[derive(Copy)]
    pub struct Solver {
        /// How the passes are computed.
        method: SolverMethod = SolverMethod::FORM, "\"auto\"";
        /// Error allowed, as a share of the forces and of the movement of the ends.
        tolerance: f64 = Number(TOLERANCE), "0.01" => 0.01;
        /// Distance between points of the cable that are computed.
        node_spacing: Option<f64> = Number(STEP), "chosen";
        /// Advance of the vehicle from one computed place to the next.
        vehicle_step: Option<f64> = Number(STEP), "chosen";
        /// Time step of the method `explicit`.
        time_step: Option<f64> = Number(TIME_STEP), "chosen";
        /// How far beyond the duct's ends vehicles are followed.
        approach: Option<f64> = Number(APPROACH), "as far as it matters";
    }
}

impl Default for Solver {
    /// All is chosen to suit the scene, for forces within 1 %.
    fn default() -> Self {
        Self {
            method: SolverMethod::Auto,
            tolerance: 0.01,
            node_spacing: None,
            vehicle_step: None,
            time_step: None,
            approach: None,
        }
    }
}

/// How the passes are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum SolverMethod {
    /// The cheapest that is accurate enough.
    #[default]
    Auto,
    /// Implicit, without inertia.
    QuasiStatic,
    /// Explicit time steps, with inertia.
    Explicit,
    /// Without inertia too, but few passes are simulated, with jumps between them.
    PassLaw,
}

file_words! {
    SolverMethod: Auto "auto", QuasiStatic "quasi-static", Explicit "explicit", PassLaw "pass-law";
    "; inertia is computed by \"explicit\": dynamic is no longer there, since below 200 km/h it changes next to nothing"
}
