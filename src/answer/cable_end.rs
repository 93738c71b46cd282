//! The two ends of a cable.

use serde::{Deserialize, Serialize};

/// An end of the cable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CableEnd {
    /// x = 0.
    Upstream,
    /// x = length.
    Downstream,
}

impl CableEnd {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Upstream, Self::Downstream];

    /// Its name in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Upstream => "upstream",
            Self::Downstream => "downstream",
        }
    }
}
