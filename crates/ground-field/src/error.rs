//! What can go wrong in the ground.

use std::error::Error;

/// Error of a ground model or of what is built on one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GroundError {
    /// A parameter is outside its range, or not a number.
    #[error("{name} = {value:?}: must be {allowed}")]
    InvalidParameter {
        /// The parameter's name.
        name: &'static str,
        /// What was given.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// The displacement has no finite value here, such as directly at a point load.
    #[error("{model}: the displacement has no finite value at radius {radius:?} m, depth {depth:?} m")]
    Singular {
        /// The ground model.
        model: &'static str,
        /// Horizontal distance from the load's axis \[m\].
        radius: f64,
        /// Depth below the surface \[m\].
        depth: f64,
    },
    /// The asked accuracy was not reached; no value is returned in its place.
    #[error(
        "{model}: error {reached:.1e} of the peak where {asked:.1e} was asked, at radius {radius:?} m, depth {depth:?} m"
    )]
    Accuracy {
        /// The ground model.
        model: &'static str,
        /// Asked error, as a share of the peak displacement at this depth.
        asked: f64,
        /// Estimated error that remains, as a share of the same peak.
        reached: f64,
        /// Horizontal distance from the load's axis \[m\].
        radius: f64,
        /// Depth below the surface \[m\].
        depth: f64,
    },
    /// The model cannot represent this ground.
    #[error("{model} cannot represent this ground: {limit}")]
    Unsupported {
        /// The ground model.
        model: &'static str,
        /// What it cannot represent.
        limit: &'static str,
    },
    /// A model's own error.
    #[error("{model} failed")]
    Model {
        /// The ground model.
        model: &'static str,
        /// Its error.
        source: Box<dyn Error + Send + Sync>,
    },
}

/// `value` if it is a finite number for which `holds`, or the error that says what is allowed: what a constructor does with its
/// arguments.
///
/// ```
/// let speed = ground_field::checked("speed", 11.1, "finite and positive", |v| v > 0.0)?;
/// assert_eq!(speed, 11.1);
/// assert!(ground_field::checked("speed", f64::NAN, "finite and positive", |v| v > 0.0).is_err());
/// # Ok::<(), ground_field::GroundError>(())
/// ```
///
/// # Errors
///
/// [`GroundError::InvalidParameter`].
#[inline]
pub fn checked(
    name: &'static str,
    value: f64,
    allowed: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<f64, GroundError> {
    if value.is_finite() && holds(value) {
        Ok(value)
    } else {
        Err(GroundError::InvalidParameter { name, value, allowed })
    }
}

/// Checks the place a ground model is asked about: radius and depth \[m\], both finite and not negative.
///
/// # Errors
///
/// [`GroundError::InvalidParameter`].
#[inline]
pub fn check_place(radius: f64, depth: f64) -> Result<(), GroundError> {
    let allowed = "finite and not negative";
    checked("radius", radius, allowed, |v| v >= 0.0)?;
    checked("depth", depth, allowed, |v| v >= 0.0)?;
    Ok(())
}
