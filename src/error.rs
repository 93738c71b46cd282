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
    #[error(
        "{0}; every pass one by one (solver.method = \"quasi-static\", at most a million traffic.passes) may do"
    )]
    Law(#[from] LawError),
    /// The readings of a load cell are wrong.
    #[error(transparent)]
    Data(#[from] DataError),
    /// The parameters could not be fitted.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// The finest affordable mesh leaves too large an error.
    #[error(
        "the estimated error of {:.1} % is too far above the tolerance of {:.2} %: an error of more than 10 % is no answer; a larger \
         tolerance (solver.tolerance), a finer mesh (solver.node_spacing) or solver.method = \"quasi-static\" may help",
        100.0 * .reached,
        100.0 * .asked
    )]
    Inaccurate {
        /// Estimated error, as a share of the forces.
        reached: f64,
        /// Tolerance asked.
        asked: f64,
    },
    /// The forces of an answer do not balance: friction cannot carry them.
    #[error(
        "after pass {pass} the forces ask for {needed:.4e} N of friction per metre where its limit is {limit:.4e} N/m: this is no \
         answer; solver.method = \"quasi-static\" computes every pass"
    )]
    Unbalanced {
        /// The pass.
        pass: u64,
        /// Friction that the forces would need \[N/m\].
        needed: f64,
        /// The most that friction can be \[N/m\].
        limit: f64,
    },
    /// The duct is so long beside its depth that no mesh of it can be computed.
    #[error(
        "duct.length = {length} m and duct.depth = {depth} m: a mesh as fine as this depth asks for has {nodes:.1e} nodes along the duct, \
         where 5e6 are allowed: a shorter or a deeper duct, a larger solver.tolerance, or a solver.node_spacing"
    )]
    TooManyNodes {
        /// Length of the duct \[m\].
        length: f64,
        /// Depth of the duct \[m\].
        depth: f64,
        /// Nodes that the mesh would have.
        nodes: f64,
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
    /// The [`Progress`](crate::Progress) callback stopped the computation.
    #[error("stopped before it was done")]
    Stopped,
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
            Self::TooManyNodes { .. } => file.locate("duct.length"),
            // No mesh but one that the scene names is so coarse.
            Self::Cable(CableError::CoarseMesh { .. }) => file
                .locate("solver.node_spacing")
                .or_else(|| file.locate("solver.vehicle_step")),
            Self::Scene(SceneError::Value { key, .. }) => file.locate(key),
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
            | Self::TooManyNodes { .. }
            | Self::Ground(GroundError::InvalidParameter { .. } | GroundError::Unsupported { .. })
            | Self::Cable(
                CableError::InvalidParameter { .. }
                | CableError::UnsupportedLaw { .. }
                | CableError::CoarseMesh { .. },
            ) => true,
            _ => false,
        }
    }
}
