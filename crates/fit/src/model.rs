//! Scenes as a model to be fitted: from friction and ground to the forces that load cells would read.
//!
//! The motion of the duct is computed once. A fit needs forces that are smooth in the parameters, so the mesh is fixed: where it
//! is chosen by a run's tolerance, it may change from one run to the next.

use std::sync::Arc;

use calibrate::{Model, ModelError, Part};
use cycle_jump::Guide;
use ground_field::DuctMotion;
use rayon::prelude::*;

use super::cell::Observed;
use super::error::unfit;
use super::options::Series;
use super::unknown::{Quantity, Unknown};
use super::watch::Watch;
use creepage_plan::ground::Ground;
use creepage_plan::{Levels, Period, plan};
use creepage_run::{
    Error, Progress,
    passes::{JumpSize, Jumping, Task},
};
use creepage_scene::{Scene, SolverMethod};

/// Tolerance for which a scene's plan takes the mesh of a fit.
const TOLERANCE: f64 = 0.01;
/// Most passes that are all simulated. Of more, the same few are in every run of a fit, with the same jumps between them: where
/// jumps were chosen anew, forces would not be smooth in the parameters.
const EVERY_PASS: u64 = 1000;
/// Error of such a jump, the periods before the first one, and its length beside them.
const JUMP: JumpSize = JumpSize {
    tolerance: 1e-3,
    first_periods: 8,
    first_jump: 0.25,
};
/// Most passes that are simulated to find the jumps.
const MOST_PASSES: u64 = 100_000;

/// One series, ready to be predicted.
pub struct SeriesModel {
    scene: Scene,
    ground: Arc<Ground>,
    method: SolverMethod,
    pub levels: Levels,
    /// The traffic's period and the jumps over it, where not every pass is simulated.
    jumps: Option<(Period, Vec<u64>)>,
    /// Passes of the readings since the cable was at rest and what was measured, in their order.
    pub observed: Vec<(u64, Observed)>,
    /// Passes at which the force along the cable is looked at, and all that are read.
    stages: Vec<u64>,
    wanted: Vec<u64>,
}

impl SeriesModel {
    pub fn new(series: &Series<'_>) -> Result<Self, Error> {
        if series.scene.warming().is_some() {
            return unfit(
                "heat",
                "a heated cable",
                "a fit follows passes, not days of heat: leave [heat] out, and readings at which the cable was warm",
            );
        }
        let mut scene = series.scene.clone();
        let list = series.readings.readings().iter();
        let observed =
            list.map(|reading| Ok((reading.passes, Observed::of(series.scene, reading.measured)?)));
        let observed = observed.collect::<Result<Vec<_>, Error>>()?;
        let passes = |is_wanted: &dyn Fn(&(u64, Observed)) -> bool| -> Vec<u64> {
            let mut passes: Vec<u64> = observed
                .iter()
                .filter(|one| is_wanted(one))
                .map(|(pass, _)| *pass)
                .collect();
            passes.sort_unstable();
            passes.dedup();
            passes
        };
        let (stages, wanted) = (passes(&|one| one.1.is_inside()), passes(&|one| one.0 > 0));
        scene.traffic.passes = series.readings.last_pass();
        scene.solver.tolerance = scene.solver.tolerance.min(TOLERANCE);
        let (method, levels, period, ground) = {
            let plan = plan(&scene)?;
            (plan.method, plan.levels, plan.period, plan.ground)
        };
        let mut model = Self {
            scene,
            ground,
            method,
            levels,
            jumps: None,
            observed,
            stages,
            wanted,
        };
        if model.method != SolverMethod::Explicit && model.scene.traffic.passes > EVERY_PASS {
            let task = model.task(&model.scene, &model.ground.motions, model.coarsest())?;
            let passes = task.with_jumps(&jumping(&period, Guide::Free), &[])?;
            model.jumps = Some((period, passes.schedule));
        }
        Ok(model)
    }

    /// How the passes are computed.
    pub fn method(&self) -> SolverMethod {
        match &self.jumps {
            Some(_) => SolverMethod::PassLaw,
            None if self.method == SolverMethod::PassLaw => SolverMethod::QuasiStatic,
            None => self.method,
        }
    }

    /// The level of meshes that only shows where to look: that of the answer where the scene names it.
    pub fn coarsest(&self) -> usize {
        if self.levels.named { self.levels.first } else { 0 }
    }

    /// Largest vertical displacement of the duct under the first vehicle \[m\].
    pub fn peak_vertical(&self) -> f64 {
        self.ground.motions[0].peak_vertical()
    }

    /// What the instruments should show after each reading's pass.
    fn predict(&self, scene: &Scene, stiffness: f64, level: usize) -> Result<Vec<f64>, Error> {
        let softer = |motion: &DuctMotion| motion.clone().scaled(1.0 / stiffness);
        let motions = self
            .ground
            .motions
            .iter()
            .map(softer)
            .collect::<Result<Vec<_>, _>>()?;
        let task = self.task(scene, &motions, level)?;
        let passes = match &self.jumps {
            Some((period, schedule)) => {
                task.with_jumps(&jumping(period, Guide::Obey(schedule)), &self.wanted)?
            }
            None => task.every_pass()?,
        };
        let deflection = self.peak_vertical() / stiffness;
        let value = |&(pass, observed): &(u64, Observed)| {
            if pass == 0 && observed != Observed::Deflection {
                // At rest.
                return 0.0;
            }
            let place = passes.records.partition_point(|record| record.pass < pass);
            let stage = passes.stages.iter().find(|stage| stage.pass == pass);
            observed.value(scene, &passes.records[place].outcome, stage, deflection)
        };
        Ok(self.observed.iter().map(value).collect())
    }

    fn task<'a>(
        &'a self,
        scene: &'a Scene,
        motions: &'a [DuctMotion],
        level: usize,
    ) -> Result<Task<'a>, Error> {
        Ok(Task {
            scene,
            method: self.method,
            motions,
            mesh: self.levels.mesh(level)?,
            start: None,
            stages: &self.stages,
            progress: Progress::default(),
        })
    }
}

fn jumping<'a>(period: &'a Period, guide: Guide<'a>) -> Jumping<'a> {
    Jumping {
        period,
        size: JUMP,
        most_passes: MOST_PASSES,
        guide,
        beyond: false,
    }
}

/// All series, each on one of its meshes.
pub struct CableModel<'a> {
    pub series: &'a [SeriesModel],
    pub unknowns: &'a [Unknown],
    pub mesh: MeshOf,
    /// Stiffness of the ground beside the scene's, where it is not fitted.
    pub stiffness: f64,
    pub watch: &'a Watch<'a>,
}

/// Which mesh of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshOf {
    /// The coarsest one.
    Guess,
    /// That which its plan takes.
    Answer,
    /// One twice as fine.
    Check,
}

impl MeshOf {
    /// Its level among the meshes of a series.
    pub fn level(self, series: &SeriesModel) -> usize {
        match self {
            Self::Guess => series.coarsest(),
            Self::Answer => series.levels.first,
            Self::Check => series.levels.first + 1,
        }
    }
}

impl Model for CableModel<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError> {
        let of_series = |(index, series): (usize, &SeriesModel)| {
            let mut scene = series.scene.clone();
            let mut stiffness = self.stiffness;
            for (unknown, &value) in self.unknowns.iter().zip(parameters) {
                if unknown.acts_on(index) {
                    unknown.quantity.set(&mut scene, value);
                    if unknown.quantity == Quantity::GroundStiffness {
                        stiffness = value;
                    }
                }
            }
            series.predict(&scene, stiffness, self.mesh.level(series))
        };
        let forces = self.series.par_iter().enumerate().map(of_series);
        let forces = forces.collect::<Result<Vec<Vec<f64>>, Error>>()?;
        self.watch.run()?;
        Ok(forces.concat())
    }

    fn parts(&self) -> Vec<Part> {
        let of_series = |(index, series): (usize, &SeriesModel)| Part {
            predictions: series.observed.len(),
            parameters: (0..self.unknowns.len())
                .filter(|&unknown| self.unknowns[unknown].acts_on(index))
                .collect(),
        };
        self.series.iter().enumerate().map(of_series).collect()
    }
}
