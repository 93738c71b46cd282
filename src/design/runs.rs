//! Runs of one scene with springs of different stiffness, all on one mesh, none of them twice.

use std::cmp::Ordering;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::limits::held;
use super::options::DesignOptions;
use super::trade_off::{Spring, TradeOff};
use crate::FixedMesh;
use crate::ground::Ground;
use crate::run::{run_over, run_shown};
use crate::{Error, Limits, Place, Progress, RunOptions, Scene, finite};

/// Stiffnesses go from this part of the cable's own stiffness EA/L to its inverse.
const DECADES: i32 = 2;
/// Stiffnesses that differ by less than this share are the same: a logarithm there and back.
const SAME: f64 = 1e-9;

/// What was run, and what is needed to run more.
pub struct Runs<'a> {
    mesh: OneMesh,
    places: Vec<Place>,
    limits: &'a Limits,
    progress: Progress<'a>,
    expected: usize,
    points: Mutex<Vec<TradeOff>>,
    count: AtomicUsize,
}

impl<'a> Runs<'a> {
    /// Of `scene` over its `ground`; `expected` runs are all of the progress.
    pub fn new(
        scene: &Scene,
        ground: &Arc<Ground>,
        options: &'a DesignOptions<'a>,
        progress: Progress<'a>,
        expected: usize,
    ) -> Result<Self, Error> {
        let places = options.places();
        Ok(Self {
            mesh: OneMesh::new(scene, ground, &places, progress)?,
            places,
            limits: &options.limits,
            progress,
            expected,
            points: Mutex::default(),
            // That of the mesh.
            count: AtomicUsize::new(1),
        })
    }

    /// Runs the scene with a spring of these stiffnesses \[N/m\] at each place, or finds the run in what was done.
    pub fn run(&self, stiffnesses: &[f64]) -> Result<TradeOff, Error> {
        let springs = self.places.iter().zip(stiffnesses);
        let springs: Vec<Spring> = springs
            .map(|(place, stiffness)| Spring::new(*place, *stiffness))
            .collect();
        if let Some(done) = self.done(stiffnesses) {
            return Ok(done);
        }
        let point = self.mesh.run(&springs, self.limits, false)?;
        self.points().push(point.clone());
        let count = self.count.fetch_add(1, Relaxed);
        let share = count as f64 / self.expected as f64;
        self.progress.report(share.min(1.0))?;
        Ok(point)
    }

    /// The same `point` with its own error, from a run on coarser meshes and with jumps of its own, unless its forces so differ just enough
    /// to be on the other side of a limit.
    pub fn judged(&self, point: &TradeOff) -> Result<TradeOff, Error> {
        self.count.fetch_add(1, Relaxed);
        let own = self.mesh.run(&point.springs, self.limits, true)?;
        if own.within_limits == point.within_limits {
            return Ok(own);
        }
        let error_estimate = own.error_estimate;
        Ok(TradeOff {
            error_estimate,
            ..point.clone()
        })
    }

    /// The run with these stiffnesses, if it was done.
    pub fn done(&self, stiffnesses: &[f64]) -> Option<TradeOff> {
        let same = |(spring, stiffness): (&Spring, &f64)| {
            let done = spring.stiffness();
            done == *stiffness || (done - stiffness).abs() <= SAME * done.min(*stiffness)
        };
        let points = self.points();
        let mut points = points.iter();
        points
            .find(|point| point.springs.iter().zip(stiffnesses).all(same))
            .cloned()
    }

    pub fn points(&self) -> MutexGuard<'_, Vec<TradeOff>> {
        self.points.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// How many were made, that of the mesh among them.
    pub fn count(&self) -> usize {
        self.count.load(Relaxed)
    }

    /// Everything that was run, by growing stiffness.
    pub fn into_curve(self) -> Vec<TradeOff> {
        let mut points = self.points.into_inner().unwrap_or_default();
        sort(&mut points);
        points
    }
}

/// Sorts runs by growing stiffness.
fn sort(points: &mut [TradeOff]) {
    let stiffnesses =
        |point: &TradeOff| -> Vec<f64> { point.springs.iter().map(Spring::stiffness).collect() };
    points.sort_by(|a, b| {
        let pairs = stiffnesses(a).into_iter().zip(stiffnesses(b));
        pairs.fold(Ordering::Equal, |order, (a, b)| order.then(a.total_cmp(&b)))
    });
}

/// Stiffnesses to try at `place` \[N/m\], ascending, so many a decade: from a free end to a fixed one, from no clamp to a stiff one.
/// Without a clamp it cannot be seen how far the cable moves where it would be, which `limits` may need.
pub fn stiffnesses(scene: &Scene, place: Place, limits: &Limits, per_decade: i32) -> Vec<f64> {
    let own = scene.cable.axial_stiffness / scene.duct.length;
    let steps = DECADES * per_decade;
    let grid = (-steps..=steps).map(|i| own * 10_f64.powf(f64::from(i) / f64::from(per_decade)));
    let (first, last) = match place {
        Place::Clamp(position) => {
            let clamps = limits.clamps.iter();
            let moves = clamps
                .filter(|clamp| clamp.limits.movement_m.is_some())
                .any(|clamp| Place::Clamp(clamp.position_m).is_clamp_at(position));
            ((!moves).then_some(0.0), None)
        }
        _ => (Some(0.0), Some(f64::INFINITY)),
    };
    first.into_iter().chain(grid).chain(last).collect()
}

/// A scene on the mesh that its stiffest variant needs, and its ground: runs that are to be compared are made on the same ones, and where
/// the end is nearly free there is no force whose relative error a finer mesh could make small.
pub struct OneMesh {
    scene: Scene,
    ground: Arc<Ground>,
    /// What the run of the stiffest variant has shown of it.
    shown: Option<FixedMesh>,
}

impl OneMesh {
    /// Finds the mesh by a run of `scene`, over its `ground`, with the ends among `places` fixed.
    pub fn new(
        scene: &Scene,
        ground: &Arc<Ground>,
        places: &[Place],
        progress: Progress<'_>,
    ) -> Result<Self, Error> {
        // This run may be stopped, but its share of the work is not counted.
        let options = RunOptions {
            progress: progress.part(0.0, 0.0),
            ..RunOptions::default()
        };
        let ends = places.iter().filter(|place| !matches!(place, Place::Clamp(_)));
        let fixed: Vec<Spring> = ends.map(|place| Spring::new(*place, f64::INFINITY)).collect();
        let stiffest = held(scene, &fixed);
        stiffest.validate()?;
        let (run, shown) = run_shown(&stiffest, Arc::clone(ground), &options)?;
        let plan = run.plan;
        let mut scene = scene.clone();
        scene.solver.node_spacing.get_or_insert(plan.node_spacing_m);
        scene.solver.vehicle_step.get_or_insert(plan.vehicle_step_m);
        Ok(Self {
            scene,
            ground: Arc::clone(ground),
            shown,
        })
    }

    /// Runs the scene with `springs`, on coarser meshes too where its own error `is_judged`.
    pub fn run(&self, springs: &[Spring], limits: &Limits, is_judged: bool) -> Result<TradeOff, Error> {
        let scene = held(&self.scene, springs);
        scene.validate()?;
        let options = RunOptions {
            mesh: self.shown.filter(|_| !is_judged),
            ..RunOptions::default()
        };
        let run = run_over(&scene, Arc::clone(&self.ground), &options)?;
        let point = TradeOff::of(&self.scene, &run, springs, limits);
        finite::check(&point)?;
        Ok(point)
    }
}
