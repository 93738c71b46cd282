//! Which model of the ground a scene gets.

use boussinesq::{HalfSpace, Odemark};
use burmister::LayeredHalfSpace;
use ground_field::GroundField;
use layered_fem::LayeredFem;

use crate::Error;
use crate::scene::{GroundModel, Scene};

/// Accuracy of the duct's motion as a share of its peak where the ground has a closed form. The cable feels the motion's
/// second derivative, and the closed forms give it away for a few hundred evaluations.
const CLOSED_FORM_ACCURACY: f64 = 1e-9;
/// The same for layers by Hankel transform; asked of the transform itself is a tenth of it.
const TRANSFORM_ACCURACY: f64 = 1e-7;
/// The same for a model of unknown smoothness.
const OWN_ACCURACY: f64 = 1e-6;
/// Tightest and loosest accuracy asked of finite elements, and the share of the tolerance they get.
const ELEMENTS_ACCURACY: (f64, f64) = (2e-4, 5e-3);
const ELEMENTS_SHARE: f64 = 0.25;

/// A ground model, its name in scene files, and why it was taken.
pub struct ChosenGround<'a> {
    pub field: Box<dyn GroundField + 'a>,
    pub name: &'static str,
    pub reason: &'static str,
    /// Accuracy to which the duct's motion follows it, as a share of its peak.
    pub accuracy: f64,
}

/// A model that the caller brings along.
pub fn own(field: &dyn GroundField) -> ChosenGround<'_> {
    ChosenGround {
        field: Box::new(field),
        name: "own",
        reason: "the caller's own model",
        accuracy: OWN_ACCURACY,
    }
}

/// The model the scene names, or the cheapest that represents its ground.
pub fn choose(scene: &Scene) -> Result<ChosenGround<'static>, Error> {
    let profile = &scene.ground.profile;
    let homogeneous = profile.homogeneous();
    let graded = profile.layers().iter().any(|layer| layer.soil().is_none());
    let asked = "the scene asks for it";
    let model = match scene.ground.model {
        GroundModel::Auto if homogeneous.is_some() => GroundModel::Boussinesq,
        GroundModel::Auto if graded => GroundModel::FiniteElements,
        GroundModel::Auto => GroundModel::Burmister,
        model => model,
    };
    let reason = |chosen| {
        if scene.ground.model == GroundModel::Auto {
            chosen
        } else {
            asked
        }
    };
    match model {
        GroundModel::Auto | GroundModel::Boussinesq => Ok(ChosenGround {
            field: Box::new(HalfSpace::new(homogeneous.ok_or(Error::Unfit {
                key: "ground.model",
                found: "boussinesq",
                reason: "its ground has layers or a rigid base, and this closed form knows one half-space only".into(),
            })?)),
            name: "boussinesq",
            reason: reason("the ground is one half-space, whose displacement has a closed form"),
            accuracy: CLOSED_FORM_ACCURACY,
        }),
        GroundModel::Odemark => Ok(ChosenGround {
            field: Box::new(Odemark::new(profile)?),
            name: "odemark",
            reason: asked,
            accuracy: TRANSFORM_ACCURACY,
        }),
        GroundModel::Burmister => Ok(ChosenGround {
            field: Box::new(LayeredHalfSpace::new(profile)?.with_accuracy(0.1 * TRANSFORM_ACCURACY)?),
            name: "burmister",
            reason: reason("the ground has layers or a rigid base, exact by Hankel transform"),
            accuracy: TRANSFORM_ACCURACY,
        }),
        GroundModel::FiniteElements => {
            let (tightest, loosest) = ELEMENTS_ACCURACY;
            let accuracy = (ELEMENTS_SHARE * scene.solver.tolerance).clamp(tightest, loosest);
            Ok(ChosenGround {
                field: Box::new(LayeredFem::new(profile, accuracy)?),
                name: "fem",
                reason: reason("a modulus that varies with depth needs finite elements"),
                accuracy,
            })
        }
    }
}
