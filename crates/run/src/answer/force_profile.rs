//! Force along the cable at one time.

use serde::{Deserialize, Serialize};

/// Force along the cable.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ForceProfile {
    /// Positions along the duct \[m\], midway between nodes.
    pub positions_m: Vec<f64>,
    /// Force in the cable there \[N\], compression positive.
    pub force_n: Vec<f64>,
}
