//! What another thread sees of a run that goes on: how far it is, and the passes that are finished, which are all that is left of it if
//! it is stopped.

use std::sync::{Mutex, MutexGuard, PoisonError};

use cable_dem::{Mesh, Statistics};
use cycle_jump::Record;
use serde::{Deserialize, Serialize};

use crate::answer::{DuctMotionSummary, ErrorEstimate, PassRecord, PlanSummary, Saturation, simulated};
use crate::scene::Traffic;

/// What is finished of a run that was stopped: passes on one mesh, whose error nobody knows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct CutShort {
    /// The scene's title.
    pub title: String,
    /// True: what tells the document from that of a whole run.
    pub cut_short: bool,
    /// How it was computed, and on which mesh.
    pub plan: PlanSummary,
    /// Motion of the duct under the first vehicle.
    pub duct_motion: DuctMotionSummary,
    /// Force and movement after the finished passes, ascending.
    pub passes: Vec<PassRecord>,
    /// `None`: where the force levels off is not known.
    pub saturation: Option<Saturation>,
    /// `None`: an error follows only from all passes on several meshes.
    pub error_estimate: Option<ErrorEstimate>,
    /// What the plan warns of.
    pub warnings: Vec<String>,
}

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HowFar {
    /// The farthest pass on the mesh under way.
    pub pass: u64,
    /// The number of passes.
    pub passes: u64,
    /// Distance between the nodes of that mesh \[m\].
    pub node_spacing_m: f64,
    /// Whether a coarser mesh than that was not good enough.
    pub is_refined: bool,
    /// Nodes eliminated so far, on all meshes together: as [`Cost::node_updates`](crate::Cost::node_updates) of the run.
    pub node_updates: f64,
}

/// A run under way, seen from another thread; [`RunOptions::underway`](crate::RunOptions::underway) fills it.
///
/// ```
/// use creepage::{RunOptions, Scene, Underway};
///
/// let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
/// scene.traffic.passes = 3;
/// let underway = Underway::default();
/// assert!(underway.finished().is_none());
/// let run = creepage::run_with(&scene, &RunOptions { underway: Some(&underway), ..RunOptions::default() })?;
/// let finished = underway.finished().expect("all passes");
/// assert_eq!(finished.passes, run.passes);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Underway(Mutex<Seen>);

#[derive(Debug, Default)]
struct Seen {
    /// The answer without its passes, and their traffic.
    answer: Option<(CutShort, Traffic)>,
    /// The passes that an answer lists.
    listed: Vec<u64>,
    /// In the order in which they were begun.
    meshes: Vec<Passes>,
    node_updates: f64,
}

/// Passes on one mesh.
#[derive(Debug)]
struct Passes {
    mesh: Mesh,
    /// Whether its passes may be the answer: some are only for comparison.
    shown: bool,
    reached: u64,
    /// Whether the records are all that the mesh will give.
    is_finished: bool,
    /// The listed ones, and the last.
    records: Vec<Record>,
}

impl Underway {
    fn seen(&self) -> MutexGuard<'_, Seen> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The passes that are finished: all on the finest mesh that has them, or else those on the mesh under way. `None` before the first one,
    /// and where passes are not shown one by one, with heat or in random order, before the first mesh is finished.
    pub fn finished(&self) -> Option<CutShort> {
        let seen = self.seen();
        let (answer, traffic) = seen.answer.as_ref()?;
        let rank = |passes: &&Passes| (passes.shown, passes.is_finished);
        let finest = |passes: &&Passes| -passes.mesh.spacing();
        let with_passes = seen.meshes.iter().filter(|passes| !passes.records.is_empty());
        let passes =
            with_passes.max_by(|a, b| rank(a).cmp(&rank(b)).then(finest(a).total_cmp(&finest(b))))?;
        let mut answer = answer.clone();
        answer.plan.node_spacing_m = passes.mesh.spacing();
        answer.plan.vehicle_step_m = passes.mesh.vehicle_step();
        let records = passes.records.iter();
        answer.passes = records.map(|record| PassRecord::new(record, traffic)).collect();
        Some(answer)
    }

    /// How far the run is; `None` before its first mesh.
    pub fn reached(&self) -> Option<HowFar> {
        let seen = self.seen();
        let (_, traffic) = seen.answer.as_ref()?;
        // Meshes are computed side by side, so the last one begun need not be the finest; of several runs on that it is the last.
        let shown = || seen.meshes.iter().rev().filter(|passes| passes.shown);
        let finest = shown().min_by(|a, b| a.mesh.spacing().total_cmp(&b.mesh.spacing()));
        let last = finest.or(seen.meshes.last())?;
        let is_coarser = |passes: &Passes| passes.mesh.spacing() > last.mesh.spacing();
        Some(HowFar {
            pass: last.reached,
            passes: traffic.passes,
            node_spacing_m: last.mesh.spacing(),
            is_refined: shown().any(|passes| passes.is_finished && is_coarser(passes)),
            node_updates: seen.node_updates,
        })
    }

    /// Nodes eliminated so far.
    pub(super) fn node_updates(&self) -> f64 {
        self.seen().node_updates
    }

    /// A run begins.
    pub(super) fn begin(&self, answer: CutShort, traffic: &Traffic) {
        *self.seen() = Seen {
            listed: simulated(traffic, 1),
            answer: Some((answer, traffic.clone())),
            ..Seen::default()
        };
    }

    /// Its passes begin on a mesh.
    pub(super) fn on_mesh(&self, mesh: Mesh, shown: bool) -> OnMesh<'_> {
        let mut seen = self.seen();
        seen.meshes.push(Passes {
            mesh,
            shown,
            reached: 0,
            is_finished: false,
            records: Vec::new(),
        });
        OnMesh {
            underway: self,
            place: seen.meshes.len() - 1,
        }
    }
}

/// Where the passes on one mesh are kept.
#[derive(Debug, Clone, Copy)]
pub struct OnMesh<'a> {
    underway: &'a Underway,
    place: usize,
}

impl OnMesh<'_> {
    /// A pass is finished, and how far all are; passes may only measure.
    pub fn reach(self, pass: u64, statistics: &Statistics) {
        let mut seen = self.underway.seen();
        seen.node_updates += statistics.node_updates as f64;
        seen.meshes[self.place].reached = pass;
    }

    /// Keeps a pass of the traffic.
    pub fn keep(self, record: &Record) {
        let mut seen = self.underway.seen();
        let is_listed = |pass: u64| seen.listed.binary_search(&pass).is_ok();
        let count = seen.answer.as_ref().map_or(0, |(_, traffic)| traffic.passes);
        let last = seen.meshes[self.place].records.last().map(|record| record.pass);
        // Where jumps lead lies beyond the traffic; and a pass may be looked at again.
        if record.pass > count || last.is_some_and(|last| last >= record.pass) {
            return;
        }
        let replaces = last.is_some_and(|last| !is_listed(last));
        let records = &mut seen.meshes[self.place].records;
        if replaces {
            records.pop();
        }
        records.push(record.clone());
    }

    /// All passes on this mesh are done: those that an answer lists, of all `records`.
    pub fn finish(self, records: &[Record]) {
        let mut seen = self.underway.seen();
        let listed = |record: &&Record| seen.listed.binary_search(&record.pass).is_ok();
        let records = records.iter().filter(listed).cloned().collect();
        seen.meshes[self.place].records = records;
        seen.meshes[self.place].is_finished = true;
    }
}
