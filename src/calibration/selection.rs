//! What is fitted, as far as scenes and readings allow.

use super::options::{CalibrateOptions, Series};
use super::unknown::{Quantity, Unknown};
use crate::Error;
use crate::scene::FrictionLaw;

/// What is fitted, checked against the scenes.
pub fn unknowns(series: &[Series<'_>], options: &CalibrateOptions<'_>) -> Result<Vec<Unknown>, Error> {
    if series.is_empty() {
        return Err(Error::Unfit {
            key: "series",
            found: "none",
            reason: "there is nothing to fit".into(),
        });
    }
    let mut unknowns = options.unknowns.clone();
    let coulomb = |unknown: &Unknown| {
        series
            .iter()
            .enumerate()
            .any(|(index, one)| unknown.acts_on(index) && one.scene.friction.law == FrictionLaw::Coulomb)
    };
    if unknowns.is_empty() {
        unknowns.push(Unknown::shared(Quantity::DynamicCoefficient));
        let shape_factor = Unknown::shared(Quantity::ShapeFactor);
        if !coulomb(&shape_factor) {
            unknowns.push(shape_factor);
        }
    }
    let ground = Unknown::shared(Quantity::GroundStiffness);
    if options.deflection.is_some() && !unknowns.contains(&ground) {
        unknowns.push(ground);
    }
    if unknowns
        .iter()
        .any(|unknown| unknown.quantity == Quantity::ShapeFactor && coulomb(unknown))
    {
        return Err(Error::Unfit {
            key: "friction.law",
            found: "coulomb",
            reason: "it has no shape factor to be fitted".into(),
        });
    }
    if unknowns
        .iter()
        .any(|unknown| unknown.series.is_some_and(|index| index >= series.len()))
    {
        return Err(Error::Unfit {
            key: "unknowns",
            found: "a series of a higher index than there are",
            reason: "series are counted from 0".into(),
        });
    }
    if let [only] = series {
        let free = unknowns.len() - usize::from(options.deflection.is_some());
        let needed = match only.readings.sigmas() {
            Some(_) => free.max(1),
            None => (free + 1).max(2),
        };
        only.readings.check_count(unknowns.len(), needed)?;
    }
    Ok(unknowns)
}
