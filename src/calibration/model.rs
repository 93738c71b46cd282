//! Scenes as a model to be fitted: from friction and ground to the forces that load cells would read.
//!
//! The motion of the duct is computed once. A fit needs forces that are smooth in the parameters, so the mesh is fixed: where it
//! is chosen by a run's tolerance, it may change from one run to the next.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use cable_dem::Mesh;
use calibrate::{Model, ModelError, Part};
use cycle_jump::Guide;
use ground_field::DuctMotion;
use rayon::prelude::*;

use super::cell::Observed;
use super::error::unfit;
use super::options::Series;
use super::unknown::{Quantity, Unknown};
use super::watch::Watch;
use crate::ground::Ground;
use crate::plan::{Period, plan};
use crate::scene::SolverMethod;
use crate::{Error, Progress, Scene};
use creepage_run::passes::{JumpSize, Jumping, Task};

/// Nodes per depth of the duct on the coarsest mesh, which only shows where to look; every further level has twice as many.
const COARSEST: f64 = 3.0;
/// Steps of the vehicle per node spacing.
const STEPS_PER_SPACING: f64 = 2.0;
/// Most passes that are all simulated. Of more, the same few are in every run of a fit, with the same jumps between them: where
/// jumps were chosen anew, forces would not be smooth in the parameters.
const EVERY_PASS: u64 = 1000;
/// Error of such a jump, the periods before the first one, and its length beside them.
const JUMP: f64 = 1e-3;
const FIRST_PERIODS: u64 = 8;
const FIRST_JUMP: f64 = 0.25;
/// Most passes that are simulated to find the jumps.
const MOST_PASSES: u64 = 100_000;

/// One series, ready to be predicted.
pub struct SeriesModel {
    scene: Scene,
    ground: Arc<Ground>,
    method: SolverMethod,
    /// The traffic's period and the jumps over it, where not every pass is simulated.
    jumps: Option<(Period, Vec<u64>)>,
    /// Passes of the readings since the cable was at rest and what was measured, in their order.
    pub observed: Vec<(u64, Observed)>,
    /// Passes at which the force along the cable is looked at.
    stages: Vec<u64>,
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
        let observe =
            |reading: &crate::Reading| Ok((reading.passes, Observed::of(series.scene, reading.measured)?));
        let observed: Vec<(u64, Observed)> = series
            .readings
            .readings()
            .iter()
            .map(observe)
            .collect::<Result<_, Error>>()?;
        let inside = observed.iter().filter(|(_, observed)| observed.is_inside());
        let mut stages: Vec<u64> = inside.map(|(pass, _)| *pass).collect();
        stages.sort_unstable();
        stages.dedup();
        scene.traffic.passes = series.readings.last_pass();
        let (method, period, ground) = {
            let plan = plan(&scene)?;
            (plan.method, plan.period, plan.ground)
        };
        let mut model = Self {
            observed,
            stages,
            jumps: None,
            scene,
            ground,
            method,
        };
        if model.method != SolverMethod::Explicit && model.scene.traffic.passes > EVERY_PASS {
            let task = model.task(&model.scene, &model.ground.motions, 0)?;
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

    /// Largest vertical displacement of the duct under the first vehicle \[m\].
    pub fn peak_vertical(&self) -> f64 {
        self.ground.motions[0].peak_vertical()
    }

    /// Whether the scene says how fine to be.
    pub fn is_meshed(&self) -> bool {
        self.scene.solver.node_spacing.is_some() || self.scene.solver.vehicle_step.is_some()
    }

    /// The mesh of a level. One that the scene names is the first, and every further one halves it.
    pub fn mesh(&self, level: u32) -> Result<Mesh, Error> {
        let Scene { duct, solver, .. } = &self.scene;
        let finer = f64::from(1 << level);
        let natural = (duct.depth / COARSEST).min(duct.length / 8.0);
        let spacing = solver
            .node_spacing
            .unwrap_or_else(|| natural.max(solver.vehicle_step.unwrap_or(0.0)))
            / finer;
        let step = solver
            .vehicle_step
            .map_or(spacing / STEPS_PER_SPACING, |step| step / finer);
        Ok(Mesh::new(duct.length, spacing, step)?)
    }

    /// What the instruments should show after each reading's pass.
    fn predict(&self, scene: &Scene, stiffness: f64, level: u32) -> Result<Vec<f64>, Error> {
        let motions: Cow<'_, [DuctMotion]> = if stiffness == 1.0 {
            Cow::Borrowed(&self.ground.motions)
        } else {
            let softer = |motion: &DuctMotion| motion.clone().scaled(1.0 / stiffness);
            self.ground.motions.iter().map(softer).collect::<Result<_, _>>()?
        };
        let task = self.task(scene, &motions, level)?;
        let passes = match &self.jumps {
            Some((period, schedule)) => {
                let mut wanted: Vec<u64> = self
                    .observed
                    .iter()
                    .map(|(pass, _)| *pass)
                    .filter(|&pass| pass > 0)
                    .collect();
                wanted.sort_unstable();
                wanted.dedup();
                task.with_jumps(&jumping(period, Guide::Obey(schedule)), &wanted)?
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
        level: u32,
    ) -> Result<Task<'a>, Error> {
        Ok(Task {
            scene,
            method: self.method,
            motions,
            mesh: self.mesh(level)?,
            start: None,
            stages: &self.stages,
            progress: Progress::default(),
        })
    }
}

fn jumping<'a>(period: &'a Period, guide: Guide<'a>) -> Jumping<'a> {
    Jumping {
        period,
        size: JumpSize {
            tolerance: JUMP,
            first_periods: FIRST_PERIODS,
            first_jump: FIRST_JUMP,
        },
        most_passes: MOST_PASSES,
        guide,
        beyond: false,
    }
}

/// Runs that were made: level, stiffness and parameters as bits, and what was predicted.
pub type Memory = Mutex<HashMap<(u32, Vec<u64>), Vec<f64>>>;

/// All series on one level of meshes.
pub struct CableModel<'a> {
    pub series: &'a [SeriesModel],
    pub unknowns: &'a [Unknown],
    pub level: u32,
    /// Stiffness of the ground beside the scene's, where it is not fitted.
    pub stiffness: f64,
    /// Added to what this level predicts: the difference to the next one, near the optimum.
    pub correction: Option<Vec<f64>>,
    pub watch: &'a Watch<'a>,
    /// A fit on the next level begins where the runs of this one ended: none is made twice.
    pub memory: &'a Memory,
}

impl Model for CableModel<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError> {
        let mut forces = self.remembered(parameters)?;
        if let Some(correction) = &self.correction {
            for (force, correction) in forces.iter_mut().zip(correction) {
                *force += correction;
            }
        }
        Ok(forces)
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

impl CableModel<'_> {
    fn remembered(&self, parameters: &[f64]) -> Result<Vec<f64>, Error> {
        let values = std::iter::once(&self.stiffness).chain(parameters);
        // The way through free variables leaves the last bits to chance; rounded, lest a power of two has two keys.
        let key = (
            self.level,
            values.map(|value| (value.to_bits() + (1 << 9)) >> 10).collect(),
        );
        let known = self
            .memory
            .lock()
            .map_or(None, |memory| memory.get(&key).cloned());
        if let Some(known) = known {
            return Ok(known);
        }
        let forces = self.run(parameters)?;
        if let Ok(mut memory) = self.memory.lock() {
            memory.insert(key, forces.clone());
        }
        Ok(forces)
    }

    fn run(&self, parameters: &[f64]) -> Result<Vec<f64>, Error> {
        let forces: Vec<Vec<f64>> = self
            .series
            .par_iter()
            .enumerate()
            .map(|(index, series)| {
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
                series.predict(&scene, stiffness, self.level)
            })
            .collect::<Result<_, Error>>()?;
        self.watch.run()?;
        Ok(forces.concat())
    }
}
