//! The end of the cable at which a load cell sits.

use cable_dem::End;

#[cfg(feature = "plot")]
use crate::PassRecord;
use crate::{Error, Scene};

/// The end of the cable that pressed on the load cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CellEnd {
    Upstream,
    Downstream,
}

impl CellEnd {
    /// The end that is held in `scene`, the downstream one if both are.
    pub fn of(scene: &Scene) -> Result<Self, Error> {
        match (scene.ends.upstream, scene.ends.downstream) {
            (End::Free, End::Free) => Err(Error::Unfit {
                key: "ends",
                found: "both free",
                reason: "a load cell was at an end that is held".into(),
            }),
            (_, End::Free) => Ok(Self::Upstream),
            _ => Ok(Self::Downstream),
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Upstream => "upstream",
            Self::Downstream => "downstream",
        }
    }

    /// The force on it after a pass \[N\].
    #[cfg(feature = "plot")]
    pub fn force(self, record: &PassRecord) -> f64 {
        match self {
            Self::Upstream => record.upstream_force_n,
            Self::Downstream => record.downstream_force_n,
        }
    }
}
