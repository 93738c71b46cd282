//! Creepage of power cables in underground ducts under traffic (cable surf-riding, ケーブル波乗り現象).
//!
//! The ground bends under each vehicle, the duct moves some ten micrometres back and forth, friction drags the cable a little
//! further forward than back, and after thousands of passes hundreds of newtons press on a joint. A [`Scene`] says
//! what lies where and who drives above it; [`run`] computes the force after every pass:
//!
//! ```
//! use creepage::Scene;
//!
//! let text = std::fs::read_to_string("examples/scenes/full-scale-upper.toml")?;
//! let mut scene = Scene::from_toml("full-scale-upper.toml", &text)?;
//! scene.traffic.passes = 5;
//! let run = creepage::run(&scene)?;
//! let force = run.passes[4].downstream_force_n;
//! assert!((force / 223.3 - 1.0).abs() < 0.01, "{force} N");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The parts are crates of their own: `ground-field` (the contract), `boussinesq` (closed forms), `burmister` (layers by
//! Hankel transform), `layered-fem` (layers by finite elements), `cable-dem` (the cable), `pass-law` (many passes), `calibrate` (parameters from measurements).

mod analysis;
pub mod calibration;
#[cfg(feature = "cli")]
pub mod cli;
pub mod design;
mod error;
#[cfg(feature = "plot")]
pub mod figure;
mod planner;
pub mod presets;
pub mod scene;
#[cfg(feature = "sweep")]
pub mod sweep;
pub mod template;

pub use analysis::profile::{Profile, profile, profile_at};
pub use analysis::result::{
    Cost, DuctMotionSummary, ErrorEstimate, ErrorShares, PassRecord, PlanSummary, Run, Saturation,
};
pub use analysis::run::{RunOptions, check, run, run_with};
pub use calibration::{CalibrateOptions, Calibrated, Series, calibrate, calibrate_jointly};
pub use error::Error;
pub use planner::{Plan, PlanReport, Rung, plan, plan_on};
pub use scene::{Scene, SceneError, SceneFile};

/// The README's example is a test too.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
