//! What can go wrong in an analysis.

use std::borrow::Cow;

use cable_dem::CableError;
use calibrate::{CalibrationError, DataError};
use ground_field::GroundError;
use pass_law::LawError;

use crate::SceneError;

/// Error of an analysis.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The ground could not be computed.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The cable could not be computed.
    #[error(transparent)]
    Cable(#[from] CableError),
    /// The pass law could not be computed.
    #[error(transparent)]
    Law(#[from] LawError),
    /// The readings of a load cell are wrong.
    #[error(transparent)]
    Data(#[from] DataError),
    /// The parameters could not be fitted.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// The finest affordable mesh leaves too large an error.
    #[error(
        "the estimated error of {:.1} % is too far above the tolerance of {:.2} %: the forces are small beside what passes through \
         the cable; a node spacing in the scene (solver.node_spacing) or a larger tolerance gives an answer nonetheless",
        100.0 * .reached,
        100.0 * .asked
    )]
    Inaccurate {
        /// Estimated error, as a share of the forces.
        reached: f64,
        /// Tolerance asked.
        asked: f64,
    },
    /// The scene asks for something that does not fit the rest of it.
    #[error("{key}: {found} does not fit this scene: {reason}")]
    Unfit {
        /// The scene's key.
        key: &'static str,
        /// What it asks for.
        found: &'static str,
        /// Why it does not fit.
        reason: Cow<'static, str>,
    },
}

impl Error {
    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Calibration(error) if error.is_bad_input())
            || matches!(
                self,
                Self::Scene(_)
                    | Self::Data(_)
                    | Self::Unfit { .. }
                    | Self::Ground(GroundError::InvalidParameter { .. } | GroundError::Unsupported { .. })
                    | Self::Cable(CableError::InvalidParameter { .. } | CableError::UnsupportedLaw { .. })
            )
    }
}
