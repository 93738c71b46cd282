//! The limits of every point, which may name clamps that not every point has.

use std::sync::Arc;

use creepage_run::{Error, Limits, Run, Verdict};
use creepage_scene::Scene;

/// The limits of a scene, or why it has none.
type Resolve = dyn Fn(&Scene) -> Result<Limits, String> + Send + Sync;

/// The limits of every point.
#[derive(Clone)]
pub struct PointLimits {
    /// What distinguishes them from others.
    name: String,
    of: Arc<Resolve>,
}

impl PointLimits {
    /// Limits by a `name`, under which a sweep is resumed, and what they are in a scene.
    pub fn new(
        name: impl Into<String>,
        of: impl Fn(&Scene) -> Result<Limits, String> + Send + Sync + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            of: Arc::new(of),
        }
    }

    /// What the `run` of `scene` makes of them.
    pub(super) fn verdicts(&self, run: &Run, scene: &Scene) -> Result<Vec<Verdict>, Error> {
        let unfit = |reason: String| Error::unfit("restraints", "a limit of a clamp", reason);
        Ok((self.of)(scene).map_err(unfit)?.verdicts(run))
    }
}

impl std::fmt::Debug for PointLimits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.name)
    }
}
