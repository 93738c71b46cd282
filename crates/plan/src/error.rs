//! What can go wrong in an analysis.

use std::borrow::Cow;

use cable_dem::CableError;
use creepage_tables::TableError;
use cycle_jump::JumpError;
use ground_field::GroundError;

use crate::error_source::ErrorSource;
use crate::shown::{exact_percent, percent};
use creepage_scene::{Location, SceneError, SceneFile};

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
    /// A run cannot go on from a state.
    #[error("the state is not one of this duct: {reason}")]
    State {
        /// Why.
        reason: String,
    },
    /// Jumps over passes do not get on.
    #[error(
        "too many passes would have to be simulated; solver.method = \"quasi-static\" simulates every one, at most 1 000 000"
    )]
    Jumps(#[source] JumpError),
    /// A table, such as one of readings, is wrong.
    #[error(transparent)]
    Data(#[from] TableError),
    /// What is computed from many runs, such as a fit to readings, has failed.
    #[error("{error}")]
    Study {
        /// Why.
        #[source]
        error: Box<dyn std::error::Error + Send + Sync>,
        /// Whether its input is at fault.
        is_bad_input: bool,
    },
    /// The finest affordable mesh leaves too large an error.
    #[error(
        "the estimated error of {}, mainly of {}, is too far above the tolerance of {}: an error of more than 10 % is no answer; {}",
        percent(*.reached),
        cause.name(),
        exact_percent(*.asked),
        cause.remedy()
    )]
    Inaccurate {
        /// Estimated error, as a share of the forces.
        reached: f64,
        /// Tolerance asked.
        asked: f64,
        /// Without this there would be an answer; else the largest part of the error.
        cause: ErrorSource,
    },
    /// What came out is no answer: forces that do not balance, a number that is not finite.
    #[error("{reason}")]
    NoAnswer {
        /// Why.
        reason: String,
    },
    /// The duct is so long relative to its depth that no mesh of it can be computed.
    #[error(
        "duct.length = {length} m and duct.depth = {depth} m: found a mesh of {nodes:.1e} nodes, as fine as this depth needs; allowed: 5e6 \
         nodes, with a shorter or a deeper duct, a larger solver.tolerance, or a solver.node_spacing"
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
        found: Cow<'static, str>,
        /// Why it does not fit.
        reason: Cow<'static, str>,
    },
    /// The callback of progress stopped the computation.
    #[error("stopped before it was done")]
    Stopped,
    /// There is no pass whose answer is known.
    #[error("no pass was computed")]
    NoPass,
    /// An error whose cause stands in a scene file.
    #[error("{location}: {error}{}", .location.excerpt())]
    Located {
        /// Where.
        location: Box<Location>,
        /// The error, whose message is part of this one's.
        error: Box<Error>,
    },
}

impl From<JumpError> for Error {
    fn from(error: JumpError) -> Self {
        match error {
            JumpError::Cable(error) => Self::Cable(error),
            stuck => Self::Jumps(stuck),
        }
    }
}

/// The error's message with those of its causes. Some errors repeat their cause: it is not added
/// again.
pub fn with_causes(error: &dyn std::error::Error) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let text = error.to_string();
        if !message.contains(&text) {
            message = format!("{message}: {text}");
        }
        cause = error.source();
    }
    message
}

impl Error {
    /// [`Error::Unfit`] of this `key`, for a `reason`.
    pub fn unfit(
        key: &'static str,
        found: impl Into<Cow<'static, str>>,
        reason: impl Into<Cow<'static, str>>,
    ) -> Self {
        let (found, reason) = (found.into(), reason.into());
        Self::Unfit { key, found, reason }
    }

    /// This error with the line of the key at fault, where one is at fault and the scene came from
    /// `file`.
    #[must_use]
    pub fn located(self, file: &SceneFile) -> Self {
        let keys = match &self {
            // No mesh but one that the scene names is so coarse.
            Self::Cable(CableError::CoarseMesh { .. }) => vec!["solver.node_spacing", "solver.vehicle_step"],
            _ if self.location().is_some() => Vec::new(),
            _ => self.key().into_iter().collect(),
        };
        let Some(location) = keys.into_iter().find_map(|key| file.locate(key)) else {
            return self;
        };
        let (location, error) = (Box::new(location), Box::new(self));
        Self::Located { location, error }
    }

    /// Where in a scene file the cause stands, if it stands in one.
    pub fn location(&self) -> Option<&Location> {
        match self {
            Self::Scene(error) => error.location(),
            Self::Located { location, .. } => Some(location),
            _ => None,
        }
    }

    /// The scene's key at fault, if one is.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Scene(SceneError::Wrong(wrong)) => Some(&wrong.key),
            Self::Unfit { key, .. } => Some(key),
            Self::TooManyNodes { .. } => Some("duct.length"),
            Self::Located { error, .. } => error.key(),
            _ => None,
        }
    }

    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Located { error, .. } => error.is_bad_input(),
            Self::Study { is_bad_input, .. } => *is_bad_input,
            Self::Scene(_)
            | Self::Data(_)
            | Self::State { .. }
            | Self::Unfit { .. }
            | Self::TooManyNodes { .. }
            | Self::Ground(GroundError::InvalidParameter { .. } | GroundError::Unsupported { .. })
            | Self::Cable(
                CableError::InvalidParameter { .. }
                | CableError::NoRest { .. }
                | CableError::CoarseMesh { .. },
            ) => true,
            _ => false,
        }
    }
}
