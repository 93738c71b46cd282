//! The ground of the scene before, where the next one has the same.

use std::sync::Arc;

use crate::ground::{Ground, road};
use crate::{Error, Scene};

/// The last scene whose ground was computed, and that ground.
#[derive(Default)]
pub struct KnownGround(Option<(Scene, Arc<Ground>)>);

impl KnownGround {
    /// The ground of `scene`: that of the scene before where nothing differs that the motion of the
    /// duct depends on.
    ///
    /// # Errors
    ///
    /// As for [`Ground::new`].
    pub fn of(&mut self, scene: &Scene) -> Result<Arc<Ground>, Error> {
        if let Some((last, ground)) = &self.0
            && is_same_site(last, scene)
        {
            return Ok(Arc::clone(ground));
        }
        let ground = Arc::new(Ground::new(scene, None, road::reach(scene))?);
        self.0 = Some((scene.clone(), Arc::clone(&ground)));
        Ok(ground)
    }
}

fn is_same_site(a: &Scene, b: &Scene) -> bool {
    let numbers = |scene: &Scene| {
        let (duct, tolerance) = (&scene.duct, scene.solver.tolerance);
        [duct.depth, duct.lateral_offset, road::reach(scene), tolerance]
    };
    a.ground == b.ground && a.vehicles == b.vehicles && numbers(a) == numbers(b)
}
