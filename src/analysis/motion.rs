//! Motion of the duct under each of a scene's vehicles.

use ground_field::{DuctLine, DuctMotion, GroundField};

use crate::Error;
use crate::scene::{PeakScaling, Scene};

/// A ground model, and the accuracy to which the duct's motion follows it as a share of its peak.
pub struct Ground<'a> {
    pub field: &'a dyn GroundField,
    pub accuracy: f64,
}

impl<'a> Ground<'a> {
    pub fn new(field: &'a dyn GroundField, accuracy: f64) -> Self {
        Self { field, accuracy }
    }
}

/// The motion under every vehicle for |ξ| up to `reach` \[m\], scaled to a measured peak where the scene has one.
pub fn motions(scene: &Scene, ground: &Ground<'_>, reach: f64) -> Result<Vec<DuctMotion>, Error> {
    let line = DuctLine::new(scene.duct.depth, scene.duct.lateral_offset)?;
    let mut motions = Vec::new();
    for traffic in &scene.vehicles {
        motions.push(DuctMotion::new(
            ground.field,
            &traffic.vehicle,
            line,
            reach,
            ground.accuracy,
        )?);
    }
    scale(scene, motions)
}

fn scale(scene: &Scene, motions: Vec<DuctMotion>) -> Result<Vec<DuctMotion>, Error> {
    let factor = |wanted: f64, peak: f64, key: &'static str| {
        let factor = wanted / peak;
        if factor.is_finite() {
            Ok(factor)
        } else {
            Err(Error::Unfit {
                key,
                found: "a peak",
                reason: "the vehicle does not move the duct, so there is nothing to scale".into(),
            })
        }
    };
    match scene.ground.scaling {
        None => Ok(motions),
        Some(PeakScaling::Longitudinal(wanted)) => motions
            .into_iter()
            .map(|motion| {
                let factor = factor(wanted, motion.peak_longitudinal(), "ground.longitudinal_peak")?;
                Ok(motion.scaled(factor)?)
            })
            .collect(),
        Some(PeakScaling::Vertical(wanted)) => {
            let factor = factor(wanted, motions[0].peak_vertical(), "ground.vertical_peak")?;
            Ok(motions
                .into_iter()
                .map(|motion| motion.scaled(factor))
                .collect::<Result<_, _>>()?)
        }
    }
}
