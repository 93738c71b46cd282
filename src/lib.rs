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
//! assert!((force / 210.5 - 1.0).abs() < 0.01, "{force} N");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The same without scene files, from the crates alone: a ground ([`boussinesq`]), the motion of the duct in it
//! ([`ground_field`]), and the cable ([`cable_dem`]):
//!
//! ```
//! use boussinesq::HalfSpace;
//! use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, QuasiStatic};
//! use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
//!     let truck = Vehicle::point("20 tf", 196_133.0, 11.1)?;
//!     let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 50.0, 1e-6)?;
//!     let limit = 0.25 * 108.8; // friction coefficient × weight, N/m
//!     let law = FrictionLaw::ElasticPlastic { shape_factor: 2e8 / limit };
//!     let cable = DuctedCable::new(30.0, 8.01e6, Friction::new(law, limit)?)?;
//!     let cable = cable.with_ends(End::Free, End::Fixed)?;
//!     let mut solver = QuasiStatic::new(cable, Mesh::for_depth(30.0, 1.2, 12.0)?)?;
//!     let passage = solver.passage(&motion, 15.0)?;
//!     let mut state = solver.at_rest();
//!     let force = solver.pass(&passage, &mut state)?.force.downstream;
//!     println!("{force:.1} N on the joint after the first truck");
//! #   // An independent computation of the first pass: 102.08 N.
//! #   assert!((force / 102.08 - 1.0).abs() < 0.01, "{force} N");
//!     Ok(())
//! }
//! ```
//!
//! The parts are crates of their own, handed on here so that their versions fit: [`ground_field`] (the contract), [`boussinesq`] (closed
//! forms), [`burmister`] (layers by Hankel transform), `layered_fem` (layers by finite elements), [`cable_dem`] (the cable), [`cycle_jump`]
//! (many passes), `fitting` (the crate `calibrate`: parameters from measurements), `figure` (the crate `plain-figure`: charts as SVG). What
//! needs many runs is in `calibration` (the crate `creepage-fit`), `design` and `sweep` (`creepage-study`), `report` (`creepage-report`).
//!
//! # Features
//!
//! `cli`, the command, is on by default with its page, `explore`, and takes all others with it. Without default features a scene is read, planned
//! and run, with few other crates; `calibrate` adds fits, `study` sweeps, designs and measures, `report` (with both) the page
//! and workbooks, `fem` finite elements, `schema` the JSON Schema of a scene.

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "cli")]
mod template;

#[cfg(feature = "calibrate")]
pub use ::calibrate as fitting;
pub use creepage_scene as scene;
pub use creepage_scene::presets;
#[cfg(feature = "study")]
pub use creepage_study::{design, measures, output, sweep};
#[cfg(feature = "fem")]
pub use layered_fem;
#[cfg(feature = "study")]
pub use plain_figure as figure;
pub use {boussinesq, burmister, cable_dem, cycle_jump, ground_field};
#[cfg(feature = "calibrate")]
pub use {creepage_fit as calibration, creepage_fit::readings};
#[cfg(feature = "report")]
pub use {creepage_report as report, creepage_report::workbook};

#[cfg(feature = "calibrate")]
pub use calibration::{CalibrateOptions, Calibrated, Series, calibrate, calibrate_jointly};
pub use creepage_run::{
    Candidate, ClampLimits, Cost, DayExtremes, DayPoint, DuctMotionSummary, EndLimits, Error, ErrorEstimate,
    ErrorShares, ErrorSource, ExtremePass, FixedMesh, ForceProfile, ForceRange, FrictionProfile, HeatRecord,
    Limited, Limits, Part, PassRecord, PastPass, Place, Plan, PlanReport, PlanSummary, Profile, Progress,
    Quantiles, RandomSpread, Reached, RestraintRange, RestraintRecord, Run, RunOptions, Saturation,
    SavedState, SlipLengths, Stage, Units, Verdict, occurrence, plan, profile, profile_at, run, run_plan,
    run_with, with_causes,
};
#[cfg(feature = "calibrate")]
pub use readings::{DataError, ReadOptions, Reading, Readings};
pub use scene::{CableEnd, Scene, SceneError, SceneFile};
#[cfg(feature = "cli")]
pub use template::template;
#[cfg(feature = "cli")]
use {
    creepage_plan::{error, shown},
    creepage_report::words,
};

/// The examples of the README and of the page on the library are tests too.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
#[doc = include_str!("../docs/library.md")]
struct PageExamples;
