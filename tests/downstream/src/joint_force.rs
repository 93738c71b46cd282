//! Force on a joint as a model to be calibrated: friction and stiffness of the ground in, forces after listed passes out.

use creepage::cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, QuasiStatic};
use creepage::fitting::{Model, ModelError};
use creepage::ground_field::{DuctLine, DuctMotion, Vehicle};

use crate::MeasuredGround;

/// Length of the duct \[m\], its depth \[m\], and how far before it vehicles come from \[m\].
const LENGTH: f64 = 20.0;
const DEPTH: f64 = 1.2;
const APPROACH: f64 = 15.0;
/// Weight of the cable \[N/m\] and EA \[N\].
const WEIGHT: f64 = 108.8;
const AXIAL_STIFFNESS: f64 = 8.01e6;
/// Shear stiffness of the sheath \[N/m per metre\].
const SHEAR_STIFFNESS: f64 = 1e8;

/// Any error of the parts.
pub type BoxError = Box<dyn std::error::Error + Send + Sync>;

/// The joint at the downstream end of 20 m of duct; its parameters are μ_d and how many times stiffer the ground is.
#[derive(Debug, Clone)]
pub struct JointForce {
    motion: DuctMotion,
    passes: Vec<usize>,
}

impl JointForce {
    /// Forces after each of `passes`, ascending, of a vehicle of 20 tf over `ground`.
    ///
    /// # Errors
    ///
    /// Whatever the ground answers.
    pub fn new(ground: &MeasuredGround, passes: Vec<usize>) -> Result<Self, BoxError> {
        let truck = Vehicle::point("truck", 196_133.0, 11.1)?;
        let reach = LENGTH + APPROACH + 1.0;
        let motion = DuctMotion::new(ground, &truck, DuctLine::new(DEPTH, 0.0)?, reach, 1e-6)?;
        Ok(Self { motion, passes })
    }

    /// Force \[N\] after each pass asked for.
    ///
    /// # Errors
    ///
    /// Whatever the cable answers.
    pub fn forces(&self, friction: f64, stiffness: f64) -> Result<Vec<f64>, BoxError> {
        let limit = friction * WEIGHT;
        let shape_factor = 2.0 * SHEAR_STIFFNESS / limit;
        let friction = Friction::new(FrictionLaw::ElasticPlastic { shape_factor }, limit)?;
        let cable = DuctedCable::new(LENGTH, AXIAL_STIFFNESS, friction)?.with_ends(End::Free, End::Fixed)?;
        let motion = self.motion.clone().scaled(1.0 / stiffness)?;
        let mut solver = QuasiStatic::new(cable, Mesh::for_depth(LENGTH, DEPTH, 6.0)?)?;
        let passage = solver.passage(&motion, APPROACH)?;
        let mut state = solver.at_rest();
        let mut forces = Vec::new();
        for pass in 1..=self.passes.last().copied().unwrap_or(0) {
            let outcome = solver.pass(&passage, &mut state)?;
            if self.passes.contains(&pass) {
                forces.push(outcome.force.downstream);
            }
        }
        Ok(forces)
    }
}

impl Model for JointForce {
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError> {
        self.forces(parameters[0], parameters[1])
    }
}
