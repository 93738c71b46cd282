//! The motion of the duct in time: a fixed shape that travels along the cable.

use ground_field::{Direction, DuctMotion};

use crate::course::{Course, as_driven};
use crate::error::checked;
use crate::{CableError, DuctedCable, Mesh};

/// Longest step of the lattice \[m\].
const LATTICE_STEP: f64 = 0.02;
/// Most lattice points: 4e7 take 640 MB.
const MAX_POINTS: f64 = 4e7;

/// A duct whose displacement travels along it with a vehicle, tabulated for one mesh.
///
/// Depends on the mesh and the vehicle, not on the cable's state: made once, used for every pass.
///
/// At time t the duct at node i stands at D_i(t) = D(i h − x_v(t)), x_v the vehicle's position. The shape is tabulated on a
/// lattice that divides the node spacing h into M parts, and read by cubic Hermite interpolation: all nodes then lie at
/// the same fraction θ between two lattice points, and those M apart stand side by side in memory, so that one step
/// reads four contiguous rows with the same four weights. Slopes are fourth-order differences of the values: the error is
/// s⁴/384 · max|D⁗| and more of that order, s the lattice step: below 1e-7 of the peak for s = 20 mm in a duct 1.2 m deep.
#[derive(Debug, Clone)]
pub struct MovingDuct {
    direction: Direction,
    speed: f64,
    mesh: Mesh,
    approach: f64,
    /// By phase the values at the lattice points p, p + M, p + 2M, …, and the slopes there times the lattice step.
    rows: Vec<[Vec<f64>; 2]>,
    /// ξ of the first lattice point is −`origin` \[m\].
    origin: f64,
    step: f64,
    peak: f64,
    steepest: f64,
}

/// The four rows and weights that give every node's duct displacement at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Instant<'a> {
    rows: [&'a [f64]; 4],
    weights: [f64; 4],
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
        Self::on_course(cable, mesh, speed, &Course::new(direction, shape, approach)?)
    }

    fn on_course(
        cable: &DuctedCable,
        mesh: &Mesh,
        speed: f64,
        course: &Course<impl Fn(f64) -> f64>,
    ) -> Result<Self, CableError> {
        let (direction, approach) = (course.direction, course.approach);
        checked("speed", speed, "finite and positive", |v| v > 0.0)?;
        mesh.check_length(cable.length())?;
        let h = mesh.spacing();
        let phases = (h / LATTICE_STEP).ceil().max(1.0);
        let step = h / phases;
        let length = mesh.length();
        // Spacings from the first lattice point to ξ = 0, and altogether; one to spare on both sides.
        let before = ((length + approach) / h).ceil() + 1.0;
        let per_row = 2.0 * before + 1.0;
        checked("lattice points", per_row * phases, "at most 4e7", |v| {
            v <= MAX_POINTS
        })?;
        let (phases, per_row) = (phases as usize, per_row as usize);
        let origin = before * h;

        // Along x, whichever way the vehicle drives; two points more on both sides, for the slopes.
        let sign = direction.sign();
        let points = (0..phases * per_row + 4).map(|j| sign * (step * (j as f64 - 2.0) - origin));
        let mut values = course.tabulate(points)?;
        for value in &mut values {
            *value *= sign;
        }
        let peak = values.iter().fold(0.0_f64, |peak, d| peak.max(d.abs()));
        let slope = |j: usize| (8.0 * (values[j + 3] - values[j + 1]) - (values[j + 4] - values[j])) / 12.0;
        let steepest = (0..phases * per_row).fold(0.0_f64, |most, j| most.max(slope(j).abs())) / step;
        let rows = (0..phases)
            .map(|p| {
                let points = || (0..per_row).map(move |c| p + c * phases);
                [
                    points().map(|j| values[j + 2]).collect(),
                    points().map(slope).collect(),
                ]
            })
            .collect();
        Ok(Self {
            direction,
            speed,
            mesh: *mesh,
            approach,
            rows,
            origin,
            step,
            peak,
            steepest,
        })
    }

    /// Which way the vehicle drives.
    pub fn direction(&self) -> Direction {
        self.direction
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

    /// Largest velocity of the duct along itself \[m/s\].
    pub fn peak_velocity(&self) -> f64 {
        self.steepest * self.speed
    }

    /// Length \[m\] over which the duct's displacement changes: its largest value over its steepest slope. 0 for a duct at
    /// rest.
    pub fn natural_length(&self) -> f64 {
        if self.steepest > 0.0 {
            self.peak / self.steepest
        } else {
            0.0
        }
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

    /// Writes the displacement of every node's duct at time `t` \[s\] to `duct` \[m\].
    pub(crate) fn displacement(&self, t: f64, duct: &mut [f64]) {
        let Instant { rows, weights } = self.at(t, duct.len());
        for (i, d) in duct.iter_mut().enumerate() {
            *d = (0..4).map(|k| weights[k] * rows[k][i]).sum();
        }
    }

    /// The duct of `nodes` nodes at time `t` \[s\]; times outside the pass are its ends.
    pub(crate) fn at(&self, t: f64, nodes: usize) -> Instant<'_> {
        let x = self.vehicle_position(t.clamp(0.0, self.duration()));
        let place = (self.origin - x) / self.step;
        let left = place.floor();
        let s = place - left;
        let left = left as usize;
        let row = |j: usize| {
            let (phase, first) = (j % self.rows.len(), j / self.rows.len());
            self.rows[phase].each_ref().map(|row| &row[first..first + nodes])
        };
        let ([value, slope], [next_value, next_slope]) = (row(left), row(left + 1));
        Instant {
            rows: [value, slope, next_value, next_slope],
            weights: [
                1.0 - s * s * (3.0 - 2.0 * s),
                s * (1.0 - s) * (1.0 - s),
                s * s * (3.0 - 2.0 * s),
                s * s * (s - 1.0),
            ],
        }
    }
}

impl Instant<'_> {
    /// Moves `duct` to this instant's displacements \[m\] and writes how far each node's duct moved to `increment`.
    pub fn advance(&self, duct: &mut [f64], increment: &mut [f64]) {
        let n = duct.len();
        let [a, b, c, d] = self.rows.map(|row| &row[..n]);
        let [wa, wb, wc, wd] = self.weights;
        let increment = &mut increment[..n];
        for i in 0..n {
            let now = (wa * a[i] + wb * b[i]) + (wc * c[i] + wd * d[i]);
            increment[i] = now - duct[i];
            duct[i] = now;
        }
    }
}
