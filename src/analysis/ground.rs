//! Which model of the ground a scene gets.

use boussinesq::HalfSpace;
use ground_field::GroundField;

use crate::Error;
use crate::scene::{Ground, GroundModel};

/// A ground model, its name in scene files, and why it was taken.
pub struct ChosenGround {
    pub field: Box<dyn GroundField>,
    pub name: &'static str,
    pub reason: String,
}

/// The model the scene names, or the cheapest that represents its ground.
pub fn choose(ground: &Ground) -> Result<ChosenGround, Error> {
    let unfit = |found, reason| Error::Unfit {
        key: "ground.model",
        found,
        reason,
    };
    match (ground.model, ground.profile.homogeneous()) {
        (GroundModel::Auto | GroundModel::Boussinesq, Some(soil)) => Ok(ChosenGround {
            field: Box::new(HalfSpace::new(soil)),
            name: "boussinesq",
            reason: "the ground is one half-space, whose displacement has a closed form".into(),
        }),
        (GroundModel::Boussinesq, None) => Err(unfit(
            "boussinesq",
            "its ground has layers or a rigid base, and this closed form knows one half-space only",
        )),
        (GroundModel::Auto, None) => Err(unfit(
            "auto",
            "no model of this version represents layered ground",
        )),
        (GroundModel::Odemark, _) => Err(unfit("odemark", "not in this version")),
        (GroundModel::Burmister, _) => Err(unfit("burmister", "not in this version")),
        (GroundModel::FiniteElements, _) => Err(unfit("fem", "not in this version")),
    }
}
