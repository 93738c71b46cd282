//! What a report contains: everything that is computed for it.

use super::agreement::Agreement;
use super::source::Source;
use crate::words::{Answer, Reader, round_below};
use creepage_fit::{held_end, readings::Readings};
use creepage_run::{
    Error, Limits, PastPass, PlanReport, Profile, Progress, Run, RunOptions, SavedState, Units, Verdict,
    profile::profile_over,
};
use creepage_scene::{Scene, Unit};
use creepage_study::measures::Comparison;

/// Positions at which the motion of the duct is drawn, and how far on either side of the vehicle \[depths\].
const POSITIONS: i32 = 301;
const REACH_DEPTHS: f64 = 10.0;
/// Passes after which the cable is shown, at most.
const STAGES: u32 = 4;

/// What a report contains besides the scene's answer.
#[derive(Default)]
pub struct ReportOptions<'a> {
    /// Readings of the load cell, drawn over the computed force.
    pub readings: Option<&'a Readings>,
    /// Measures in every combination of what is not known.
    pub compared: Option<&'a Comparison>,
    /// Limits that are judged at the top of the page.
    pub limits: Limits,
    /// Units in which the page is.
    pub units: Units,
    /// The cable as another run has left it, with which the page's run begins.
    pub start: Option<&'a SavedState>,
    /// The files that were read, the scene's first; without any the page states the scene alone, as [`Scene::to_toml`] writes it.
    pub sources: &'a [Source],
    /// What was set on top of the scene's file.
    pub overrides: &'a [String],
    /// When the page is made, in words.
    pub date: Option<&'a str>,
    /// Warnings in addition to those of the run.
    pub warnings: &'a [String],
    /// Called after each pass of the scene's run; it may stop the report.
    pub progress: Progress<'a>,
}

/// The content of the page; [`to_html`](Report::to_html) writes it.
#[derive(Debug)]
pub struct Report {
    pub(super) reader: Reader,
    pub(super) scene: Scene,
    pub(super) run: Run,
    pub(super) plan: PlanReport,
    pub(super) motion: Profile,
    pub(super) agreement: Option<Agreement>,
    pub(super) compared: Option<Comparison>,
    /// What the runs before have left.
    pub(super) history: Vec<PastPass>,
    pub(super) verdicts: Vec<Verdict>,
    pub(super) sources: Vec<Source>,
    /// Whether the first source is the scene's file.
    pub(super) is_from_file: bool,
    pub(super) overrides: Vec<String>,
    pub(super) date: Option<String>,
    pub(super) warnings: Vec<String>,
}

impl Report {
    /// Computes everything.
    ///
    /// # Errors
    ///
    /// [`Error`] when the run fails, and when readings are given and no end of the cable is held.
    pub fn new(scene: &Scene, options: &ReportOptions<'_>) -> Result<Self, Error> {
        scene.validate()?;
        if options.readings.is_some() {
            held_end(scene)?;
        }
        let mut plan = creepage_run::plan(scene)?;
        plan.start = options.start;
        let options_of_run = RunOptions {
            start: options.start,
            progress: options.progress,
            stages: &stages(scene.traffic.passes),
            ..RunOptions::default()
        };
        let run = creepage_run::run_plan(&plan, &options_of_run)?;
        let compare = |readings: &Readings| Agreement::new(scene, &run, readings);
        let agreement = options.readings.map(compare).transpose()?;
        let mistakes = agreement.iter().flat_map(|agreement| &agreement.mistakes);
        let warnings = options.warnings.iter().chain(&run.warnings).chain(mistakes);
        Ok(Self {
            reader: Reader::new(options.units, scene),
            plan: plan.report(),
            motion: profile_over(scene, &plan.ground, &positions(scene, options.units.length))?,
            compared: options.compared.cloned(),
            history: options.start.map_or(Vec::new(), |start| start.history().to_vec()),
            verdicts: options.limits.verdicts(&run),
            sources: match options.sources {
                [] => vec![Source::new("the scene in SI units", scene.to_toml().as_bytes())],
                sources => sources.to_vec(),
            },
            is_from_file: !options.sources.is_empty(),
            overrides: options.overrides.to_vec(),
            date: options.date.map(str::to_owned),
            warnings: warnings.cloned().collect(),
            agreement,
            run,
            scene: scene.clone(),
        })
    }

    /// Run and scene in words.
    pub(super) fn answer(&self) -> Answer<'_> {
        Answer {
            scene: &self.scene,
            run: &self.run,
            reader: self.reader,
        }
    }

    /// What looks mistaken in the readings.
    pub fn mistakes(&self) -> &[String] {
        let agreement = self.agreement.as_ref();
        agreement.map_or(&[], |agreement| &agreement.mistakes)
    }

    /// What the scene's answer makes of the limits.
    pub fn verdicts(&self) -> &[Verdict] {
        &self.verdicts
    }

    /// The scene's answer.
    pub fn run(&self) -> &Run {
        &self.run
    }
}

/// How far on either side of the vehicle the figures go, a round length in `unit`.
pub(super) fn reach(scene: &Scene, unit: Unit) -> f64 {
    let wheels = scene.vehicles[0].wheels();
    let longest = wheels.iter().map(|wheel| wheel.x.abs()).fold(0.0, f64::max);
    let reach = unit.of_si(REACH_DEPTHS * scene.duct.depth + longest);
    let step = 0.5 * 10_f64.powf(reach.log10().floor());
    step * (reach / step).ceil()
}

/// Positions ξ \[m\] of the figures of the duct's motion.
fn positions(scene: &Scene, unit: Unit) -> Vec<f64> {
    let (half, middle) = (reach(scene, unit) / unit.of_si(1.0), POSITIONS / 2);
    let position = |k: i32| half * f64::from(k) / f64::from(middle);
    (-middle..=middle).map(position).collect()
}

/// The first pass, the last, and round numbers between them.
fn stages(count: u64) -> Vec<u64> {
    let share = |k: u32| f64::from(k) / f64::from(STAGES - 1);
    let between = |k: u32| round_below((count as f64).powf(share(k))).round() as u64;
    let before = (0..STAGES - 1).map(between).filter(|&pass| pass < count);
    let mut stages: Vec<u64> = before.chain([count]).collect();
    stages.dedup();
    stages
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
