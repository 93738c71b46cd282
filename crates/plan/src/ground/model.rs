//! Which model of the ground a scene needs: the exact one, which is also the cheapest.
//!
//! One soil has a closed form, uniform layers a Hankel transform. A layer whose modulus varies is
//! cut into uniform sublayers, twice as many until the duct's motion is steady. The cable feels the
//! ground through that motion alone, and a motion costs the same whatever model it came from, so an
//! approximate ground would save nothing.

use boussinesq::HalfSpace;
use burmister::LayeredHalfSpace;
use ground_field::{DuctMotion, GroundField, SoilProfile};

use super::motion::{difference, motions};
use crate::error::Error;
use creepage_scene::{GroundModel, Scene};

/// Accuracy of the duct's motion as a share of its peak where the ground has a closed form. The
/// cable feels the motion's second derivative, and the closed forms give it away for a few hundred
/// evaluations.
const CLOSED_FORM_ACCURACY: f64 = 1e-9;
/// The same for layers by Hankel transform; asked of the transform itself is a tenth of it.
const TRANSFORM_ACCURACY: f64 = 1e-7;
/// The same for a model of unknown smoothness.
const OWN_ACCURACY: f64 = 1e-6;
/// Sublayers of a layer whose modulus varies, to begin with, and the most of all layers together.
const MIN_SUBLAYERS: usize = 16;
const MAX_LAYERS: usize = 1000;
/// Share of the tolerance that cutting a layer into sublayers may take.
const SUBLAYERS_SHARE: f64 = 0.05;
/// Midpoint moduli are of second order: the finer of two motions is off by a third of their
/// difference.
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
        let profile = &scene.ground.profile()?;
        let is_graded = profile.layers().iter().any(|layer| layer.soil().is_none());
        let automatic = scene.ground.model == GroundModel::Auto;
        let (name, field, accuracy, reason): (_, &dyn GroundField, _, _) = match (
            own,
            scene.ground.model,
            profile.homogeneous(),
        ) {
            (Some(own), _, _) => ("own", own, OWN_ACCURACY, "the caller's own model"),
            (_, GroundModel::Auto | GroundModel::Boussinesq, Some(soil)) => (
                "boussinesq",
                &HalfSpace::new(soil),
                CLOSED_FORM_ACCURACY,
                "the ground is one half-space, whose displacement has a closed form",
            ),
            (_, GroundModel::Boussinesq, None) => {
                let reason =
                    "its ground has layers or a rigid base, and this closed form knows one half-space only";
                return Err(Error::unfit("ground.model", "boussinesq", reason));
            }
            (_, GroundModel::Auto, None) if is_graded => return Self::graded(scene, profile, reach),
            (_, GroundModel::Auto | GroundModel::Burmister, _) => (
                "burmister",
                &layered(profile)?,
                TRANSFORM_ACCURACY,
                "the Hankel transform is exact for uniform layers",
            ),
            (_, GroundModel::FiniteElements, _) => {
                // A quarter of the tolerance is for the ground.
                let accuracy = (0.25 * scene.solver.tolerance).clamp(2e-4, 5e-3);
                ("fem", &elements(profile, accuracy)?, accuracy, "")
            }
        };
        let named = own.is_none() && !automatic;
        Ok(Self {
            name,
            reason: if named { "the scene asks for it" } else { reason },
            accuracy,
            motions: motions(scene, field, accuracy, reach)?,
        })
    }

    /// Uniform sublayers in the place of a modulus that varies.
    fn graded(scene: &Scene, profile: &SoilProfile, reach: f64) -> Result<Self, Error> {
        let sliced = |count| {
            let field = layered(&profile.sublayered(count, scene.duct.depth)?)?;
            motions(scene, &field, TRANSFORM_ACCURACY, reach)
        };
        let mut count = MIN_SUBLAYERS;
        let mut motions = sliced(count)?;
        loop {
            count *= 2;
            let finer = sliced(count)?;
            let error = difference(&motions, &finer, scene.duct.depth) / SECOND_ORDER;
            motions = finer;
            let most = 2 * count * profile.layers().len();
            if error <= SUBLAYERS_SHARE * scene.solver.tolerance || most > MAX_LAYERS {
                return Ok(Self {
                    name: "burmister",
                    reason: "the Hankel transform on uniform sublayers, twice as many until the motion is steady",
                    accuracy: error.max(TRANSFORM_ACCURACY),
                    motions,
                });
            }
        }
    }
}

fn layered(profile: &SoilProfile) -> Result<LayeredHalfSpace, Error> {
    Ok(LayeredHalfSpace::new(profile)?.with_accuracy(0.1 * TRANSFORM_ACCURACY)?)
}

#[cfg(feature = "fem")]
fn elements(profile: &SoilProfile, accuracy: f64) -> Result<layered_fem::LayeredFem, Error> {
    Ok(layered_fem::LayeredFem::new(profile, accuracy)?)
}

#[cfg(not(feature = "fem"))]
fn elements(_: &SoilProfile, _: f64) -> Result<HalfSpace, Error> {
    let reason = "this program was built without finite elements (feature `fem`)";
    Err(Error::unfit("ground.model", "fem", reason))
}
