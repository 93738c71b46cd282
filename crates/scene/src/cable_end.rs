//! The two ends of a cable.

use cable_dem::End;
use serde::{Deserialize, Serialize};

use crate::scene::Scene;

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

    /// What of two values belongs to it, that of the upstream end first.
    pub fn of<T>(self, [upstream, downstream]: [T; 2]) -> T {
        match self {
            Self::Upstream => upstream,
            Self::Downstream => downstream,
        }
    }

    /// How `scene` holds it.
    pub fn held_in(self, scene: &Scene) -> End {
        self.of([scene.ends.upstream, scene.ends.downstream])
    }

    /// Its name in scenes.
    pub fn name(self) -> &'static str {
        self.of(["upstream", "downstream"])
    }
}
