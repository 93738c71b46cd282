//! The ground of the scene before, where the next one has the same.

use std::sync::{Arc, Mutex, PoisonError};

use crate::ground::{Ground, road};
use crate::scene::{self, TrafficVehicle};
use crate::{Error, Scene};

/// Gives each scene its ground, and the one of the scene before where nothing that it depends on differs.
#[derive(Debug, Default)]
pub struct KnownGround {
    last: Mutex<Option<(Site, Arc<Ground>)>>,
}

/// All that the motion of the duct depends on.
#[derive(Debug, Clone, PartialEq)]
struct Site {
    ground: scene::Ground,
    vehicles: Vec<TrafficVehicle>,
    /// Depth, distance to the side, reach and tolerance.
    numbers: [f64; 4],
}

impl Site {
    fn of(scene: &Scene) -> Self {
        Self {
            ground: scene.ground.clone(),
            vehicles: scene.vehicles.clone(),
            numbers: [
                scene.duct.depth,
                scene.duct.lateral_offset,
                road::reach(scene),
                scene.solver.tolerance,
            ],
        }
    }
}

impl KnownGround {
    /// The ground of `scene`.
    ///
    /// # Errors
    ///
    /// As for [`Ground::new`].
    pub fn of(&self, scene: &Scene) -> Result<Arc<Ground>, Error> {
        let last = || self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let site = Site::of(scene);
        let known = last().take_if(|(last, _)| *last == site);
        let ground = match known {
            Some((_, ground)) => ground,
            None => Arc::new(Ground::new(scene, None, road::reach(scene))?),
        };
        *last() = Some((site, Arc::clone(&ground)));
        Ok(ground)
    }
}
