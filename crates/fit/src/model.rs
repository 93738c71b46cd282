//! A scene as a model to be fitted: from friction and ground to what its instruments would read.
//!
//! The motion of the duct is computed once. A fit needs forces that are smooth in the parameters,
//! so the mesh is fixed: where it is chosen by a run's tolerance, it may change from one run to
//! the next.

use std::collections::BTreeSet;
use std::sync::Arc;

use cycle_jump::Guide;
use ground_field::DuctMotion;

use crate::instrument::{located, shown};
use crate::readings::{Measured, Place, Reading, Readings};
use creepage_plan::ground::Ground;
use creepage_plan::{Levels, Period, plan};
use creepage_run::{
    Error, Progress,
    answer::JumpSize,
    passes::{Jumping, Task},
};
use creepage_scene::{Scene, SolverMethod};

/// Tolerance for which a scene's plan takes the mesh of a fit.
const TOLERANCE: f64 = 0.01;
/// Maximum number of passes that are all simulated. Of more, the same few are in every run of a fit, with the
/// same jumps between them: where jumps were chosen anew, forces would not be smooth in the
/// parameters.
const EVERY_PASS: u64 = 1000;
/// Error of such a jump, the periods before the first one, and its length relative to them.
const JUMP: JumpSize = JumpSize {
    tolerance: 1e-3,
    first_periods: 8,
    first_jump: 0.25,
};
/// Maximum number of passes that are simulated to find the jumps.
const MAX_PASSES: u64 = 100_000;

/// Which mesh of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshOf {
    /// The coarsest one, which only shows where to look: that of the answer where the scene names
    /// it.
    Guess,
    /// That which its plan takes.
    Answer,
    /// One twice as fine.
    Check,
}

/// One series, ready to be predicted.
pub struct SeriesModel<'a> {
    pub scene: Scene,
    pub readings: &'a Readings,
    pub ground: Arc<Ground>,
    method: SolverMethod,
    pub levels: Levels,
    /// The traffic's period and the jumps over it, where not every pass is simulated.
    jumps: Option<(Period, Vec<u64>)>,
    /// The readings, in their order.
    pub rows: Vec<Reading>,
    /// Passes at which the force along the cable is looked at, and all that are read.
    stages: Vec<u64>,
    wanted: Vec<u64>,
}

impl<'a> SeriesModel<'a> {
    /// Of the series with this index.
    pub fn new(index: usize, scene: &Scene, readings: &'a Readings) -> Result<Self, Error> {
        if scene.warming().is_some() {
            let reason = "a fit follows passes, not days of heat: leave [heat] out, and readings at which the cable was warm";
            return Err(Error::unfit("heat", "a heated cable", reason));
        }
        let row = |reading: &Reading| {
            Ok(Reading {
                measured: located(scene, reading.measured)?,
                series: index,
                ..*reading
            })
        };
        let rows = readings.list.iter().map(row);
        let rows = rows.collect::<Result<Vec<_>, Error>>()?;
        let mut scene = scene.clone();
        scene.traffic.passes = readings.last_pass();
        scene.solver.tolerance = scene.solver.tolerance.min(TOLERANCE);
        let (method, levels, period, ground) = {
            let plan = plan(&scene)?;
            (plan.method, plan.levels, plan.period, plan.ground)
        };
        let mut model = Self {
            scene,
            readings,
            ground,
            method,
            levels,
            jumps: None,
            stages: passes(rows.iter().filter(|row| is_inside(row))),
            wanted: passes(rows.iter().filter(|row| row.passes > 0)),
            rows,
        };
        if method != SolverMethod::Explicit && model.scene.traffic.passes > EVERY_PASS {
            let task = model.task(&model.scene, &model.ground.motions, MeshOf::Guess)?;
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

    /// The level of a mesh among those of the scene.
    pub fn level(&self, mesh: MeshOf) -> usize {
        match mesh {
            MeshOf::Guess if !self.levels.named => 0,
            MeshOf::Guess | MeshOf::Answer => self.levels.first,
            MeshOf::Check => self.levels.first + 1,
        }
    }

    /// What the instruments should show after each reading's pass in `scene`, this one with other
    /// parameters, on ground so many times as stiff.
    pub fn predict(&self, scene: &Scene, stiffness: f64, mesh: MeshOf) -> Result<Vec<f64>, Error> {
        let motions = self.ground.motions.iter();
        let softer = |motion: &DuctMotion| motion.clone().scaled(1.0 / stiffness);
        let motions = motions.map(softer).collect::<Result<Vec<_>, _>>()?;
        let task = self.task(scene, &motions, mesh)?;
        let passes = match &self.jumps {
            Some((period, schedule)) => {
                task.with_jumps(&jumping(period, Guide::Obey(schedule)), &self.wanted)?
            }
            None => task.every_pass()?,
        };
        let deflection = self.ground.motions[0].peak_vertical() / stiffness;
        let value = |reading: &Reading| {
            if reading.is_at_rest() {
                return 0.0;
            }
            let records = &passes.records;
            let place = records.partition_point(|record| record.pass < reading.passes);
            let stage = passes.stages.iter().find(|stage| stage.pass == reading.passes);
            shown(
                reading.measured,
                scene,
                &records[place].outcome,
                stage,
                deflection,
            )
        };
        Ok(self.rows.iter().map(value).collect())
    }

    fn task<'t>(
        &'t self,
        scene: &'t Scene,
        motions: &'t [DuctMotion],
        mesh: MeshOf,
    ) -> Result<Task<'t>, Error> {
        Ok(Task {
            scene,
            method: self.method,
            motions,
            mesh: self.levels.mesh(self.level(mesh))?,
            start: None,
            stages: &self.stages,
            progress: Progress::default(),
        })
    }
}

/// Whether it takes the force along the cable.
fn is_inside(row: &Reading) -> bool {
    use Measured::{Force, Strain};
    matches!(row.measured, Force(Place::At(_)) | Strain(_))
}

/// The passes of these readings, each once, in order.
fn passes<'r>(rows: impl Iterator<Item = &'r Reading>) -> Vec<u64> {
    let passes: BTreeSet<u64> = rows.map(|row| row.passes).collect();
    passes.into_iter().collect()
}

fn jumping<'a>(period: &'a Period, guide: Guide<'a>) -> Jumping<'a> {
    Jumping {
        period,
        size: JUMP,
        max_passes: MAX_PASSES,
        guide,
        beyond: false,
    }
}
