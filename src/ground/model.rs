//! Which model of the ground a scene needs: the exact one, which is also the cheapest.
//!
//! One soil has a closed form, uniform layers a Hankel transform. A layer whose modulus varies is cut into uniform
//! sublayers, twice as many until the duct's motion is steady. The cable feels the ground through that motion alone, and a
//! motion costs the same whatever model it came from, so an approximate ground would save nothing.

use boussinesq::HalfSpace;
use burmister::LayeredHalfSpace;
use ground_field::{DuctMotion, GroundField, SoilProfile};

use super::motion::{difference, motions};
use crate::Error;
use crate::scene::{GroundModel, Scene};

/// Accuracy of the duct's motion as a share of its peak where the ground has a closed form. The cable feels the motion's
/// second derivative, and the closed forms give it away for a few hundred evaluations.
const CLOSED_FORM_ACCURACY: f64 = 1e-9;
/// The same for layers by Hankel transform; asked of the transform itself is a tenth of it.
const TRANSFORM_ACCURACY: f64 = 1e-7;
/// The same for a model of unknown smoothness.
const OWN_ACCURACY: f64 = 1e-6;
/// Sublayers of a layer whose modulus varies, to begin with, and the most of all layers together.
const FEWEST_SUBLAYERS: usize = 16;
const MOST_LAYERS: usize = 1000;
/// Share of the tolerance that cutting a layer into sublayers may take.
const SUBLAYERS_SHARE: f64 = 0.05;
/// Midpoint moduli are of second order: the finer of two motions is off by a third of their difference.
const SECOND_ORDER: f64 = 3.0;

/// The motion of the duct under every vehicle, and the model of the ground that gave it.
#[derive(Debug)]
pub struct Ground {
    pub name: &'static str,
    /// Why this model.
    pub reason: &'static str,
    /// Accuracy of the motions as a share of their peak.
    pub accuracy: f64,
    pub motions: Vec<DuctMotion>,
}

impl Ground {
    /// The ground of `scene`, or a model that the caller brings along, for |ξ| up to `reach` \[m\].
    pub fn new(scene: &Scene, own: Option<&dyn GroundField>, reach: f64) -> Result<Self, Error> {
        let named = "the scene asks for it";
        if let Some(field) = own {
            let reason = "the caller's own model";
            return Self::of_field(scene, "own", field, OWN_ACCURACY, reason, reach);
        }
        let profile = &scene.ground.profile()?;
        match scene.ground.model {
            GroundModel::Auto => match profile.homogeneous() {
                Some(soil) => {
                    let reason = "the ground is one half-space, whose displacement has a closed form";
                    let field = HalfSpace::new(soil);
                    Self::of_field(scene, "boussinesq", &field, CLOSED_FORM_ACCURACY, reason, reach)
                }
                None if is_graded(profile) => Self::graded(scene, reach),
                None => {
                    let reason = "the Hankel transform is exact for uniform layers";
                    Self::layered(scene, profile, reason, reach)
                }
            },
            GroundModel::Boussinesq => {
                let soil = profile.homogeneous().ok_or(Error::Unfit {
                    key: "ground.model",
                    found: "boussinesq",
                    reason: "its ground has layers or a rigid base, and this closed form knows one half-space only"
                        .into(),
                })?;
                let field = HalfSpace::new(soil);
                Self::of_field(scene, "boussinesq", &field, CLOSED_FORM_ACCURACY, named, reach)
            }
            GroundModel::Burmister => Self::layered(scene, profile, named, reach),
            GroundModel::FiniteElements => Self::elements(scene, named, reach),
        }
    }

    #[cfg(feature = "fem")]
    fn elements(scene: &Scene, reason: &'static str, reach: f64) -> Result<Self, Error> {
        // A quarter of the tolerance is for the ground.
        let accuracy = (0.25 * scene.solver.tolerance).clamp(2e-4, 5e-3);
        let field = layered_fem::LayeredFem::new(&scene.ground.profile()?, accuracy)?;
        Self::of_field(scene, "fem", &field, accuracy, reason, reach)
    }

    #[cfg(not(feature = "fem"))]
    fn elements(_: &Scene, _: &'static str, _: f64) -> Result<Self, Error> {
        Err(Error::Unfit {
            key: "ground.model",
            found: "fem",
            reason: "this program was built without finite elements (feature `fem`)".into(),
        })
    }

    fn of_field(
        scene: &Scene,
        name: &'static str,
        field: &dyn GroundField,
        accuracy: f64,
        reason: &'static str,
        reach: f64,
    ) -> Result<Self, Error> {
        Ok(Self {
            name,
            reason,
            accuracy,
            motions: motions(scene, field, accuracy, reach)?,
        })
    }

    fn layered(
        scene: &Scene,
        profile: &SoilProfile,
        reason: &'static str,
        reach: f64,
    ) -> Result<Self, Error> {
        let field = LayeredHalfSpace::new(profile)?.with_accuracy(0.1 * TRANSFORM_ACCURACY)?;
        Self::of_field(scene, "burmister", &field, TRANSFORM_ACCURACY, reason, reach)
    }

    /// Uniform sublayers in the place of a modulus that varies.
    fn graded(scene: &Scene, reach: f64) -> Result<Self, Error> {
        let reason = "the Hankel transform on uniform sublayers, twice as many until the motion is steady";
        let profile = &scene.ground.profile()?;
        let sliced = |count| {
            Self::layered(
                scene,
                &profile.sublayered(count, scene.duct.depth)?,
                reason,
                reach,
            )
        };
        let mut count = FEWEST_SUBLAYERS;
        let mut ground = sliced(count)?;
        loop {
            count *= 2;
            let finer = sliced(count)?;
            let error = difference(&ground.motions, &finer.motions, scene.duct.depth) / SECOND_ORDER;
            ground = Self {
                accuracy: error.max(TRANSFORM_ACCURACY),
                ..finer
            };
            let most = 2 * count * profile.layers().len();
            if error <= SUBLAYERS_SHARE * scene.solver.tolerance || most > MOST_LAYERS {
                return Ok(ground);
            }
        }
    }
}

fn is_graded(profile: &SoilProfile) -> bool {
    profile.layers().iter().any(|layer| layer.soil().is_none())
}
