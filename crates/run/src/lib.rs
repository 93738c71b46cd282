#![doc = include_str!("../README.md")]

#[doc(hidden)]
pub mod answer;
mod days;
mod jumps;
#[doc(hidden)]
pub mod passes;
#[doc(hidden)]
pub mod profile;
mod progress;
mod refine;
#[doc(hidden)]
pub mod run;
mod tuning;

pub use answer::{
    ClampLimits, Cost, DayExtremes, DayPoint, DuctMotionSummary, EndLimits, ErrorEstimate, ErrorShares,
    ExtremePass, FixedMesh, ForceProfile, ForceRange, FrictionProfile, HeatRecord, Limited, Limits,
    PassRecord, Place, PlanSummary, Quantiles, RandomSpread, Reached, RestraintRange, RestraintRecord, Run,
    Saturation, Stage, Start, Units, Verdict,
};
pub use cable_dem::SlipLengths;
pub use creepage_plan::{
    Candidate, Error, ErrorSource, Part, PastPass, Plan, PlanReport, SavedState, occurrence, plan,
    with_causes,
};
pub use creepage_scene::{CableEnd, Scene, SceneError, SceneFile};
pub use passes::RunOptions;
pub use profile::{Profile, profile, profile_at};
pub use progress::Progress;
pub use run::{run, run_plan, run_with};
