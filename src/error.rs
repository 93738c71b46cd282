//! What can go wrong in an analysis.

use std::borrow::Cow;

use cable_dem::CableError;
use calibrate::{CalibrationError, DataError};
use ground_field::GroundError;
use pass_law::LawError;

use crate::SceneError;
use crate::scene::{Location, SceneFile};

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
    /// The computation made a number that is none: no answer holds one.
    #[error("the computation failed: {field} came out as {value}")]
    NotFinite {
        /// Where in the answer.
        field: String,
        /// What came out.
        value: f64,
    },
    /// An error whose cause stands in a scene file.
    #[error("{location}: {source}{}", .location.excerpt())]
    Located {
        /// Where.
        location: Box<Location>,
        /// The error.
        source: Box<Error>,
    },
}

impl Error {
    /// This error with the line of the key at fault, where one is at fault and the scene came from `file`.
    #[must_use]
    pub fn located(self, file: &SceneFile) -> Self {
        let location = match &self {
            Self::Unfit { key, .. } => file.locate(key),
            _ => None,
        };
        match location {
            Some(location) => Self::Located {
                location: Box::new(location),
                source: Box::new(self),
            },
            None => self,
        }
    }

    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Located { source, .. } => source.is_bad_input(),
            Self::Calibration(error) => error.is_bad_input(),
            Self::Scene(_)
            | Self::Data(_)
            | Self::Unfit { .. }
            | Self::Ground(GroundError::InvalidParameter { .. } | GroundError::Unsupported { .. })
            | Self::Cable(CableError::InvalidParameter { .. } | CableError::UnsupportedLaw { .. }) => true,
            _ => false,
        }
    }
}
