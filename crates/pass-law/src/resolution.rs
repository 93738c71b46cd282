//! How finely cells and runs at the ends are computed.

use cable_dem::DuctedCable;

use crate::LawError;
use crate::error::checked;

/// Weight of the slip length beside the depth.
const SLIP_LENGTHS: f64 = 0.6;
/// Longest slip length that the law takes, in depths.
const MOST_REACH: f64 = 8.0;
/// Longest fading length in depths.
const MOST_DEPTHS: f64 = 8.0;

/// Cells in units of the duct's depth, which is the natural length of the ground's motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    depth: f64,
    nodes_per_depth: f64,
    accuracy: f64,
}

impl Resolution {
    /// For a duct at `depth` \[m\]: six nodes and twelve vehicle positions a depth, and the advance tabulated to 0.2 % of
    /// its largest value.
    ///
    /// # Errors
    ///
    /// [`LawError::InvalidParameter`] unless the depth is finite and positive.
    pub fn new(depth: f64) -> Result<Self, LawError> {
        Ok(Self {
            depth: checked("depth", depth, "finite and positive", |v| v > 0.0)?,
            nodes_per_depth: 6.0,
            accuracy: 2e-3,
        })
    }

    /// The same with `nodes_per_depth` nodes, and twice as many vehicle positions, a depth. Six stay within about half a per
    /// cent of the limit of fine meshes, twelve within 0.2 %; the time grows with the square.
    ///
    /// # Errors
    ///
    /// [`LawError::InvalidParameter`] unless it is between 2 and 100.
    pub fn with_nodes_per_depth(mut self, nodes_per_depth: f64) -> Result<Self, LawError> {
        self.nodes_per_depth = checked("nodes_per_depth", nodes_per_depth, "from 2 to 100", |v| {
            (2.0..=100.0).contains(&v)
        })?;
        Ok(self)
    }

    /// The same with the advance tabulated to `accuracy`, a share of its largest value in the table.
    ///
    /// # Errors
    ///
    /// [`LawError::InvalidParameter`] unless it is between 1e-5 and 0.1.
    pub fn with_accuracy(mut self, accuracy: f64) -> Result<Self, LawError> {
        self.accuracy = checked("accuracy", accuracy, "from 1e-5 to 0.1", |v| {
            (1e-5..=0.1).contains(&v)
        })?;
        Ok(self)
    }

    /// Depth of the duct \[m\].
    pub fn depth(self) -> f64 {
        self.depth
    }

    /// Distance between nodes \[m\].
    pub fn node_spacing(self) -> f64 {
        self.depth / self.nodes_per_depth
    }

    /// Distance between vehicle positions \[m\].
    pub fn vehicle_step(self) -> f64 {
        0.5 * self.node_spacing()
    }

    /// Refuses a friction so small that a vehicle's effect reaches over [`MOST_REACH`] depths: cells long enough for it take
    /// minutes, and the passes one by one seconds.
    pub(crate) fn check_reach(self, cable: &DuctedCable, peak: f64) -> Result<(), LawError> {
        let limit = cable.friction().limit();
        let length = (cable.axial_stiffness() * peak / limit).sqrt();
        let most = MOST_REACH * self.depth;
        if limit == 0.0 || length <= most {
            Ok(())
        } else {
            Err(LawError::FarReaching { length, most })
        }
    }

    /// Length \[m\] over which the effect of a vehicle fades: the depth, or the length √(EA D_l/q) over which friction stretches
    /// the cable by the duct's displacement, in proportion to which it grows where friction is small.
    pub(crate) fn fading_length(self, cable: &DuctedCable, peak: f64) -> f64 {
        let limit = cable.friction().limit();
        if limit == 0.0 {
            return self.depth;
        }
        let slip_length = (cable.axial_stiffness() * peak / limit).sqrt();
        self.depth
            .max(SLIP_LENGTHS * slip_length)
            .min(MOST_DEPTHS * self.depth)
    }

    /// Accuracy of the table, a share of the largest advance.
    pub fn accuracy(self) -> f64 {
        self.accuracy
    }
}
