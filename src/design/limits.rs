//! What is asked of a design, and what can be wrong with that.

use serde::{Deserialize, Serialize};

use crate::scene::{End, Restraint};
use crate::{Error, Limited, Limits, Scene};

/// Where a spring is put.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// At the upstream end, in place of what holds it in the scene.
    Upstream,
    /// At the downstream end, in place of what holds it in the scene.
    Downstream,
    /// A clamp at this position along the duct \[m\], beside what is in the scene.
    Clamp(f64),
}

/// Error of a design.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DesignError {
    /// A run of the scene failed.
    #[error(transparent)]
    Analysis(#[from] Error),
    /// A limit or a position that has no meaning.
    #[error("{name}: found {found}; allowed: {allowed}")]
    Invalid {
        /// What it is.
        name: &'static str,
        /// Its value.
        found: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A limit is crossed more than once as the stiffness grows.
    #[error(
        "the {what} crosses its limit {crossings} times as the stiffness grows: there is no single range of stiffness"
    )]
    NotMonotone {
        /// What is limited.
        what: String,
        /// How often.
        crossings: usize,
    },
    /// The stiffness at the limit of force or movement was not found, and why.
    #[error("the stiffness at the limit of {0} was not found")]
    Search(String, #[source] Box<dyn std::error::Error + Send + Sync>),
}

impl DesignError {
    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Analysis(error) => error.is_bad_input(),
            error => matches!(error, Self::Invalid { .. }),
        }
    }
}

/// Refuses limits that have no meaning, and none at all.
pub(super) fn check(limits: &Limits) -> Result<(), DesignError> {
    let mut none = true;
    for (_, quantity, limit) in limits.all() {
        none = false;
        positive(
            match quantity {
                Limited::Force => "limit of force",
                Limited::Movement => "limit of movement",
            },
            limit,
        )?;
    }
    if none {
        return Err(DesignError::Invalid {
            name: "number of limits",
            found: 0.0,
            allowed: "one or more",
        });
    }
    Ok(())
}

fn positive(name: &'static str, found: f64) -> Result<(), DesignError> {
    if found > 0.0 && found.is_finite() {
        return Ok(());
    }
    Err(DesignError::Invalid {
        name,
        found,
        allowed: "a finite number greater than 0",
    })
}

impl Place {
    pub(super) fn check(self, scene: &Scene) -> Result<(), DesignError> {
        match self {
            Self::Clamp(position) if !(0.0..=scene.duct.length).contains(&position) => {
                Err(DesignError::Invalid {
                    name: "position of the clamp",
                    found: position,
                    allowed: "a position in the duct, from 0 m to its length",
                })
            }
            _ => Ok(()),
        }
    }

    /// The scene with a spring of this stiffness \[N/m\] here: none at 0, and a fixed end at infinity.
    pub(super) fn held(self, scene: &Scene, stiffness: f64) -> Scene {
        let mut scene = scene.clone();
        let end = match stiffness {
            0.0 => End::Free,
            f64::INFINITY => End::Fixed,
            _ => End::Spring(stiffness),
        };
        match self {
            Self::Upstream => scene.ends.upstream = end,
            Self::Downstream => scene.ends.downstream = end,
            Self::Clamp(_) if stiffness == 0.0 => {}
            Self::Clamp(position) => scene.restraints.push(Restraint { position, stiffness }),
        }
        scene
    }
}
