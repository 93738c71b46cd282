//! A report: one page of HTML about a scene, which needs no network and nothing beside it.
//!
//! What an engineer takes to a meeting: the scene in words, the numbers that count, figures of force, movement and of the motion behind
//! them, ways to hold the cable beside each other, and how all of that was computed and how wrong it may be. The page is read on
//! a phone, on paper, and on light and dark screens.
//!
//! The numbers are those of one [`Run`] of the scene; the ways to hold the cable are runs of their own, at a tolerance of at least 5 %, all
//! on one mesh ([`crate::design::compare`]). A way that fails is told on the page with its reason.
//!
//! ```
//! use creepage::{Scene, report::{Report, ReportOptions}};
//!
//! let text = std::fs::read_to_string("examples/scenes/full-scale-upper.toml")?;
//! let mut scene = Scene::from_toml("full-scale-upper.toml", &text)?;
//! scene.traffic.passes = 5;
//! let report = Report::new(&scene, &ReportOptions::default())?;
//! let page = report.to_html();
//! assert!(page.contains("Full-scale experiment, upper phase"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod agreement;
mod figures;
mod html;
mod measures;
mod page;
mod quantity;
mod sections;
mod words;

use crate::calibration::Readings;
use crate::design::Measure;
use crate::scene::SolverMethod;
use crate::{
    Error, FrictionProfile, PlanReport, Profile, Progress, Run, RunOptions, Scene, finite, profile_at,
};
use agreement::Agreement;
use measures::Comparison;

/// Positions at which the motion of the duct is drawn, and how far on either side of the vehicle \[depths\].
const POSITIONS: i32 = 301;
const REACH_DEPTHS: f64 = 10.0;
/// Lengths that are called round, in powers of ten.
const ROUND_LENGTHS: [f64; 7] = [1.0, 1.5, 2.0, 2.5, 3.0, 5.0, 7.5];
/// Passes at which the cable is looked at, at most.
const STAGES: i32 = 4;

/// Share of the work that the scene's own run is taken to be; the rest are ways to hold the cable.
const RUN_SHARE: f64 = 0.3;

/// What a report is to hold beside the scene's answer.
#[derive(Default)]
pub struct ReportOptions<'a> {
    /// Readings of the load cell, to be drawn over the computed force.
    pub readings: Option<&'a Readings>,
    /// Ways to hold the cable; fixed end, springs and clamps that suit the scene where there are none.
    pub measures: Option<&'a [Measure]>,
    /// Warnings to be told beside those of the run.
    pub warnings: &'a [String],
    /// Called after each pass of the scene's run, then after each way to hold the cable; it may stop the report.
    pub progress: Progress<'a>,
}

/// Everything that the page tells.
#[derive(Debug)]
pub struct Report {
    scene: Scene,
    run: Run,
    plan: PlanReport,
    motion: Profile,
    friction: Friction,
    agreement: Option<Agreement>,
    measures: Comparison,
    warnings: Vec<String>,
}

/// Friction with the vehicle over the middle.
#[derive(Debug)]
struct Friction {
    /// The passes shown.
    passes: Vec<(u64, FrictionProfile)>,
    /// Why there are not more.
    remark: Option<String>,
}

impl Report {
    /// Computes everything.
    ///
    /// # Errors
    ///
    /// [`Error`] when the scene's own run fails or makes a number that is none, or readings are given and no end of the cable is held. Ways to hold the cable that
    /// fail are told on the page.
    pub fn new(scene: &Scene, options: &ReportOptions<'_>) -> Result<Self, Error> {
        scene.validate()?;
        let agreed = |run: &Run| {
            options
                .readings
                .map(|readings| Agreement::new(scene, run, readings))
                .transpose()
        };
        if options.readings.is_some() {
            crate::calibration::CellEnd::of(scene)?;
        }
        let stages = stages(scene.traffic.passes);
        let plan = crate::plan(scene)?;
        let options_of_run = RunOptions {
            progress: options.progress.part(0.0, RUN_SHARE),
            stages: &stages,
            ..RunOptions::default()
        };
        let run = crate::run_plan(&plan, &options_of_run)?;
        let warnings = options.warnings.iter().chain(&run.warnings).cloned().collect();
        let report = Self {
            plan: plan.report(),
            motion: profile_at(scene, &positions(scene))?,
            friction: friction(scene, &run),
            agreement: agreed(&run)?,
            measures: Comparison::new(scene, &run, options)?,
            warnings,
            run,
            scene: scene.clone(),
        };
        report.check()?;
        Ok(report)
    }

    /// Makes sure that every number on the page is one.
    fn check(&self) -> Result<(), Error> {
        finite::check(&self.run)?;
        finite::check(&self.plan)?;
        finite::check(&self.motion)?;
        finite::check(&self.friction.passes)?;
        let answers = self
            .measures
            .ways
            .iter()
            .filter_map(|way| way.answer.as_ref().ok());
        answers.into_iter().try_for_each(finite::check)?;
        let agreement = self.agreement.as_ref();
        agreement.map_or(Ok(()), |a| finite::check(&[a.rms_n, a.mean_n, a.largest_n]))
    }

    /// The scene's answer.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The page.
    pub fn to_html(&self) -> String {
        page::page(self)
    }
}

/// How far on either side of the vehicle the figures go \[m\]: a round length, so that their axes have ticks on both sides.
fn reach(scene: &Scene) -> f64 {
    let wheels = scene.vehicles[0].vehicle.wheels();
    let longest = wheels.iter().map(|wheel| wheel.x.abs()).fold(0.0, f64::max);
    let reach = REACH_DEPTHS * scene.duct.depth + longest;
    let power = 10_f64.powf(reach.log10().floor());
    let above = ROUND_LENGTHS.into_iter().find(|length| length * power >= reach);
    above.unwrap_or(10.0) * power
}

/// Positions ξ \[m\] of the figures of the duct's motion.
fn positions(scene: &Scene) -> Vec<f64> {
    let half = reach(scene);
    let middle = POSITIONS / 2;
    (-middle..=middle)
        .map(|k| half * f64::from(k) / f64::from(middle))
        .collect()
}

/// The first pass, the last, and round numbers between them.
fn stages(count: u64) -> Vec<u64> {
    let mut stages: Vec<u64> = (0..STAGES - 1)
        .map(|k| round((count as f64).powf(f64::from(k) / f64::from(STAGES - 1))))
        .filter(|&pass| pass < count)
        .collect();
    stages.push(count);
    stages.dedup();
    stages
}

/// The largest of 1, 2, 5, 10, 20, … that is not above `number`, which is at least 1.
fn round(number: f64) -> u64 {
    // The cube root of a thousand comes out a little below ten.
    let number = number * (1.0 + 1e-9);
    let power = 10_f64.powf(number.log10().floor());
    let leading = number / power;
    let step = [5.0, 2.0]
        .into_iter()
        .find(|step| leading >= *step)
        .unwrap_or(1.0);
    (step * power).round() as u64
}

/// Friction in the first and the last pass where the run saw it, else in the first alone, by a run of its own.
fn friction(scene: &Scene, run: &Run) -> Friction {
    if scene.friction_limit() == 0.0 {
        return Friction {
            passes: Vec::new(),
            remark: Some("There is no friction here, so nothing drags the cable along.".into()),
        };
    }
    let seen = run.stages.iter();
    let mut passes: Vec<_> = seen
        .filter_map(|stage| Some((stage.pass, stage.friction.clone()?)))
        .collect();
    if passes.len() > 2 {
        passes.drain(1..passes.len() - 1);
    }
    if !passes.is_empty() {
        return Friction { passes, remark: None };
    }
    let mut scene = scene.clone();
    scene.traffic.passes = 1;
    scene.solver.method = SolverMethod::QuasiStatic;
    let options = RunOptions {
        stages: &[1],
        ..RunOptions::default()
    };
    let method = &run.plan.cable;
    match crate::run_with(&scene, &options) {
        Ok(first) => Friction {
            passes: first
                .stages
                .into_iter()
                .filter_map(|stage| Some((stage.pass, stage.friction?)))
                .collect(),
            remark: Some(format!(
                "The method {method} does not show friction while a vehicle passes; the first pass was computed by the method \
                 quasi-static."
            )),
        },
        Err(error) => Friction {
            passes: Vec::new(),
            remark: Some(format!(
                "The method {method} does not show friction while a vehicle passes, and the method quasi-static does not apply: \
                 {error}."
            )),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_round_and_end_with_the_last_pass() {
        assert_eq!(stages(1), [1]);
        assert_eq!(stages(2), [1, 2]);
        assert_eq!(stages(5), [1, 2, 5]);
        assert_eq!(stages(200), [1, 5, 20, 200]);
        assert_eq!(stages(1000), [1, 10, 100, 1000]);
        assert_eq!(stages(10_000_000), [1, 200, 20_000, 10_000_000]);
        assert_eq!(stages(30), [1, 2, 5, 30]);
    }
}
