//! The motion of the duct in time: a fixed shape that travels along the cable.

use ground_field::{Direction, DuctMotion};

use crate::course::{Course, as_driven, of_shape};
use crate::error::{checked, positive};
use crate::{CableError, DuctedCable, Mesh};

/// Longest step of the lattice \[m\].
const LATTICE_STEP: f64 = 0.02;
/// Maximum number of lattice points: 4e7 take 320 MB.
const MAX_POINTS: f64 = 4e7;

/// A duct whose displacement travels along it with a vehicle, tabulated for one mesh.
///
/// Depends on the mesh and the vehicle, not on the cable's state: made once, used for every pass.
///
/// At time t the duct at node i stands at D_i(t) = D(i h − x_v(t)), x_v the vehicle's position. The
/// shape is tabulated on a lattice that divides the node spacing h, and read by cubic Hermite
/// interpolation with slopes that are fourth-order differences: six values a node, with the same
/// weights at all nodes, which lie at the same fraction θ between two lattice points. The error is
/// s⁴/384 · max|D⁗| and more of that order, s the lattice step: below 1e-7 of the peak for s = 20
/// mm in a duct 1.2 m deep.
#[derive(Debug, Clone)]
pub struct MovingDuct {
    direction: Direction,
    speed: f64,
    mesh: Mesh,
    approach: f64,
    /// D at the lattice points \[m\].
    values: Vec<f64>,
    /// Lattice points from one node to the next, and their distance \[m\].
    parts: usize,
    step: f64,
    /// ξ of the third lattice point is −`origin` \[m\].
    origin: f64,
    peak: f64,
    /// Largest |D′|.
    pub(super) steepest: f64,
}

impl MovingDuct {
    /// The duct of `cable` with nodes as in `mesh`, under a vehicle whose duct motion is `motion`; see [`crate::Explicit::passage`].
    ///
    /// The vehicle is followed as in [`crate::Passage::new`].
    ///
    /// # Errors
    ///
    /// As for [`crate::Passage::new`], and [`CableError::InvalidParameter`] for a table of more than 4e7 points.
    pub fn new(
        cable: &DuctedCable,
        mesh: &Mesh,
        motion: &DuctMotion,
        approach: f64,
    ) -> Result<Self, CableError> {
        let speed = motion.velocity().abs();
        Self::on_course(cable, mesh, speed, &as_driven(motion, mesh, approach)?)
    }

    /// The duct under a travelling displacement `shape`(ξ) \[m\], ξ positive ahead of the vehicle and the displacement
    /// positive in its direction of travel; ξ = 0 travels at `speed` \[m/s\] from `approach` \[m\] before the duct to `approach` past it.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless speed and `approach` are positive, the shape is finite and the table has at most 4e7
    /// points.
    pub fn from_shape(
        cable: &DuctedCable,
        mesh: &Mesh,
        direction: Direction,
        speed: f64,
        shape: impl Fn(f64) -> f64,
        approach: f64,
    ) -> Result<Self, CableError> {
        Self::on_course(cable, mesh, speed, &of_shape(direction, shape, approach)?)
    }

    fn on_course(
        cable: &DuctedCable,
        mesh: &Mesh,
        speed: f64,
        course: &Course<impl Fn(f64) -> f64>,
    ) -> Result<Self, CableError> {
        let (direction, approach) = (course.direction, course.approach);
        positive("speed", speed)?;
        mesh.check_length(cable.length())?;
        let h = mesh.spacing();
        let parts = (h / LATTICE_STEP).ceil().max(1.0);
        let step = h / parts;
        // Spacings from the first lattice point to ξ = 0, and one more, which a slope needs.
        let before = ((mesh.length() + approach) / h).ceil() + 1.0;
        let points = (2.0 * before + 1.0) * parts;
        checked("lattice points", points, "at most 4e7", |v| v <= MAX_POINTS)?;
        let origin = before * h;

        // Two points more on both sides, for the slopes.
        let places = (0..points as usize + 4).map(|j| step * (j as f64 - 2.0) - origin);
        let values = course.tabulate(places)?;
        let slope = |d: &[f64]| (8.0 * (d[3] - d[1]) - (d[4] - d[0])) / (12.0 * step);
        let largest = |most: f64, value: f64| most.max(value.abs());
        Ok(Self {
            direction,
            speed,
            mesh: *mesh,
            approach,
            parts: parts as usize,
            step,
            origin,
            peak: values.iter().copied().fold(0.0, largest),
            steepest: values.windows(5).map(slope).fold(0.0, largest),
            values,
        })
    }

    /// Speed of the vehicle \[m/s\].
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Duration of one pass \[s\]: over the duct and both approaches.
    pub fn duration(&self) -> f64 {
        (self.mesh.length() + 2.0 * self.approach) / self.speed
    }

    /// Largest displacement of the duct \[m\].
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Whether this duct was tabulated for `mesh`.
    pub(crate) fn check(&self, mesh: &Mesh) -> Result<(), CableError> {
        if self.mesh == *mesh {
            Ok(())
        } else {
            Err(CableError::PassageMismatch)
        }
    }

    /// How many steps of at most `longest` \[s\] a pass takes; one that divides it to rounding is taken as it is.
    pub(crate) fn steps(&self, longest: f64) -> f64 {
        (self.duration() / longest * (1.0 - 1e-12)).ceil().max(1.0)
    }

    /// Position of the vehicle \[m\] at time `t` \[s\] after the start.
    pub(crate) fn vehicle_position(&self, t: f64) -> f64 {
        match self.direction {
            Direction::Forward => self.speed * t - self.approach,
            Direction::Reverse => self.mesh.length() + self.approach - self.speed * t,
        }
    }

    /// Writes the displacement of every node's duct at time `t` \[s\] to `duct` \[m\]; times
    /// outside the pass are its ends.
    pub(crate) fn displacement(&self, t: f64, duct: &mut [f64]) {
        let x = self.vehicle_position(t.clamp(0.0, self.duration()));
        let place = (self.origin - x) / self.step;
        let first = place.floor();
        let s = place - first;
        // Hermite's weights of both values and both slopes; a slope is (8 (D₁ − D₋₁) − (D₂ −
        // D₋₂))/12.
        let [value, next_value] = [1.0 - s * s * (3.0 - 2.0 * s), s * s * (3.0 - 2.0 * s)];
        let [slope, next_slope] = [s * (1.0 - s) * (1.0 - s) / 12.0, s * s * (s - 1.0) / 12.0];
        let weights = [
            slope,
            next_slope - 8.0 * slope,
            value - 8.0 * next_slope,
            next_value + 8.0 * slope,
            8.0 * next_slope - slope,
            -next_slope,
        ];
        let nodes = self.values[first as usize..].windows(6).step_by(self.parts);
        debug_assert!(nodes.len() >= duct.len());
        for (d, values) in duct.iter_mut().zip(nodes) {
            *d = weights
                .iter()
                .zip(values)
                .map(|(weight, value)| weight * value)
                .sum();
        }
    }
}
