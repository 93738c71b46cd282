//! The cable cut into equal elements, and the lattice the vehicle moves on.

use crate::CableError;
use crate::error::{checked, positive};

/// Maximum number of nodes of a mesh: 1e7 nodes take about 1 GB.
const MAX_NODES: f64 = 1e7;

/// Equally spaced nodes 0..=n along the cable, and the vehicle's advance per step.
///
/// The advance is a whole fraction or a whole multiple of the spacing: then the nodes seen from the vehicle always
/// fall on the same few lattices, and the duct's motion is evaluated once, not at every step.
///
/// ```
/// use cable_dem::Mesh;
///
/// // Six nodes on 1.2 m, and two positions of the vehicle per node.
/// let mesh = Mesh::for_depth(30.0, 1.2, 6.0)?;
/// assert_eq!((mesh.elements(), mesh.nodes()), (150, 151));
/// assert!((mesh.vehicle_step() - 0.1).abs() < 1e-12);
/// # Ok::<(), cable_dem::CableError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mesh {
    elements: usize,
    spacing: f64,
    /// Lattice points from one node to the next, and from one vehicle position to the next: one of both is 1.
    pub(crate) phases: usize,
    pub(crate) stride: usize,
}

impl Mesh {
    /// Minimum number of elements of a cable, however short, of a mesh that is chosen for it.
    pub const MIN_ELEMENTS: f64 = 8.0;
    /// Steps of the vehicle per node spacing of such a mesh.
    pub const STEPS_PER_SPACING: f64 = 2.0;

    /// A mesh of a cable of `length` \[m\] with nodes at most `node_spacing` \[m\] and vehicle positions at most
    /// `vehicle_step` \[m\] apart.
    ///
    /// Any spacing is taken, as the mesh knows no depth of the duct. What the cable feels is about as long as the duct is deep, so that
    /// three nodes per depth are the least: prefer [`Mesh::for_depth`], which keeps to that and states the errors.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless all are finite and positive, the spacing is at most half the length and
    /// there are at most 1e7 nodes.
    pub fn new(length: f64, node_spacing: f64, vehicle_step: f64) -> Result<Self, CableError> {
        positive("length", length)?;
        checked(
            "node_spacing",
            node_spacing,
            "positive, at most half the duct's length and at least its 1e-7th part",
            |v| v > 0.0 && v <= 0.5 * length && length / v <= MAX_NODES,
        )?;
        checked(
            "vehicle_step",
            vehicle_step,
            "positive and at least a 1e-7th part of the duct's length",
            |v| v > 0.0 && length / v <= MAX_NODES,
        )?;
        // A spacing that divides the length to rounding is taken as it is.
        let elements = ((length / node_spacing) * (1.0 - 1e-12)).ceil() as usize;
        let spacing = length / elements as f64;
        let (phases, stride) = if vehicle_step < spacing * (1.0 - 1e-12) {
            (((spacing / vehicle_step) * (1.0 - 1e-12)).ceil() as usize, 1)
        } else {
            (1, ((vehicle_step / spacing) * (1.0 + 1e-12)).floor() as usize)
        };
        Ok(Self {
            elements,
            spacing,
            phases,
            stride,
        })
    }

    /// A mesh of a cable of `length` \[m\] in a duct at `depth` \[m\]: `nodes_per_depth` nodes on a stretch as long as the duct is deep,
    /// at least eight elements, and two positions of the vehicle per node.
    ///
    /// Error of the force after fifty vehicles of 20 tf over a duct of 30 m, 1.2 m deep, with a stiff sheath:
    ///
    /// | nodes per depth | 0.24 | 1.2 | 3 | 6 | 12 |
    /// |---|---|---|---|---|---|
    /// | error | 105 % | 14 % | 1.4 % | 0.8 % | < 0.1 % |
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless length and depth are finite and positive, there are at least three nodes per depth, and
    /// at most 5e6 of them.
    pub fn for_depth(length: f64, depth: f64, nodes_per_depth: f64) -> Result<Self, CableError> {
        positive("length", length)?;
        positive("depth", depth)?;
        checked("nodes_per_depth", nodes_per_depth, "at least 3", |v| v >= 3.0)?;
        let spacing = (depth / nodes_per_depth).min(length / Self::MIN_ELEMENTS);
        Self::new(length, spacing, spacing / Self::STEPS_PER_SPACING)
    }

    /// `elements` of length `spacing` \[m\], as a stored state names them.
    #[cfg(feature = "serde")]
    pub(crate) fn of_elements(elements: usize, spacing: f64) -> Result<Self, CableError> {
        checked("nodes", (elements + 1) as f64, "from 3 to 1e7", |v| {
            (3.0..=MAX_NODES).contains(&v)
        })?;
        Ok(Self {
            elements,
            spacing: positive("node_spacing", spacing)?,
            phases: 1,
            stride: 1,
        })
    }

    /// The same nodes, whatever the vehicle's steps.
    pub(crate) fn nodes_alone(&self) -> Self {
        Self {
            phases: 1,
            stride: 1,
            ..*self
        }
    }

    /// Number of elements n; there are n + 1 nodes.
    pub fn elements(&self) -> usize {
        self.elements
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.elements + 1
    }

    /// Distance h between nodes \[m\].
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Length of the cable \[m\].
    pub fn length(&self) -> f64 {
        self.spacing * self.elements as f64
    }

    /// Advance of the vehicle per step \[m\].
    pub fn vehicle_step(&self) -> f64 {
        self.lattice_step() * self.stride as f64
    }

    /// Length of cable \[m\] whose friction acts at `node`: h, and half of it at the ends.
    pub fn tributary_length(&self, node: usize) -> f64 {
        if node == 0 || node == self.elements {
            0.5 * self.spacing
        } else {
            self.spacing
        }
    }

    /// Refuses the mesh unless it is as long as a cable of `length` \[m\].
    pub(crate) fn check_length(&self, length: f64) -> Result<(), CableError> {
        checked("mesh length", self.length(), "the cable's length", |v| {
            (v / length - 1.0).abs() < 1e-9
        })
        .map(|_| ())
    }

    /// The node before `position` \[m\], and how far on to the next it lies, as a share of the spacing.
    pub(crate) fn place(&self, position: f64) -> (usize, f64) {
        let place = (position / self.spacing).clamp(0.0, self.elements as f64);
        let left = (place.floor() as usize).min(self.elements - 1);
        (left, place - left as f64)
    }

    /// Distance between the points of the lattice on which both nodes and vehicle positions lie \[m\].
    pub(crate) fn lattice_step(&self) -> f64 {
        self.spacing / self.phases as f64
    }
}
