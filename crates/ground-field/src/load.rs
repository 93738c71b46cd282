//! A vertical load on the road surface.

use crate::GroundError;
use crate::error::checked;

/// A vertical load on the surface: a point load, or uniform pressure on a disc.
///
/// ```
/// use ground_field::SurfaceLoad;
///
/// let wheel = SurfaceLoad::new(49e3, 0.15)?;
/// assert!((wheel.pressure() - 693e3).abs() < 1e3);
/// assert!(SurfaceLoad::point(49e3)?.is_point());
/// assert!(SurfaceLoad::point(f64::NAN).is_err());
/// # Ok::<(), ground_field::GroundError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceLoad {
    force: f64,
    contact_radius: f64,
}

impl SurfaceLoad {
    /// A load of `force` \[N\], positive downward, spread evenly over a disc of `contact_radius` \[m\].
    /// Radius 0 is a point load.
    ///
    /// # Errors
    ///
    /// [`GroundError::InvalidParameter`] unless both are finite and not negative.
    pub fn new(force: f64, contact_radius: f64) -> Result<Self, GroundError> {
        let allowed = "finite and not negative";
        Ok(Self {
            force: checked("force", force, allowed, |v| v >= 0.0)?,
            contact_radius: checked("contact_radius", contact_radius, allowed, |v| v >= 0.0)?,
        })
    }

    /// A point load of `force` \[N\], positive downward.
    ///
    /// # Errors
    ///
    /// As for [`SurfaceLoad::new`].
    pub fn point(force: f64) -> Result<Self, GroundError> {
        Self::new(force, 0.0)
    }

    /// Force \[N\], positive downward.
    pub fn force(self) -> f64 {
        self.force
    }

    /// Radius of the loaded disc \[m\]; 0 for a point load.
    pub fn contact_radius(self) -> f64 {
        self.contact_radius
    }

    /// Whether the load acts on a single point.
    pub fn is_point(self) -> bool {
        self.contact_radius == 0.0
    }

    /// Contact pressure \[Pa\]; infinite for a point load.
    pub fn pressure(self) -> f64 {
        self.force / (std::f64::consts::PI * self.contact_radius * self.contact_radius)
    }
}
