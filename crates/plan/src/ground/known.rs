//! Grounds that are known: scenes that differ in the cable alone share one.

use std::sync::{Arc, Mutex, PoisonError};

use super::model::Ground;
use super::road;
use crate::error::Error;
use creepage_scene::{self as scene, Scene, TrafficVehicle};

/// What a ground follows from: layers, vehicles; depth, offset and reach \[m\], and the tolerance.
type Site = (scene::Ground, Vec<TrafficVehicle>, [f64; 4]);

/// The grounds that were computed last, for any number of threads.
#[derive(Debug)]
pub struct KnownGrounds {
    most: usize,
    known: Mutex<Vec<(Site, Arc<Ground>)>>,
}

impl KnownGrounds {
    /// None as yet; at `most` so many are kept.
    pub fn new(most: usize) -> Self {
        let known = Mutex::default();
        Self { most, known }
    }

    /// The ground of `scene`; it is computed where none is known that is the same.
    ///
    /// # Errors
    ///
    /// As for [`Ground::new`].
    pub fn of(&self, scene: &Scene) -> Result<Arc<Ground>, Error> {
        let (duct, reach) = (&scene.duct, road::reach(scene));
        let numbers = [duct.depth, duct.lateral_offset, reach, scene.solver.tolerance];
        let site = (scene.ground.clone(), scene.vehicles.clone(), numbers);
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, ground)) = known().iter().find(|(known, _)| *known == site) {
            return Ok(Arc::clone(ground));
        }
        // Other threads may look meanwhile.
        let ground = Arc::new(Ground::new(scene, None, reach)?);
        let mut known = known();
        known.insert(0, (site, Arc::clone(&ground)));
        known.truncate(self.most);
        Ok(ground)
    }
}
