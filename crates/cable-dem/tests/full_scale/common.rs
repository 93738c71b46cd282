//! The scene of the full-scale experiment on a homogeneous half-space, and all solvers on it.
#![allow(dead_code, reason = "every test file uses its part")]

use boussinesq::HalfSpace;
use cable_dem::{
    CableError, CableState, DuctedCable, End, Explicit, ExplicitOptions, ExplicitOutcome, Friction,
    FrictionLaw, Mesh, MovingDuct, PassOutcome, Passage, QuasiStatic,
};
use ground_field::{Direction, DuctMotion};

pub type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Mass per metre of the cable \[kg/m\]: 108.8 N/m.
pub const MASS: f64 = 108.8 / 9.80665;
/// Axial stiffness \[N\].
pub const EA: f64 = 8.01e6;
/// Friction limit \[N/m\]: 0.25 × 108.8 N/m.
pub const LIMIT: f64 = 27.2;
/// How far before and past the duct the vehicle drives \[m\].
pub const APPROACH: f64 = 15.0;

pub const STIFF_SHEATH: FrictionLaw = FrictionLaw::ElasticPlastic {
    shape_factor: 2e8 / LIMIT,
};

/// The duct 1.2 m below a load of 20 tf at `speed` \[km/h\].
pub fn truck(speed: f64) -> Result<DuctMotion, Box<dyn std::error::Error>> {
    let ground = HalfSpace::new(testkit::soil(800e6, 0.4));
    Ok(testkit::truck(&ground, speed / 3.6)?)
}

/// A cable, its mesh, and one vehicle.
pub struct Scene {
    pub cable: DuctedCable,
    pub mesh: Mesh,
    pub passage: Passage,
    pub duct: MovingDuct,
}

impl Scene {
    /// A cable, free upstream.
    pub fn new(
        (law, limit): (FrictionLaw, f64),
        axial_stiffness: f64,
        downstream: End,
        (length, spacing, vehicle_step): (f64, f64, f64),
        motion: &DuctMotion,
    ) -> Result<Self, CableError> {
        let cable = DuctedCable::new(length, axial_stiffness, Friction::new(law, limit)?)?
            .with_ends(End::Free, downstream)?;
        let mesh = Mesh::new(length, spacing, vehicle_step)?;
        let shape = |xi: f64| motion.longitudinal(xi);
        Ok(Self {
            // The shape itself: also on meshes too coarse to say anything of the duct.
            passage: Passage::from_shape(&cable, &mesh, Direction::Forward, shape, APPROACH)?,
            duct: MovingDuct::from_shape(
                &cable,
                &mesh,
                Direction::Forward,
                motion.velocity(),
                shape,
                APPROACH,
            )?,
            cable,
            mesh,
        })
    }

    /// The 30 m scene, fixed downstream.
    pub fn thirty_metres(law: FrictionLaw, spacing: f64, motion: &DuctMotion) -> Result<Self, CableError> {
        let size = (30.0, spacing, 0.5 * spacing);
        Self::new((law, LIMIT), EA, End::Fixed, size, motion)
    }

    pub fn quasi_static(&self, passes: usize) -> Result<PassOutcome, CableError> {
        let mut solver = QuasiStatic::new(self.cable.clone(), self.mesh)?;
        let mut state = CableState::at_rest(&self.mesh);
        last(passes, || solver.pass(&self.passage, &mut state))
    }

    /// Force on the downstream end at the vehicle's last position in the last of `passes`, before the ground returns to rest.
    pub fn quasi_static_before_rest(&self, passes: usize) -> Result<f64, CableError> {
        let mut solver = QuasiStatic::new(self.cable.clone(), self.mesh)?;
        let mut state = CableState::at_rest(&self.mesh);
        let mut last = state.clone();
        for _ in 0..passes {
            solver.pass_observed(&self.passage, &mut state, |_, state| {
                last = state();
            })?;
        }
        Ok(last.end_forces(&self.cable)?.downstream)
    }

    pub fn explicit(&self, passes: usize, options: ExplicitOptions) -> Result<ExplicitOutcome, CableError> {
        let mut solver = Explicit::new(self.cable.clone(), self.mesh, MASS, options)?;
        let mut state = CableState::at_rest(&self.mesh);
        last(passes, || solver.pass(&self.duct, &mut state))
    }
}

fn last<T>(passes: usize, mut pass: impl FnMut() -> Result<T, CableError>) -> Result<T, CableError> {
    for _ in 1..passes {
        pass()?;
    }
    pass()
}

/// a/b − 1.
pub fn relative(a: f64, b: f64) -> f64 {
    a / b - 1.0
}
