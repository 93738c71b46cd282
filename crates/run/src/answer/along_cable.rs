//! Force and friction along the cable at one time.

use cable_dem::{CableError, CableState, DuctedCable, SlipLengths};
use serde::{Deserialize, Serialize};

/// Force along the cable.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ForceProfile {
    /// Positions along the duct \[m\], midway between nodes.
    pub positions_m: Vec<f64>,
    /// Force in the cable there \[N\], compression positive.
    pub force_n: Vec<f64>,
}

impl ForceProfile {
    /// Of the cable as it is left in `state`.
    pub(crate) fn new(cable: &DuctedCable, state: &CableState) -> Result<Self, CableError> {
        let force_n: Vec<f64> = state.element_forces(cable)?.collect();
        let middle = |element: usize| state.node_spacing() * (element as f64 + 0.5);
        Ok(Self {
            positions_m: (0..force_n.len()).map(middle).collect(),
            force_n,
        })
    }
}

/// The cable at one pass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// Number of the pass, from 1.
    pub pass: u64,
    /// Force along the cable after it.
    pub force_profile: ForceProfile,
    /// Friction on the cable during it.
    pub friction: Option<FrictionProfile>,
}

/// Friction along the cable with the vehicle over the duct's middle (Kashiro et al., Figure 7).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FrictionProfile {
    /// Place of the vehicle in the scene's list, from 0.
    pub vehicle: usize,
    /// Position of the vehicle's origin along the duct \[m\].
    pub vehicle_position_m: f64,
    /// Positions along the duct \[m\]: the nodes.
    pub positions_m: Vec<f64>,
    /// Friction on the cable there \[N/m\], positive toward growing x.
    pub friction_n_per_m: Vec<f64>,
    /// Lengths at the limit.
    pub slip_lengths: SlipLengths,
}
