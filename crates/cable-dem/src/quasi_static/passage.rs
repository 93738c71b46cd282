//! A vehicle's passage as the quasi-static solver takes it.

use ground_field::{Direction, DuctMotion};

use friction_chain::tridiagonal::{self, Row};

use super::schedule::schedule;
use crate::course::{Course, as_driven, of_shape};
use crate::tuning::{UNBALANCED_SHARE, WATCHED_SHARE};
use crate::{CableError, DuctedCable, Friction, Mesh};

/// A watched node slips when its friction exceeds the limit by this share of the limit.
pub(super) const SLIPPING_SHARE: f64 = (1.0 - 2.0 * WATCHED_SHARE) * UNBALANCED_SHARE;

/// A vehicle's passage as the cable feels it: adherent motion and adhesion on the lattice of one mesh.
///
/// Depends on the cable, the mesh and the vehicle, not on the cable's state: computed once, used for every pass.
///
/// A cable stuck to its duct all along would move by the *adherent motion* a(ξ): the duct's motion D(ξ), smoothed by the
/// sheath's shear over the screening length λ,
///
/// (a − D)/γ = EA a″,  discretely  −k (a_{i−1} − 2 a_i + a_{i+1}) = h A_i,  A = (D − a)/γ.
///
/// A(ξ) is the friction that adhesion takes: −EA D″ for Coulomb's law, where a = D. Measured from the adherent motion,
/// r = u − a and g = f − A, the cable feels the passing vehicle only through the friction bounds, which it shifts,
///
/// −q − A(ξ) ≤ g ≤ q − A(ξ),
///
/// and at ends and clamps. Where g stays within them nothing changes: r and g are the cable's state, and only the
/// zone where the travelling shift presses g against a bound has to be solved.
#[derive(Debug, Clone)]
pub struct Passage {
    mesh: Mesh,
    /// Axial stiffness \[N\], friction and least friction limit \[N/m\] for which it was computed.
    cable: (f64, Friction, f64),
    /// One lattice a phase: node i with the vehicle at lattice position s stands at ξ-index i·m − s, with m = phases
    /// per node spacing.
    phases: Vec<Phase>,
    /// Lattice indices before the vehicle's origin.
    behind: usize,
    /// Vehicle positions along the duct, in lattice units, in the order in which the vehicle takes them.
    pub(super) positions: Vec<i64>,
    /// Nodes on either side of the vehicle beyond which adhesion cannot matter.
    pub(super) reach: usize,
    /// Largest adherent displacement \[m\].
    pub(super) peak: f64,
    /// Zeros, one a node and one beyond either end: the ground at rest.
    still: Vec<f64>,
}

#[derive(Debug, Clone)]
struct Phase {
    adherent: Vec<f64>,
    adhesion: Vec<f64>,
}

/// The passage at one vehicle position.
#[derive(Debug, Clone, Copy)]
pub(super) struct Snapshot<'a> {
    /// Adherent displacement \[m\], that of node i at index i + 1, so that both ends have a neighbour outside.
    adherent: &'a [f64],
    /// Adhesion \[N/m\] of every node.
    pub adhesion: &'a [f64],
    /// Last node at or before the vehicle; outside the duct, negative or beyond the last.
    pub node: i64,
    /// Vehicle position on the lattice.
    pub position: i64,
}

impl Passage {
    /// The passage of a vehicle whose duct motion is `motion` over `cable`, meshed by `mesh`; see [`crate::QuasiStatic::passage`].
    ///
    /// Its origin is followed from `approach` \[m\] before the duct to `approach` past it; before and after that the ground is at
    /// rest, D = 0. What the duct does while the vehicle is farther away is taken in one step, there and back;
    /// [`crate::approach`] says how far out that is exact.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless `approach` is positive and at most 1e5 m, [`CableError::OutOfReach`] if the motion
    /// is not known as far as the duct's length and the approach together, [`CableError::CoarseMesh`] for a mesh that leaves out
    /// more than 65 % of the duct's peak: about 1.5 nodes per depth or fewer.
    pub fn new(
        cable: &DuctedCable,
        mesh: &Mesh,
        motion: &DuctMotion,
        approach: f64,
    ) -> Result<Self, CableError> {
        Self::on_course(cable, mesh, &as_driven(motion, mesh, approach)?)
    }

    /// The passage of a travelling longitudinal displacement `shape`(ξ) \[m\], ξ positive ahead of the vehicle and the
    /// displacement positive in its direction of travel; ξ = 0 travels from `approach` \[m\] before the duct to `approach`
    /// past it, in strides of a fiftieth of its distance where that is more than the mesh's step: what the shape does should be near it.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless `approach` is positive and at most 1e5 m and `shape` is finite. Whether the mesh is
    /// fine enough for the shape is for the caller to know.
    pub fn from_shape(
        cable: &DuctedCable,
        mesh: &Mesh,
        direction: Direction,
        shape: impl Fn(f64) -> f64,
        approach: f64,
    ) -> Result<Self, CableError> {
        Self::on_course(cable, mesh, &of_shape(direction, shape, approach)?)
    }

    fn on_course(
        cable: &DuctedCable,
        mesh: &Mesh,
        course: &Course<impl Fn(f64) -> f64>,
    ) -> Result<Self, CableError> {
        let step = mesh.lattice_step();
        let unseen = WATCHED_SHARE * UNBALANCED_SHARE * cable.least_limit();
        let m = mesh.phases as i64;
        let (end, stride) = (mesh.elements() as i64 * m, mesh.stride as i64);
        let approach = (course.approach / mesh.vehicle_step()).ceil() as i64 * stride;

        // Every ξ-index that a node, or the neighbour outside an end, can have; whole phases on both sides.
        let behind = ((end + stride + approach) / m + 3) * m;
        let shape = course.tabulate((-behind..=behind).map(|j| step * j as f64))?;
        let mut positions = schedule(end, approach, (course.half_length / step).ceil() as i64, stride);
        if course.direction == Direction::Reverse {
            for position in &mut positions {
                *position = end - *position;
            }
        }
        let compliance = cable.friction().compliance();
        let (stiffness, h) = (cable.axial_stiffness() / mesh.spacing(), mesh.spacing());
        let phase = |phase: usize| {
            let duct: Vec<f64> = shape[phase..].iter().step_by(m as usize).copied().collect();
            Phase::new(&duct, compliance * stiffness / h, stiffness / h)
        };
        let phases: Vec<Phase> = (0..m as usize).map(phase).collect();
        let adherent = phases.iter().flat_map(|phase| &phase.adherent);
        let peak = adherent.fold(0.0_f64, |peak, a| peak.max(a.abs()));
        let origin = behind / m;
        let reach = phases
            .iter()
            .flat_map(|phase| phase.adhesion.iter().enumerate())
            .filter(|(_, adhesion)| adhesion.abs() > unseen)
            .map(|(c, _)| (c as i64 - origin).unsigned_abs() as usize + 1)
            .max()
            .unwrap_or(0);
        Ok(Self {
            mesh: *mesh,
            cable: (cable.axial_stiffness(), cable.friction(), cable.least_limit()),
            behind: behind as usize,
            positions,
            reach,
            phases,
            peak,
            still: vec![0.0; mesh.nodes() + 2],
        })
    }

    /// Whether it was computed for a cable of the same stiffness and friction on the same mesh.
    pub(super) fn fits(&self, cable: &DuctedCable, mesh: &Mesh) -> bool {
        let cable = (cable.axial_stiffness(), cable.friction(), cable.least_limit());
        self.mesh == *mesh && self.cable == cable
    }

    /// Vehicle positions of one pass.
    pub fn steps(&self) -> usize {
        self.positions.len()
    }

    /// Number of lattice points.
    pub(super) fn points(&self) -> usize {
        self.phases.len() * self.phases[0].adherent.len()
    }

    /// Lattice point in the vehicle's frame at which node 0 stands, points of one phase side by side.
    pub(super) fn first_point(&self, snapshot: &Snapshot<'_>) -> usize {
        let (at, m) = (
            (self.behind as i64 - snapshot.position) as usize,
            self.phases.len(),
        );
        at % m * self.phases[0].adherent.len() + at / m
    }

    /// The ground at rest, the vehicle having left.
    pub(super) fn still(&self) -> Snapshot<'_> {
        Snapshot {
            adherent: &self.still,
            adhesion: &self.still[..self.mesh.nodes()],
            ..self.snapshot(self.positions[self.positions.len() - 1])
        }
    }

    /// The vehicle at lattice position `position`.
    pub(super) fn snapshot(&self, position: i64) -> Snapshot<'_> {
        let m = self.phases.len() as i64;
        // Index of node −1.
        let index = self.behind as i64 - m - position;
        let (phase, first) = (index.rem_euclid(m) as usize, index.div_euclid(m) as usize);
        let beyond = first + self.mesh.nodes() + 2;
        Snapshot {
            adherent: &self.phases[phase].adherent[first..beyond],
            adhesion: &self.phases[phase].adhesion[first + 1..beyond - 1],
            node: position.div_euclid(m),
            position,
        }
    }
}

impl Snapshot<'_> {
    /// Adherent displacement \[m\] of `node`.
    pub fn adherent_at(&self, node: usize) -> f64 {
        self.adherent[node + 1]
    }

    /// By how much more the neighbour after `node` is displaced than the one before \[m\].
    pub fn stretch_around(&self, node: usize) -> f64 {
        self.adherent[node + 2] - self.adherent[node]
    }
}

impl Phase {
    /// Adherent motion and adhesion on one lattice of spacing h from the duct's motion there.
    ///
    /// `screening` is (λ/h)², `bend` is EA/h². The first and last points take the duct's own motion; any solution
    /// of the difference equation serves as a frame of reference, so that this choice does not touch the answer.
    fn new(duct: &[f64], screening: f64, bend: f64) -> Self {
        let last = duct.len() - 1;
        let mut adherent = duct.to_vec();
        if screening > 0.0 {
            let per_pivot = 1.0 / (1.0 + 2.0 * screening);
            let row = |i: usize| Row {
                share: screening * per_pivot,
                value: per_pivot * duct[i + 1],
            };
            let mut factors = vec![0.0; duct.len()];
            tridiagonal::solve([duct[0], duct[last]], row, &mut factors, &mut adherent[1..last]);
        }
        let mut adhesion = vec![0.0; duct.len()];
        for i in 1..last {
            adhesion[i] = -bend * (adherent[i - 1] - 2.0 * adherent[i] + adherent[i + 1]);
        }
        Self { adherent, adhesion }
    }
}
