#![doc = include_str!("../README.md")]

#[doc(hidden)]
pub mod answer;
#[doc(hidden)]
pub mod cable;
mod days;
#[doc(hidden)]
pub mod error;
mod error_source;
#[doc(hidden)]
pub mod finite;
#[doc(hidden)]
pub mod ground;
#[doc(hidden)]
pub mod hash;
mod jumps;
#[doc(hidden)]
pub mod passes;
#[doc(hidden)]
pub mod plan;
#[doc(hidden)]
pub mod profile;
mod progress;
mod refine;
#[doc(hidden)]
pub mod run;
mod saved_state;
#[doc(hidden)]
pub mod shown;
mod tuning;
pub use creepage_scene as scene;

pub use answer::{
    ClampLimits, Cost, DayExtremes, DayPoint, DuctMotionSummary, EndLimits, ErrorEstimate, ErrorShares,
    ExtremePass, ForceProfile, ForceRange, FrictionProfile, HeatRecord, Limited, Limits, PassRecord, Place,
    PlanSummary, Quantiles, RandomSpread, Reached, RestraintRange, RestraintRecord, Run, Saturation,
    SlipRecord, Stage, Start, Units, Verdict,
};
pub use error::{Error, with_causes};
pub use error_source::ErrorSource;
pub use passes::{FixedMesh, RunOptions};
pub use plan::{Candidate, Part, Plan, PlanReport, occurrence, plan, plan_on};
pub use profile::{Profile, profile, profile_at};
pub use progress::Progress;
pub use run::{check, run, run_plan, run_with};
pub use saved_state::{PastPass, SavedState};
pub use scene::{CableEnd, Scene, SceneError, SceneFile};
